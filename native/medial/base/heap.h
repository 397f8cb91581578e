// SPDX-License-Identifier: GPL-3.0-or-later
// What the C library keeps of the memory that was given back to it.
#pragma once

namespace medial {

// Has it return to the system what it has free, where it can.
void release_heap();

}  // namespace medial
