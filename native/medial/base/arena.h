// SPDX-License-Identifier: GPL-3.0-or-later
// An arena holds the memory of an analysis, so that later stages reuse what earlier ones free.
// Getting fresh memory from the system takes longer than some stages do.
#pragma once

#include <atomic>
#include <cstddef>
#include <map>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

#include "base/address_space.h"
#include "base/thread.h"

namespace medial {

// An arena is a block of address space that becomes memory as it is used. Requests that do not fit
// into it are served by operator new. It is safe to use from several threads.
class Arena {
 public:
  explicit Arena(size_t capacity);
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // Tells whether arenas have a block. They have none in builds with a sanitizer, which would see
  // the block as a single allocation, nor without MEDIAL_ARENA: operator new then serves all
  // requests.
  static bool in_use();

  void* take(size_t bytes);
  void give_back(void* memory, size_t bytes);
  // Gives free pages back to the system, if it accepts them. Touching them again is slow (page
  // faults).
  void release();
  size_t capacity() const { return block_.size(); }
  // Counts the bytes from the system, up to the last byte of the block that is used or was not
  // released.
  size_t held() const;

 private:
  friend class ArenaToucher;

  void* take_from_block(size_t bytes);
  void give_back_to_block(size_t offset, size_t bytes);
  bool owns(const void* memory) const;
  void touch(size_t bytes, const std::atomic<bool>& stop);

  mutable std::mutex mutex_;
  AddressSpace block_;
  std::map<size_t, size_t> free_;       // maps offsets to bytes; no two ranges touch
  size_t touched_ = 0, elsewhere_ = 0;  // bytes of the block, and outside it
};

// Touches the first bytes of an arena from a thread of its own, so that later stages find mapped
// pages. It stops when all are touched or the variable is destroyed. It does nothing where the
// system cannot map pages while others use them.
class ArenaToucher {
 public:
  ArenaToucher(Arena& arena, size_t bytes);
  ~ArenaToucher() { stop_ = true; }
  ArenaToucher(const ArenaToucher&) = delete;
  ArenaToucher& operator=(const ArenaToucher&) = delete;

 private:
  std::atomic<bool> stop_{false};
  Thread thread_;  // is destroyed before the flag that it reads
};

// Takes memory from an arena, or from operator new if there is none.
void* take_memory(Arena* arena, size_t bytes);
void give_memory_back(Arena* arena, void* memory, size_t bytes);

template <typename T>
struct ArenaAllocator {
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  ArenaAllocator(Arena* from = nullptr) : arena(from) {}
  template <typename U>
  ArenaAllocator(const ArenaAllocator<U>& other) : arena(other.arena) {}

  T* allocate(size_t count) { return static_cast<T*>(take_memory(arena, count * sizeof(T))); }
  void deallocate(T* memory, size_t count) { give_memory_back(arena, memory, count * sizeof(T)); }
  // Constructing an element without a value does nothing: all arrays are written before they are
  // read.
  template <typename U>
  void construct(U*) noexcept {}
  template <typename U, typename... Values>
  void construct(U* element, Values&&... values) {
    ::new (static_cast<void*>(element)) U(std::forward<Values>(values)...);
  }
  template <typename U>
  friend bool operator==(const ArenaAllocator& a, const ArenaAllocator<U>& b) {
    return a.arena == b.arena;
  }

  Arena* arena;
};

// Elements of an array are uninitialised until they are written.
template <typename T>
using Array = std::vector<T, ArenaAllocator<T>>;

}  // namespace medial
