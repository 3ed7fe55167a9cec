#include "files/vrml/read/vrml_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <iterator>
#include <thread>

#include "files/vrml_seen.h"
#include "io/file_bytes.h"
#include "places.h"

namespace icome::files {
namespace {

namespace fs = std::filesystem;

/// A shell script in the place of the worker, while it lives.
class OtherWorker {
 public:
  explicit OtherWorker(const std::string& script)
      : path_(fs::path(testing::TempDir()) / ("worker_" + std::to_string(::getpid()))) {
    std::ofstream(path_) << "#!/bin/sh\n" << script << "\n";
    fs::permissions(path_, fs::perms::owner_all);
    ::setenv("ICOME_VRML_WORKER", path_.c_str(), 1);
  }
  OtherWorker(const OtherWorker&) = delete;
  OtherWorker& operator=(const OtherWorker&) = delete;
  ~OtherWorker() {
    ::unsetenv("ICOME_VRML_WORKER");
    fs::remove(path_);
  }

 private:
  fs::path path_;
};

std::string failure_with(const std::string& script, const DesignReadOptions& options = {}) {
  const OtherWorker worker(script);
  // More than a socket takes at once: the worker may be gone before it is sent.
  return ask_about(std::string(3'000'000, ' '), options).failure;
}

auto open_files() { return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()); }

void expect_found(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(VrmlProcess, TellsTheSceneOfAFile) {
  const SeenAnswer answer = ask_about(
      "Transform { translation 0.1 0 -2.5 children [\n"
      "  DEF Ball Shape { appearance Appearance { material DEF Red Material { diffuseColor 1 0 0 } }\n"
      "    geometry Sphere { radius 0.3 } }\n"
      "  USE Ball ] }");
  ASSERT_EQ(answer.refusal(), "");
  EXPECT_EQ(answer.notes(), "");
  ASSERT_EQ(answer->nodes()->size(), 3U);
  EXPECT_EQ(answer->geometries()->size(), 1U);
  EXPECT_EQ(answer->appearances()->size(), 1U);
  const flat::Node* ball = answer->nodes()->Get(1);
  EXPECT_EQ(ball->def()->str(), "Ball");
  EXPECT_EQ(ball->parent(), 0);
  EXPECT_FALSE(ball->reused());
  EXPECT_TRUE(answer->nodes()->Get(2)->reused());
  EXPECT_EQ(answer->nodes()->Get(0)->matrix()->Get(3), 0.1);
  EXPECT_EQ(answer->geometries()->Get(0)->sizes()->Get(0), 0.3);
  EXPECT_EQ(answer->appearances()->Get(0)->name()->str(), "Red");
}

TEST(VrmlProcess, AnswersEverySharedFileOrSaysWhyNot) {
  const fs::path folder = places::shared_data() / "vrml";
  if (!fs::exists(folder)) GTEST_SKIP() << "shared VRML files are not here";
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto ending = entry.path().extension();
    if (ending != ".wrl" && ending != ".vrml") continue;
    const auto bytes = io::read_bytes(entry.path(), 1U << 30U);
    ASSERT_TRUE(bytes) << entry.path();
    const SeenAnswer answer(ask_vrml_worker(*bytes, entry.path()));
    ASSERT_TRUE(answer.is_scene()) << entry.path() << ": " << answer.failure;
    if (answer.refusal().empty()) ++read;
    const bool may_be_refused = entry.path().string().find("/malformed/") != std::string::npos ||
                                entry.path().filename() == "face.vrml";
    EXPECT_TRUE(answer.refusal().empty() || may_be_refused) << entry.path() << " " << answer.refusal();
  }
  EXPECT_GT(read, 130);
}

TEST(VrmlProcess, SaysWhereItLooksForTheWorker) {
  ::setenv("ICOME_VRML_WORKER", "/nowhere/worker", 1);
  const std::string failure = ask_about("Group {}").failure;
  ::unsetenv("ICOME_VRML_WORKER");
  expect_found(failure, "t.wrl: the program that reads VRML, /nowhere/worker, cannot be started");
  expect_found(failure, "ICOME_VRML_WORKER");
}

TEST(VrmlProcess, TellsHowAWorkerEnded) {
  expect_found(failure_with("exit 3"), "t.wrl: the VRML reader ended without an answer (code 3)");
  expect_found(failure_with("kill -SEGV $$"), "t.wrl: the VRML reader crashed (signal 11) on this file");
  expect_found(failure_with("exit 101", {.memory_limit = 3U << 30U}),
               "needs more than the 3221 MB of memory");
  expect_found(failure_with("exit 102"), "nest too deep");
  // It reads all, and then is gone.
  expect_found(failure_with("head -c 3000000 >/dev/null"), "ended without an answer (code 0)");
}

TEST(VrmlProcess, EndsAWorkerThatHangs) {
  expect_found(failure_with("exec sleep 1000", {.seconds_limit = 0.2}), "took longer than 0.2 s");
  // It has closed its end, and goes on.
  expect_found(failure_with("exec sleep 1000 <&- >&-"), "the VRML reader crashed (signal 9)");
}

TEST(VrmlProcess, RefusesRubbish) {
  expect_found(failure_with("echo 'this is no frame of any kind'"), "something else than a scene");
  // An answer of 2^63 bytes.
  expect_found(failure_with("printf '\\006\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\200'"),
               "something else than a scene");
  // One that is cut short.
  expect_found(failure_with("printf '\\006\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0\\020\\0\\0\\0\\0abc'"),
               "ended without an answer");
  // One that is whole, but no scene, is for the caller to find out.
  EXPECT_EQ(failure_with("printf '\\006\\0\\0\\0\\0\\0\\0\\0\\003\\0\\0\\0\\0\\0\\0\\0abc'"),
            "the answer is no Scene");
}

TEST(VrmlProcess, GivesTheWorkerNothingButItsSocket) {
  const int open_here = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  const fs::path told = fs::path(testing::TempDir()) / "worker_has";
  failure_with("ls /proc/self/fd > " + told.string() + "; env >> " + told.string());
  ::close(open_here);
  std::ifstream file(told);
  std::string line;
  while (std::getline(file, line) && line.find('=') == std::string::npos)
    EXPECT_LE(std::stoi(line), 3) << "3 is the folder that is listed";
  for (; file; std::getline(file, line)) EXPECT_EQ(line.find("HOME="), std::string::npos);
  fs::remove(told);
}

TEST(VrmlProcess, StopsWhenProgressSays) {
  std::vector<double> parts;
  DesignReadOptions options;
  options.progress = [&](double part) {
    parts.push_back(part);
    return parts.size() < 3;
  };
  expect_found(failure_with("exec sleep 1000", options), "t.wrl: reading was stopped");
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_GE(parts.front(), 0.0);
  EXPECT_LE(parts.back(), 1.0);
}

TEST(VrmlProcess, KeepsToItsLimits) {
  // Each PROTO copies all before it: without end, for a person.
  std::string slow = "PROTO P0 [] { Group {} }\n";
  for (int i = 1; i < 20'000; ++i)
    slow += fmt::format("PROTO P{} [] {{ Group {{ children P{} {{}} }} }}\n", i, i - 1);
  expect_found(ask_about(slow, {.seconds_limit = 0.3}).failure, "took longer than 0.3 s");
#ifndef ICOME_ADDRESS_SANITIZER
  // Many small things, which Coin does not ask for by new.
  std::string copies = "PROTO P0 [] { Group { children [ Group {} Group {} ] } }\n";
  for (int i = 1; i < 40; ++i)
    copies += fmt::format("PROTO P{0} [] {{ Group {{ children [ P{1} {{}} P{1} {{}} ] }} }}\n", i, i - 1);
  expect_found(ask_about(copies, {.memory_limit = 300U << 20U}).failure,
               "needs more than the 314.6 MB of memory");
#endif
}

TEST(VrmlProcess, LeavesNothingBehind) {
  ask_about("Group {}");
  const auto before = open_files();
  ask_about("Group {}");
  ask_about("Group {");
  failure_with("exit 3");
  failure_with("exec sleep 1000", {.seconds_limit = 0.05});
  failure_with("echo 'this is no frame of any kind'; exec sleep 1000");
  failure_with("exec sleep 1000", {.progress = [](double) { return false; }});
  ::setenv("ICOME_VRML_WORKER", "/nowhere/worker", 1);
  ask_about("Group {}");
  ::unsetenv("ICOME_VRML_WORKER");
  EXPECT_EQ(open_files(), before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

TEST(VrmlProcess, WorksFromSeveralThreads) {
  std::vector<std::thread> threads;
  std::array<std::size_t, 4> nodes{};
  for (std::size_t i = 0; i < nodes.size(); ++i)
    threads.emplace_back([&nodes, i] {
      std::string text;
      for (std::size_t k = 0; k <= i; ++k) text += "Group {} ";
      const SeenAnswer answer = ask_about(text);
      if (answer.is_scene()) nodes[i] = answer->nodes()->size();
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(nodes, (std::array<std::size_t, 4>{1, 2, 3, 4}));
}

}  // namespace
}  // namespace icome::files
