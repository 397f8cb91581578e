// SPDX-License-Identifier: GPL-3.0-or-later
// The faces of a hierarchy as Python passes them.
#pragma once

#include <medial/faces.h>

#include "arrays.h"

namespace medial::python {

// Keeps the arrays that the input of the core refers to.
class FacesArgument {
 public:
  FacesArgument(const py::object& vertices, const py::object& triangles, const py::object& face,
                double sharp_angle, const py::object& sharp_edges, bool smooth)
      : vertices_(vertices, "vertices"),
        triangles_(triangles),
        face_object_(face),
        face_(ids_of(face, "face")),
        sharp_edges_(sharp_edges),
        sharp_angle_(sharp_angle),
        smooth_(smooth) {}

  FacesInput input() const {
    return {vertices_.span(), triangles_.span(), face_, sharp_angle_, sharp_edges_.span(), smooth_};
  }

 private:
  Points vertices_;
  Triangles triangles_;
  py::object face_object_;
  std::span<const int32_t> face_;
  EdgeRows sharp_edges_;
  double sharp_angle_;
  bool smooth_;
};

}  // namespace medial::python
