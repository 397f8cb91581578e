// SPDX-License-Identifier: GPL-3.0-or-later
// Memory that was freed, and that the C library still keeps.
#pragma once

namespace medial {

// Makes the C library return its free memory to the system, where it can.
void release_heap();

}  // namespace medial
