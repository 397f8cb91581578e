// SPDX-License-Identifier: GPL-3.0-or-later
// How much memory this process has from the system.
#pragma once

#include <cstddef>

namespace medial::test {

// Bytes: on Windows committed ones, which count against the memory and the page file of the
// machine, touched or not; elsewhere those that lie in memory.
size_t process_memory();

}  // namespace medial::test
