# SPDX-License-Identifier: GPL-3.0-or-later
"""One-line faults, one for each thing that a stage has to get right: what the tests are measured by.

A mutation replaces `old`, which occurs exactly once in its file, by `new`. `sweep.py` builds each and runs the tests.
`python` names the test files that are asked when the native tests notice nothing. `equivalent` says why no test can
notice a mutation: it changes no result.
"""

from dataclasses import dataclass
from pathlib import Path

SOURCES = Path("native/medial")


@dataclass(frozen=True)
class Mutation:
    file: str  # below native/medial; the methods of others are below lab/native
    old: str
    new: str
    breaks: str
    python: tuple[str, ...] = ()
    equivalent: str = ""

    @property
    def path(self) -> Path:
        return (Path("lab/native") if self.file.startswith("rivals/") else SOURCES) / self.file

    def applied(self, text: str) -> str:
        """The source with the mutation. Raises ValueError if `old` does not occur once."""
        count = text.count(self.old)
        if count != 1:
            raise ValueError(
                f"Expected one occurrence of {self.old!r} in {self.path}, found {count}; "
                "bring the mutation up to date."
            )
        return text.replace(self.old, self.new)


MUTATIONS = (
    # ---- base
    Mutation("base/rows.cpp", "  x[2] ^= x[1];", "  x[2] ^= x[0];", "the Hilbert curve jumps"),
    Mutation(
        "base/rows.cpp",
        "if (distinct.points.empty() || distinct.points.back() != p) {",
        "if (distinct.points.size() < rows.size()) {",
        "repeated rows are samples of their own",
    ),
    Mutation(
        "base/union_find.h",
        "if (a < b) std::swap(a, b);\n    parent_[a]",
        "if (a > b) std::swap(a, b);\n    parent_[a]",
        "the highest id stands for a set",
    ),
    Mutation(
        "base/filtered_kernel.h",
        "0x1p-47 * error",
        "0x1p-67 * error",
        "twice the digits count as more than they are",
    ),
    Mutation(
        "base/exact_integer.h",
        "const int shift = last_bit(x);",
        "const int shift = last_bit(x) + 1;",
        "integers of doubles lose the last digit",
    ),
    Mutation(
        "base/polygon_edges.cpp",
        "corner + 1 < end ? corner + 1 : begin",
        "corner + 1 < end ? corner + 1 : corner",
        "polygons are not closed",
    ),
    # ---- delaunay
    Mutation(
        "delaunay/samples.cpp",
        "centre + 2 * radius * direction",
        "centre + 1.5 * radius * direction",
        "the bounding sphere is too narrow",
    ),
    Mutation(
        "delaunay/samples.cpp",
        "(3 - std::sqrt(5.0))",
        "(3 - std::sqrt(4.0))",
        "the bounding sphere is uneven",
    ),
    Mutation(
        "delaunay/triangulation.cpp",
        "const int slot = rank[j] ^ (odd & (rank[j] >> 1));",
        "const int slot = rank[j] ^ (odd & (rank[j] >> 2));",
        "cells lose their orientation",
    ),
    Mutation(
        "delaunay/circumcentre.cpp",
        "constexpr double kOperations = 16;",
        "constexpr double kOperations = 1;",
        "the error bound is 16 times too small",
        equivalent="The bound is generous: of 17 million random cells, fat ones, flat ones and needles, none had an "
        "error of more than 0.058 of it, less than a sixteenth. Only how many cells are computed in integers changes.",
    ),
    Mutation(
        "delaunay/circumcentre.cpp",
        "constexpr double kOperations = 16;",
        "constexpr double kOperations = 0.0625;",
        "the error bound is 256 times too small",
    ),
    Mutation(
        "delaunay/circumcentre.cpp",
        "vv * cross(w, u) + ww",
        "vv * cross(u, w) + ww",
        "circumcentres are wrong",
    ),
    Mutation(
        "delaunay/circumcentre.cpp",
        "const Integer denominator = 2 * dot(u, vw);",
        "const Integer denominator = dot(u, vw);",
        "circumcentres of flat cells are wrong",
    ),
    Mutation(
        "delaunay/circumcentre.cpp",
        "return {exact_normal(a, b, c), 4 * DBL_EPSILON};",
        "return {exact_normal(a, c, b), 4 * DBL_EPSILON};",
        "normals of needles look the other way",
    ),
    Mutation(
        "delaunay/voronoi.cpp",
        "return squared_length(d) <= error * error;",
        "return squared_length(d) < 0 * error;",
        "cospherical cells keep Voronoi vertices of their own",
    ),
    Mutation(
        "delaunay/voronoi.cpp",
        "  unite(vertices, same_ray_pairs(t, found, vertices));\n",
        "",
        "cocircular triangles of the hull keep rays of their own",
    ),
    Mutation(
        "delaunay/voronoi.cpp",
        "unit_normal(points[j], points[l], points[k])",
        "unit_normal(points[j], points[k], points[l])",
        "Voronoi rays lead inwards",
    ),
    Mutation(
        "delaunay/edges.h",
        "{{-1, 2, 3, 1}, {3, -1, 0, 2}",
        "{{-1, 3, 1, 2}, {3, -1, 0, 2}",
        "facets turn the other way round",
    ),
    Mutation(
        "delaunay/edges.cpp",
        "int{row_[q] > row_[p]}",
        "int{row_[q] < row_[p]}",
        "edges begin at their higher row",
    ),
    Mutation(
        "delaunay/edges.cpp",
        "for (auto cell = cells.rbegin(); cell != cells.rend(); ++cell) {",
        "for (auto cell = cells.begin(); cell != cells.end(); ++cell) {",
        "unbounded facets are not known as such",
    ),
    # ---- axis
    Mutation(
        "axis/poles.cpp",
        "if (squared_length(v) > squared_length(farthest)) farthest = v;",
        "if (squared_length(v) >= squared_length(farthest)) farthest = v;",
        "of equally far Voronoi vertices the last one is the pole",
    ),
    Mutation(
        "axis/poles.cpp",
        "if (squared_length(v) > squared_length(farthest)) farthest = v;",
        "if (squared_length(v) < squared_length(farthest) || farthest == Vec3{}) farthest = v;",
        "poles are the nearest Voronoi vertices",
    ),
    Mutation(
        "axis/poles.cpp",
        "  sort_unique(rays);\n",
        "  std::sort(rays.begin(), rays.end());\n",
        "an infinite edge counts as often as triangles share it",
    ),
    Mutation(
        "axis/poles.cpp",
        "if (found == Vec3{}) found = to_farthest_vertex",
        "if (finite == cells.size()) found = to_farthest_vertex",
        "no farthest vertex where the infinite directions cancel out",
        equivalent="The directions at a sample are normals of the hull there. The hull of samples that span a volume "
        "has an inside, into which none of these points, so their sum is not zero.",
    ),
    Mutation(
        "axis/umbrellas.cpp",
        "pole) >= 0 ? Height::above : Height::below",
        "pole) > 0 ? Height::above : Height::below",
        "a Voronoi vertex in the tangent plane counts as below",
    ),
    Mutation(
        "axis/umbrellas.cpp",
        "      if (i == own || height_[next] != Height::above) continue;",
        "      if (i == own || height_[next] == Height::above) continue;",
        "umbrellas are of the edges that do not cross the plane",
    ),
    Mutation(
        "axis/significance.cpp",
        "end.sine = std::min(end.sine, std::abs(",
        "end.sine = std::max(end.sine * (i > begin), std::abs(",
        "theta is the maximum over the umbrella, not the minimum",
    ),
    Mutation(
        "axis/significance.cpp",
        "std::max(result.radius[p], circumradius(",
        "std::min(result.radius[p] == 0 ? HUGE_VAL : result.radius[p], circumradius(",
        "rho compares with the smallest circumradius",
    ),
    Mutation(
        "axis/edge_ends.h",
        "result.sine_both[e] = std::min(at_p.sine, at_q.sine);",
        "result.sine_both[e] = std::max(at_p.sine, at_q.sine);",
        "the rule Both is content with one end",
    ),
    Mutation(
        "axis/significance.cpp",
        "  if (q.umbrella) bits",
        "  if (false && q.umbrella) bits",
        "edges of the umbrella of q are tried from there",
    ),
    Mutation(
        "axis/significance.cpp",
        "p_rho = p.ratio >= q.ratio;",
        "p_rho = p.sine >= q.sine;",
        "the wrong end is left out of the Ratio condition",
    ),
    Mutation(
        "axis/selection.cpp",
        "sine_ = largest_sine(wanted.thresholds.theta);",
        "sine_ = largest_sine(1.05 * wanted.thresholds.theta);",
        "theta0 is stricter than was asked for",
    ),
    Mutation(
        "axis/selection.cpp",
        "t.rule) > sine_;",
        "t.rule) >= sine_;",
        "theta0 is met, not exceeded",
    ),
    Mutation(
        "axis/selection.cpp",
        "t.rule) > t.rho;",
        "t.rule) >= t.rho;",
        "rho0 is met, not exceeded",
    ),
    Mutation(
        "axis/selection.cpp",
        "return try_larger && try_smaller ? smaller : 0;",
        "return try_larger || try_smaller ? smaller : 0;",
        "the rule Both holds where one end is not tried",
    ),
    Mutation(
        "axis/selection.cpp",
        "std::sqrt(std::sqrt(epsilon))",
        "std::sqrt(epsilon)",
        "the exponent of Definition 4",
    ),
    Mutation(
        "axis/selection.cpp",
        "wanted_.limit_set && !satisfies_angle(edge);",
        "wanted_.limit_set;",
        "Definition 4 is asked of the Angle condition, too",
    ),
    Mutation(
        "rivals/size_selection.cpp",
        "if (size(edge) < least_length_)",
        "if (size(edge) <= least_length_)",
        "the length of lambda is exceeded, not reached",
    ),
    Mutation(
        "rivals/size_selection.cpp",
        "largest = std::max(largest, radius);",
        "largest = radius;",
        "one ball alone is asked for its angle",
    ),
    Mutation(
        "rivals/pole_balls.cpp",
        "squared_length(v) > most)",
        "squared_length(v) > 2 * most)",
        "balls at poles are not the farthest",
    ),
    Mutation(
        "rivals/power_shape.cpp",
        "return std::all_of(",
        "return std::any_of(",
        "one wanted ball is enough for a simplex of the power shape",
    ),
    Mutation(
        "axis/medial_mesh.cpp",
        "(!is_wide(polygon_",
        "(false && !is_wide(polygon_",
        "facets on a line are emitted",
        python=("test_on_a_line.py",),
    ),
    Mutation(
        "axis/medial_mesh.cpp",
        "if (polygon_.size() < 3 ||",
        "if (polygon_.size() < 4 ||",
        "triangular facets are left out",
    ),
    Mutation(
        "axis/medial_mesh.cpp",
        "std::rotate(begin, std::min_element(begin, end), end);",
        "std::rotate(begin, std::max_element(begin, end), end);",
        "polygons begin at their highest vertex",
    ),
    Mutation(
        "axis/feature_size.cpp",
        "std::ldexp(std::sqrt(3.0) / kThinning, -level)",
        "std::ldexp(std::sqrt(3.0) / (16 * kThinning), -level)",
        "too many vertices are left out of the feature size",
        python=("test_feature_size.py",),
    ),
    # ---- inside
    Mutation(
        "inside/boundary.cpp",
        "out.push_back({other, id});",
        "out.push_back({id, other});",
        "edges of the border run the wrong way",
    ),
    Mutation(
        "inside/solid_angle.cpp",
        "const double error = 3 * node.spread",
        "const double error = 0.003 * node.spread",
        "the remainder of the expansion is underrated",
        python=("test_sides.py",),
    ),
    Mutation(
        "inside/ray_crossings.cpp",
        "if ((volume > 0) != leaves) return 0;",
        "if (std::abs(volume) > 0 && false) return 0;",
        "what lies behind the origin of a ray counts",
    ),
    Mutation(
        "inside/ray_crossings.cpp",
        "if ((end > 0) == leaves) return 0;",
        "if ((end > 0) != leaves) return 0;",
        "segments end at the wrong place",
    ),
    Mutation(
        "inside/winding_number.cpp",
        "return drop ? closed_there - *drop : closed(query);",
        "return drop ? closed_there + *drop : closed(query);",
        "a winding number is told from another by the wrong sign",
    ),
    Mutation(
        "inside/winding_number.cpp",
        "return caps_.is_below(closed_here - 0.5, query);",
        "return caps_.is_below(closed_here - 0.6, query);",
        "inside begins at a winding number of 0.6",
    ),
    Mutation(
        "inside/sides.cpp",
        "return ball > widest && distance_to_samples(points, t, voronoi, f) > widest;",
        "return distance_to_samples(points, t, voronoi, f) > widest;",
        "the flood goes on without the test of the ball",
        equivalent="The other distance is never larger: it is that of a nearer place of the Voronoi edge that begins "
        "in the middle of the ball. The test of the ball only saves time.",
    ),
    Mutation(
        "inside/sides.cpp",
        "return ball > widest && distance_to_samples(points, t, voronoi, f) > widest;",
        "return ball > 0 * widest;",
        "the flood passes through the surface",
    ),
    Mutation(
        "inside/sides.cpp",
        "return circumradius < longest / 3 ? circumradius : longest / 3;",
        "return circumradius < longest / 12 ? circumradius : longest / 12;",
        "triangles are taken for narrower than they are",
        python=("test_sides.py", "test_sides_from.py"),
    ),
    Mutation(
        "inside/sides.cpp",
        "if (vote < 0) sides[c]",
        "if (vote > 0) sides[c]",
        "normals vote the wrong way",
    ),
    Mutation(
        "inside/sides.cpp",
        "outward < 0 ? Side::inner : Side::outer",
        "outward < 0 ? Side::outer : Side::outer",
        "far away is outside though the normals look inwards",
    ),
    Mutation(
        "inside/sides.cpp",
        "sides[c] = like < 0 ? solid[last] : sides[like];",
        "sides[c] = like < 0 ? solid[c] : sides[like];",
        "a Voronoi vertex has the side of its cell, wherever it lies",
    ),
    Mutation(
        "inside/sides.cpp",
        "return inner == ring.size() ? Side::inner",
        "return 2 * inner > ring.size() ? Side::inner",
        "a facet is inner when most of its vertices are",
    ),
    Mutation(
        "inside/buried.cpp",
        "above.is_inside(points[row] + step) == below",
        "above.is_inside(points[row] + step) != below",
        "what bounds something is taken for buried",
        python=("test_sampling.py",),
    ),
    Mutation(
        "inside/level_set.cpp",
        "corner.inside = winding.is_inside(corner.at, corner.closed);",
        "corner.inside = corner.closed > 0;",
        "the caps are taken for the level set",
    ),
    Mutation(
        "inside/level_set.cpp",
        "return drop && *drop == 0;",
        "return drop.has_value();",
        "the level set is followed through triangles",
    ),
    Mutation(
        "inside/level_set.cpp",
        "if (!in->inside) std::swap(in, out);",
        "if (in->inside) std::swap(in, out);",
        "falls begin outside",
    ),
    Mutation(
        "inside/walls.cpp",
        "depth += hit.cosine > 0 ? -1 : 1;",
        "depth -= 1;",
        "the way to a wall ends where it enters another part",
    ),
    Mutation(
        "inside/walls.cpp",
        "return hit.cosine >= kFacing ? hit.at : HUGE_VAL;",
        "return hit.at;",
        "walls at a slant count",
    ),
    Mutation(
        "inside/solid_betti.cpp",
        "++betti[volume[v] > 0 ? 0 : 2];",
        "++betti[0];",
        "cavities are counted as pieces",
    ),
    Mutation(
        "inside/solid_betti.cpp",
        "if (!is_fan(triangles, fans[v], v)) return std::nullopt;",
        "if (fans[v].size() < 3) return std::nullopt;",
        "pinched surfaces have Betti numbers",
    ),
    Mutation(
        "inside/pockets.cpp",
        "points_[corners[0]]) <= hole;",
        "points_[corners[0]]) <= 0 * hole;",
        "pockets stay",
    ),
    Mutation(
        "inside/pockets.cpp",
        "return winding.is_inside_along(from, to + offset);",
        "return winding.is_inside_along(to + offset, to + offset);",
        "small bodies are taken for pockets",
        python=("test_pockets.py",),
    ),
    # ---- cocone
    Mutation(
        "cocone/cocone.cpp",
        "const bool meet = here != there || here == Zone::in_cocone;",
        "const bool meet = here == Zone::in_cocone || there == Zone::in_cocone;",
        "Voronoi edges that cross the whole cocone do not meet it",
    ),
    Mutation(
        "cocone/cocone.cpp",
        "return width < HUGE_VAL && reaches(p, ratio * ratio * width, s);",
        "return width < HUGE_VAL && reaches(p, ratio * width, s);",
        "flatness asks for a thinner ratio",
    ),
    Mutation(
        "cocone/cocone.cpp",
        "all = all && agree;",
        "all = all || agree;",
        "samples are flat though neighbours disagree",
    ),
    Mutation(
        "cocone/cocone.cpp",
        "if (flat[p] && !(meetings[f.cell][f.slot] >> i & 1)) return false;",
        "if (!(meetings[f.cell][f.slot] >> i & 1)) return false;",
        "candidates have to please corners that are not flat",
    ),
    Mutation(
        "cocone/labelled_poles.cpp",
        "std::abs(inner - outer) - 1",
        "std::abs(inner - outer) + 1",
        "poles that both sides claim are labelled first",
        python=("test_pole_sides.py",),
    ),
    Mutation(
        "cocone/labelled_poles.cpp",
        "constexpr double kDeep = 0.5;",
        "constexpr double kDeep = -0.9;",
        "balls that hardly touch lie on one side",
        python=("test_pole_sides.py",),
    ),
    Mutation(
        "cocone/labelled_poles.cpp",
        "(label_[node] == Label::inner) == (link.weight > 0)",
        "(label_[node] == Label::inner)",
        "opposite poles get the same label",
        python=("test_pole_sides.py",),
    ),
    Mutation(
        "cocone/manifold.cpp",
        "  prune(s, candidates, umbrellas.triangles, cocone.flat, run);\n",
        "",
        "nothing is pruned",
        python=("test_tight_cocone.py",),
    ),
    Mutation(
        "cocone/manifold.cpp",
        "return dot(n, m) >= least_cosine * length(n) * length(m);",
        "return dot(n, m) >= -least_cosine * length(n) * length(m);",
        "triangles continue each other only at small angles",
        python=("test_tight_cocone.py",),
    ),
    Mutation(
        "cocone/marking.cpp",
        "(cosine < 0) != (facing[p] != facing[q])",
        "cosine < 0",
        "patches are joined by their poles, whichever way they face",
        python=("test_tight_cocone.py",),
    ),
    Mutation(
        "cocone/marking.cpp",
        "return std::tuple(-std::abs(a.cosine), a.p, a.q) < std::tuple(-std::abs(b.cosine), b.p, b.q);",
        "return std::tuple(std::abs(a.cosine), a.p, a.q) < std::tuple(std::abs(b.cosine), b.p, b.q);",
        "patches are joined where they agree least",
        python=("test_tight_cocone.py",),
    ),
    Mutation(
        "cocone/peeling.cpp",
        "return std::tie(size, face.cell, face.slot) <",
        "return std::tie(size, face.cell, face.slot) >",
        "the smallest openings are passed first",
        python=("test_tight_cocone.py",),
    ),
    Mutation(
        "cocone/peeling.cpp",
        "return voters == 0 ? 0 : votes > 0 ? 1 : -1;",
        "return voters == 0 ? 0 : votes >= 0 ? 1 : -1;",
        "a tie of the votes is outside",
        python=("test_tight_cocone.py",),
    ),
    Mutation(
        "cocone/solid.cpp",
        "const bool third = edges[i] == edges[i - 2] &&",
        "const bool third = edges[i] == edges[i - 1] &&",
        "edges of two triangles count as not manifold",
    ),
    # ---- skeleton
    Mutation(
        "collapse/wires.cpp",
        "if (++front.edges >= kEdgesPerAnchor && away > 0.5 * complex_.radius[vertex]) {",
        "if (away > 0) {",
        "times on wires are summed over zigzags",
    ),
    Mutation(
        "collapse/sheets.cpp",
        "return left.size() > 2 && std::all_of",
        "return left.size() > 9 && std::all_of",
        "chains of fins become parts of the sheet that they branch from",
    ),
    Mutation(
        "thickness/inscribed_balls.cpp",
        "if (side.distance < (1 - kInside) * here.distance)",
        "if (side.distance < 0)",
        "balls touch reflex edges through the sides of them",
    ),
    Mutation(
        "thickness/inscribed_balls.cpp",
        "dot(q.point - centre, normal) < 0 || is_moved_through(x, q);",
        "is_moved_through(x, q);",
        "faces that balls touch from outside are walls",
    ),
    Mutation(
        "thickness/inscribed_balls.cpp",
        "dot(q.point - centre, normal) < 0 || is_moved_through(x, q);",
        "dot(q.point - centre, normal) < 0;",
        "places that their bulge moved through a face have walls",
    ),
    Mutation(
        "exact/held_ball.cpp",
        "2 * samples_.hole_near(start_) > first.distance;",
        "2 * samples_.hole_near(start_) < first.distance;",
        "wires of thin round bars stay where samples put them",
        python=("test_thin_radii.py",),
    ),
    Mutation(
        "exact/held_ball.cpp",
        "return (is_inside(foot) ? 1 : -1) * normalized(centre_ - foot.point);",
        "return normalized(centre_ - foot.point);",
        "outside of a bar the way leads away from it",
        python=("test_thin_radii.py",),
    ),
    Mutation(
        "exact/empty_ball.cpp",
        "if (!is_inside(samples.faces(), walls, ball->away)) return {};",
        "",
        "balls touch smooth walls from outside",
        python=("test_even.py",),
    ),
    Mutation(
        "walls/samples_on_faces.cpp",
        "if (found && lies_between(found->edge, n, m)) return found;",
        "if (found) return found;",
        "tangent planes of a round bar meet in the rim of a disc",
        python=("test_thin_radii.py",),
    ),
    Mutation(
        "levels/smooth_line.cpp",
        "kEntries && j + k < size",
        "kEntries - 1 && j + k < size",
        "smooth lines lose a factor on the way back",
        python=("test_branches.py",),
    ),
    Mutation(
        "levels/canal.cpp",
        "canal.trust = all_round();",
        "canal.trust = 1;",
        "two walls are taken for a round limb",
    ),
    Mutation(
        "levels/canal.cpp",
        "canal.radius += f[0];",
        "canal.radius -= f[0];",
        "radii of canals are corrected the wrong way",
    ),
    Mutation(
        "levels/canal.cpp",
        "is_cone_ ? straight : place_on_canal(to, straight);",
        "straight;",
        "samples are taken for those of a straight canal",
    ),
    Mutation(
        "levels/canal.cpp",
        "away = d - from_.radius - t * (slope_ + t * flare_);",
        "away = d - from_.radius - t * t * flare_;",
        "a canal that grows is taken for an even one",
    ),
    Mutation(
        "levels/chains.cpp",
        "return !fixed_[vertex] && at_[vertex].size() == 2;",
        "return at_[vertex].size() == 2;",
        "chains pass through fixed vertices",
    ),
    Mutation(
        "levels/chains.cpp",
        "chain.closed = closed;",
        "chain.closed = false;",
        "closed chains have ends",
    ),
    Mutation(
        "levels/even_level.cpp",
        "moved ? HUGE_VAL : level_.radius[i]",
        "moved ? level_.radius[i] : level_.radius[i]",
        "balls of moved vertices are those of the old places",
    ),
    Mutation(
        "levels/relax.cpp",
        "for (size_t k = chain.closed ? 0 : 1; k < chain.size(); ++k) number_",
        "for (size_t k = 1; k < chain.size(); ++k) number_",
        "a vertex of a closed chain stays behind",
    ),
    # ---- sampling
    Mutation(
        "sampling/creases.cpp",
        "<= cosine ? Crease::sharp : Crease::none",
        ">= cosine ? Crease::sharp : Crease::none",
        "flat edges are sharp",
    ),
    Mutation(
        "sampling/creases.cpp",
        "here.size() != 2 || !straight(",
        "here.size() < 2 || !straight(",
        "where more than two creases meet is no corner",
        python=("test_sampling.py",),
    ),
    Mutation(
        "sampling/pn_triangles.cpp",
        "return third - dot(third, normal) * normal;",
        "return third + 0 * dot(third, normal) * normal;",
        "smooth edges stay straight",
    ),
    Mutation(
        "sampling/pn_triangles.cpp",
        "Vec3 centre = (-1.0 / 6) * (p + q + r);",
        "Vec3 centre = (1.0 / 6) * (p + q + r);",
        "patches bulge in the middle",
    ),
    Mutation(
        "sampling/pieces.cpp",
        "0.7548776662466927",
        "0.7500000000000000",
        "places in a piece lie in rows",
        python=("test_blue_noise.py",),
    ),
    Mutation(
        "sampling/pieces.cpp",
        "if (v > u) {",
        "if (v < u) {",
        "places lie outside of their piece",
    ),
    Mutation(
        "sampling/sizing.cpp",
        "const double limit = spacing + kGrading * away;",
        "const double limit = spacing + 3 * kGrading * away;",
        "the spacing grows too fast",
    ),
    Mutation(
        "sampling/poisson_disk.cpp",
        "std::min(radius, disk.radius)",
        "std::max(radius, disk.radius)",
        "of two radii the larger counts",
        python=("test_blue_noise.py", "test_sampling.py"),
    ),
    Mutation(
        "sampling/poisson_disk.cpp",
        "out.push_back({place, scale * read.piece().spacing, read.point(place)});",
        "out.push_back({place, 0.9 * scale * read.piece().spacing, read.point(place)});",
        "discs are smaller than asked for",
    ),
    Mutation(
        "sampling/poisson_disk.cpp",
        "dot(disk.normal, normal()) > 0) return false;",
        "dot(disk.normal, normal()) > -2) return false;",
        "opposite walls repel each other",
    ),
    Mutation(
        "sampling/poisson_disk.cpp",
        "darts * kPacking / (scale * scale)",
        "0.2 * darts * kPacking / (scale * scale)",
        "too few darts leave holes",
        python=("test_blue_noise.py",),
    ),
    Mutation(
        "sampling/mirrored_rows.cpp",
        "    along = turned;\n",
        "    along = -turned;\n",
        "walks turn back at edges",
    ),
    Mutation(
        "sampling/poisson_disk.h",
        "!(away < std::min(disk.radius, disks[j].radius))",
        "!(away < 0.5 * std::min(disk.radius, disks[j].radius))",
        "mirrored pairs stay though they have no room",
        python=("test_sampling.py",),
    ),
    Mutation(
        "sampling/surface_samples.cpp",
        "constexpr double kFirstRow = 0.75, kNextRow = 0.85;",
        "constexpr double kFirstRow = 0.75, kNextRow = 0.65;",
        "the second row is too near to the first",
    ),
    Mutation(
        "sampling/surface_samples.cpp",
        "    spacing.scale *= std::sqrt(last.count() / wanted);",
        "    spacing.scale *= std::sqrt(wanted / last.count());",
        "the count is not met",
    ),
    # ---- balls
    Mutation(
        "base/nearest_ball.cpp",
        "  return std::sqrt(squared_distance(node.box, query)) - node.largest;",
        "  return std::sqrt(squared_distance(node.box, query)) + node.largest;",
        "large balls are looked for too near",
        python=("test_ball_cover.py",),
    ),
    Mutation(
        "cover/ball_choice.cpp",
        "if (gain.places < before && !gains.empty() && gain < gains.top()) {",
        "if (gain.places < before && gains.empty()) {",
        "a ball that gains little any more is taken",
        python=("test_ball_cover.py",),
    ),
    Mutation(
        "cover/ball_choice.cpp",
        "const double limit = std::max(kNear * away, least);",
        "const double limit = std::max(away, least);",
        "balls that come not near compete, too",
        python=("test_ball_cover.py",),
    ),
    Mutation(
        "cover/ball_cover.cpp",
        "std::clamp(radius, 0.0, std::max(depth[i], 0.0))",
        "std::max(radius, 0.0 * depth[i])",
        "balls stick out of the solid",
        python=("test_ball_cover.py",),
    ),
    Mutation(
        "cover/ball_cover.cpp",
        "reach > 0 ? std::clamp(needed[i], kept[i].radius, most) : kept[i].radius",
        "reach > 0 ? std::min(kept[i].radius, most) : kept[i].radius",
        "balls around a solid do not grow",
        python=("test_ball_cover.py",),
    ),
    Mutation(
        "cover/pieces.h",
        "  if (longest <= piece) {",
        "  if (longest <= 1e9 * piece) {",
        "the corners of faces alone are held",
        python=("test_ball_cover.py",),
    ),
    # ---- remesh
    Mutation(
        "remesh/sheet_complex.cpp",
        "  for (auto& [a, b] : wires_) a = kept.number[a], b = kept.number[b];\n",
        "",
        "wires of a compact mesh keep their numbers",
    ),
    Mutation(
        "remesh/sheet_complex.cpp",
        "  if (count != at_edge) return false;",
        "  if (count < at_edge) return false;",
        "links may have more in common than the edge",
    ),
    Mutation(
        "remesh/sheet_complex.cpp",
        "  return !closes;",
        "  return true;",
        "collapses close the last triangle of a cavity",
    ),
    Mutation(
        "remesh/sheet_complex.cpp",
        "uses(from, third) == 1 && uses(to, third) == 1",
        "uses(from, third) == 1 && uses(to, third) == 0",
        "the last triangle between three rims goes",
    ),
    Mutation(
        "remesh/sheet_complex.cpp",
        "stratum_[from] > stratum_[to]",
        "false",
        "vertices leave their curve for a sheet",
    ),
    Mutation(
        "remesh/sheet_complex.cpp",
        "  if (is_inside) return;",
        "  return;",
        "strata stay as they were after a collapse along a curve",
    ),
    Mutation(
        "remesh/sheet_complex.cpp",
        "  return uses(c, d) == 0 && !is_wired(c, d);",
        "  return uses(c, d) == 0;",
        "flips make an edge where a wire is",
    ),
    Mutation(
        "remesh/remesh.cpp",
        "return cosine[0] * sine[1] + cosine[1] * sine[0] < 0;",
        "return cosine[0] * sine[1] + cosine[1] * sine[0] > 0;",
        "edges flip away from the better diagonal",
    ),
    Mutation(
        "remesh/remesh.cpp",
        "kRise * distance(e_.position[a], e_.position[b])",
        "HUGE_VAL",
        "a rim that passes from one crease to another is on one of them halfway",
        python=("test_even.py",),
    ),
    Mutation(
        "remesh/remesh.cpp",
        "share > kLong || misses_line(a, b) ?",
        "share > kLong ?",
        "edges along creases miss them by any chord",
        python=("test_crisp.py",),
    ),
    Mutation(
        "remesh/sheet_complex.h",
        "uses(corner, b) > 0 && uses(a, b) == 0",
        "uses(corner, b) > 0",
        "a triangle is added between ends that have an edge",
    ),
    Mutation(
        "exact/even_places.cpp",
        "if (!(openness(ball.away) > kRimOpenness)) return Touch{};  // it has one foot",
        "",
        "sheets and rims end at balls with one foot",
        python=("test_even.py",),
    ),
    Mutation(
        "exact/even_places.cpp",
        "return walls.count == 1 ? ball_from_beyond(v) : Touch{};",
        "return {};",
        "vertices beyond a thin wall find no ball",
        python=("test_even.py",),
    ),
    Mutation(
        "exact/even_creases.cpp",
        "  mend();\n",
        "",
        "rims move onto creases whatever that turns over",
        python=("test_even.py",),
    ),
    Mutation(
        "exact/even_creases.cpp",
        "  std::erase_if(nodes, [&](int32_t v) { return e_.mesh.stratum(v) != Stratum::node; });\n",
        "",
        "the nearest vertex goes to a corner, where a node is beside it",
        python=("test_crisp.py",),
    ),
    Mutation(
        "remesh/even_mesh.cpp",
        "return turn > kMostTurn;",
        "return turn > -2;",
        "changes turn triangles over",
    ),
    Mutation(
        "remesh/even_mesh.cpp",
        "(is_exact_ && turn > kMostTurn) || ",
        "",
        "needles may not get flatter at exact places",
        python=("test_even.py",),
    ),
    Mutation(
        "remesh/even_mesh.cpp",
        "sign * dot(e_.normal[one.triangle], e_.normal[other]) >= kFold;",
        "false;",
        "sheets fold",
        python=("test_even.py",),
    ),
    Mutation(
        "remesh/target_length.cpp",
        "0.5 * (std::abs(sum) + deviator)",
        "0.5 * std::abs(sum)",
        "only the mean curvature counts",
    ),
    Mutation(
        "remesh/target_length.cpp",
        "width[before[*v]] = std::max(width[before[*v]], width[*v]);",
        "width[before[*v]] = width[*v];",
        "a rim is as far away as any vertex",
        python=("test_even.py",),
    ),
    # ---- reduce
    Mutation(
        "reduce/sphere_complex.cpp",
        "if (holds(neighbours_[b], vertex) && !has_triangle(a, b, vertex)) return false;",
        "if (vertex < 0) return false;",
        "loops of three edges are pinched",
        python=("test_reduce.py",),
    ),
    Mutation(
        "reduce/sphere_complex.cpp",
        "return !holds(neighbours_[b], c) || !has_triangle(b, c, d);",
        "return !holds(neighbours_[b], c) || d >= 0;",
        "hollow tetrahedra are pinched",
        python=("test_reduce.py",),
    ),
    Mutation(
        "reduce/collapse.cpp",
        "if (!(dot(was, is) > 0) || is_line(after, is)) return true;",
        "if (!(dot(was, is) > 0) || is_line(after, is)) return false;",
        "triangles turn over",
        python=("test_reduce.py",),
    ),
    Mutation(
        "reduce/collapse.cpp",
        "    quadrics_[a] += quadrics_[b];",
        "    quadrics_[b] += quadrics_[a];",
        "what a sphere stood for is forgotten",
        python=("test_reduce.py",),
    ),
    Mutation(
        "reduce/collapse.cpp",
        "(locks_ && locks_->ends_sheet(complex_, a, b)) ||",
        "(locks_ && gone(a) && locks_->ends_sheet(complex_, a, b)) ||",
        "the last triangle of a sheet collapses",
        python=("test_small_sheets.py",),
    ),
    Mutation(
        "reduce/collapse.cpp",
        "collapse_all({false, HUGE_VAL, locks_->shortest()}, 0, run)",
        "collapse_all({false, HUGE_VAL, 0}, 0, run)",
        "short edges of borders stay",
        python=("test_mid_surface.py",),
    ),
    Mutation(
        "reduce/tangent_places.cpp",
        "if (!(squared_length(inward) > kNoDistance * kNoDistance)) return {};",
        "",
        "rims at triangles without area tell a direction",
        python=("test_mid_surface.py",),
    ),
    Mutation(
        "reduce/fit.cpp",
        "dot(normals_[t], normal(corners)) > 0) continue;",
        "squared_length(normal(corners)) >= 0) continue;",
        "the fit turns triangles over",
        python=("test_reduce.py",),
    ),
    Mutation(
        "reduce/cone_and_slab.cpp",
        "(at + height * cone.ratio / cone.flat) / cone.whole",
        "(at - height * cone.ratio / cone.flat) / cone.whole",
        "cones are met on the wrong side of the foot",
        python=("test_reduce.py",),
    ),
    Mutation(
        "reduce/cone_and_slab.cpp",
        "if (!(first >= 0 && second >= 0 && third >= 0)) return",
        "if (!(first >= 0 && second >= 0)) return",
        "slabs reach beyond one side",
        python=("test_reduce.py",),
    ),
    Mutation(
        "reduce/envelope.cpp",
        "  return std::sqrt(squared_distance(node.box, query)) - node.largest;",
        "  return std::sqrt(squared_distance(node.box, query)) + node.largest;",
        "large spheres are looked for too near",
        python=("test_reduce.py",),
    ),
    # ---- all
    Mutation(
        "analyse.cpp",
        "automatic_sides(surface.closed(), has_normals)",
        "automatic_sides(!surface.triangles.empty(), has_normals)",
        "open faces tell inside from outside unasked",
        python=("test_sides_from.py",),
    ),
)
