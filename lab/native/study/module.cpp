// SPDX-License-Identifier: GPL-3.0-or-later
// The Python module _medial_study is not shipped: it has all of _medial, and functions that only
// tests and the laboratory call.
#include "bindings.h"
#include "study/study_bindings.h"
#include "study_docstrings.h"

#define PyInit__medial_study initialise_study  // as in ../module.cpp
PYBIND11_MODULE(_medial_study, m) {
  medial::python::bind_product(m);
  m.doc() = medial::python::docs::about_medial_study;
  medial::python::bind_stages(m);
  medial::python::bind_rivals(m);
}
#undef PyInit__medial_study

// NOLINTNEXTLINE(bugprone-reserved-identifier): Python asks for this name
extern "C" PYBIND11_EXPORT PyObject* PyInit__medial_study() {
  return medial::python::is_main_interpreter() ? initialise_study() : nullptr;
}
