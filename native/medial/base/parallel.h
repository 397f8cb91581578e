// SPDX-License-Identifier: GPL-3.0-or-later
// These loops run over ids on all cores. A loop body writes only slots of its own ids, so results
// never depend on the threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <vector>

#include "base/run.h"
#include "base/thread.h"

namespace medial {

inline int thread_count(int wanted) {
  if (wanted > 0) return wanted;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

inline constexpr int64_t kGrain = 2048;

// Calls body(begin, end, worker) for chunks of at most `grain` ids that cover [0, count); worker <
// run.threads. Chunks start at multiples of `grain`, whatever the number of threads that are wanted
// or available. The first exception is rethrown.
inline void parallel_chunks(int64_t count, const Run& run,
                            const std::function<void(int64_t, int64_t, int)>& body,
                            int64_t grain = kGrain) {
  std::atomic<int64_t> next{0};
  std::atomic<bool> stop{false};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&](int worker) {
    try {
      for (;;) {
        const int64_t begin = next.fetch_add(grain);
        if (begin >= count || stop.load(std::memory_order_relaxed)) return;
        throw_if_cancelled(run.progress);
        body(begin, std::min(begin + grain, count), worker);
        if (worker == 0 && run.moves_bar) {
          advance(run.progress, static_cast<double>(begin) / static_cast<double>(count));
        }
      }
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      stop = true;
    }
  };
  const int64_t chunks = (count + grain - 1) / grain;
  const int extra = static_cast<int>(std::min<int64_t>(run.threads, chunks)) - 1;
  {
    std::vector<Thread> team;
    for (int i = 0; i < extra; ++i) {
      team.emplace_back([&work, worker = i + 1] { work(worker); });
      if (!team.back().started()) break;
    }
    work(0);
  }
  if (failure) std::rethrow_exception(failure);
}

// Calls body(id) for every id in [0, count).
template <typename Body>
void parallel_for(int64_t count, const Run& run, const Body& body, int64_t grain = kGrain) {
  parallel_chunks(
      count, run,
      [&](int64_t begin, int64_t end, int) {
        for (int64_t i = begin; i < end; ++i) body(i);
      },
      grain);
}

// Collects the items that body(id, out, worker) appends to `out` for every id in [0, count), in
// order; part i belongs to the ids from i * grain on.
template <typename T, typename Body>
std::vector<Array<T>> parallel_parts(int64_t count, const Run& run, const Body& body,
                                     int64_t grain = kGrain) {
  std::vector<Array<T>> parts(static_cast<size_t>((count + grain - 1) / grain));
  std::vector<std::vector<T>> rooms(run.threads);
  parallel_chunks(
      count, run,
      [&](int64_t begin, int64_t end, int worker) {
        auto& room = rooms[worker];
        room.clear();
        for (int64_t i = begin; i < end; ++i) body(i, room, worker);
        parts[static_cast<size_t>(begin / grain)] = pack(room, run);
      },
      grain);
  return parts;
}

// Does the same, and appends the items as one list to `all`.
template <typename All, typename Body>
void parallel_append_to(All& all, int64_t count, const Run& run, const Body& body,
                        int64_t grain = kGrain) {
  auto parts = parallel_parts<typename All::value_type>(count, run, body, grain);
  std::vector<size_t> begin{all.size()};
  for (const auto& part : parts) begin.push_back(begin.back() + part.size());
  all.resize(begin.back());
  parallel_for(
      static_cast<int64_t>(parts.size()), {run.threads},
      [&](int64_t i) {
        std::copy(parts[i].begin(), parts[i].end(), all.data() + begin[i]);
        parts[i] = {};
      },
      1);
}

template <typename T, typename Body>
std::vector<T> parallel_append(int64_t count, const Run& run, const Body& body,
                               int64_t grain = kGrain) {
  std::vector<T> all;
  parallel_append_to(all, count, run, body, grain);
  return all;
}

}  // namespace medial
