// Loops over ids on all cores. A loop body writes only slots of its own ids, so results never
// depend on the threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "progress.h"

namespace medial {

// What every stage needs beside its data.
struct Run {
  int threads = 1;
  Progress* progress = nullptr;
};

inline int thread_count(int wanted) {
  if (wanted > 0) return wanted;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

inline constexpr int64_t kGrain = 2048;

// Calls body(begin, end, worker) for chunks of at most `grain` ids that cover [0, count); worker <
// run.threads. Chunks start at multiples of `grain`, whatever the number of threads. The first
// exception is rethrown.
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
        if (worker == 0) {
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
    std::vector<std::jthread> team;
    for (int i = 0; i < extra; ++i) team.emplace_back(work, i + 1);
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

// Concatenates, in order of the ids, what body(id, out) appends to `out` for every id in [0,
// count).
template <typename T, typename Body>
std::vector<T> parallel_append(int64_t count, const Run& run, const Body& body,
                               int64_t grain = kGrain) {
  const auto chunks = static_cast<size_t>((count + grain - 1) / grain);
  std::vector<std::vector<T>> parts(chunks);
  parallel_chunks(
      count, run,
      [&](int64_t begin, int64_t end, int worker) {
        auto& part = parts[static_cast<size_t>(begin / grain)];
        for (int64_t i = begin; i < end; ++i) body(i, part, worker);
      },
      grain);
  size_t total = 0;
  for (const auto& part : parts) total += part.size();
  std::vector<T> all;
  all.reserve(total);
  for (auto& part : parts) {
    all.insert(all.end(), part.begin(), part.end());
    std::vector<T>().swap(part);
  }
  return all;
}

}  // namespace medial
