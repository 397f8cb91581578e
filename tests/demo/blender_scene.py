# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of a medial axis: camera, light, and a surface like thin glass round the coloured axis."""

import math
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

VIEW = Vector((0.62, -1.0, 0.42))  # from the shape to the camera
SUN = Vector((-0.3, -0.8, 1.0))  # from the shape to the light
PIXELS = (800, 600)
SAMPLES = 24


def arrange(source, result, shine=True):
    """Set up everything that `bpy.ops.render.render` needs. Without `shine` the surface has no highlight, which would
    show each triangle of a mesh of many flat ones."""
    source.data.materials.clear()
    source.data.materials.append(glass(shine))
    source.visible_shadow = source.visible_diffuse = source.visible_glossy = False
    result.show_in_front = False
    show_whole(source)


def show_whole(*things):
    """Set up camera, light and renderer for a picture with the whole of some objects."""
    points = np.concatenate([world_points(thing) for thing in things])
    look_at(*bounding_ball(points), points)
    light()
    use_cycles()


def world_points(thing):
    """(n, 3) vertices with modifiers, in the world."""
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    matrix = np.array(thing.matrix_world)
    return points.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3]


def bounding_ball(points):
    center = (points.min(axis=0) + points.max(axis=0)) / 2
    return Vector(center), float(np.linalg.norm(points - center, axis=1).max())


def look_at(center, radius, points):
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera
    camera.data.lens = 70
    camera.data.clip_start, camera.data.clip_end = radius / 100, radius * 100
    camera.rotation_euler = VIEW.to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.render.resolution_x, bpy.context.scene.render.resolution_y = PIXELS
    bpy.context.view_layer.update()
    graph = bpy.context.evaluated_depsgraph_get()
    camera.location, _ = camera.camera_fit_coords(graph, points.ravel().tolist())
    camera.location += VIEW.normalized() * 0.12 * (camera.location - center).length  # a margin


def render(picture):
    bpy.context.scene.render.filepath = str(Path(picture).resolve())
    bpy.ops.render.render(write_still=True)


def light():
    """A soft sun, a fill light without shadows, light from everywhere, and a white background darker below."""
    for name, direction, energy, shadow in (("Sun", SUN, 1.6, True), ("Fill", VIEW, 1.5, False)):
        lamp = bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN"))
        lamp.data.energy = energy
        lamp.data.angle = math.radians(8)
        lamp.data.cycles.cast_shadow = shadow
        lamp.rotation_euler = direction.to_track_quat("Z", "Y").to_euler()
        bpy.context.scene.collection.objects.link(lamp)
    world = bpy.data.worlds.new("White")
    bpy.context.scene.world = world
    world.use_nodes = True
    nodes, links = world.node_tree.nodes, world.node_tree.links
    nodes.clear()
    ambient, seen = (nodes.new("ShaderNodeBackground") for _ in range(2))
    ambient.inputs[0].default_value = (0.85, 0.92, 1.0, 1.0)
    ambient.inputs[1].default_value = 0.6
    height = nodes.new("ShaderNodeSeparateXYZ")
    links.new(nodes.new("ShaderNodeTexCoord").outputs["Window"], height.inputs[0])
    shade = nodes.new("ShaderNodeValToRGB")
    shade.color_ramp.elements[0].color = (0.74, 0.79, 0.86, 1.0)
    shade.color_ramp.elements[1].color = (0.98, 0.985, 1.0, 1.0)
    links.new(height.outputs[1], shade.inputs[0])
    links.new(shade.outputs[0], seen.inputs[0])
    switch = nodes.new("ShaderNodeMixShader")
    links.new(nodes.new("ShaderNodeLightPath").outputs["Is Camera Ray"], switch.inputs[0])
    links.new(ambient.outputs[0], switch.inputs[1])
    links.new(seen.outputs[0], switch.inputs[2])
    links.new(switch.outputs[0], nodes.new("ShaderNodeOutputWorld").inputs[0])


def glass(shine=True):
    """Clear where the surface faces the camera, tinted where it turns away, with a highlight if wanted; no back side.

    Made of transparency and emission alone, which Cycles draws without noise. Sockets are linked by index:
    their names differ between versions.
    """
    material = bpy.data.materials.new("Surface")
    material.use_nodes = True
    material.blend_method = "BLEND"
    material.diffuse_color = (0.55, 0.7, 0.9, 0.15)
    tree = material.node_tree
    tree.nodes.clear()
    new, link = tree.nodes.new, tree.links.new
    clear, tint = new("ShaderNodeBsdfTransparent"), new("ShaderNodeEmission")
    tint.inputs[0].default_value = (0.30, 0.48, 0.75, 1.0)
    turned = new("ShaderNodeLayerWeight")
    turned.inputs[0].default_value = 0.2
    rim = map_range(new, link, turned.outputs[1], 0.06, 0.75)
    body = mix(new, link, rim, clear.outputs[0], tint.outputs[0])
    if shine:
        white = new("ShaderNodeEmission")
        body = mix(new, link, highlight(new, link), body, white.outputs[0])
    behind = new("ShaderNodeNewGeometry").outputs["Backfacing"]
    front = mix(new, link, behind, body, clear.outputs[0])
    link(front, new("ShaderNodeOutputMaterial").inputs[0])
    return material


def painted(name, colour):
    """A plain material of one colour."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    surface = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    surface.inputs["Base Color"].default_value = colour
    return material


def map_range(new, link, value, low, high):
    node = new("ShaderNodeMapRange")
    node.inputs[3].default_value, node.inputs[4].default_value = low, high
    link(value, node.inputs[0])
    return node.outputs[0]


def mix(new, link, factor, first, second):
    node = new("ShaderNodeMixShader")
    link(factor, node.inputs[0])
    link(first, node.inputs[1])
    link(second, node.inputs[2])
    return node.outputs[0]


def highlight(new, link):
    """0 to 0.8: how nearly the surface mirrors the sun into the camera."""
    halfway = (VIEW.normalized() + SUN.normalized()).normalized()
    dot = new("ShaderNodeVectorMath")
    dot.operation = "DOT_PRODUCT"
    dot.inputs[1].default_value = halfway
    link(new("ShaderNodeNewGeometry").outputs["Normal"], dot.inputs[0])
    power = new("ShaderNodeMath")
    power.operation = "POWER"
    power.use_clamp = True
    power.inputs[1].default_value = 90.0
    link(dot.outputs["Value"], power.inputs[0])
    return map_range(new, link, power.outputs[0], 0.0, 0.8)


def use_cycles():
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = SAMPLES
    scene.cycles.use_adaptive_sampling = True
    scene.cycles.adaptive_threshold = 0.03
    scene.cycles.use_denoising = False  # Debian's Blender has no denoiser
    scene.cycles.max_bounces = 0
    scene.cycles.transparent_max_bounces = 32
    scene.cycles.min_transparent_bounces = 32  # else rays end by chance, which shows as grain
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "PNG"
