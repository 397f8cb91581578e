// SPDX-License-Identifier: GPL-3.0-or-later
// This thread is joined in its destructor, like std::jthread, which libc++ before 20 lacks.
#pragma once

#include <system_error>
#include <thread>
#include <utility>

namespace medial {

class Thread {
 public:
  Thread() = default;
  // Does nothing if the system cannot start another thread.
  template <typename Work>
  explicit Thread(Work work) {
    try {
      thread_ = std::thread(std::move(work));
    } catch (const std::system_error&) {
    }
  }
  Thread(Thread&&) = default;
  Thread& operator=(Thread&&) = delete;
  ~Thread() {
    if (started()) thread_.join();
  }

  bool started() const { return thread_.joinable(); }

 private:
  std::thread thread_;
};

}  // namespace medial
