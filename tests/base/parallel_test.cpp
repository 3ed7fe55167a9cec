#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/no_threads.h"

namespace icome::base {
namespace {

/// Marks all items, and gives how often each was met.
std::vector<int> met_by_parts(std::size_t count, std::size_t grain) {
  std::vector<int> met(count, 0);
  parallel_for(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) ++met[i];
  });
  return met;
}

TEST(ParallelFor, MeetsEveryItemOnce) {
  for (const std::size_t count : {0, 1, 2, 7, 1000})
    for (const std::size_t grain : {0, 1, 3, 5000})
      EXPECT_EQ(met_by_parts(count, grain), std::vector<int>(count, 1)) << count << " by " << grain;
}

TEST(ParallelFor, ThrowsWhatAPartHasThrownWhenAllAreOver) {
  for (const std::size_t bad : {0, 500, 999}) {
    std::atomic<std::size_t> over = 0;
    try {
      parallel_for(1000, 1, [&](std::size_t begin, std::size_t end) {
        over += end - begin;
        if (begin <= bad && bad < end) throw std::runtime_error("item " + std::to_string(bad));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), "item " + std::to_string(bad));
    }
    EXPECT_EQ(over, 1000U);
  }
}

TEST(ParallelFor, ThrowsWhatTheFirstPartHasThrown) {
  for (int i = 0; i < 20; ++i) {
    try {
      parallel_for(1000, 1, [](std::size_t begin, std::size_t) { throw begin; });
      FAIL() << "nothing was thrown";
    } catch (std::size_t begin) {
      EXPECT_EQ(begin, 0U);
    }
  }
}

TEST(ParallelFor, DoesAllByItselfWhereThereAreNoThreads) {
  const NoThreads none;
  EXPECT_THROW(std::thread([] {}).join(), std::system_error);
  EXPECT_EQ(met_by_parts(1000, 1), std::vector<int>(1000, 1));
}

}  // namespace
}  // namespace icome::base
