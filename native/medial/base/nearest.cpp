#include "base/nearest.h"

#include <boost/geometry/geometries/register/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/geometry/strategies/strategies.hpp>

BOOST_GEOMETRY_REGISTER_POINT_3D(medial::Vec3, double, boost::geometry::cs::cartesian, x, y, z)

namespace medial {

// Packed at once, 8 to a leaf: built and asked in 2.3 s of one core for a million queries among 3.2
// million sites, where CGAL's Kd_tree took 5.7 s.
struct Nearest::Tree : boost::geometry::index::rtree<Vec3, boost::geometry::index::linear<8>> {
  using rtree::rtree;
};

Nearest::Nearest(std::span<const Vec3> sites)
    : tree_(std::make_unique<const Tree>(sites.begin(), sites.end())) {}

Nearest::~Nearest() = default;

double Nearest::distance(const Vec3& query) const {
  Vec3 site;
  const auto found = tree_->query(boost::geometry::index::nearest(query, 1), &site);
  return found == 0 ? HUGE_VAL : medial::distance(query, site);
}

}  // namespace medial
