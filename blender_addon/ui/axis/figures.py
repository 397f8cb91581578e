# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of a result in the panel: the important ones in a few rows, and all of them."""

import bpy

from ...bridge.axis import axis_object, report_object
from ...bridge.mesh import stored
from ...bridge.mesh.colours import colour_range
from ...bridge.objects.source_state import has_changed
from ...bridge.thickness.heat_map import shown_heat
from ...bridge.thickness.thickness_object import scale_on
from ...core.axis.topology import betti_in_short
from ...core.axis.verdict import Light, in_short
from ...core.samples.density import share_text
from ..base import manual
from ..base.legend import draw_legend, draw_thickness_legend, light
from ..base.plain_words import draw_told, warned
from ..base.show import shows_colours
from ..base.translation import say
from ..base.wrapped_text import counted, draw_wrapped
from ..settings.guide import WHY
from ..settings.properties import needs_analysis
from .inward_faces import draw_inward_faces


def draw_result(context, layout, result):
    """Its verdict, its pieces and its radii, a row each; where its colours are shown, their legend has the radii."""
    if reason := why_outdated(context, result):
        layout.label(text=reason, icon_value=light(Light.LOOK.name))
    else:
        _draw_verdict(context, layout, result)
    _draw_pieces(context, layout, result)
    if hidden := result.get(stored.HIDDEN, 0):
        draw_wrapped(context, layout, f"{hidden:,} facets hidden", "INFO")
    if crumbs := result.get(stored.CRUMBS, 0):
        text = "1 crumb hidden" if crumbs == 1 else f"{crumbs:,} crumbs hidden"
        draw_wrapped(context, layout, text, "INFO")
    if lone := result.get(stored.LONE_POINTS, 0):
        text = "1 lone point hidden" if lone == 1 else f"{lone:,} lone points hidden"
        draw_wrapped(context, layout, text, "INFO")
    if not _draw_legend(context, layout, result):
        _draw_radii(context, layout, axis_object.radius_range(result))


def draw_sequence(context, layout, frame):
    """The radii of a frame of a sequence, whose colours are those of all its frames."""
    _draw_name(layout, frame)
    _draw_radii(context, layout, (frame[stored.RADIUS_MIN], frame[stored.RADIUS_MAX]))
    _draw_legend(context, layout, frame)


def draw_report(context, layout, report):
    """Draws how dense the samples are."""
    _draw_name(layout, report)
    limit = report.get(stored.EPSILON_LIMIT, 0.0)
    share = share_text(report.get(stored.EPSILON_SHARE, 0.0))
    draw_wrapped(context, layout, f"{share} is sparse: epsilon above {limit:g}", "INFO")
    for warning in report.get(stored.WARNINGS, "").splitlines():
        draw_told(context, layout, warning, "ERROR", warned)
    _draw_legend(context, layout, report)


def draw_details(context, layout, result):
    """All other figures of a result, and every sentence."""
    numbers = {
        "points": result.get(stored.POINTS, 0),
        "duplicates": result.get(stored.DUPLICATES, 0),
        "facets": len(result.data.polygons),
        "unbounded": result.get(stored.UNBOUNDED, 0),
        "without area": result.get(stored.ZERO_AREA, 0),
        "vertices": len(result.data.vertices),
        "without an exact place": result.get(stored.REFUSED, 0),
    }
    seconds = f"{result.get(stored.SECONDS, 0.0):.2f} s"
    draw_wrapped(context, layout, f"{counted(numbers)}, {seconds}", "MESH_DATA")
    sentences = (stored.TOPOLOGY, stored.SAMPLED, stored.DENSITY, stored.INSIDE)
    for name in (*sentences, stored.SOURCE_MESH, stored.PLACES):
        if sentence := result.get(name):
            draw_wrapped(context, layout, sentence, "INFO")
    for warning in result.get(stored.WARNINGS, "").splitlines():
        draw_wrapped(context, layout, warning, "ERROR")
    draw_inward_faces(layout, result)


def draw_report_details(context, layout, report):
    """All other figures of a report."""
    _draw_name(layout, report)
    median, most = (report.get(name, 0.0) for name in (stored.EPSILON_MEDIAN, stored.EPSILON_P95))
    worst = (report.get(stored.EPSILON_WORST) or [0.0])[0]
    at_edges = share_text(report.get(stored.EPSILON_SHARE_OF_ALL, 0.0))
    text = f"Epsilon: median {median:.2f}, 95 % below {most:.2f}, at most {worst:.2g}"
    draw_wrapped(context, layout, f"{text}; with sharp edges {at_edges} is sparse", "INFO")
    draw_wrapped(context, layout, report.get(stored.SAMPLED, ""), "INFO")


