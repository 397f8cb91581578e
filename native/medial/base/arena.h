// SPDX-License-Identifier: GPL-3.0-or-later
// The memory of an analysis: what one stage frees serves the next. The system takes long to hand
// out fresh memory, longer than some stages take.
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

// A block of address space that becomes memory as it is used; requests that find no room in it are
// met elsewhere. Safe to use from several threads.
class Arena {
 public:
  explicit Arena(size_t capacity);
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  // Whether arenas have a block. Not in builds with a sanitizer, for which one block is one
  // allocation, whatever happens in it; nor without MEDIAL_ARENA: all requests are met elsewhere.
  static bool in_use();

  void* take(size_t bytes);
  void give_back(void* memory, size_t bytes);
  // Returns what is free to the system, as far as that takes it. It comes again where it is used,
  // which takes its time.
  void release();
  size_t capacity() const { return block_.size(); }
  // Memory that the system has given, up to the last byte that is used or was not released.
  size_t held() const;

 private:
  friend class ArenaToucher;

  void* take_from_block(size_t bytes);
  void give_back_to_block(size_t offset, size_t bytes);
  bool owns(const void* memory) const;
  void touch(size_t bytes, const std::atomic<bool>& stop);

  mutable std::mutex mutex_;
  AddressSpace block_;
  std::map<size_t, size_t> free_;       // offset: bytes; no two touch
  size_t touched_ = 0, elsewhere_ = 0;  // of the block; beside it
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
  Thread thread_;  // ends before the flag that it reads
};

// From an arena, or from anywhere for none.
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
  // An element without a value stays as it is: all arrays are written before they are read.
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

// Elements have no value until they are given one.
template <typename T>
using Array = std::vector<T, ArenaAllocator<T>>;

}  // namespace medial
