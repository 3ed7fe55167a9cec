#include "study/records/session_log.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "study/data_samples.h"

namespace icome::study {
namespace {

namespace fs = std::filesystem;

const std::string kNasty = std::string("a\tb\nc\\n \"q\" \xff") + std::string(1, '\0') + "n/a\r";

std::vector<EventRecord> some_events() {
  return {{EventKind::Session, 0.0, 0.0, 0, "", "2005-03-01T10:00:00"},
          {EventKind::Page, 0.25, 3.5, 0, "consent", ""},
          {EventKind::Page, 4.0, 1.0, 0, "condition", ""},
          {EventKind::Answer, 5.0, 1.0 / 3.0, 1, "each.trouble", kNasty},
          {EventKind::Answer, 5.5, 0.1, 0, "each.trouble", "n/a"},
          {EventKind::Answer, 6.0, 1e-300, 0, "all.best", ""},
          {EventKind::Unpractised, 7.0, 0.0, 1, "", ""},
          {EventKind::Resumed, 8.0, 0.0, 0, "", "later"}};
}

TEST(SessionLog, GivesBackWhatWasAdded) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  const Participant person = enrolled(folder);
  base::Random random(1);
  std::vector<TrialRecord> trials;
  {
    SessionLog log = log_of(folder, person);
    for (const EventRecord& event : some_events()) ASSERT_TRUE(log.add(event));
    do_trials(log, 7, random);
    trials = log.progress().trials;
  }
  const SessionLog log = log_of(folder, person);
  EXPECT_TRUE(log.notices().empty());
  ASSERT_EQ(log.progress().trials.size(), 7U);
  for (std::size_t i = 0; i < trials.size(); ++i)
    EXPECT_TRUE(same_trial(log.progress().trials[i], trials[i])) << i;
  ASSERT_EQ(log.progress().events.size(), some_events().size());
  for (std::size_t i = 0; i < some_events().size(); ++i)
    EXPECT_TRUE(same_event(log.progress().events[i], some_events()[i])) << i;
  EXPECT_EQ(*answer_of(log.progress(), "each.trouble", 1), kNasty);
  EXPECT_EQ(answer_of(log.progress(), "each.trouble", 2), nullptr);
}

TEST(SessionLog, WhatIsNoNumberComesBackAsNone) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  const Participant person = enrolled(folder);
  base::Random random(1);
  TrialRecord trial = trial_after(person, 0, random);
  trial.measures.approach_time = std::nan("");
  ASSERT_TRUE(log_of(folder, person).add(trial, {}));
  EXPECT_TRUE(std::isnan(log_of(folder, person).progress().trials[0].measures.approach_time));
}

TEST(SessionLog, TraceHasARowASample) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  SessionLog log = log_of(folder, enrolled(folder));
  base::Random random(4);
  Trace trace = trace_of(2, random);
  trace.samples[0] = {-0.5, {0.1, 0.2, 0.3}, base::Quaternion(1, 0, 0, 0), {1, 2, 3}, {0, -4.5, 0}, 5, -1};
  ASSERT_TRUE(log.add(trial_after(log.participant(), 0, random), trace));
  const std::string table = bytes_of(trace_file(scratch.data(), "001"));
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "-0.5\t0.1\t0.2\t0.3\t0\t0\t0\t1\t1\t2\t3\t0\t-4.5\t0\t5\t-1\t-1\t-1");
  EXPECT_EQ(lines_of(trace_file(scratch.data(), "001")), 2U);
  const fs::path channels =
      scratch.data() / "sub-001/motion/sub-001_task-datatest_tracksys-pointer_channels.tsv";
  EXPECT_EQ(lines_of(channels), 19U);  // a header and 18 columns
  const std::string sidecar = bytes_of(trace_file(scratch.data(), "001").replace_extension(".json"));
  for (const char* const member :
       {R"("SamplingFrequency": 1000.0)", R"("TaskName": "data-test")", R"("TrackedPointsCount": 2)",
        R"("target",)", R"("ManufacturersModelName": "simulated \"x\"")", R"("SoftwareVersions": "icome )"})
    EXPECT_NE(sidecar.find(member), std::string::npos) << member;
}

