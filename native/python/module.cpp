// SPDX-License-Identifier: GPL-3.0-or-later
// This is the Python module _medial; _medial.pyi documents it in full.
#include <medial/errors.h>

#include "bindings.h"
#include "docstrings.h"

namespace py = pybind11;

namespace medial::python {

// All types and errors are local to this file: an installed package, an extension of Blender and an
// older add-on may each bring a copy of the module into one process, and each keeps its own.
void bind_product(py::module_& m) {
  m.doc() = docs::about_medial;
  m.attr("__version__") = MEDIAL_VERSION;
  py::register_local_exception<InvalidInputError>(m, "InvalidInputError", PyExc_ValueError).doc() =
      docs::InvalidInputError;
  py::register_local_exception<DegenerateInputError>(m, "DegenerateInputError", PyExc_ValueError)
      .doc() = docs::DegenerateInputError;
  py::register_local_exception<Cancelled>(m, "Cancelled", PyExc_Exception).doc() = docs::Cancelled;
  bind_tight_cocone(m);
  bind_analysis(m);
  bind_sampling(m);
  bind_surfaces(m);
  bind_balls(m);
  bind_reduce(m);
}

}  // namespace medial::python

PYBIND11_MODULE(_medial, m) { medial::python::bind_product(m); }
