// SPDX-License-Identifier: GPL-3.0-or-later
// Loops also finish if the system gives no more threads. This program has its own pthread_create,
// which then fails.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <medial/analysis.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>

#include "shapes.h"

namespace {

std::atomic<int> threads_left{1 << 20};

}  // namespace

extern "C" __attribute__((visibility("default"))) int pthread_create(pthread_t* thread,
                                                                     const pthread_attr_t* how,
                                                                     void* (*work)(void*),
                                                                     void* data) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  return threads_left-- > 0 ? create(thread, how, work, data) : EAGAIN;
}

namespace medial {
namespace {

class FewThreads : public testing::TestWithParam<int> {
 protected:
  void TearDown() override { threads_left = 1 << 20; }
};

TEST_P(FewThreads, EachIdIsVisitedOnce) {
  std::vector<int> visits(100000, 0);
  threads_left = GetParam();
  parallel_for(
      static_cast<int64_t>(visits.size()), {8}, [&](int64_t i) { ++visits[i]; }, 100);
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 100000);
  EXPECT_LT(threads_left, GetParam());  // so many were asked for, or the next in vain
}

TEST_P(FewThreads, TheAxisIsTheSame) {
  const auto points = test::ellipsoid(5000, 2);
  const auto axis = [&] { return MedialAnalysis({points}, {.threads = 8}, nullptr).extract({}); };
  const MedialMesh many = axis();
  threads_left = GetParam();
  const MedialMesh few = axis();
  EXPECT_EQ(few.vertices, many.vertices);
  EXPECT_EQ(few.face_vertices, many.face_vertices);
  EXPECT_EQ(few.generators, many.generators);
}

INSTANTIATE_TEST_SUITE_P(Left, FewThreads, testing::Values(0, 1, 5));

}  // namespace
}  // namespace medial
