#include "realtime/message_pipe.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "realtime/guard/guard.h"

namespace icome::realtime {
namespace {

TEST(MessagePipe, GivesMessagesInTheOrderTheyCame) {
  MessagePipe<int> pipe(3);
  EXPECT_TRUE(pipe.try_push(1));
  EXPECT_TRUE(pipe.try_push(2));
  EXPECT_EQ(pipe.try_pop(), 1);
  EXPECT_TRUE(pipe.try_push(3));
  EXPECT_EQ(pipe.try_pop(), 2);
  EXPECT_EQ(pipe.try_pop(), 3);
  EXPECT_EQ(pipe.try_pop(), std::nullopt);
}

TEST(MessagePipe, HoldsExactlyItsCapacity) {
  // 5 is no power of two, which is what the slots are rounded up to.
  MessagePipe<int> pipe(5);
  EXPECT_EQ(pipe.capacity(), 5u);
  for (int round = 0; round < 4; ++round) {
    for (int i = 0; i < 5; ++i) EXPECT_TRUE(pipe.try_push(i));
    EXPECT_FALSE(pipe.try_push(5));
    for (int i = 0; i < 5; ++i) EXPECT_EQ(pipe.try_pop(), i);
    EXPECT_EQ(pipe.try_pop(), std::nullopt);
  }
}

TEST(MessagePipe, LeavesARefusedMessageWithItsSender) {
  MessagePipe<std::unique_ptr<int>> pipe(1);
  ASSERT_TRUE(pipe.try_push(std::make_unique<int>(1)));
  auto second = std::make_unique<int>(2);
  EXPECT_FALSE(pipe.try_push(std::move(second)));
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(**pipe.try_pop(), 1);
  EXPECT_TRUE(pipe.try_push(std::move(second)));
  EXPECT_EQ(**pipe.try_pop(), 2);
}

TEST(MessagePipe, KeepsNoPartOfAPoppedMessageAndFreesTheRest) {
  // Const, so that moving it out leaves a copy behind: only the pipe can let go of that.
  struct Holder {
    const std::shared_ptr<int> payload;
  };
  const auto payload = std::make_shared<int>(1);
  {
    MessagePipe<Holder> pipe(4);
    pipe.try_push(Holder{payload});
    pipe.try_push(Holder{payload});
    EXPECT_EQ(payload.use_count(), 3);
    pipe.try_pop();
    EXPECT_EQ(payload.use_count(), 2) << "the pipe kept a popped message alive";
  }
  EXPECT_EQ(payload.use_count(), 1) << "the pipe leaked a message it still held";
}

TEST(MessagePipe, CarriesTypesWithoutADefaultValue) {
  struct Numbered {
    explicit Numbered(int n) : number(n) {}
    int number;
  };
  MessagePipe<Numbered> pipe(2);
  pipe.try_push(Numbered(4));
  EXPECT_EQ(pipe.try_pop()->number, 4);
}

TEST(MessagePipe, LosesAndReordersNothingBetweenThreads) {
  constexpr std::uint64_t kMessages = 20000;
  MessagePipe<std::uint64_t> pipe(100);
  std::thread pusher([&pipe] {
    for (std::uint64_t n = 0; n < kMessages; ++n) {
      while (!pipe.try_push(n)) std::this_thread::yield();
    }
  });
  std::uint64_t expected = 0;
  std::uint64_t wrong = 0;
  while (expected < kMessages) {
    const auto message = pipe.try_pop();
    if (!message) {
      std::this_thread::yield();
      continue;
    }
    wrong += *message != expected++;
  }
  pusher.join();
  EXPECT_EQ(wrong, 0u);
  EXPECT_EQ(pipe.try_pop(), std::nullopt);
}

TEST(MessagePipe, NeitherAllocatesNorFreesNorLocks) {
  if (!RealtimeGuard::available()) GTEST_SKIP() << "the guard is off under sanitizers";
  MessagePipe<std::string> pipe(8);
  std::string long_message(100, 'x');
  RealtimeGuard guard;
  const bool pushed = pipe.try_push(std::move(long_message));
  auto popped = pipe.try_pop();
  guard.stop();
  EXPECT_TRUE(pushed);
  EXPECT_EQ(popped->size(), 100u);
  EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0u);
}

TEST(DuplexPipe, CarriesBothWaysAtOnceWithoutMixing) {
  DuplexPipe<int, std::string> pipe(2);
  EXPECT_TRUE(pipe.first().try_push(1));
  EXPECT_TRUE(pipe.second().try_push("one"));
  EXPECT_EQ(pipe.second().try_pop(), 1);
  EXPECT_EQ(pipe.first().try_pop(), "one");
  EXPECT_EQ(pipe.first().try_pop(), std::nullopt);
  EXPECT_EQ(pipe.second().try_pop(), std::nullopt);
}

TEST(DuplexPipe, AnswersEveryQuestionBetweenThreads) {
  constexpr int kQuestions = 2000;
  DuplexPipe<int, int> pipe(30);
  std::thread answerer([&pipe] {
    for (int answered = 0; answered < kQuestions;) {
      const auto question = pipe.second().try_pop();
      if (!question) {
        std::this_thread::yield();
        continue;
      }
      while (!pipe.second().try_push(*question * 2)) std::this_thread::yield();
      ++answered;
    }
  });
  int asked = 0;
  int wrong = 0;
  for (int heard = 0; heard < kQuestions;) {
    if (asked < kQuestions && pipe.first().try_push(asked)) ++asked;
    if (const auto answer = pipe.first().try_pop()) {
      wrong += *answer != 2 * heard++;
    } else {
      std::this_thread::yield();
    }
  }
  answerer.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace icome::realtime
