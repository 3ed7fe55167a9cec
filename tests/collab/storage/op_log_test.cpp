// What every log of edits promises, wherever it keeps them.
#include "collab/storage/op_log.h"

#include "collab/storage/memory_op_log.h"
#include "collab/storage/postgres_op_log.h"
#include "collab/storage/sample_log.h"
#include "collab/storage/shared_postgres.h"
#include "files/sample_files.h"
#include "memory_place.h"

namespace icome::collab {
namespace {

/// A log of each kind, the clock by which it judges leases, and why there is none on this machine.
struct MemoryKind {
  static std::string why_missing() { return {}; }
  std::int64_t now = 1'000'000;
  MemoryOpLog log{[this] { return now; }};
};
struct SqliteKind {
  static std::string why_missing() { return {}; }
  std::int64_t now = 1'000'000;
  files::ScratchFolder folder{memory_place()};
  SqliteOpLog log = good(SqliteOpLog::open(folder.path() / "designs.sqlite", [this] { return now; }));
};

/// The clock of a store in a database, which stands still until somebody sets it.
class StandingClock {
 public:
  StandingClock(const std::string& address, std::int64_t now) : database_(address) { *this = now; }
  StandingClock& operator=(std::int64_t now) {
    now_ = now;
    database_.run(
        "CREATE OR REPLACE FUNCTION icome.clock_milliseconds() RETURNS bigint LANGUAGE sql VOLATILE AS "
        "'SELECT " +
        std::to_string(now) + "::bigint'");
    return *this;
  }
  StandingClock& operator+=(std::int64_t more) { return *this = now_ + more; }
  StandingClock& operator-=(std::int64_t less) { return *this = now_ - less; }
  operator std::int64_t() const { return now_; }

 private:
  PostgresMeddler database_;
  std::int64_t now_ = 0;
};
struct PostgresKind {
  static std::string why_missing() { return why_no_postgres(); }
  std::string address = shared_postgres().fresh_database();
  PostgresOpLog log = good(PostgresOpLog::open(address));
  StandingClock now{address, 1'000'000};
};

template <typename Kind>
class OpLogTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string why = Kind::why_missing();
    if (!why.empty()) GTEST_SKIP() << why;
    kind_.emplace();
  }
  OpLog& log() { return kind_->log; }
  auto& now() { return kind_->now; }

  /// The fence of a design that is made for it.
  std::uint64_t made(const std::string& design) {
    good(log().create(design));
    return good(log().lease(design, "server", 1000)).fence;
  }
  DesignRow row(const std::string& design) { return good(log().find(design)).value(); }

 private:
  std::optional<Kind> kind_;
};

using LogKinds = testing::Types<MemoryKind, SqliteKind, PostgresKind>;
TYPED_TEST_SUITE(OpLogTest, LogKinds);

TYPED_TEST(OpLogTest, KnowsItsDesignsByName) {
  EXPECT_TRUE(good(this->log().designs()).empty());
  EXPECT_FALSE(good(this->log().find("a")));
  for (const char* name : {"b", "a", "Drop'); DELETE FROM designs; --", "\u00e4"})
    good(this->log().create(name));
  const auto rows = good(this->log().designs());
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].name, "Drop'); DELETE FROM designs; --");
  EXPECT_EQ(rows[1].name, "a");
  EXPECT_EQ(rows[2].name, "b");
  EXPECT_EQ(rows[3].name, "\u00e4");
  EXPECT_NE(rows[0].history, rows[1].history);
  EXPECT_EQ(this->row("a").sequence, 0U);
  EXPECT_EQ(this->row("a").snapshot_sequence, 0U);
  EXPECT_EQ(sentence_of(this->log().create("a")),
            "a: there is a design of this name in the store. Choose another name.");
}

