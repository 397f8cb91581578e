// SPDX-License-Identifier: GPL-3.0-or-later
// The C library may keep memory that the program has freed.
#pragma once

namespace medial {

// Makes the C library return its free memory to the system, if it can.
void release_heap();

}  // namespace medial
