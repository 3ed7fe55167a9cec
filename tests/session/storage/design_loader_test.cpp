#include "session/storage/design_loader.h"

#include <fmt/format.h>

#include <cerrno>

#include "files/design_files.h"
#include "session/autosave_samples.h"

namespace icome::session {
namespace {

using files::DesignReadOptions;
using files::LoadedDesign;
using LoadResult = base::Result<LoadedDesign>;

/// Reads until it is told to stop.
LoadResult read_for_ever(const DesignReadOptions& options) {
  while (options.progress(0.5)) std::this_thread::yield();
  return base::fail("interrupted");
}

DesignLoader::Outcome outcome_of(DesignLoader& loader) {
  loader.wait();
  auto outcome = loader.poll();
  if (!outcome) throw std::runtime_error("no outcome");
  EXPECT_FALSE(loader.poll().has_value()) << "told twice";
  EXPECT_FALSE(loader.part().has_value());
  return std::move(*outcome);
}

/// A VRML file that takes the worker a while.
std::string long_vrml() {
  std::string text = "#VRML V2.0 utf8\n";
  for (int i = 0; i < 40000; ++i) {
    text += fmt::format(
        "Transform {{ translation {} 0 0 children Shape {{ geometry Sphere {{ radius {} }} }} }}\n", i,
        i + 1);
  }
  return text;
}

TEST(DesignLoader, ReadsADesignInTheBackground) {
  const ScratchFolder folder;
  const auto path = folder.write("part.obj", files::sample_obj());
  DesignLoader loader;
  EXPECT_FALSE(loader.part().has_value());
  loader.open(path);
  const auto outcome = outcome_of(loader);
  ASSERT_TRUE(outcome.result && *outcome.result);
  EXPECT_EQ(outcome.design, path);
  const auto expected = files::read_design(path);
  EXPECT_EQ(hash((*outcome.result)->world), hash(expected->world));
  EXPECT_EQ((*outcome.result)->remarks, expected->remarks);
}

TEST(DesignLoader, TellsHowMuchIsDoneAndNeverLess) {
  std::atomic<int> told = 0, seen = 0;
  DesignLoader loader;
  loader.start("part", [&](const DesignReadOptions& options) -> LoadResult {
    for (const double part : {0.25, 0.75, 0.5, 2.0}) {
      options.progress(part);
      ++told;
      wait_until([&] { return seen == told; });
    }
    return LoadedDesign{};
  });
  std::vector<double> parts;
  for (int i = 1; i <= 4; ++i) {
    wait_until([&] { return told == i; });
    parts.push_back(loader.part().value());
    ++seen;
  }
  EXPECT_EQ(parts, (std::vector<double>{0.25, 0.75, 0.75, 1.0}));
  EXPECT_TRUE(outcome_of(loader).result->has_value());
}

TEST(DesignLoader, TellsWhyADesignCannotBeRead) {
  DesignLoader loader;
  loader.open("/nowhere/part.wrl");
  const auto outcome = outcome_of(loader);
  ASSERT_TRUE(outcome.result && !*outcome.result);
  EXPECT_EQ(outcome.result->error().message, "/nowhere/part.wrl: cannot be read: No such file or directory");
}

TEST(DesignLoader, SurvivesAReaderThatThrows) {
  DesignLoader loader;
  loader.start("part", [](const DesignReadOptions&) -> LoadResult { throw std::bad_alloc(); });
  EXPECT_NE(outcome_of(loader).result->error().message.find("not enough memory"), std::string::npos);
  loader.start("part", [](const DesignReadOptions&) -> LoadResult { throw std::length_error("too long"); });
  EXPECT_NE(outcome_of(loader).result->error().message.find("too long"), std::string::npos);
}

TEST(DesignLoader, TellsAtOnceOfACancelledReading) {
  DesignLoader loader;
  loader.start("part", read_for_ever);
  loader.cancel();
  const auto outcome = outcome_of(loader);
  EXPECT_EQ(outcome.design, "part");
  EXPECT_FALSE(outcome.result.has_value());
  loader.cancel();  // of nothing
  EXPECT_FALSE(loader.poll().has_value());
}

TEST(DesignLoader, CancelsWhatHasEndedButWasNotTold) {
  DesignLoader loader;
  loader.start("part", [](const DesignReadOptions&) -> LoadResult { return LoadedDesign{}; });
  loader.wait();
  loader.cancel();
  EXPECT_FALSE(outcome_of(loader).result.has_value());
}

TEST(DesignLoader, ANewerDesignReplacesTheOneBeingRead) {
  DesignLoader loader;
  loader.start("first", read_for_ever);
  loader.start("second", read_for_ever);
  loader.cancel();
  loader.start("third", [](const DesignReadOptions&) -> LoadResult { return LoadedDesign{}; });
  const auto outcome = outcome_of(loader);
  EXPECT_EQ(outcome.design, "third");
  EXPECT_TRUE(outcome.result && *outcome.result);
}

TEST(DesignLoader, ReadsNoMoreAtATimeHoweverManyAreCancelled) {
  std::atomic<int> begun = 0;
  std::atomic<bool> may_end = false;
  DesignLoader loader;
  const auto deaf = [&](const DesignReadOptions&) -> LoadResult {
    ++begun;
    wait_until([&] { return may_end.load(); });
    return base::fail("interrupted");
  };
  for (int i = 0; i < 50; ++i) {
    loader.start("given up", deaf);
    if (i % 3 == 0) loader.cancel();
  }
  loader.start("newest", [](const DesignReadOptions&) -> LoadResult { return LoadedDesign{}; });
  wait_until([&] { return begun == int(DesignLoader::kMostLeaving); });
  EXPECT_FALSE(loader.poll().has_value());
  EXPECT_EQ(loader.part(), 0.0) << "it waits";
  may_end = true;
  const auto outcome = outcome_of(loader);
  EXPECT_EQ(outcome.design, "newest");
  EXPECT_TRUE(outcome.result && *outcome.result);
  EXPECT_EQ(begun, int(DesignLoader::kMostLeaving)) << "others were never begun";
}

TEST(DesignLoader, IsNotHeldUpByOneThatDoesNotEnd) {
  std::atomic<bool> may_end = false;
  DesignLoader loader;
  loader.start("stuck", [&](const DesignReadOptions&) -> LoadResult {
    wait_until([&] { return may_end.load(); });
    return base::fail("interrupted");
  });
  loader.start("other", [](const DesignReadOptions&) -> LoadResult { return LoadedDesign{}; });
  EXPECT_EQ(outcome_of(loader).design, "other");
  may_end = true;
}

TEST(DesignLoader, EndsWhileADesignIsBeingRead) {
  std::atomic<bool> ended = false;
  {
    DesignLoader loader;
    loader.start("part", [&](const DesignReadOptions& options) {
      auto result = read_for_ever(options);
      ended = true;
      return result;
    });
    wait_until([&] { return loader.part() == 0.5; });
  }
  EXPECT_TRUE(ended);
}

TEST(DesignLoader, CancelsAVrmlFileWithItsProcess) {
  const ScratchFolder folder;
  const auto path = folder.write("long.wrl", long_vrml());
  {
    DesignLoader loader;
    loader.open(path);
    wait_until([&] { return loader.part().value() > 0.1; });  // the worker has it
    loader.cancel();
    EXPECT_FALSE(outcome_of(loader).result.has_value());
  }
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD) << "the worker was left behind";
}

}  // namespace
}  // namespace icome::session
