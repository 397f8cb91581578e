// SPDX-License-Identifier: GPL-3.0-or-later
// Progress of one job, shared by the thread that computes and the one that watches, and its cancel
// flag.
#pragma once

#include <medial/errors.h>

#include <atomic>

namespace medial {

// How far a job is, what it does, and whether it is to end.
class Progress {
 public:
  // For those who watch; safe to use from any thread at any time. A job that is cancelled throws
  // Cancelled within 0.3 s.
  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  const char* stage() const { return stage_.load(std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }

  // For the job. `name` must outlive it: string literals only.
  void begin_stage(const char* name, double from, double to) {
    stage_.store(name, std::memory_order_relaxed);
    from_ = from;
    to_ = to;
    advance(0);
  }
  // `share` of the running stage that is done, 0 to 1.
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
