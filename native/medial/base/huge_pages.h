// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace medial {

// Advises the system to use few large pages instead of many small ones, if it has such: it then
// hands out memory faster, and the processor finds it faster. It is defined in address_space.cpp.
void prefer_huge_pages(void* memory, size_t bytes);

}  // namespace medial
