// SPDX-License-Identifier: GPL-3.0-or-later
// Lists that are nearly always short, such as the edges at a vertex.
#pragma once

#include <boost/container/small_vector.hpp>

namespace medial {

// A list whose first entries need no memory of their own: twice as many as most vertices have
// triangles.
template <typename T>
using ShortList = boost::container::small_vector<T, 24>;

}  // namespace medial
