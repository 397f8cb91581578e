// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/arena.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <type_traits>

#include "analysis_parts.h"
#include "delaunay/triangulation.h"
#include "process_memory.h"
#include "shapes.h"

namespace medial {
namespace {

// The arrays of an analysis would lie in an arena that is gone. The analysis itself moves the
// pointer to all of them.
static_assert(!std::is_move_constructible_v<MedialAnalysis::Parts>);
static_assert(!std::is_move_assignable_v<MedialAnalysis::Parts>);
static_assert(!std::is_copy_constructible_v<MedialAnalysis::Parts>);
static_assert(!std::is_copy_constructible_v<MedialAnalysis>);

constexpr size_t kMegabyte = 1 << 20;

TEST(Arena, ServesTheNextWithWhatOneHasFreed) {
  if (!Arena::in_use()) GTEST_SKIP() << "built without arenas";
  Arena arena(16 * kMegabyte);
  void* const first = arena.take(3 * kMegabyte);
  void* const second = arena.take(kMegabyte);
  arena.give_back(first, 3 * kMegabyte);
  void* const third = arena.take(2 * kMegabyte);
  EXPECT_EQ(third, first);
  EXPECT_EQ(arena.held(), 4 * kMegabyte);
  arena.give_back(second, kMegabyte);
  arena.give_back(third, 2 * kMegabyte);
  // The free memory is one block again.
  void* const all = arena.take(16 * kMegabyte);
  EXPECT_EQ(all, first);
  arena.give_back(all, 16 * kMegabyte);
}

TEST(Arena, DoesNotCountMemoryThatTheSystemRefuses) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers end the program where memory is refused";
#endif
  Arena arena(kMegabyte);
  EXPECT_THROW(arena.take(size_t{1} << 62), std::bad_alloc);
  EXPECT_EQ(arena.held(), 0u);
}

TEST(Arena, ReturnsWhatIsFreeAndKeepsWhatIsNot) {
  if (!Arena::in_use()) GTEST_SKIP() << "built without arenas";
#ifdef _WIN32
  GTEST_SKIP() << "here the memory stays";
#endif
  constexpr size_t kPart = 32 * kMegabyte;
  Arena arena(4 * kPart);
  const size_t before = test::process_memory();
  std::array<void*, 4> parts{};
  for (void*& part : parts) {
    part = arena.take(kPart);
    std::memset(part, 1, kPart);
  }
  arena.give_back(parts[0], kPart);
  arena.give_back(parts[2], kPart);
  arena.give_back(parts[3], kPart);
  EXPECT_GT(test::process_memory(), before + 3 * kPart);  // what is free stays memory until then
  arena.release();
  EXPECT_LT(test::process_memory(), before + kPart + kPart / 2);
  EXPECT_EQ(arena.held(), 2 * kPart);
  const auto* const kept = static_cast<const unsigned char*>(parts[1]);
  EXPECT_TRUE(std::all_of(kept, kept + kPart, [](unsigned char byte) { return byte == 1; }));
  void* const again = arena.take(kPart);
  EXPECT_EQ(again, parts[0]);
  std::memset(again, 2, kPart);  // comes back
  EXPECT_GT(test::process_memory(), before + kPart + kPart / 2);
  arena.give_back(again, kPart);
  arena.give_back(parts[1], kPart);
  arena.release();
  EXPECT_EQ(arena.held(), 0u);
}

TEST(Arena, MeetsElsewhereWhatFindsNoRoom) {
  Arena arena(2 * kMegabyte);
  void* const fits = arena.take(kMegabyte);
  void* const larger = arena.take(4 * kMegabyte);
  std::memset(larger, 1, 4 * kMegabyte);
  EXPECT_EQ(arena.held(), 5 * kMegabyte);
  arena.give_back(larger, 4 * kMegabyte);
  EXPECT_EQ(arena.held(), kMegabyte);
  arena.give_back(fits, kMegabyte);
}

TEST(Arena, ReservesAddressesAndNotMemory) {
  if (!Arena::in_use()) GTEST_SKIP() << "built without arenas";
  constexpr size_t kReserved = size_t{8} << 30, kUsed = 64 * kMegabyte;
  const size_t before = test::process_memory();
  Arena arena(kReserved);
  ASSERT_EQ(arena.capacity(), kReserved);
  const size_t reserved = test::process_memory();
  EXPECT_LT(reserved, before + kMegabyte);
  void* const memory = arena.take(kUsed);
  std::memset(memory, 1, kUsed);
  const size_t used = test::process_memory();
  EXPECT_GE(used, reserved + kUsed - kMegabyte);
  EXPECT_LE(used, reserved + kUsed + 9 * kMegabyte);
  arena.give_back(memory, kUsed);
}

TEST(Arena, FillsFreshMemoryWhereItIsBuiltTo) {
#ifdef MEDIAL_FILL_MEMORY
  Arena arena(2 * kMegabyte);
  for (Arena* from : {&arena, static_cast<Arena*>(nullptr)}) {
    const Array<uint8_t> fresh(kMegabyte, ArenaAllocator<uint8_t>(from));
    EXPECT_EQ(std::count(fresh.begin(), fresh.end(), 0xCD), kMegabyte);
  }
#else
  GTEST_SKIP() << "built without MEDIAL_FILL_MEMORY";
#endif
}

#if defined(__SANITIZE_ADDRESS__)
#define MEDIAL_ASAN
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MEDIAL_ASAN
#endif
#endif

// Faults planted into the arrays of an analysis, which AddressSanitizer must see: with all of them
// in one block it would not.
class PlantedFaultDeathTest : public testing::Test {
 protected:
  void SetUp() override {
#ifndef MEDIAL_ASAN
    GTEST_SKIP() << "built without AddressSanitizer";
#endif
    testing::FLAGS_gtest_death_test_style = "threadsafe";
  }

  // Beyond what the compiler can see through.
  static volatile Cell* cell(Array<Cell>& cells, size_t i) { return cells.data() + i; }

  const std::vector<Vec3> points_ = test::random_points(1000, 3);
  Arena arena_{2000 * points_.size()};
};

TEST_F(PlantedFaultDeathTest, OverflowOfAnArrayIsSeen) {
  Triangulation t = triangulate(points_, {1, nullptr, &arena_});
  auto* const id = reinterpret_cast<volatile int32_t*>(cell(t.cells, t.cells.size()));
  EXPECT_DEATH(*id = 1, "heap-buffer-overflow");
}

TEST_F(PlantedFaultDeathTest, UseOfAnArrayThatIsFreedIsSeen) {
  Triangulation t = triangulate(points_, {1, nullptr, &arena_});
  auto* const id = reinterpret_cast<volatile int32_t*>(cell(t.cells, 0));
  t.cells = Array<Cell>(ArenaAllocator<Cell>(&arena_));
  EXPECT_DEATH(*id = 1, "heap-use-after-free");
}

}  // namespace
}  // namespace medial
