# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that an operator made: selected, and put where one sees them."""


def select_made(context, made):
    """Select what was made and nothing else, as Blender does with new objects; not in edit mode."""
    if not made or context.mode != "OBJECT":
        return
    context.view_layer.update()
    for thing in context.selected_objects:
        thing.select_set(False)
    shown = [thing for thing in made if thing.name in context.view_layer.objects]
    for thing in shown:
        thing.select_set(True)
    if shown:
        context.view_layer.objects.active = shown[0]


def bring_into_view_layer(context, made):
    """Link what was made of an axis also to the collection of the scene, where the view layer leaves out the
    collections of that axis: there Blender neither shows nor evaluates it."""
    context.view_layer.update()
    if made.name not in context.view_layer.objects:
        context.scene.collection.objects.link(made)
        context.view_layer.update()
