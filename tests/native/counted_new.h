// SPDX-License-Identifier: GPL-3.0-or-later
// Counts of the calls of the global operators new and delete in a test program.
#pragma once

#include <atomic>
#include <cstdint>

namespace medial::test {

extern std::atomic<int64_t> live_bytes;
extern std::atomic<int64_t> peak_bytes;  // may be set back
extern std::atomic<int64_t> allocations;

}  // namespace medial::test
