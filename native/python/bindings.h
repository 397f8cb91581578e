// SPDX-License-Identifier: GPL-3.0-or-later
// These functions bind the parts of the module _medial, and all of them together.
#pragma once

#include <pybind11/pybind11.h>

namespace medial::python {

// Returns whether this is the main interpreter of the process; sets an ImportError if it is not.
bool is_main_interpreter();

void bind_product(pybind11::module_& module);
void bind_analysis(pybind11::module_& module);
void bind_thickness(pybind11::module_& module);  // before the analysis
void bind_hierarchy(pybind11::module_& module);  // after the progress, before the analysis
void bind_reduce(pybind11::module_& module);     // after the progress
void bind_tight_cocone(pybind11::module_& module);
void bind_sampling(pybind11::module_& module);
void bind_structure(pybind11::module_& module);
void bind_surfaces(pybind11::module_& module);
void bind_balls(pybind11::module_& module);
void bind_scan(pybind11::module_& module);

}  // namespace medial::python
