// SPDX-License-Identifier: GPL-3.0-or-later
#include "counted_new.h"

#include <cstdlib>
#include <new>

namespace medial::test {

std::atomic<int64_t> live_bytes{0};
std::atomic<int64_t> peak_bytes{0};
std::atomic<int64_t> allocations{0};

namespace {

// Before what is handed out stands its size: what was asked for, whatever malloc makes of it.
constexpr size_t kHeader = __STDCPP_DEFAULT_NEW_ALIGNMENT__;

}  // namespace
}  // namespace medial::test

using namespace medial::test;

// All other forms call these, but for those of types that are aligned more strictly; there are
// none.
// GCC takes the header for a place outside the block where it inlines these functions.
#pragma GCC diagnostic ignored "-Warray-bounds"
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"

void* operator new(size_t size) {
  void* block = std::malloc(kHeader + size);
  if (block == nullptr) throw std::bad_alloc();
  *static_cast<size_t*>(block) = size;
  ++allocations;
  const int64_t live = live_bytes += static_cast<int64_t>(size);
  int64_t peak = peak_bytes;
  while (peak < live && !peak_bytes.compare_exchange_weak(peak, live)) {
  }
  return static_cast<char*>(block) + kHeader;
}

void operator delete(void* pointer) noexcept {
  if (pointer == nullptr) return;
  void* block = static_cast<char*>(pointer) - kHeader;
  live_bytes -= static_cast<int64_t>(*static_cast<size_t*>(block));
  std::free(block);
}

void operator delete(void* pointer, size_t) noexcept { operator delete(pointer); }