TEST(SessionLog, TwoCannotRunAPerson) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  const Participant person = enrolled(folder);
  {
    const SessionLog log = log_of(folder, person);
    const auto second = folder.open_log(person);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message,
              "another program runs the session of 001; end that first, or take another person.");
  }
  EXPECT_TRUE(folder.open_log(person));
}

TEST(SessionLog, RefusesWhatCannotComeNext) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  SessionLog log = log_of(folder, enrolled(folder));
  base::Random random(1);
  do_trials(log, 2, random);
  TrialRecord trial = trial_after(log.participant(), 2, random);
  ++trial.plan.number;
  EXPECT_FALSE(log.add(trial, {}));
  trial = trial_after(log.participant(), 2, random);
  trial.plan.condition = 1 - trial.plan.condition;
  EXPECT_FALSE(log.add(trial, {}));
  trial = trial_after(log.participant(), 2, random);
  trial.plan.values = {2};
  EXPECT_FALSE(log.add(trial, {}));
  EXPECT_FALSE(log.add(EventRecord{EventKind::Answer, 0.0, 0.0, 0, "each.nothing", ""}));
  EXPECT_EQ(lines_of(trials_file(scratch.data())), 3U);
  EXPECT_EQ(lines_of(events_file(scratch.data())), 1U);
}

TEST(SessionLog, TornTrialIsDoneAgain) {
  const StudyScratch scratch;
  base::Random random(1);
  {
    DataFolder folder = opened(scratch.data());
    SessionLog log = log_of(folder, enrolled(folder));
    do_trials(log, 3, random);
  }
  const fs::path file = trials_file(scratch.data());
  const std::string whole = bytes_of(file);
  const std::size_t last = whole.rfind('\n', whole.size() - 2) + 1;
  for (std::size_t size = last; size < whole.size(); ++size) {
    put_bytes(file, whole.substr(0, size));
    put_bytes(trace_file(scratch.data(), "003"), "left");
    DataFolder folder = opened(scratch.data());
    SessionLog log = log_of(folder, folder.participants()[0]);
    ASSERT_EQ(log.progress().trials.size(), 2U);
    ASSERT_EQ(log.notices().size(), 1U);
    EXPECT_EQ(log.notices()[0], "The last trial was cut off while it was written; it is done again.");
    EXPECT_EQ(bytes_of(file), whole.substr(0, last));
    EXPECT_FALSE(fs::exists(trace_file(scratch.data(), "003")));
    do_trials(log, 1, random);
    EXPECT_EQ(lines_of(file), 4U);
    EXPECT_EQ(lines_of(trace_file(scratch.data(), "003")), 3U);
  }
}

TEST(SessionLog, TornEventComesAgain) {
  const StudyScratch scratch;
  {
    DataFolder folder = opened(scratch.data());
    SessionLog log = log_of(folder, enrolled(folder));
    for (const EventRecord& event : some_events()) ASSERT_TRUE(log.add(event));
  }
  const fs::path file = events_file(scratch.data());
  const std::string whole = bytes_of(file);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    put_bytes(file, whole.substr(0, size));
    const std::size_t rows =
        std::size_t(std::count(whole.begin(), whole.begin() + std::ptrdiff_t(size), '\n'));
    const std::size_t events = rows == 0 ? 0 : rows - 1;
    DataFolder folder = opened(scratch.data());
    SessionLog log = log_of(folder, folder.participants()[0]);
    ASSERT_EQ(log.progress().events.size(), events);
    EXPECT_EQ(log.notices().size(), rows > 0 && whole[size - 1] != '\n' ? 1U : 0U);
    ASSERT_TRUE(log.add(some_events()[events]));
    const std::size_t end = whole.find('\n', std::max(size, whole.find('\n') + 1));
    EXPECT_EQ(bytes_of(file), whole.substr(0, end + 1)) << size;
  }
}

