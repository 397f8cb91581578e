// SPDX-License-Identifier: GPL-3.0-or-later
// These functions bind the parts of the module _medial_study that are not in _medial.
#pragma once

#include <pybind11/pybind11.h>

namespace medial::python {

void bind_stages(pybind11::module_& module);
void bind_rivals(pybind11::module_& module);

}  // namespace medial::python
