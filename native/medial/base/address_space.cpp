// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/address_space.h"

#include <algorithm>
#include <cstdlib>
#include <memory>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#ifdef _WIN32
#define WIN32_LEAN_AND_MEAN
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>
#else
#include <sys/mman.h>
#endif

namespace medial {

void release_heap() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

#ifdef _WIN32

void prefer_huge_pages(void*, size_t) {}

namespace {

constexpr size_t kStep = 8 << 20;  // bytes committed at once

}  // namespace

AddressSpace::AddressSpace(size_t bytes) {
  if (bytes == 0) return;
  begin_ = static_cast<std::byte*>(VirtualAlloc(nullptr, bytes, MEM_RESERVE, PAGE_READWRITE));
  if (begin_ != nullptr) size_ = bytes;
}

AddressSpace::~AddressSpace() {
  if (begin_ != nullptr) VirtualFree(begin_, 0, MEM_RELEASE);
}

bool AddressSpace::commit(size_t bytes) {
  if (bytes <= committed_) return true;
  const size_t more =
      std::min((bytes - committed_ + kStep - 1) / kStep * kStep, size_ - committed_);
  if (VirtualAlloc(begin_ + committed_, more, MEM_COMMIT, PAGE_READWRITE) == nullptr) return false;
  committed_ += more;
  return true;
}

bool AddressSpace::populate(size_t, size_t) const { return false; }

bool AddressSpace::release(size_t, size_t) const { return false; }

#else

void prefer_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] size_t bytes) {
#ifdef MADV_HUGEPAGE  // Linux
  constexpr size_t kHugePage = 2 << 20;
  if (std::align(kHugePage, kHugePage, memory, bytes) == nullptr) return;
  madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
}

AddressSpace::AddressSpace(size_t bytes) {
  if (bytes == 0) return;
  void* const found = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                           MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (found == MAP_FAILED) return;
  begin_ = static_cast<std::byte*>(found);
  size_ = bytes;
  prefer_huge_pages(begin_, size_);
}

AddressSpace::~AddressSpace() {
  if (begin_ != nullptr) munmap(begin_, size_);
}

// On this system addresses become memory by themselves when they are touched.
bool AddressSpace::commit(size_t bytes) {
  committed_ = std::max(committed_, bytes);
  return true;
}

bool AddressSpace::populate([[maybe_unused]] size_t from, [[maybe_unused]] size_t bytes) const {
#ifdef MADV_POPULATE_WRITE  // Linux 5.14
  return madvise(begin_ + from, bytes, MADV_POPULATE_WRITE) == 0;
#else
  return false;
#endif
}

bool AddressSpace::release(size_t from, size_t bytes) const {
#ifdef __APPLE__  // where MADV_DONTNEED keeps the pages
  return madvise(begin_ + from, bytes, MADV_FREE) == 0;
#else
  return madvise(begin_ + from, bytes, MADV_DONTNEED) == 0;
#endif
}

#endif

}  // namespace medial
