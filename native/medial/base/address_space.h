// SPDX-License-Identifier: GPL-3.0-or-later
// A range of addresses, reserved at once, that becomes memory as it is used. The only unit that
// knows how the system hands out memory.
#pragma once

#include <cstddef>

namespace medial {

class AddressSpace {
 public:
  // The range has no bytes where the system lacks so many consecutive addresses.
  explicit AddressSpace(size_t bytes);
  ~AddressSpace();
  AddressSpace(const AddressSpace&) = delete;
  AddressSpace& operator=(const AddressSpace&) = delete;

  std::byte* begin() const { return begin_; }
  size_t size() const { return size_; }

  // Makes the first bytes fit to be written; false where there is too little memory. Not for
  // several threads at once.
  bool commit(size_t bytes);
  // Maps bytes to memory before they are touched; false where the system cannot do that.
  bool populate(size_t from, size_t bytes) const;
  // Returns the memory of whole pages, which come back empty when they are touched; false where the
  // system cannot do that.
  bool release(size_t from, size_t bytes) const;

 private:
  std::byte* begin_ = nullptr;
  size_t size_ = 0;
  size_t committed_ = 0;
};

}  // namespace medial
