# SPDX-License-Identifier: GPL-3.0-or-later
"""Small bugs in the Python of the core, at least one in each of its rooms: the tests are measured by them.

A mutation replaces `old`, which occurs exactly once in its file, by `new`. `sweep_python.py` makes each and runs the
test files that it names, in their order.
"""

from pathlib import Path

from mutations import Mutation

SOURCES = Path("blender_addon/core")


class PythonMutation(Mutation):
    """`file` is below blender_addon/core; `python` names the test files that most likely notice the bug."""

    @property
    def path(self) -> Path:
        return SOURCES / self.file


def _bug(file: str, old: str, new: str, breaks: str, *tests: str) -> PythonMutation:
    return PythonMutation(file, old, new, breaks, tests)


MUTATIONS = (
    # ---- mid_surface
    _bug(
        "mid_surface/few_faces.py",
        "if not _are_uneven(sheets).any():",
        "if _are_uneven(sheets).all():",
        "balls where sheets meet are as large as the thickest",
        "test_mid_surface.py",
    ),
    _bug(
        "mid_surface/thin_sheets.py",
        "uses[of.reshape(-1)] == 1",
        "uses[of.reshape(-1)] >= 1",
        "triangles that lie on each other stay",
        "test_mid_surface.py",
    ),
    _bug(
        "mid_surface/thin_sheets.py",
        "of_corner.astype(np.int64) * parts",
        "of_corner * parts",
        "numbers of edges and pieces have 32 bits",
        "test_mid_surface.py",
    ),
    _bug(
        "mid_surface/mid_surface.py",
        "dot(sheets.at_corners[own[nearest]], weights)",
        "dot(sheets.at_corners[nearest], weights)",
        "sheets have the thickness of others",
        "test_mid_surface.py",
    ),
    _bug(
        "mid_surface/mid_surface.py",
        "_CURVED * float(thickness)",
        "_CURVED * float(sheets.at_corners.max())",
        "edges of sheets that thin out are as long as they are thick at most",
        "test_mid_surface.py",
    ),
    # ---- samples
    _bug(
        "samples/walls.py",
        "wide & (feature_size >= _MIDDLE * self.distance)",
        "wide & (feature_size >= 2.0 * self.distance)",
        "no sample is on a plate",
        "test_walls.py",
    ),
    _bug(
        "samples/walls.py",
        "self.bulge + corners / 2 > np",
        "self.bulge > np",
        "facets between curved walls have no corners",
        "test_walls.py",
    ),
    _bug(
        "samples/next_amount.py",
        "(doubted & walls.are_of_sheets & (bends > CROSSED))",
        "(doubted & (bends > CROSSED))",
        "edges of thin bars are taken for those of walls",
        "test_thin_radii.py",
    ),
    _bug(
        "samples/next_amount.py",
        "        return CROSSED\n",
        "        return 0.0\n",
        "pairs cross at rounded edges again",
        "test_pairs.py",
    ),
    # ---- machine
    _bug(
        "machine/cache.py",
        'part.dtype.str} {part.shape};".encode()',
        'part.dtype.str} {part.size};".encode()',
        "keys ignore the shape of an array",
        "test_cache.py",
    ),
    _bug(
        "machine/cache.py",
        "self._kept.popitem(last=False)",
        "self._kept.popitem(last=True)",
        "the newest analysis is dropped first",
        "test_cache.py",
        "test_memory.py",
        "test_skeleton.py",
    ),
    _bug(
        "machine/memory_limit.py",
        "if needed > room:",
        "if needed > 2 * room:",
        "an analysis may need twice the limit",
        "test_memory.py",
    ),
    _bug(
        "machine/free_memory.py",
        "return max(0, most - used + (",
        "return max(0, most - used - (",
        "memory that can be dropped counts as used twice",
        "test_memory.py",
    ),
    # ---- samples
    _bug(
        "samples/thinning.py",
        "key=lambda step: len(np.unique(cells(step)))) - 1",
        "key=lambda step: len(np.unique(cells(step))))",
        "a thinned cloud has more points than the limit allows",
        "test_memory.py",
    ),
    _bug(
        "samples/choose_samples.py",
        '"seed": settings.seed,',
        '"seed": 0,',
        "the seed does not reach the sampling",
        "test_cache.py",
    ),
    _bug(
        "samples/density.py",
        "return bool(self.at_edge.all()) or self.share <= _DENSE_ENOUGH",
        "return bool(self.at_edge.any()) or self.share <= _DENSE_ENOUGH",
        "one sample at a sharp edge makes all samples dense enough",
        "test_density.py",
        "test_sampling.py",
    ),
    _bug(
        "samples/noise.py",
        "heads = near[:, [1, 2, 2, 0, 0, 1]].ravel()",
        "heads = near[:, [1, 2, 2, 0, 0, 0]].ravel()",
        "noise misses one of the neighbours",
        "test_noise.py",
    ),
    _bug(
        "shape/shape.py",
        "self.points[self.triangles[:, corner]] - self.points[0] for corner",
        "self.points[self.triangles[:, corner]] for corner",
        "the volume is measured from the origin",
        "test_shape.py",
    ),
    _bug(
        "samples/buried_samples.py",
        "    if shape.volume < 0:\n",
        "    if shape.volume > 0:\n",
        "buried samples are left out only where faces point inward",
        "test_sampling.py",
        "test_solid_difference.py",
        "test_messy_meshes.py",
    ),
    # ---- axis
    _bug(
        "axis/cut.py",
        "large[0] = True",
        "large[-1] = True",
        "the smallest piece always stays, not the largest",
        "test_cut.py",
    ),
    _bug(
        "axis/clip.py",
        "ascent = (axis.radius[end] - length) * (axis.radius[end] + length) - near * near",
        "ascent = (axis.radius[end] - length) * (axis.radius[end] + length) + near * near",
        "the balls of facets that were cut do not touch the samples",
        "test_clip.py",
    ),
    _bug(
        "axis/colours.py",
        "return largest, min(float(np.min(radii)), largest / 2)",
        "return largest, max(float(np.min(radii)), largest / 2)",
        "the colour scale cuts small radii off",
        "test_colours.py",
    ),
    _bug(
        "axis/verdict.py",
        "if isinstance(warning, Severe):",
        "if isinstance(warnings[0], Severe):",
        "only the first warning can be severe",
        "test_verdict.py",
    ),
    _bug(
        "axis/topology.py",
        "torn = betti[0] > by_faces[0]",
        "torn = betti[0] >= by_faces[0]",
        "an axis of as many pieces as the faces counts as torn",
        "test_hierarchy.py",
        "test_forms.py",
        "test_sampling.py",
    ),
    # ---- solid
    _bug(
        "thickness/thin_parts.py",
        "thin = found.of_triangles < limit - found.slack",
        "thin = found.of_triangles <= limit + found.slack",
        "a wall as thick as the limit is thin",
        "test_thickness.py",
    ),
    _bug(
        "thickness/thin_parts.py",
        "np.where(large, np.cumsum(large) - 1, -1)",
        "np.where(large, np.cumsum(large), -1)",
        "patches are numbered from 1",
        "test_thickness.py",
    ),
    _bug(
        "thickness/measurement.py",
        "np.minimum(np.maximum(a, b), c))",
        "np.maximum(np.maximum(a, b), c))",
        "the length of a triangle is the maximum, not the median",
        "test_thickness.py",
    ),
    _bug(
        "thickness/close_walls.py",
        "convex & (turned < -cosine(_ACUTE))",
        "~convex & (turned < -cosine(_ACUTE))",
        "wedges of air hide close walls, and wedges of the solid do not",
        "test_close_walls.py",
        "test_thickness.py",
    ),
    _bug(
        "thickness/bounded_lengths.py",
        "torn[walls.faces[~used[walls.sample]]] = True",
        "torn[walls.faces[used[walls.sample]]] = True",
        "close walls without triangles are not shown",
        "test_close_walls.py",
    ),
    _bug(
        "thickness/bounded_lengths.py",
        "removed = on_torn[surface.triangles].all(axis=1) & np.isfinite(surface.at_most)",
        "removed = on_torn[surface.triangles].all(axis=1) & np.isinf(surface.at_most)",
        "close walls on torn faces are there twice",
        "test_close_walls.py",
    ),
    _bug(
        "cover/ball_cover.py",
        "settings = replace(settings, side=Side.INNER)",
        "settings = replace(settings)",
        "balls may be those of the outside",
        "test_ball_cover.py",
        "test_cache.py",
        "test_balls_cli.py",
    ),
    _bug(
        "thickness/thickness_colours.py",
        "found = np.where(lengths < self.limit, below, above)",
        "found = np.where(lengths <= self.limit, below, above)",
        "what is as thick as the limit has the colours of what is thinner",
        "test_thickness.py",
        "test_colours.py",
    ),
    # ---- skeleton
    _bug(
        "curves/rules.py",
        "np.minimum(net.radius[ends], net.radius[tip])",
        "net.radius[ends] + net.radius[tip]",
        "fingers beside each other are one limb",
        "test_skeleton.py",
    ),
    _bug(
        "skeleton/fill.py",
        "    decide(smooth, lips[~hidden[lips]])\n",
        "",
        "the wall of a bore stays at the lip of a slanted mouth",
        "test_fill.py",
    ),
    _bug(
        "skeleton/fill.py",
        "+ int(np.argmax(ends)) if ends.any() else len(chain) - 1",
        "+ len(ends) - 1",
        "limbs go on into the corners between lids and walls",
        "test_fill.py",
    ),
    _bug(
        "skeleton/chords.py",
        "/ tolerance[inner]",
        "/ tolerance[first]",
        "one tolerance decides about a whole chain",
        "test_skeleton.py",
    ),
    _bug(
        "rig/names.py",
        'found.append({".L": number, ".R": other})',
        'found.append({".R": number, ".L": other})',
        "left and right are exchanged",
        "test_skeleton.py",
    ),
    _bug(
        "skeleton/mirror.py",
        "image[..., 0] = 2.0 * plane - image[..., 0]",
        "image[..., 0] = plane - image[..., 0]",
        "images lie at the wrong side of a plane that is not at 0",
        "test_skeleton.py",
    ),
    _bug(
        "skeleton/branches.py",
        "if found is None and len(triangles) < len(faces.triangles):",
        "if False:",
        "cross-sections are sought among the faces near a branch alone",
        "test_branches.py",
    ),
    _bug(
        "skeleton/sections.py",
        "if len(rows) > 2 and end == 2 * segment:",
        "if len(rows) > 2:",
        "cuts that are not closed count as a cross-section",
        "test_branches.py",
    ),
    _bug(
        "rig/weights.py",
        "weight[rows, hangs_on] += (block - left).sum(axis=1)",
        "weight[rows, hangs_on] += block.sum(axis=1)",
        "a parent gets weight that its child keeps",
        "test_skeleton.py",
    ),
    # ---- files
    _bug(
        "files/placing.py",
        "sizes[0] - sizes[2] > rounding",
        "sizes[0] - sizes[1] > rounding",
        "a transform that flattens is accepted",
        "test_export.py",
        "test_skeleton.py",
    ),
    _bug(
        "files/stl.py",
        "return corners[first[order]], place[inverse.ravel()]",
        "return corners[first[order]], inverse.ravel()",
        "triangles of an STL file have the wrong corners",
        "test_import.py",
        "test_import_meshes.py",
    ),
    _bug(
        "files/dae.py",
        "if _tag(child) in _MOVES][::-1]",
        "if _tag(child) in _MOVES]",
        "the transforms of a node come in the wrong order",
        "test_import_meshes.py",
    ),
    _bug(
        "files/dae.py",
        "places = metres * np.concatenate(points)",
        "places = np.concatenate(points)",
        "lengths of a COLLADA file are no metres",
        "test_import_meshes.py",
        "test_robot.py",
    ),
    _bug(
        "files/off.py",
        "places = (table[:, first : first + 3] for first in (3, 6, 7))",
        "places = (table[:, first : first + 3] for first in (3, 6))",
        "normals after four columns of colours are not found",
        "test_import.py",
        "test_import_meshes.py",
        "test_broken_files.py",
        "test_readers.py",
    ),
    _bug(
        "files/writing.py",
        "            temporary.unlink(missing_ok=True)\n",
        "",
        "a write that failed leaves its temporary file",
        "test_export.py",
        "test_batch_faults.py",
        "test_cli.py",
    ),
    # ---- batch
    _bug(
        "batch/frames.py",
        "range(int(first), int(last or first) + 1, int(step or 1))",
        "range(int(first), int(last or first), int(step or 1))",
        "the last frame is left out",
        "test_cli.py",
    ),
    _bug(
        "batch/outputs.py",
        "return found | {(status.st_dev, status.st_ino)}",
        "return found",
        "a hard link to an input may be replaced",
        "test_cli.py",
        "test_batch_faults.py",
        "test_balls_cli.py",
        "test_thickness_cli.py",
    ),
    _bug(
        "batch/batch.py",
        "limit = self.limit if thinned else None",
        "limit = None",
        "a thinned output is kept when the memory limit changes",
        "test_cli.py",
        "test_memory.py",
        "test_batch_faults.py",
    ),
)
