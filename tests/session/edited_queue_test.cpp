#include "session/edited_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace icome::session {
namespace {

Edited renamed(int number) {
  Edited edited;
  edited.edit = std::make_shared<const world::Edit>(world::RenameObject{{1}, std::to_string(number)});
  edited.for_replicas = edited.edit;
  return edited;
}

TEST(EditedQueue, BringsAllToEveryReaderInOrder) {
  constexpr int kPosts = 20'000;  // many times what a pipe holds
  EditedQueue queue;
  std::vector<EditedQueue::Reader*> readers{&queue.add_reader(), &queue.add_reader(), &queue.add_reader()};
  std::vector<std::vector<std::uint64_t>> numbers(readers.size());
  std::vector<int> wrong(readers.size(), 0);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < readers.size(); ++i) {
    threads.emplace_back([&, i] {
      while (readers[i]->wait()) {
        while (const auto edited = readers[i]->take()) {
          numbers[i].push_back(edited->number);
          const auto& rename = std::get<world::RenameObject>(edited->edit->what);
          if (rename.name != std::to_string(edited->number)) ++wrong[i];
        }
      }
    });
  }
  for (int i = 1; i <= kPosts; ++i) EXPECT_EQ(queue.post(renamed(i)), std::uint64_t(i));
  EXPECT_EQ(queue.posted(), std::uint64_t(kPosts));
  queue.close();
  for (auto& thread : threads) thread.join();
  for (std::size_t i = 0; i < readers.size(); ++i) {
    EXPECT_EQ(wrong[i], 0);
    ASSERT_EQ(numbers[i].size(), std::size_t(kPosts));
    for (int n = 0; n < kPosts; ++n) ASSERT_EQ(numbers[i][std::size_t(n)], std::uint64_t(n) + 1);
  }
}

TEST(EditedQueue, KeepsWhatAReaderThatSleepsDoesNotTake) {
  EditedQueue queue;
  EditedQueue::Reader& awake = queue.add_reader();
  EditedQueue::Reader& asleep = queue.add_reader();
  for (int i = 1; i <= 5000; ++i) {
    queue.post(renamed(i));  // nobody reads the other: it must not wait
    ASSERT_TRUE(awake.wait());
    ASSERT_EQ(awake.take()->number, std::uint64_t(i));
    ASSERT_FALSE(awake.take());
  }
  std::uint64_t next = 1;
  while (next <= 5000) {
    while (const auto edited = asleep.take()) ASSERT_EQ(edited->number, next++);
    queue.pump();
  }
  ASSERT_FALSE(asleep.take());
}

TEST(EditedQueue, HasNoRoomWhileTheSlowestReaderIsTooFarBehind) {
  const auto picture = std::make_shared<std::string>(std::string(1000, 'x'));
  Edited edited;
  edited.edit = std::make_shared<const world::Edit>(world::CreateTexture{{1}, {"a", "image/png", picture}});
  edited.for_replicas = edited.edit;
  EditedQueue queue(10'000);
  EditedQueue::Reader& quick = queue.add_reader();
  EditedQueue::Reader& slow = queue.add_reader();
  int posted = 0;
  for (; queue.has_room(); ++posted) {
    ASSERT_LT(posted, 20);
    queue.post(edited);
    ASSERT_TRUE(quick.take());
  }
  EXPECT_GE(posted, 5) << "what an edit takes beside the picture is not much";
  ASSERT_TRUE(slow.take());
  EXPECT_TRUE(queue.has_room());
  while (slow.take()) {
  }
  EXPECT_TRUE(queue.has_room());
}

TEST(EditedQueue, GivesTheRestAfterItIsClosedAndThenEnds) {
  EditedQueue queue;
  EditedQueue::Reader& reader = queue.add_reader();
  for (int i = 1; i <= 3000; ++i) queue.post(renamed(i));
  queue.close();
  queue.close();
  queue.pump();
  for (std::uint64_t i = 1; i <= 3000; ++i) {
    ASSERT_TRUE(reader.wait());
    ASSERT_EQ(reader.take()->number, i);
  }
  EXPECT_FALSE(reader.wait());
  EXPECT_FALSE(reader.take());
}

TEST(EditedQueue, WakesAReaderThatWaitsForTheEnd) {
  EditedQueue queue;
  EditedQueue::Reader& reader = queue.add_reader();
  bool more = true;
  std::thread thread([&] { more = reader.wait(); });
  queue.close();
  thread.join();
  EXPECT_FALSE(more);
}

TEST(EditedQueue, LetsAReaderLookAtAClockInBetween) {
  EditedQueue queue;
  EditedQueue::Reader& reader = queue.add_reader();
  EXPECT_TRUE(reader.wait_for(std::chrono::milliseconds(1)));
  EXPECT_FALSE(reader.take());
  queue.post(renamed(1));
  EXPECT_TRUE(reader.wait_for(std::chrono::hours(1)));
  EXPECT_TRUE(reader.take());
  queue.close();
  EXPECT_FALSE(reader.wait_for(std::chrono::hours(1)));
}

}  // namespace
}  // namespace icome::session
