// SPDX-License-Identifier: GPL-3.0-or-later
// This class reserves a range of addresses at once, which becomes memory as it is used. It is the
// only unit that knows how the system hands out memory.
#pragma once

#include <cstddef>

namespace medial {

// Advises the system to use few large pages instead of many small ones, if it has such: it then
// hands out memory faster, and the processor finds it faster.
void prefer_huge_pages(void* memory, size_t bytes);

// Makes the C library return the memory to the system that the program has freed, if it can.
void release_heap();

class AddressSpace {
 public:
  // The range is empty if the system lacks this many consecutive addresses.
  explicit AddressSpace(size_t bytes);
  ~AddressSpace();
  AddressSpace(const AddressSpace&) = delete;
  AddressSpace& operator=(const AddressSpace&) = delete;

  std::byte* begin() const { return begin_; }
  size_t size() const { return size_; }

  // Makes the first bytes writable; returns false if there is too little memory. Only one thread
  // may call this at a time.
  bool commit(size_t bytes);
  // Maps bytes to memory before they are touched; returns false if the system cannot do that.
  bool populate(size_t from, size_t bytes) const;
  // Gives the memory of whole pages back to the system; they come back empty when they are touched
  // again. Returns false if the system cannot do that.
  bool release(size_t from, size_t bytes) const;

 private:
  std::byte* begin_ = nullptr;
  size_t size_ = 0;
  size_t committed_ = 0;
};

}  // namespace medial
