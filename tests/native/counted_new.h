// SPDX-License-Identifier: GPL-3.0-or-later
// What the global operators new and delete of a test program counted so far.
#pragma once

#include <atomic>
#include <cstdint>

namespace medial::test {

extern std::atomic<int64_t> live_bytes;
extern std::atomic<int64_t> peak_bytes;  // may be set back
extern std::atomic<int64_t> allocations;

}  // namespace medial::test