def draw_surface(context, layout, surface):
    """The figures of a reconstructed surface, and what looks wrong with it."""
    _draw_name(layout, surface)
    numbers = {
        "points": surface.get(stored.POINTS, 0),
        "duplicates": surface.get(stored.DUPLICATES, 0),
        "off the surface": surface.get(stored.OFF_SURFACE, 0),
        "triangles": len(surface.data.polygons),
        "non-manifold edges": surface.get(stored.NONMANIFOLD_EDGES, 0),
        "non-manifold points": surface.get(stored.NONMANIFOLD_VERTICES, 0),
        "cavities": surface.get(stored.CAVITIES, 0),
    }
    draw_wrapped(context, layout, counted(numbers), "MESH_DATA")
    for warning in surface.get(stored.WARNINGS, "").splitlines():
        draw_told(context, layout, warning, "ERROR", warned)


def _draw_verdict(context, layout, result):
    """Draws the traffic light with a few words, and the link to the page of the manual that explains them."""
    name = result.get(stored.LIGHT)
    if name not in WHY:  # of an older version
        return
    row = layout.row(align=True)
    words = in_short(result[stored.VERDICT])
    draw_wrapped(context, row, words, icon_value=light(name), beside=20)
    if manual.has(WHY[name].partition("#")[0]):
        row.operator("wm.medial_axis_why", text="", icon="QUESTION", emboss=False).light = name


def _draw_pieces(context, layout, result):
    """Draws how many pieces, loops and cavities there are, with a tick where the faces have as many."""
    betti = result.get(stored.BETTI, (result.get(stored.PIECES, 0), 0, 0))
    agrees = result.get(stored.TOPOLOGY, "").endswith(", as the solid")
    icon = "CHECKMARK" if agrees else "MESH_DATA"
    draw_wrapped(context, layout, ", ".join(map(say, betti_in_short(betti))), icon)


def why_outdated(context, result):
    """Why the shown result no longer belongs to its source and settings, or an empty string."""
    if stored.DRAFT in result:
        return "A draft, of few samples"
    if has_changed(result, context.view_layer.depsgraph):
        return "The source has changed"
    if needs_analysis(result, context.scene.medial_axis):
        return "Settings have changed"
    return ""


def _draw_legend(context, layout, thing):
    """The range of the colours that are shown, while they are seen; returns whether they are."""
    if not shows_colours(context.space_data):
        return False
    if axis_object.is_result(thing) and (carrier := shown_heat(thing)):
        draw_thickness(context, layout, carrier)
        return True
    found = colour_range(thing)
    if found is None:
        return False
    name, start, end = found
    if name == report_object.EPSILON.name:
        draw_legend(layout, f"{start:.2g}", f"{end:.2g}")
        return True
    low, high = length_text(context, end), length_text(context, start)
    is_one = _range_text(context, *axis_object.radius_range(thing)) == high
    draw_legend(layout, "" if is_one else low, high, turned=True)
    return True


def draw_thickness(context, layout, carrier):
    """The legend of a thickness, with the shares of the surface."""
    scale = scale_on(carrier)
    if scale is None:
        return
    low, limit, high = (length_text(context, x) for x in (scale.low, scale.limit, scale.high))
    middle = limit if scale.limit > scale.low else ""
    draw_thickness_legend(
        layout, scale, list(carrier[stored.THICKNESS_HISTOGRAM]), (low, middle, high)
    )


def _draw_radii(context, layout, radii):
    row = layout.split(factor=0.25)
    row.label(text="Radius")
    row.label(text=say(_range_text(context, *radii)), translate=False)


def _range_text(context, smallest, largest):
    """Two lengths, or one where they read the same."""
    start, end = (length_text(context, value) for value in (smallest, largest))
    return start if start == end else f"{start} to {end}"


def length_text(context, value):
    """A length in the unit of the scene."""
    units = context.scene.unit_settings
    if units.system == "NONE":
        return f"{value:.3g}"
    return bpy.utils.units.to_string(
        units.system, "LENGTH", value * units.scale_length, precision=3
    )


def _draw_name(layout, thing):
    layout.label(text=thing.name, icon="OUTLINER_OB_MESH", translate=False)