TEST(SessionLog, MakesAgainWhatIsMissing) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  const Participant person = enrolled(folder);
  base::Random random(1);
  {
    SessionLog log = log_of(folder, person);
    do_trials(log, 2, random);
  }
  const fs::path sidecar = trials_file(scratch.data()).replace_extension(".json");
  const fs::path left = scratch.data() / "sub-001/motion/.x_motion.tsv.part";
  fs::remove(sidecar);
  fs::remove(trace_file(scratch.data(), "002"));
  put_bytes(left, "half");
  const SessionLog log = log_of(folder, person);
  EXPECT_TRUE(fs::exists(sidecar));
  EXPECT_FALSE(fs::exists(left));
  ASSERT_EQ(log.notices().size(), 1U);
  EXPECT_EQ(log.notices()[0].substr(0, 31), "The trace of trial 2 is missing");
}

TEST(SessionLog, DoesNotThrowTracesAway) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  const Participant person = enrolled(folder);
  base::Random random(1);
  {
    SessionLog log = log_of(folder, person);
    do_trials(log, 3, random);
  }
  const std::string whole = bytes_of(trials_file(scratch.data()));
  put_bytes(trials_file(scratch.data()), whole.substr(0, whole.find('\n') + 1));
  const auto log = folder.open_log(person);
  ASSERT_FALSE(log);
  EXPECT_NE(log.error().message.find("Put that file back as it was"), std::string::npos);
  EXPECT_TRUE(fs::exists(trace_file(scratch.data(), "003")));
}

TEST(SessionLog, FullDiskLeavesTheFilesAsTheyWere) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  SessionLog log = log_of(folder, enrolled(folder));
  base::Random random(1);
  do_trials(log, 3, random);
  ASSERT_TRUE(log.add(some_events()[0]));
  const std::string trials = bytes_of(trials_file(scratch.data()));
  const std::string events = bytes_of(events_file(scratch.data()));
  ::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto limit = [&](std::size_t bytes) {
    rlimit now = before;
    now.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &now);
  };
  for (std::size_t more = 0; more < 60; ++more) {  // a row is longer
    limit(trials.size() + more);
    EXPECT_FALSE(log.add(trial_after(log.participant(), 3, random), {}));
    limit(events.size() + more);
    const auto added =
        log.add(EventRecord{EventKind::Answer, 0.0, 0.0, 0, "each.trouble", std::string(60, 'x')});
    limit(before.rlim_cur);
    ASSERT_FALSE(added);
    EXPECT_NE(added.error().message.find("nothing of it is on record"), std::string::npos);
    ASSERT_EQ(bytes_of(trials_file(scratch.data())), trials);
    ASSERT_EQ(bytes_of(events_file(scratch.data())), events);
    EXPECT_FALSE(fs::exists(trace_file(scratch.data(), "004")));
  }
  limit(1000);
  EXPECT_FALSE(log.add(trial_after(log.participant(), 3, random), trace_of(100, random)));
  limit(before.rlim_cur);
  ::signal(SIGXFSZ, SIG_DFL);
  EXPECT_EQ(log.progress().trials.size(), 3U);
  do_trials(log, 1, random);
  EXPECT_EQ(lines_of(trials_file(scratch.data())), 5U);
}

TEST(SessionLog, TellsWhenItsFileIsGone) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  SessionLog log = log_of(folder, enrolled(folder));
  ASSERT_TRUE(log.add(some_events()[0]));
  fs::remove_all(scratch.data() / "sub-001");
  const auto added = log.add(some_events()[1]);
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find("was taken away or replaced"), std::string::npos);
  base::Random random(1);
  EXPECT_FALSE(log.add(trial_after(log.participant(), 0, random), {}));
}

