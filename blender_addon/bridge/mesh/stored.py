# SPDX-License-Identifier: GPL-3.0-or-later
"""The custom properties that outputs store in a file, in one table: files of users hold these names, which stay."""

from __future__ import annotations


def of_option(name: str) -> str:
    """Return the property of an option of the analysis or of the look."""
    return f"ma_{name}"


# Every output
SOURCE = "ma_source"  # a pointer: it follows when either of the two is renamed
VERSION = "ma_version"
POINTS = "ma_points"
DUPLICATES = "ma_duplicates"
WARNINGS = "ma_warnings"
SAMPLED = "ma_sampled"  # what was analysed, and why: a sentence
DENSITY = "ma_density"  # how densely that lies: a sentence
SECONDS = "ma_seconds"
WRITTEN = "ma_written"  # when an object and its mesh were written between two steps of undo
OF_PART = "ma_of_part"  # the connected part of the source, as in the name of the object
SOURCE_STATE = "ma_source_state"  # a hash of the shape
SOURCE_SCALE = "ma_source_scale"  # scale, shear and mirror, 9 numbers
# The numbers at the first and at the last colour of the scale, and the name of the attribute that was coloured
COLOUR_START, COLOUR_END, COLOUR_OF = "ma_color_start", "ma_color_end", "ma_color_of"
RADIUS_MIN, RADIUS_MAX = "ma_radius_min", "ma_radius_max"

# Medial axes
ANALYSIS = "ma_analysis"
DRAFT = "ma_draft"  # there where a quick answer with few samples is shown; the exact one takes its place
ASKED = "ma_asked"  # the options of the analysis as they were asked for; Automatic may have chosen others
INSIDE = "ma_inside"  # how inside was distinguished from outside, and why: a sentence
UNBOUNDED = "ma_unbounded"
ZERO_AREA = "ma_zero_area"
BOX = "ma_box"  # of the samples: three lowest coordinates, three highest
PIECES = "ma_pieces"
CRUMBS = "ma_crumbs_hidden"  # pieces that are not there because they are crumbs
HIDDEN = "ma_hidden"  # facets that are not there because of the look
LIGHT = "ma_light"
VERDICT = "ma_verdict"  # the sentence that matters most
ONLY_RATIO, ONLY_ANGLE = (
    "ma_only_ratio",
    "ma_only_angle",
)  # shares of the facets that one condition keeps alone
BETTI = "ma_betti"  # pieces, loops and cavities; only of clean forms and curves
TOPOLOGY = "ma_topology"  # the same in a sentence
PLACES = "ma_places"  # a sentence: where balls end; only of clean forms and curves
REFUSED = "ma_refused"  # vertices at which no ball fits the faces
SOURCE_MESH = (
    "ma_source_mesh"  # a sentence: the connected parts of the source, and how they were read
)
TURNED = "ma_turned"  # triangles of the source that looked inward and were read the other way round
# The ranges of sliders
RANGES = {
    "simplify": "ma_simplify_range",
    "erode": "ma_erode_range",
    "spike": "ma_spike_range",
    "limb": "ma_limb_range",
}
REMOVALS = "ma_removals"  # how many loops and branches of a curve Detail can leave out
SIMPLIFY_GAP = "ma_simplify_gap"  # a length, in percent of the diagonal
STRUCTURE = "ma_structure"  # what `Structure` has of parts, curves and nodes, as JSON
STRUCTURE_COUNTS = "ma_structure_counts"  # sheets, seams, rims, creases, junctions, corners
WIRES = "ma_wires"  # how many edges without a face and single points a result has
LONE_POINTS = "ma_lone_points_hidden"  # how many single points of a result are not shown
WIRES_DETAIL = "ma_wires_detail"  # Sides and Subdivisions as they were set by the numbers of wires
PART_NUMBER = "ma_part_number"  # of the part that an object is
REDUCED = "ma_reduced"  # the wanted number of vertices; it marks the object

