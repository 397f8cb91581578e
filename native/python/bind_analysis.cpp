// SPDX-License-Identifier: GPL-3.0-or-later
// Progress, MedialAnalysis and MedialMesh for Python.
#include <medial/analysis.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "arrays.h"
#include "bindings.h"

namespace medial::python {
namespace {

constexpr const char* kProgressDoc =
    "Shared by the thread that computes and the one that watches; every member is safe to use at "
    "any time.";

constexpr const char* kMeshDoc =
    "The selected Voronoi facets as convex, planar polygons that share their vertices.\n\n"
    "Facets are ordered by their generators (p < q); each polygon turns counter-clockwise about "
    "the direction\n"
    "from p to q and starts at its lowest vertex id. No facet has zero area, no two vertices "
    "coincide.";

constexpr const char* kAnalysisDoc =
    "Everything about a point set that does not depend on the thresholds; computed once, extracted "
    "often.\n\n"
    "Parameters\n----------\n"
    "points : (n, 3) float64\n    Samples of the surface, finite. Float32 is converted; other "
    "types are refused.\n"
    "triangles : (m, 3) int32, optional\n    Outward-facing triangles of the surface as rows of "
    "`vertices`: they tell\n"
    "    inside from outside.\n"
    "vertices : (v, 3) float64, optional\n    What the rows of `triangles` mean; none: `points`. "
    "Rows with the same\n    coordinates are one vertex. They are no samples.\n"
    "normals : (n, 3) float64, optional\n    Outward normals of the samples, of any length; a zero "
    "normal has no vote.\n"
    "sides : SidesFrom\n    What tells inside from outside; default AUTOMATIC.\n"
    "cocone : CoconeOptions, optional\n    For TIGHT_COCONE and POLES.\n"
    "bounding_sphere : bool\n    Add 200 points at twice the radius (Dey & Zhao, sect. 4.2); only "
    "edges between true\n"
    "    samples are analysed and selected.\n"
    "against : Against\n    What theta and rho are measured against; default UMBRELLA.\n"
    "progress : Progress, optional\n"
    "threads : int\n    0: as many as the machine has. The result does not depend on it.\n\n"
    "Raises\n------\nInvalidInputError, DegenerateInputError, Cancelled";

constexpr const char* kSolidDoc =
    "(f, 3) int32: rows of the facets between inner and outer cells, outward, lowest row first, in "
    "lexicographic order:\nthe surface as the samples see it.";

constexpr const char* kExtractDoc =
    "The closure of the selected facets, as a MedialMesh.\n\n"
    "Parameters\n----------\n"
    "theta : float\n    theta0 of the Angle condition, radians in [0, pi/2]; default pi/8.\n"
    "rho : float\n    rho0 of the Ratio condition, >= 0; default 8.\n"
    "side : Side\n    BOTH (default), INNER or OUTER; INNER and OUTER need sides.\n"
    "rule : Rule\n    EITHER (default) or BOTH ends of a Delaunay edge must pass.\n"
    "criteria : Criteria\n    ANGLE_OR_RATIO (default), ANGLE, RATIO, ANGLE_AND_LENGTH or LAMBDA.\n"
    "length : float\n    Of ANGLE_AND_LENGTH and LAMBDA, a share of the diagonal of the samples' "
    "box; default 0.05.\n"
    "limit_set : bool\n    Keep a facet selected by the Ratio condition alone only if |pq| >= "
    "eps^(1/4) mu\n"
    "    (Definition 4), mu: smallest ball radius at its vertices, eps = |pq| / (rho mu). Default "
    "off.\n"
    "progress : Progress, optional\n\n"
    "Raises\n------\nInvalidInputError, Cancelled\n"
    "DegenerateInputError\n    INNER or OUTER, and `TightCocone.encloses` is false.";

constexpr const char* kFeatureSizeDoc =
    "(k,) float64: estimated local feature size: distance of each of `samples` to the nearest "
    "Voronoi vertex of a selected\nfacet of either side, too large by at most 1/32 of itself; "
    "infinite when nothing is selected. With `rows`, (m,) int32,\nof these samples alone. Other "
    "parameters as in `extract`.";

constexpr const char* kMemoryDoc =
    "Bytes at the peak of an analysis of so many samples of a surface and an extraction, as "
    "measured. Facets that are long\nand thin, as on a torus of random points, take up to four "
    "times as many.";

constexpr const char* kHierarchyMethodDoc =
    "The levels of the inner axis, as a Hierarchy; computed once, extracted often. It does not "
    "need "
    "the analysis any more.\n\n"
    "Parameters\n----------\n"
    "theta, rho, rule, criteria\n    As in `extract`: what they select is in the level with the "
    "thresholds 0, with the bridges that it lacks.\n"
    "side : Side\n    INNER only.\n"
    "progress : Progress, optional\n\n"
    "Raises\n------\nInvalidInputError, Cancelled\n"
    "DegenerateInputError\n    `TightCocone.encloses` is false.";

constexpr const char* kThicknessDoc =
    "How thick the solid is at each of `samples`, or how wide the gap, as a WallThickness. The "
    "ball "
    "that is tangent at p and\ntouches q has the diameter |pq|^2 / (n_p . (p - q)); the least "
    "over the selected facets (p, q) counts.\n\n"
    "Parameters\n----------\n"
    "normals : (n, 3) float64, optional\n    Outward normals of the points, of any length; what "
    "has a zero one is filled. Only SCAN does without.\n"
    "edges : (n,) bool, optional\n    Points on sharp edges, where a normal is the mean of sides: "
    "they are filled. Default: none.\n"
    "mode : ThicknessMode\n    WALL (default), BALL or SCAN.\n"
    "side : Side\n    INNER (default) or OUTER, the gap; it needs a bounding sphere where gaps are "
    "open.\n"
    "theta, rho, rule, criteria\n    As in `extract`; SCAN has its own.\n"
    "progress : Progress, optional\n\n"
    "Raises\n------\nInvalidInputError, Cancelled\n"
    "DegenerateInputError\n    `TightCocone.encloses` is false.";

constexpr const char* kPoleBallsDoc =
    "The poles as balls: a MedialMesh of vertices without facets (Amenta & Bern 1998; Boissonnat & "
    "Cazals 2001).\nThey are the farthest Voronoi vertex of each cell and the farthest against it, "
    "on one side or on both, where\nthey are finite. In the order of `samples`.\n\n"
    "Raises\n------\nInvalidInputError, Cancelled\n"
    "DegenerateInputError\n    INNER or OUTER, and `TightCocone.encloses` is false.";

constexpr const char* kSelectDoc =
    "Ids (rows of `edges`), ascending, of the selected edges: the set F of MEDIAL, unbounded and "
    "zero-area\n"
    "facets included. Parameters as in `extract`.\n\nReturns\n-------\nids : (s,) int32";

std::optional<Points> optional_points(const py::object& rows, const char* name) {
  return rows.is_none() ? std::optional<Points>() : Points(rows, name);
}

std::optional<std::span<const int32_t>> optional_ids(const py::object& ids, const char* name) {
  return ids.is_none() ? std::optional<std::span<const int32_t>>() : ids_of(ids, name);
}

std::unique_ptr<MedialAnalysis> analyse(const py::object& points, const py::object& triangles,
                                        const py::object& vertices, const py::object& normals,
                                        SidesFrom sides, const CoconeOptions* cocone,
                                        bool bounding_sphere, Against against, Progress* progress,
                                        int threads) {
  const Points rows(points, "points");
  const Triangles faces(triangles);
  const auto oriented = optional_points(normals, "normals");
  const auto corners = optional_points(vertices, "vertices");
  const AnalysisOptions options{sides, cocone ? *cocone : CoconeOptions{}, bounding_sphere,
                                thread_argument(threads), against};
  AnalysisInput input{rows.span(), faces.span()};
  if (oriented) input.normals = oriented->span();
  if (corners) input.vertices = corners->span();
  const py::gil_scoped_release release;
  return std::make_unique<MedialAnalysis>(input, options, progress);
}

WallThickness thickness_of(const MedialAnalysis& analysis, const py::object& normals,
                           const py::object& edges, ThicknessMode mode, Side side, double theta,
                           double rho, Rule rule, Criteria criteria, Progress* progress) {
  const auto directions = optional_points(normals, "normals");
  ThicknessInput input;
  if (directions) input.normals = directions->span();
  if (!edges.is_none()) input.at_edge = flags_of(edges, "edges");
  const ThicknessOptions options{mode, side, {theta, rho, rule, criteria}};
  const py::gil_scoped_release release;
  return analysis.thickness(input, options, progress);
}

Extraction extraction(double theta, double rho, Side side, Rule rule, Criteria criteria,
                      bool limit_set, double length) {
  return {{theta, rho, rule, criteria, length}, side, limit_set};
}

void bind_enums(py::module_& m) {
  py::enum_<Side>(m, "Side", py::module_local(),
                  "Which axis a facet belongs to; also the values of MedialMesh.side.")
      .value("BOTH", Side::both, "As an argument every facet, as a value not known.")
      .value("INNER", Side::inner,
             "Every Voronoi vertex of the facet is inside; by Tight Cocone, every cell round the "
             "dual edge, too.")
      .value("OUTER", Side::outer, "None is.")
      .value("CROSSING", Side::crossing, "Some are; only as a value.");
  py::enum_<SidesFrom>(m, "SidesFrom", py::module_local(),
                       "What tells inside from outside, for `MedialAnalysis`.")
      .value(
          "AUTOMATIC", SidesFrom::automatic,
          "SURFACE when the triangles are closed, else NORMALS when given, else TIGHT_COCONE; or "
          "POLES where its `pole_disagreement` is above 0.05.")
      .value("SURFACE", SidesFrom::surface, "The winding number of the triangles.")
      .value("NORMALS", SidesFrom::normals,
             "A vote of the outward normals of the samples nearest to each Voronoi vertex.")
      .value("TIGHT_COCONE", SidesFrom::tight_cocone,
             "The watertight surface of `TightCocone`; needs the points only.")
      .value("NONE", SidesFrom::none, "Nothing; every facet has side BOTH.")
      .value("POLES", SidesFrom::poles,
             "Labels that go from pole to pole, and a vote of the samples by those of their own; "
             "needs the points only, and keeps cavities.");
  py::enum_<Rule>(m, "Rule", py::module_local(),
                  "Which ends of a Delaunay edge pq must pass a condition (Dey & Zhao, sect. 3).")
      .value("EITHER", Rule::either, "p or q, the paper's text.")
      .value("BOTH", Rule::both, "p and q, per criterion.");
  py::enum_<Criteria>(m, "Criteria", py::module_local(),
                      "Which conditions select: those of Dey & Zhao (sect. 3.1 and 3.2), or of "
                      "others on the same facets.")
      .value("ANGLE_OR_RATIO", Criteria::angle_or_ratio)
      .value("ANGLE", Criteria::angle)
      .value("RATIO", Criteria::ratio)
      .value("ANGLE_AND_LENGTH", Criteria::angle_and_length,
             "After Attali & Lachaud (2001): every ball of the facet sees pq under at least twice "
             "theta, and |pq| is at least `length`.")
      .value("LAMBDA", Criteria::lambda,
             "Chazal & Lieutier (2005): the nearest samples fit in no ball with a diameter below "
             "`length`, twice their lambda. Of edges, too.");
  py::enum_<Against>(m, "Against", py::module_local(),
                     "What theta and rho at a sample are measured against (Dey & Zhao, the Remark "
                     "in sect. 3.2).")
      .value("UMBRELLA", Against::umbrella, "The normals and the circumradii of its umbrella.")
      .value("POLE", Against::pole, "The pole vector for the normals.")
      .value("POLYGON", Against::polygon,
             "The farthest corner of the tangent polygon for the circumradii.")
      .value("POLE_AND_POLYGON", Against::pole_and_polygon, "Both.");
}

void bind_progress(py::module_& m) {
  py::class_<Progress>(m, "Progress", kProgressDoc, py::is_final(), py::module_local())
      .def(py::init<>())
      .def_property_readonly("fraction", &Progress::fraction,
                             "Share of the whole job that is done, 0 to 1, never falling.")
      .def_property_readonly("stage", &Progress::stage, "Name of the running stage, for people.")
      .def_property_readonly("cancelled", &Progress::cancelled, "Whether `cancel` was called.")
      .def("cancel", &Progress::cancel,
           "Ask the computation to stop; it raises `Cancelled` within 0.3 s.");
}

void bind_mesh(py::module_& m) {
  py::class_<MedialMesh>(m, "MedialMesh", kMeshDoc, py::is_final(), py::module_local())
      .def_property_readonly(
          "vertices", view_property<double>(&MedialMesh::vertices),
          "(v, 3) float64: Voronoi vertices, the centres of empty balls, in order of first use.")
      .def_property_readonly("radius", view_property<double>(&MedialMesh::radius),
                             "(v,) float64: radius of each vertex' empty ball.")
      .def_property_readonly("face_offsets", view_property<int32_t>(&MedialMesh::face_offsets),
                             "(f + 1,) int32: facet i has the corners "
                             "face_vertices[face_offsets[i] : face_offsets[i + 1]].")
      .def_property_readonly("face_vertices", view_property<int32_t>(&MedialMesh::face_vertices),
                             "(c,) int32: vertex ids, facet after facet.")
      .def_property_readonly("theta", view_property<double>(&MedialMesh::theta),
                             "(f,) float64, radians in [0, pi/2]: the Angle condition holds for "
                             "every theta0 below it.")
      .def_property_readonly("rho", view_property<double>(&MedialMesh::rho),
                             "(f,) float64: the Ratio condition holds for every rho0 below it.")
      .def_property_readonly(
          "side", [](const MedialMesh& mesh) { return numbers_of(mesh.side); },
          "(f,) int32: values of `Side`.")
      .def_property_readonly(
          "generators", view_property<int32_t>(&MedialMesh::generators),
          "(f, 2) int32: rows p < q of the two samples whose cells meet in the facet.")
      .def_property_readonly(
          "edges", view_property<int32_t>(&MedialMesh::edges),
          "(e, 2) int32: vertices of the edges without a facet; only LAMBDA has such.")
      .def_readonly("unbounded", &MedialMesh::unbounded,
                    "Selected facets that reach infinity; they are counted, never emitted.")
      .def_readonly(
          "zero_area", &MedialMesh::zero_area,
          "Selected facets that are a point or a segment (cospherical samples), by centres "
          "that are right to 2^-40 of the radius or better; they are not emitted.")
      .def_readonly("rings", &MedialMesh::rings,
                    "Rings of cells that were walked: of the facets that the conditions select, "
                    "without those that one cell shows to lie on the other side.");
}

auto theta_property(Rule rule) {
  return [rule](const MedialAnalysis& a) { return array_of<double>(a.theta(rule)); };
}

auto rho_property(Rule rule) {
  return [rule](const MedialAnalysis& a) { return array_of<double>(a.rho(rule)); };
}

py::array bounded(const MedialAnalysis& a) {
  return array_of<uint8_t>(a.edges_bounded()).attr("view")("bool");
}

}  // namespace

void bind_analysis(py::module_& m) {
  bind_enums(m);
  bind_progress(m);
  bind_mesh(m);
  bind_hierarchy(m);
  bind_thickness(m);
  m.def("memory_needed", &memory_needed, kMemoryDoc, py::arg("points"));
  const Thresholds paper;
  py::class_<MedialAnalysis>(m, "MedialAnalysis", kAnalysisDoc, py::is_final(), py::module_local())
      .def(py::init(&analyse), py::arg("points"), py::arg("triangles") = py::none(), py::kw_only(),
           py::arg("vertices") = py::none(), py::arg("normals") = py::none(),
           py::arg("sides") = SidesFrom::automatic, py::arg("cocone") = py::none(),
           py::arg("bounding_sphere") = false, py::arg("against") = Against::umbrella,
           py::arg("progress") = nullptr, py::arg("threads") = 0)
      .def_property_readonly(
          "samples", [](const MedialAnalysis& a) { return array_of<int32_t>(a.sample_rows()); },
          "(k,) int32: rows of the distinct points, ascending.")
      .def_property_readonly("bytes", &MedialAnalysis::bytes, "Memory that the analysis holds.")
      .def_property_readonly("duplicates", &MedialAnalysis::duplicates,
                             "Rows merged into an earlier row with the same coordinates: n - k.")
      .def_property_readonly(
          "edges", [](const MedialAnalysis& a) { return array_of<int32_t>(a.edge_rows()); },
          "(e, 2) int32: all Delaunay edges between samples, p < q, in lexicographic order.")
      .def_property_readonly("theta", theta_property(Rule::either),
                             "(e,) float64: max over both ends of pi/2 - max over t in U_p of "
                             "angle(n_t, pq) (sect. 3.1).")
      .def_property_readonly(
          "rho", rho_property(Rule::either),
          "(e,) float64: max over both ends of |pq| / max over t in U_p of R_t (sect. 3.2).")
      .def_property_readonly(
          "theta_both", theta_property(Rule::both),
          "(e,) float64: as `theta` with the minimum of the two ends (Rule.BOTH).")
      .def_property_readonly("rho_both", rho_property(Rule::both),
                             "(e,) float64: as `rho` with the minimum of the two ends (Rule.BOTH).")
      .def_property_readonly(
          "side", [](const MedialAnalysis& a) { return numbers_of(a.edge_sides()); },
          "(e,) int32: values of `Side` for the facet dual to each edge; all BOTH for "
          "`SidesFrom.NONE`.")
      .def_property_readonly("sides_from", &MedialAnalysis::sides_from,
                             "What told inside from outside; never AUTOMATIC.")
      .def_property_readonly("pole_disagreement", &MedialAnalysis::pole_disagreement,
                             "float: of the samples whose labelled poles lie on two sides, the "
                             "share for which Tight Cocone says\notherwise; None unless AUTOMATIC "
                             "had to choose between the two.")
      .def_property_readonly(
          "tight_cocone",
          [](const MedialAnalysis& a) {
            return std::const_pointer_cast<WatertightSurface>(a.tight_cocone());
          },
          "The surface that told inside from outside; None unless `sides_from` is TIGHT_COCONE. "
          "Its `cell_side` is\nempty: with a bounding sphere the cells are not those of "
          "`delaunay`.")
      .def_property_readonly("bounded", &bounded,
                             "(e,) bool: the dual facet does not reach infinity.")
      .def_property_readonly("closed", &MedialAnalysis::closed,
                             "Every edge of the triangles is used equally often in both "
                             "directions, and there are triangles.")
      .def_property_readonly("boundary_edges", &MedialAnalysis::boundary_edges,
                             "Edges of the triangles that break this.")
      .def_property_readonly("cells", &MedialAnalysis::finite_cells,
                             "Number of finite Delaunay cells.")
      .def_property_readonly(
          "timings", [](const MedialAnalysis& a) { return seconds(a.timings()); },
          "Seconds of each stage, in order.")
      .def_property_readonly(
          "spacing", [](const MedialAnalysis& a) { return array_of<double>(a.spacing()); },
          "(k,) float64: largest circumradius in the umbrella of each of `samples`: the hole round "
          "it; infinite for an empty one.")
      .def(
          "feature_size",
          [](const MedialAnalysis& a, double theta, double rho, Rule rule, Criteria criteria,
             const py::object& rows, Progress* progress) {
            const auto chosen = optional_ids(rows, "rows");
            std::vector<double> sizes;
            {
              const py::gil_scoped_release release;
              sizes = a.feature_size({theta, rho, rule, criteria}, chosen, progress);
            }
            return array_of<double>(std::move(sizes));
          },
          kFeatureSizeDoc, py::arg("theta") = paper.theta, py::arg("rho") = paper.rho,
          py::arg("rule") = paper.rule, py::arg("criteria") = paper.criteria, py::kw_only(),
          py::arg("rows") = py::none(), py::arg("progress") = nullptr)
      .def("thickness", &thickness_of, kThicknessDoc, py::arg("normals") = py::none(),
           py::kw_only(), py::arg("edges") = py::none(), py::arg("mode") = ThicknessMode::wall,
           py::arg("side") = Side::inner, py::arg("theta") = paper.theta,
           py::arg("rho") = paper.rho, py::arg("rule") = paper.rule,
           py::arg("criteria") = paper.criteria, py::arg("progress") = nullptr)
      .def(
          "solid_triangles",
          [](const MedialAnalysis& a) {
            std::vector<Triangle> triangles;
            {
              const py::gil_scoped_release release;
              triangles = a.solid_triangles();
            }
            return array_of<int32_t>(std::move(triangles));
          },
          kSolidDoc)
      .def(
          "hierarchy",
          [](const MedialAnalysis& a, double theta, double rho, Rule rule, Criteria criteria,
             Side side, Progress* progress) {
            const py::gil_scoped_release release;
            return a.hierarchy({theta, rho, rule, criteria}, side, progress);
          },
          kHierarchyMethodDoc, py::arg("theta") = paper.theta, py::arg("rho") = paper.rho,
          py::arg("rule") = paper.rule, py::arg("criteria") = paper.criteria,
          py::arg("side") = Side::inner, py::kw_only(), py::arg("progress") = nullptr)
      .def(
          "select",
          [](const MedialAnalysis& a, double theta, double rho, Side side, Rule rule,
             Criteria criteria, bool limit_set, double length) {
            std::vector<int32_t> ids;
            {
              const py::gil_scoped_release release;
              ids = a.select(extraction(theta, rho, side, rule, criteria, limit_set, length));
            }
            return array_of<int32_t>(std::move(ids));
          },
          kSelectDoc, py::arg("theta") = paper.theta, py::arg("rho") = paper.rho,
          py::arg("side") = Side::both, py::arg("rule") = paper.rule,
          py::arg("criteria") = paper.criteria, py::kw_only(), py::arg("limit_set") = false,
          py::arg("length") = paper.length)
      .def(
          "extract",
          [](const MedialAnalysis& a, double theta, double rho, Side side, Rule rule,
             Criteria criteria, bool limit_set, double length, Progress* progress) {
            const py::gil_scoped_release release;
            return a.extract(extraction(theta, rho, side, rule, criteria, limit_set, length),
                             progress);
          },
          kExtractDoc, py::arg("theta") = paper.theta, py::arg("rho") = paper.rho,
          py::arg("side") = Side::both, py::arg("rule") = paper.rule,
          py::arg("criteria") = paper.criteria, py::kw_only(), py::arg("limit_set") = false,
          py::arg("length") = paper.length, py::arg("progress") = nullptr)
      .def(
          "poles",
          [](const MedialAnalysis& a, Side side, Progress* progress) {
            const py::gil_scoped_release release;
            return a.poles(side, progress);
          },
          kPoleBallsDoc, py::arg("side") = Side::both, py::kw_only(),
          py::arg("progress") = nullptr);
}

}  // namespace medial::python