TEST(SessionLog, AnswersOfAllStandInOneTable) {
  const StudyScratch scratch;
  DataFolder folder = opened(scratch.data());
  for (int i = 0; i < 2; ++i) {
    SessionLog log = log_of(folder, enrolled(folder));
    ASSERT_TRUE(log.add(EventRecord{EventKind::Answer, 1.0, 1.0, 1, "each.trouble", "a\tb"}));
    ASSERT_TRUE(log.add(EventRecord{EventKind::Answer, 2.0, 1.0, std::size_t(i), "all.best", "far"}));
    if (i == 1) {
      ASSERT_TRUE(log.add(EventRecord{EventKind::Over, 3.0, 0.0, 0, "", ""}));
    }
  }
  EXPECT_EQ(bytes_of(scratch.data() / "phenotype/all.tsv"),
            "participant_id\tbest\nsub-001\tfar\nsub-002\tfar\n");
  const std::string each = bytes_of(scratch.data() / "phenotype/each.tsv");
  EXPECT_EQ(each, "participant_id\ttrouble_near\ttrouble_far\nsub-001\tn/a\ta\\tb\nsub-002\tn/a\ta\\tb\n");
  EXPECT_NE(bytes_of(scratch.data() / "phenotype/each.json").find("Asked after the condition 'far'."),
            std::string::npos);
  EXPECT_NE(bytes_of(scratch.data() / "phenotype/all.json").find("\"far\": \"Far\""), std::string::npos);
}

/// Does trials and tells after each how many are on record, until it is killed.
[[noreturn]] void do_trials_until_killed(const fs::path& data, int pipe, std::uint64_t seed) {
  DataFolder folder = opened(data);
  SessionLog log = log_of(folder, folder.find("001").value());
  base::Random random(seed);
  while (true) {
    const std::size_t done = log.progress().trials.size();
    if (!log.add(EventRecord{EventKind::Page, 1.0, 1.0, 0, "rest", "x"})) ::_exit(2);
    const TrialRecord trial = trial_after(log.participant(), done, random);
    if (!log.add(trial, trace_of(40, random))) ::_exit(3);
    const auto count = std::uint32_t(done + 1);
    if (::write(pipe, &count, sizeof count) != ssize_t(sizeof count)) ::_exit(4);
  }
}

/// Kills a program at any moment between so many trials and a little later; how many it has said to be done.
std::size_t trials_until_kill(const fs::path& data, std::uint32_t least, base::Random& random) {
  int ends[2] = {};
  EXPECT_EQ(::pipe(ends), 0);
  const std::uint64_t seed = least;
  const pid_t child = ::fork();
  if (child == 0) do_trials_until_killed(data, ends[1], seed);
  ::close(ends[1]);
  std::uint32_t said = 0;
  while (said < least && ::read(ends[0], &said, sizeof said) == ssize_t(sizeof said)) {
  }
  ::usleep(useconds_t(random.uniform(0.0, least == 0 ? 15000.0 : 1500.0)));
  ::kill(child, SIGKILL);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << status;
  while (::read(ends[0], &said, sizeof said) == ssize_t(sizeof said)) {
  }
  ::close(ends[0]);
  return said;
}

/// Every trial is as the program made it from its seed, each with all of its trace.
void expect_trials(const fs::path& data, const SessionLog& log, base::Random& again) {
  const std::vector<TrialRecord>& trials = log.progress().trials;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    EXPECT_TRUE(same_trial(trials[i], trial_after(log.participant(), i, again))) << i;
    const Trace trace = trace_of(40, again);
    EXPECT_EQ(lines_of(trace_file(data, fmt::format("{:03}", i + 1))), trace.samples.size());
  }
}

TEST(SessionLog, KillsLoseAtMostTheRunningTrial) {
  base::Random random(77);
  for (int kill = 0; kill < 200; ++kill) {
    const StudyScratch scratch;
    {
      DataFolder folder = opened(scratch.data());
      enrolled(folder);
    }
    const auto least = std::uint32_t(random.index(8));
    const std::size_t said = trials_until_kill(scratch.data(), least, random);
    DataFolder folder = opened(scratch.data());
    SessionLog log = log_of(folder, folder.participants()[0]);
    EXPECT_GE(log.progress().trials.size(), said);
    EXPECT_LE(log.progress().trials.size(), said + 1);
    base::Random again(least);
    expect_trials(scratch.data(), log, again);
    do_trials(log, 1, again);
    ASSERT_TRUE(read_study_data(scratch.data()));
  }
}

}  // namespace
}  // namespace icome::study
