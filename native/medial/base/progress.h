// Progress of one job, shared by the thread that computes and the one that watches, and its cancel
// flag.
#pragma once

#include <atomic>

#include "base/errors.h"

namespace medial {

class Progress {
 public:
  double fraction() const { return fraction_.load(std::memory_order_relaxed); }
  const char* stage() const { return stage_.load(std::memory_order_relaxed); }
  bool cancelled() const { return cancelled_.load(std::memory_order_relaxed); }
  void cancel() { cancelled_.store(true, std::memory_order_relaxed); }

  // `name` must outlive the job: string literals only.
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

inline void begin_stage(Progress* progress, const char* name, double from, double to) {
  if (progress) progress->begin_stage(name, from, to);
}
inline void throw_if_cancelled(const Progress* progress) {
  if (progress && progress->cancelled()) throw Cancelled();
}
inline void advance(Progress* progress, double share) {
  if (progress) progress->advance(share);
}

}  // namespace medial
