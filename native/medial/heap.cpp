#include "heap.h"

#include <algorithm>
#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace medial {
namespace {

constexpr size_t kPage = 4096;   // and at least a cache line apart
constexpr size_t kSmall = 4096;  // requests below leave no gaps here
constexpr size_t kStep = 8 << 20;

size_t rounded_up(size_t bytes, size_t step) { return (bytes + step - 1) / step * step; }

#ifdef __linux__
bool populate(std::byte* begin, size_t bytes) {
#ifdef MADV_POPULATE_WRITE  // Linux 5.14
  return madvise(begin, bytes, MADV_POPULATE_WRITE) == 0;
#else
  return begin == nullptr && bytes == 0;
#endif
}
#else
bool populate(std::byte*, size_t) { return false; }
#endif

}  // namespace

Heap::Heap(size_t capacity)
    : block_(static_cast<std::byte*>(
          ::operator new (rounded_up(capacity, kPage), std::align_val_t{kPage}, std::nothrow))),
      capacity_(block_ ? rounded_up(capacity, kPage) : 0) {
  if (capacity_ > 0) free_[0] = capacity_;
}

Heap::~Heap() { ::operator delete (block_, std::align_val_t{kPage}); }

bool Heap::owns(const void* memory) const {
  const auto* const at = static_cast<const std::byte*>(memory);
  return !std::less<>()(at, block_) && std::less<>()(at, block_ + capacity_);
}

void* Heap::take(size_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    used_ += bytes;
    peak_ = std::max(peak_, used_);
    const size_t size = rounded_up(bytes, 64);
    const auto room =
        bytes < kSmall ? free_.end() : std::find_if(free_.begin(), free_.end(), [&](const auto& f) {
          return f.second >= size;
        });
    if (room != free_.end()) {
      const auto [offset, left] = *room;
      free_.erase(room);
      if (left > size) free_[offset + size] = left - size;
      touched_ = std::max(touched_, offset + size);
      return block_ + offset;
    }
    elsewhere_ += bytes;
  }
  return ::operator new(bytes);
}

void Heap::give_back(void* memory, size_t bytes) {
  const bool own = owns(memory);
  if (!own) ::operator delete(memory);
  const std::lock_guard lock(mutex_);
  used_ -= bytes;
  if (!own) {
    elsewhere_ -= bytes;
    return;
  }
  const auto offset = static_cast<size_t>(static_cast<std::byte*>(memory) - block_);
  auto here = free_.emplace(offset, rounded_up(bytes, 64)).first;
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

void Heap::touch(size_t bytes, const std::stop_token& stop) {
  const size_t end = std::min(bytes, capacity_) / kPage * kPage;
  for (size_t at = 0; at < end && !stop.stop_requested(); at += kStep) {
    if (!populate(block_ + at, std::min(kStep, end - at))) return;
    const std::lock_guard lock(mutex_);
    touched_ = std::max(touched_, std::min(at + kStep, end));
  }
}

size_t Heap::used() const {
  const std::lock_guard lock(mutex_);
  return used_;
}

size_t Heap::peak() const {
  const std::lock_guard lock(mutex_);
  return peak_;
}

size_t Heap::held() const {
  const std::lock_guard lock(mutex_);
  return touched_ + elsewhere_;
}

}  // namespace medial
