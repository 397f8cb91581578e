// SPDX-License-Identifier: GPL-3.0-or-later
// The progress of one job, and its cancel flag, are shared by the thread that computes and the one
// that watches.
#pragma once

#include <medial/errors.h>

#include <atomic>

namespace medial {

// Progress holds how far a job is, its stage, and whether it was cancelled.
class Progress {
 public:
  // Watchers may call these from any thread at any time. A cancelled job throws Cancelled within
  // 0.3 s.
  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  const char* stage() const { return stage_.load(std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }

  // The job calls these. `name` must outlive the object: pass string literals only.
  void begin_stage(const char* name, double from, double to) {
    stage_.store(name, std::memory_order_relaxed);
    from_ = from;
    to_ = to;
    advance(0);
  }
  // Sets the share of the running stage that is done, 0 to 1.
  void advance(double share) {
    if (cancelled()) throw Cancelled();
    const double now = from_ + share * (to_ - from_);
    if (now > fraction()) fraction_.store(now, std::memory_order_relaxed);
  }

 private:
  std::atomic<double> fraction_{0};
  std::atomic<const char*> stage_{""};
  std::atomic<bool> cancelled_{false};
  double from_ = 0, to_ = 1;  // only the computing thread writes and reads them
};

}  // namespace medial