# Reports of samples
EPSILON_LIMIT = "ma_epsilon_limit"
EPSILON_MEDIAN, EPSILON_P95 = "ma_epsilon_median", "ma_epsilon_p95"
EPSILON_SHARE, EPSILON_SHARE_OF_ALL = "ma_epsilon_share", "ma_epsilon_share_of_all"
EPSILON_WORST, EPSILON_WORST_PLACES = "ma_epsilon_worst", "ma_epsilon_worst_places"

# Skeletons, armatures and sequences
ENDS, LOOPS, BRANCHES = "ma_ends", "ma_loops", "ma_branches"
MIRRORED = "ma_mirrored"
LIMB_LINE = "ma_line"  # on the curve of a limb: a pointer to the source
BONES = "ma_bones"
MADE_BONE = "ma_bone"  # on each bone that was made here: the name that it got then, which an artist may change
RIG_FRAME = "ma_rig_frame"  # the frame of the rig that the armature has now
BOUND_GROUPS = "ma_groups"  # the vertex groups that were made here, a name per line
BONE_GROUP = "ma_group"  # on a bone: its group there; Blender renames groups with their bones
BOUND_WEIGHTS = "ma_weights"  # a hash of the weights in them
SEQUENCE = "ma_sequence"
SEQUENCE_FORMAT = "ma_sequence_format"  # collections of earlier versions lack it: theirs is AXES
SEQUENCE_FRAME = "ma_frame"

# Thickness
THICKNESS_KEY = "ma_thickness_key"  # names the measurement
THICKNESS_MINIMUM = "ma_thickness_minimum"
THICKNESS_LIMIT = "ma_thickness_limit"
THICKNESS_AREA, THICKNESS_SHARE = "ma_thickness_area", "ma_thickness_share"
THICKNESS_GAP = "ma_thickness_gap"
THICKNESS_NORMALS = "ma_thickness_normals"  # where they come from: a sentence
THICKNESS_PATCHES = "ma_thickness_patches"  # how many
THICKNESS_PLACES = (
    "ma_thickness_places"  # of the thinnest patches: x, y, z in the own frame, area, minimum
)
THICKNESS_PLACE = "ma_thickness_place"  # x, y, z of the minimum
THICKNESS_LOCAL = "ma_thickness_local"  # from the measured frame to that of the carrier, 16 numbers
THICKNESS_ON_SOURCE = "ma_thickness_on_source"  # whether the source has the attributes, too
THICKNESS_SCALE = "ma_thickness_scale"  # low, limit and high of its ThicknessScale
THICKNESS_HISTOGRAM = "ma_thickness_histogram"  # shares of the area with each colour of the legend
THICKNESS_CURRENT = "ma_thickness_current"  # the patch that was framed last; -1: none
THICKEN_GROUP = "ma_thicken_group"  # on the source: the vertex group that was made here

# Other products
OFF_SURFACE = "ma_off_surface"  # points that are not on a reconstructed surface
NONMANIFOLD_EDGES, NONMANIFOLD_VERTICES = "ma_nonmanifold_edges", "ma_nonmanifold_vertices"
CAVITIES = "ma_cavities"
REBUILT = "ma_rebuilt"  # marks the object
REBUILT_MEAN, REBUILT_LARGEST = "ma_rebuilt_mean", "ma_rebuilt_largest"
REBUILT_VOLUME = "ma_rebuilt_volume"
HOLLOW_WALL, HOLLOW_LEAST = "ma_hollow_wall", "ma_hollow_least"
SOLID_WALL, SOLID_LEAST = "ma_solid_wall", "ma_solid_least"
MID_SHEETS, MID_SHARE = "ma_mid_sheets", "ma_mid_share"
THICK_FACES = "ma_thick_faces"
BALLS_MODE, BALLS_COVERED = "ma_balls_mode", "ma_balls_covered"
BALLS_OUTSIDE, BALLS_FARTHEST = "ma_balls_outside", "ma_balls_farthest"
BALLS_WRITTEN = "ma_balls_written"  # identifies the balls to which the figures belong
NODES, CAPSULES = "ma_nodes", "ma_capsules"  # identify our groups after someone renamed them
