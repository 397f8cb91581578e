// The memory of an analysis: what one stage frees serves the next. The system takes long to hand
// out fresh memory, longer than some stages take.
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <stop_token>
#include <vector>

namespace medial {

// A block of address space that becomes memory as it is touched; requests that find no room in it
// are met elsewhere.
class Heap {
 public:
  explicit Heap(size_t capacity);
  ~Heap();
  Heap(const Heap&) = delete;
  Heap& operator=(const Heap&) = delete;

  void* take(size_t bytes);
  void give_back(void* memory, size_t bytes);
  // Has the first bytes touched, where the system can do so beside those who use them.
  void touch(size_t bytes, const std::stop_token& stop);
  size_t used() const;  // bytes that were taken and not given back
  size_t peak() const;  // the most that ever were
  // Memory that the system has given; what was touched stays.
  size_t held() const;

 private:
  bool owns(const void* memory) const;

  mutable std::mutex mutex_;
  std::byte* block_;
  size_t capacity_;
  std::map<size_t, size_t> free_;  // offset: bytes; no two touch
  size_t used_ = 0, peak_ = 0;
  size_t touched_ = 0, elsewhere_ = 0;  // of the block; beside it
};

// Memory from a heap, or from anywhere for none.
template <typename T>
struct HeapAllocator {
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  HeapAllocator(Heap* from = nullptr) : heap(from) {}
  template <typename U>
  HeapAllocator(const HeapAllocator<U>& other) : heap(other.heap) {}

  T* allocate(size_t count) {
    const size_t bytes = count * sizeof(T);
    return static_cast<T*>(heap ? heap->take(bytes) : ::operator new(bytes));
  }
  void deallocate(T* memory, size_t count) {
    if (heap) {
      heap->give_back(memory, count * sizeof(T));
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
  friend bool operator==(const HeapAllocator& a, const HeapAllocator<U>& b) {
    return a.heap == b.heap;
  }

  Heap* heap;
};

// Elements have no value until they are given one.
template <typename T>
using Array = std::vector<T, HeapAllocator<T>>;

}  // namespace medial
