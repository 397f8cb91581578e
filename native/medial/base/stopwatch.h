// SPDX-License-Identifier: GPL-3.0-or-later
// A stopwatch measures the seconds of the stages of a computation, in order.
#pragma once

#include <medial/types.h>

#include <chrono>

namespace medial {

class Stopwatch {
 public:
  explicit Stopwatch(Timings& timings) : timings_(timings) {}

  void lap(const char* stage) {
    const auto now = std::chrono::steady_clock::now();
    timings_.emplace_back(stage, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  Timings& timings_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace medial
