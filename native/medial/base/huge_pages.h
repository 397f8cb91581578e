// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>

namespace medial {

// Asks the system for few large pages in the place of many small ones, where it has such: memory
// then comes faster, and the processor finds it faster. Only advice; in address_space.cpp.
void prefer_huge_pages(void* memory, size_t bytes);

}  // namespace medial
