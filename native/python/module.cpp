// SPDX-License-Identifier: GPL-3.0-or-later
// The Python module _medial; _medial.pyi documents it in full.
#include <medial/errors.h>

#include "bindings.h"

namespace py = pybind11;

// All types and errors are local to this file: an installed package, an extension of Blender and an
// older add-on may each bring a copy of the module into one process, and each keeps its own.
PYBIND11_MODULE(_medial, m) {
  m.doc() =
      "The medial axis of a surface sample (Dey & Zhao's MEDIAL), computed in C++.\n\n"
      "Ids are rows of the input array, angles radians, lengths in the unit of the input, -1 means "
      "none or the\n"
      "infinite vertex. Returned arrays are read-only. The GIL is released while C++ works.";
  m.attr("__version__") = MEDIAL_VERSION;
  py::register_local_exception<medial::InvalidInputError>(m, "InvalidInputError", PyExc_ValueError)
      .doc() =
      "An argument has the wrong shape, type, range or a value that is not finite; the message "
      "says which.";
  py::register_local_exception<medial::DegenerateInputError>(m, "DegenerateInputError",
                                                             PyExc_ValueError)
      .doc() =
      "The points are valid but span no volume: fewer than 4 distinct ones, or all on a line or a "
      "plane.";
  py::register_local_exception<medial::Cancelled>(m, "Cancelled", PyExc_Exception).doc() =
      "Progress.cancel was called; nothing was computed.";
  medial::python::bind_tight_cocone(m);
  medial::python::bind_analysis(m);
  medial::python::bind_sampling(m);
  medial::python::bind_stages(m);
  medial::python::bind_balls(m);
  medial::python::bind_reduce(m);
}