TYPED_TEST(OpLogTest, GivesBackWhatWasAppended) {
  const std::uint64_t fence = this->made("a");
  const std::vector<LogEntry> entries{
      {.sequence = 1, .author = 7, .number = 5, .at = -3, .edit = std::string("\0x\xff", 3)},
      {.sequence = 2, .author = 0xffff'ffffU, .number = ~std::uint64_t{0} >> 1U, .at = 1, .edit = {}}};
  ASSERT_FALSE(append_to(this->log(), "a", 0, fence, entries));
  EXPECT_EQ(good(this->log().read_from("a", 0, 1000)), entries);
  EXPECT_EQ(this->row("a").sequence, 2U);
  EXPECT_EQ(this->row("a").bytes, 3U);
  EXPECT_FALSE(append_to(this->log(), "a", 2, fence, {})) << "nothing can be appended, too";
}

TYPED_TEST(OpLogTest, ReadsWithinALimitOfBytes) {
  const std::uint64_t fence = this->made("a");
  ASSERT_FALSE(append_to(this->log(), "a", 0, fence, sample_entries(0, 10, 100)));
  const auto count = [&](std::uint64_t after, std::uint64_t bytes) {
    return good(this->log().read_from("a", after, bytes)).size();
  };
  EXPECT_EQ(count(0, 0), 1U) << "one at least";
  EXPECT_EQ(count(0, 199), 1U);
  EXPECT_EQ(count(0, 200), 2U);
  EXPECT_EQ(count(7, 1'000'000), 3U);
  EXPECT_EQ(count(10, 1000), 0U);
  EXPECT_EQ(count(11, 1000), 0U);
  EXPECT_EQ(count(~std::uint64_t{0}, 1000), 0U);
  EXPECT_FALSE(this->log().read_from("b", 0, 1000));
}

TYPED_TEST(OpLogTest, RefusesWhatDoesNotFollow) {
  const std::uint64_t fence = this->made("a");
  ASSERT_FALSE(append_to(this->log(), "a", 0, fence, sample_entries(0, 3)));
  const auto problem = [&](const std::string& design, std::uint64_t after, std::vector<LogEntry> batch) {
    return append_to(this->log(), design, after, fence, std::move(batch)).value().problem;
  };
  EXPECT_EQ(problem("a", 2, sample_entries(2, 1)), AppendProblem::WrongSequence);
  EXPECT_EQ(problem("a", 4, sample_entries(4, 1)), AppendProblem::WrongSequence);
  EXPECT_EQ(problem("b", 0, sample_entries(0, 1)), AppendProblem::NoDesign);
  EXPECT_EQ(problem("a", 3, sample_entries(4, 1)), AppendProblem::Malformed);
  EXPECT_EQ(problem("a", 3, {{.sequence = 4, .number = std::uint64_t{1} << 63U}}), AppendProblem::Malformed);
  auto gap = sample_entries(3, 3);
  gap[2].sequence = 7;
  EXPECT_EQ(problem("a", 3, gap), AppendProblem::Malformed);
  EXPECT_EQ(this->row("a").sequence, 3U);
  EXPECT_EQ(good(this->log().read_from("a", 0, 1000)), sample_entries(0, 3));
}

TYPED_TEST(OpLogTest, AppendsEachBatchByItself) {
  const std::uint64_t fence = this->made("a");
  ASSERT_EQ(this->made("b"), fence);
  const std::vector<Append> batches{
      {"a", 0, fence, sample_entries(0, 2)}, {"missing", 0, fence, sample_entries(0, 1)},
      {"b", 5, fence, sample_entries(5, 1)}, {"a", 2, fence, sample_entries(2, 2)},
      {"a", 2, fence, sample_entries(2, 1)}, {"b", 0, fence + 1, sample_entries(0, 1)},
      {"b", 0, fence, sample_entries(0, 1)}};
  const auto results = this->log().append(batches);
  ASSERT_EQ(results.size(), batches.size());
  EXPECT_FALSE(results[0]);
  EXPECT_EQ(results[1].value().problem, AppendProblem::NoDesign);
  EXPECT_EQ(results[2].value().problem, AppendProblem::WrongSequence);
  EXPECT_FALSE(results[3]);
  EXPECT_EQ(results[4].value().problem, AppendProblem::WrongSequence);
  EXPECT_EQ(results[5].value().problem, AppendProblem::Fenced);
  EXPECT_FALSE(results[6]);
  EXPECT_EQ(good(this->log().read_from("a", 0, 1000)), sample_entries(0, 4));
  EXPECT_EQ(good(this->log().read_from("b", 0, 1000)), sample_entries(0, 1));
  EXPECT_TRUE(this->log().append({}).empty());
}

TYPED_TEST(OpLogTest, LendsADesignToOneAtATime) {
  good(this->log().create("a"));
  const std::uint64_t fence = good(this->log().lease("a", "one", 1000)).fence;
  EXPECT_GT(fence, 0U);
  EXPECT_EQ(this->row("a").holder, "one");
  EXPECT_EQ(this->row("a").lease_ends, this->now() + 1000);
  EXPECT_EQ(sentence_of(this->log().lease("a", "two", 1000)),
            "a: one works on this design, for 1000 ms more at least.");
  this->now() += 600;
  EXPECT_EQ(good(this->log().lease("a", "one", 1000)).fence, fence) << "made longer";
  this->now() += 600;
  EXPECT_FALSE(this->log().lease("a", "two", 1000));
  this->now() += 400;
  EXPECT_EQ(good(this->log().lease("a", "two", 1000)).fence, fence + 1) << "over";
  EXPECT_FALSE(this->log().lease("a", "one", 1000));
  EXPECT_FALSE(this->log().lease("b", "one", 1000));
}

TYPED_TEST(OpLogTest, KeepsTheFenceOfALeaseThatEndedUnnoticed) {
  const std::uint64_t fence = this->made("a");
  this->now() += 5000;
  EXPECT_FALSE(append_to(this->log(), "a", 0, fence, sample_entries(0, 1))) << "nobody else took it";
  EXPECT_EQ(good(this->log().lease("a", "server", 1000)).fence, fence);
}

TYPED_TEST(OpLogTest, RefusesOldFences) {
  const std::uint64_t fence = this->made("a");
  this->now() += 1000;
  const std::uint64_t newer = good(this->log().lease("a", "two", 1000)).fence;
  EXPECT_EQ(append_to(this->log(), "a", 0, fence, sample_entries(0, 1)).value().problem,
            AppendProblem::Fenced);
  EXPECT_FALSE(append_to(this->log(), "a", 0, newer, sample_entries(0, 1)));
  EXPECT_FALSE(this->log().save_snapshot("a", fence, {1, "x"}, 0));
  EXPECT_TRUE(this->log().save_snapshot("a", newer, {1, "x"}, 0));
}

TYPED_TEST(OpLogTest, TakesNoFenceWhereNobodyHasALease) {
  good(this->log().create("a"));
  EXPECT_EQ(append_to(this->log(), "a", 0, 0, sample_entries(0, 1)).value().problem, AppendProblem::Fenced);
  const std::uint64_t fence = good(this->log().lease("a", "one", 1000)).fence;
  good(this->log().release("a", "two"));
  EXPECT_FALSE(append_to(this->log(), "a", 0, fence, sample_entries(0, 1))) << "another's lease stays";
  good(this->log().release("a", "one"));
  good(this->log().release("a", "one"));
  good(this->log().release("b", "one"));
  EXPECT_EQ(append_to(this->log(), "a", 1, fence, sample_entries(1, 1)).value().problem,
            AppendProblem::Fenced);
  EXPECT_EQ(this->row("a").holder, "");
  EXPECT_EQ(good(this->log().lease("a", "one", 1000)).fence, fence + 1) << "given back, it is old for ever";
}

TYPED_TEST(OpLogTest, SurvivesClocksThatGoBack) {
  const std::uint64_t fence = this->made("a");
  this->now() -= 3'600'000;
  EXPECT_EQ(good(this->log().lease("a", "two", 1000)).fence, fence + 1) << "held for an hour else";
  this->now() = 1000;
  const std::int64_t long_lease = std::numeric_limits<std::int64_t>::max();
  EXPECT_TRUE(this->log().lease("a", "two", long_lease));
  EXPECT_EQ(this->row("a").lease_ends, long_lease);
}

TYPED_TEST(OpLogTest, ForgetsWhatASnapshotStandsFor) {
  const std::uint64_t fence = this->made("a");
  EXPECT_FALSE(good(this->log().snapshot("a")));
  ASSERT_FALSE(append_to(this->log(), "a", 0, fence, sample_entries(0, 10, 100)));
  good(this->log().save_snapshot("a", fence, {8, "a world"}, 5));
  const auto snapshot = good(this->log().snapshot("a")).value();
  EXPECT_EQ(snapshot.sequence, 8U);
  EXPECT_EQ(snapshot.bytes, "a world");
  EXPECT_EQ(this->row("a").sequence, 10U);
  EXPECT_EQ(this->row("a").snapshot_sequence, 8U);
  EXPECT_EQ(this->row("a").bytes, 7U + 2 * 100U);
  EXPECT_EQ(sentence_of(this->log().read_from("a", 4, 10'000)),
            "a: the edits up to 5 are not kept any more. Begin with the snapshot of 8.");
  EXPECT_EQ(good(this->log().read_from("a", 5, 10'000)), sample_entries(5, 5, 100));
  ASSERT_FALSE(append_to(this->log(), "a", 10, fence, sample_entries(10, 1, 100)));
  EXPECT_EQ(this->row("a").bytes, 7U + 3 * 100U);
  good(this->log().save_snapshot("a", fence, {11, ""}, 11));
  EXPECT_EQ(this->row("a").bytes, 0U);
  EXPECT_TRUE(good(this->log().read_from("a", 11, 10'000)).empty());
  ASSERT_FALSE(append_to(this->log(), "a", 11, fence, sample_entries(11, 1)));
  EXPECT_EQ(good(this->log().read_from("a", 11, 10'000)), sample_entries(11, 1));
}

TYPED_TEST(OpLogTest, SavesNoSnapshotThatFitsNoEdit) {
  const std::uint64_t fence = this->made("a");
  ASSERT_FALSE(append_to(this->log(), "a", 0, fence, sample_entries(0, 10)));
  EXPECT_FALSE(this->log().save_snapshot("a", fence, {0, "x"}, 0));
  EXPECT_FALSE(this->log().save_snapshot("a", fence, {11, "x"}, 0)) << "not reached";
  EXPECT_FALSE(this->log().save_snapshot("a", fence, {5, "x"}, 6)) << "edits between would be lost";
  EXPECT_FALSE(this->log().save_snapshot("b", fence, {5, "x"}, 5));
  EXPECT_FALSE(good(this->log().snapshot("a")));
  good(this->log().save_snapshot("a", fence, {5, "x"}, 5));
  EXPECT_FALSE(this->log().save_snapshot("a", fence, {4, "y"}, 4)) << "older";
  EXPECT_TRUE(this->log().save_snapshot("a", fence, {5, "z"}, 0)) << "what is forgotten stays so";
  EXPECT_EQ(good(this->log().snapshot("a")).value().bytes, "z");
  EXPECT_FALSE(this->log().read_from("a", 4, 1000));
  EXPECT_FALSE(this->log().snapshot("b"));
}

TYPED_TEST(OpLogTest, KnowsTheLastNameOfAnAuthor) {
  this->made("a");
  this->made("b");
  EXPECT_EQ(good(this->log().author("a", "key", "Ann")).author, 1U);
  EXPECT_EQ(good(this->log().author("a", "other", "Bob")).author, 2U);
  EXPECT_EQ(good(this->log().author("a", "third", "")).author, 3U);
  EXPECT_EQ(good(this->log().author_names("a")), (AuthorNames{{1, "Ann"}, {2, "Bob"}}));
  EXPECT_EQ(good(this->log().author("a", "key", "Anna \u00c4")).author, 1U);
  EXPECT_EQ(good(this->log().author("a", "other", "")).author, 2U);
  EXPECT_EQ(good(this->log().author_names("a")), (AuthorNames{{1, "Anna \u00c4"}, {2, "Bob"}}));
  EXPECT_TRUE(good(this->log().author_names("b")).empty());
  EXPECT_FALSE(this->log().author_names("c"));
}

TYPED_TEST(OpLogTest, NumbersAuthorsByDesign) {
  const std::uint64_t fence = this->made("a");
  this->made("b");
  const std::string key("key\0\xff", 5);
  EXPECT_EQ(good(this->log().author("a", key, "Ann")).author, 1U);
  EXPECT_EQ(good(this->log().author("a", "other", "Ann")).author, 2U);
  EXPECT_EQ(good(this->log().author("b", "other", "Ann")).author, 1U);
  EXPECT_EQ(good(this->log().author("a", key, "Ann")).last_number, 0U);
  ASSERT_FALSE(append_to(this->log(), "a", 0, fence,
                         {{.sequence = 1, .author = 1, .number = 41},
                          {.sequence = 2, .author = 2, .number = 3},
                          {.sequence = 3, .author = 1, .number = 42},
                          {.sequence = 4, .author = 1, .number = 0},
                          {.sequence = 5, .author = 9, .number = 1}}));
  good(this->log().save_snapshot("a", fence, {5, "x"}, 5));
  EXPECT_EQ(good(this->log().author("a", key, "Ann")).last_number, 42U) << "forgotten edits count";
  EXPECT_EQ(good(this->log().author("a", "other", "Ann")).last_number, 3U);
  EXPECT_EQ(good(this->log().author("b", "other", "Ann")).last_number, 0U);
  EXPECT_FALSE(this->log().author("c", key, "Ann"));
}

TYPED_TEST(OpLogTest, RevokesForEver) {
  const std::uint64_t before = good(this->log().revoked_version());
  good(this->log().revoke("z"));
  const std::uint64_t after = good(this->log().revoked_version());
  EXPECT_NE(before, after);
  good(this->log().revoke("a"));
  good(this->log().revoke("z"));
  EXPECT_EQ(good(this->log().revoked()), (std::vector<std::string>{"z", "a"}));
  EXPECT_NE(good(this->log().revoked_version()), after);
}

}  // namespace
}  // namespace icome::collab
