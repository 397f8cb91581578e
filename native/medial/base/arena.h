// The memory of an analysis: what one stage frees serves the next. The system takes long to hand
// out fresh memory, longer than some stages take.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <mutex>
#include <new>
#include <stop_token>
#include <vector>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace medial {

namespace detail {

inline constexpr size_t kPage = 4096;
inline constexpr size_t kSmall = 4096;    // requests below leave no gaps here
inline constexpr size_t kStep = 8 << 20;  // between two looks at whether to stop
inline constexpr size_t kLine = 64;       // of the cache

inline size_t rounded_up(size_t bytes, size_t step) { return (bytes + step - 1) / step * step; }

inline bool populate([[maybe_unused]] std::byte* begin, [[maybe_unused]] size_t bytes) {
#ifdef MADV_POPULATE_WRITE  // Linux 5.14
  return madvise(begin, bytes, MADV_POPULATE_WRITE) == 0;
#else
  return false;
#endif
}

}  // namespace detail

// A block of address space that becomes memory as it is touched; requests that find no room in it
// are met elsewhere.
class Arena {
 public:
  explicit Arena(size_t capacity);
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  void* take(size_t bytes);
  void give_back(void* memory, size_t bytes);
  // Has the first bytes touched, where the system can do so beside those who use them.
  void touch(size_t bytes, const std::stop_token& stop);
  // Memory that the system has given; what was touched stays.
  size_t held() const;

 private:
  bool owns(const void* memory) const;

  mutable std::mutex mutex_;
  std::byte* block_;
  size_t capacity_;
  std::map<size_t, size_t> free_;       // offset: bytes; no two touch
  size_t touched_ = 0, elsewhere_ = 0;  // of the block; beside it
};

inline Arena::Arena(size_t capacity)
    : block_(
          static_cast<std::byte*>(::operator new (detail::rounded_up(capacity, detail::kPage),
                                                  std::align_val_t{detail::kPage}, std::nothrow))),
      capacity_(block_ ? detail::rounded_up(capacity, detail::kPage) : 0) {
  if (capacity_ > 0) free_[0] = capacity_;
}

inline Arena::~Arena() { ::operator delete (block_, std::align_val_t{detail::kPage}); }

inline bool Arena::owns(const void* memory) const {
  const auto* const at = static_cast<const std::byte*>(memory);
  return !std::less<>()(at, block_) && std::less<>()(at, block_ + capacity_);
}

inline void* Arena::take(size_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    const size_t size = detail::rounded_up(bytes, detail::kLine);
    const auto room = bytes < detail::kSmall
                          ? free_.end()
                          : std::find_if(free_.begin(), free_.end(),
                                         [&](const auto& f) { return f.second >= size; });
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

inline void Arena::give_back(void* memory, size_t bytes) {
  const bool own = owns(memory);
  if (!own) ::operator delete(memory);
  const std::lock_guard lock(mutex_);
  if (!own) {
    elsewhere_ -= bytes;
    return;
  }
  const auto offset = static_cast<size_t>(static_cast<std::byte*>(memory) - block_);
  auto here = free_.emplace(offset, detail::rounded_up(bytes, detail::kLine)).first;
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

inline void Arena::touch(size_t bytes, const std::stop_token& stop) {
  const size_t end = std::min(bytes, capacity_) / detail::kPage * detail::kPage;
  for (size_t at = 0; at < end && !stop.stop_requested(); at += detail::kStep) {
    if (!detail::populate(block_ + at, std::min(detail::kStep, end - at))) return;
    const std::lock_guard lock(mutex_);
    touched_ = std::max(touched_, std::min(at + detail::kStep, end));
  }
}

inline size_t Arena::held() const {
  const std::lock_guard lock(mutex_);
  return touched_ + elsewhere_;
}

// Memory from a arena, or from anywhere for none.
template <typename T>
struct ArenaAllocator {
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  ArenaAllocator(Arena* from = nullptr) : arena(from) {}
  template <typename U>
  ArenaAllocator(const ArenaAllocator<U>& other) : arena(other.arena) {}

  T* allocate(size_t count) {
    const size_t bytes = count * sizeof(T);
    return static_cast<T*>(arena ? arena->take(bytes) : ::operator new(bytes));
  }
  void deallocate(T* memory, size_t count) {
    if (arena) {
      arena->give_back(memory, count * sizeof(T));
    } else {
      ::operator delete(memory);
    }
  }
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
