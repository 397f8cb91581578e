// SPDX-License-Identifier: GPL-3.0-or-later
// This is the Python module _medial; _medial.pyi documents it in full.
#include <medial/errors.h>

#include "bindings.h"
#include "docstrings.h"

namespace py = pybind11;

namespace medial::python {

bool is_main_interpreter() {
  if (PyInterpreterState_Get() == PyInterpreterState_Main()) return true;
  PyErr_SetString(
      PyExc_ImportError,
      "Expected the main interpreter of the process, found a subinterpreter; use threads "
      "or processes instead.");
  return false;
}

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
  bind_structure(m);
  bind_surfaces(m);
  bind_balls(m);
  bind_scan(m);
  bind_reduce(m);
}

}  // namespace medial::python

// In a subinterpreter the entry point that pybind11 writes would wait for itself for ever. So it
// gets another name, which no library gives out (on Windows it would), and the module's own entry
// point refuses first.
#pragma push_macro("PYBIND11_EXPORT")
#undef PYBIND11_EXPORT
#define PYBIND11_EXPORT
#define PyInit__medial initialise_medial
PYBIND11_MODULE(_medial, m) { medial::python::bind_product(m); }
#undef PyInit__medial
#pragma pop_macro("PYBIND11_EXPORT")

// NOLINTNEXTLINE(bugprone-reserved-identifier): Python asks for this name
extern "C" PYBIND11_EXPORT PyObject* PyInit__medial() {
  return medial::python::is_main_interpreter() ? initialise_medial() : nullptr;
}
