// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/arena.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <iterator>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)  // GCC
#define MEDIAL_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)  // Clang
#define MEDIAL_SANITIZED
#endif
#endif

namespace medial {
namespace {

#if defined(MEDIAL_SANITIZED) || defined(MEDIAL_NO_ARENA)
constexpr bool kInUse = false;
#else
constexpr bool kInUse = true;
#endif

#ifdef MEDIAL_FILL_MEMORY
constexpr bool kFill = true;
#else
constexpr bool kFill = false;
#endif

constexpr int kPattern = 0xCD;     // no valid id, and a coordinate out of range
constexpr size_t kPage = 16384;    // a multiple of every page of memory: 4 KB on PCs, 16 KB on Macs
constexpr size_t kSmall = 4096;    // requests below leave no gaps in the block
constexpr size_t kStep = 8 << 20;  // between two looks at whether to stop
constexpr size_t kLine = 64;       // of the cache
constexpr size_t kLarge = 4 << 20;

size_t rounded_up(size_t bytes, size_t step) { return (bytes + step - 1) / step * step; }

void* take_elsewhere(size_t bytes) {
  void* const memory = ::operator new(bytes);
  if (bytes >= kLarge) prefer_huge_pages(memory, bytes);
  return memory;
}

}  // namespace

bool Arena::in_use() { return kInUse; }

Arena::Arena(size_t capacity) : block_(kInUse ? rounded_up(capacity, kPage) : 0) {
  if (block_.size() > 0) free_[0] = block_.size();
}

bool Arena::owns(const void* memory) const {
  const auto* const at = static_cast<const std::byte*>(memory);
  return !std::less<>()(at, block_.begin()) && std::less<>()(at, block_.begin() + block_.size());
}

void* Arena::take(size_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    void* const found = bytes < kSmall ? nullptr : take_from_block(bytes);
    if (found != nullptr) return found;
  }
  void* const memory = take_elsewhere(bytes);  // may throw, so it comes before the count
  const std::lock_guard lock(mutex_);
  elsewhere_ += bytes;
  return memory;
}

// Takes the first free range that fits; returns null if there is none.
void* Arena::take_from_block(size_t bytes) {
  const size_t size = rounded_up(bytes, kLine);
  const auto room = std::find_if(free_.begin(), free_.end(),
                                 [&](const auto& range) { return range.second >= size; });
  if (room == free_.end()) return nullptr;
  const auto [offset, left] = *room;
  if (!block_.commit(offset + size)) return nullptr;
  free_.erase(room);
  if (left > size) free_[offset + size] = left - size;
  touched_ = std::max(touched_, offset + size);
  return block_.begin() + offset;
}

void Arena::give_back(void* memory, size_t bytes) {
  const bool own = owns(memory);
  if (!own) ::operator delete(memory);
  const std::lock_guard lock(mutex_);
  if (own) {
    give_back_to_block(static_cast<size_t>(static_cast<std::byte*>(memory) - block_.begin()),
                       rounded_up(bytes, kLine));
  } else {
    elsewhere_ -= bytes;
  }
}

// Merges the range with the free ranges before and behind it.
void Arena::give_back_to_block(size_t offset, size_t bytes) {
  auto here = free_.emplace(offset, bytes).first;
  const auto next = std::next(here);
  if (next != free_.end() && here->first + here->second == next->first) {
    here->second += next->second;
    free_.erase(next);
  }
  if (here == free_.begin()) return;
  const auto before = std::prev(here);
  if (before->first + before->second == here->first) {
    before->second += here->second;
    free_.erase(here);
  }
}

void Arena::release() {
  const std::lock_guard lock(mutex_);
  for (const auto& [offset, bytes] : free_) {
    const size_t from = rounded_up(offset, kPage), end = std::min(offset + bytes, touched_);
    const size_t until = end == touched_ ? rounded_up(end, kPage) : end / kPage * kPage;
    if (from >= until || !block_.release(from, until - from)) continue;
    if (end == touched_) touched_ = from;
  }
}

void Arena::touch(size_t bytes, const std::atomic<bool>& stop) {
  const size_t end = std::min(bytes, block_.size()) / kPage * kPage;
  for (size_t at = 0; at < end && !stop; at += kStep) {
    if (!block_.populate(at, std::min(kStep, end - at))) return;
    const std::lock_guard lock(mutex_);
    touched_ = std::max(touched_, std::min(at + kStep, end));
  }
}

size_t Arena::held() const {
  const std::lock_guard lock(mutex_);
  return touched_ + elsewhere_;
}

ArenaToucher::ArenaToucher(Arena& arena, size_t bytes)
    : thread_([this, &arena, bytes] { arena.touch(bytes, stop_); }) {}

void* take_memory(Arena* arena, size_t bytes) {
  void* const memory = arena ? arena->take(bytes) : take_elsewhere(bytes);
  if (kFill) std::memset(memory, kPattern, bytes);
  return memory;
}

void give_memory_back(Arena* arena, void* memory, size_t bytes) {
  if (arena) {
    arena->give_back(memory, bytes);
  } else {
    ::operator delete(memory);
  }
}

}  // namespace medial
