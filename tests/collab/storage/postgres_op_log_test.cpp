// What a log in PostgreSQL promises besides what all logs do: several servers, lost connections, wrong
// addresses.
#include "collab/storage/postgres_op_log.h"

#include <atomic>
#include <future>
#include <thread>

#include "base/clock.h"
#include "collab/storage/sample_log.h"
#include "collab/storage/shared_postgres.h"
#include "collab/storage/store.h"

namespace icome::collab {
namespace {

constexpr PostgresPatience kShortPatience{.connecting = 2000, .statement = 300, .silence = 1500};

class PostgresOpLogTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string why = why_no_postgres();
    if (!why.empty()) GTEST_SKIP() << why;
    address_ = shared_postgres().fresh_database();
  }
  PostgresOpLog opened(const PostgresPatience& patience = {}) const {
    return good(PostgresOpLog::open(address_, patience));
  }
  std::string opening_sentence() const { return sentence_of(PostgresOpLog::open(address_)); }
  /// The address as sentences show it.
  std::string place() const {
    const std::size_t name = address_.find("@/") + 2;
    return "postgresql:///" + address_.substr(name) + "&port=5432";
  }
  void meddle(const std::string& sql) const { PostgresMeddler(address_).run(sql); }

  /// Ends all connections to the database but its own, or those of them that `which` says, and waits until
  /// they are gone.
  void cut_connections(const std::string& which = "true") const {
    meddle(
        "SELECT count(pg_terminate_backend(pid, 5000)) FROM pg_stat_activity WHERE datname = "
        "current_database() "
        "AND pid <> pg_backend_pid() AND " +
        which);
  }
  /// Waits until somebody waits for a lock in the database.
  void wait_for_waiting() const {
    PostgresMeddler looking(address_);
    while (looking.run("SELECT count(*) FROM pg_stat_activity WHERE datname = current_database() AND "
                       "wait_event_type = 'Lock'") == "0")
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  std::string address_;
};

TEST_F(PostgresOpLogTest, KeepsAllWhenItIsClosed) {
  std::uint64_t fence = 0, history = 0;
  {
    PostgresOpLog log = opened();
    good(log.create("a"));
    fence = good(log.lease("a", "server", 60'000)).fence;
    good(log.author("a", "key", "Ann"));
    ASSERT_FALSE(append_to(log, "a", 0, fence, sample_entries(0, 5)));
    good(log.revoke("gone"));
    history = good(log.find("a")).value().history;
  }
  PostgresOpLog log = opened();
  EXPECT_EQ(good(log.read_from("a", 0, 1000)), sample_entries(0, 5));
  EXPECT_EQ(good(log.find("a")).value().history, history);
  EXPECT_EQ(good(log.lease("a", "server", 60'000)).fence, fence);
  EXPECT_EQ(good(log.author("a", "key", "Ann")).author, 1U);
  EXPECT_EQ(good(log.revoked()), std::vector<std::string>{"gone"});
}

TEST_F(PostgresOpLogTest, GivesADesignToAnotherServerWhenItsLeaseIsOver) {
  PostgresOpLog one = opened(), two = opened();
  good(one.create("a"));
  const std::uint64_t old_fence = good(one.lease("a", "one", 200)).fence;
  ASSERT_FALSE(append_to(one, "a", 0, old_fence, sample_entries(0, 2)));
  EXPECT_FALSE(two.lease("a", "two", 60'000));
  std::this_thread::sleep_for(std::chrono::milliseconds(250));  // by the database's clock, which has no other
  const std::uint64_t fence = good(two.lease("a", "two", 60'000)).fence;
  EXPECT_EQ(append_to(one, "a", 2, old_fence, sample_entries(2, 1)).value().problem, AppendProblem::Fenced);
  EXPECT_FALSE(one.save_snapshot("a", old_fence, {2, "x"}, 0));
  EXPECT_FALSE(append_to(two, "a", 2, fence, sample_entries(2, 1)));
  EXPECT_EQ(good(one.read_from("a", 0, 1000)), sample_entries(0, 3));
  const std::int64_t left = good(one.find("a")).value().lease_ends - wall_milliseconds();
  EXPECT_NEAR(double(left), 60'000.0, 30'000.0) << "ms since 1970, as this machine has them";
}

TEST_F(PostgresOpLogTest, CanBeMadeBySeveralServersAtOnce) {
  std::vector<std::future<bool>> servers;
  for (int i = 0; i < 6; ++i)
    servers.push_back(std::async(std::launch::async, [this, i] {
      auto log = PostgresOpLog::open(address_);
      return log && log->create("design " + std::to_string(i));
    }));
  for (auto& it : servers) EXPECT_TRUE(it.get());
  EXPECT_EQ(good(opened().designs()).size(), 6U);
}

TEST_F(PostgresOpLogTest, LosesNothingOfServersThatWorkOnTheSameDesigns) {
  constexpr std::uint64_t kRounds = 40;
  const std::vector<std::string> names{"a", "b", "c", "d"};
  {
    PostgresOpLog log = opened();
    for (const std::string& it : names) good(log.create(it));
  }
  // Each takes the designs in another order, and has a half of them: none waits for the other for ever.
  const auto work = [&](int server) {
    PostgresOpLog log = opened();
    std::vector<Append> mine;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (int(i % 2) == server)
        mine.push_back({names[i], 0, good(log.lease(names[i], std::to_string(server), 60'000)).fence, {}});
    int failures = 0;
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      std::vector<Append> batches = mine;
      for (Append& it : batches) it.batch = sample_entries(it.expected_sequence = round, 1);
      for (const std::string& it : names) batches.push_back({it, 0, 99, sample_entries(0, 1)});  // refused
      if (server == 1) std::reverse(batches.begin(), batches.end());
      int appended = 0;
      for (const auto& it : log.append(batches)) {
        appended += it ? 0 : 1;
        failures += it && it->problem != AppendProblem::Fenced ? 1 : 0;
      }
      failures += appended == 2 ? 0 : 1;
    }
    return failures;
  };
  auto other = std::async(std::launch::async, [&] { return work(0); });
  EXPECT_EQ(work(1), 0);
  EXPECT_EQ(other.get(), 0);
  for (const std::string& it : names)
    EXPECT_EQ(good(opened().read_from(it, 0, 100'000)), sample_entries(0, kRounds));
}

TEST_F(PostgresOpLogTest, ConnectsAgainWhereTheConnectionWasCut) {
  PostgresOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  cut_connections();
  EXPECT_FALSE(append_to(log, "a", 0, fence, sample_entries(0, 1))) << "nothing was lost in between";
  cut_connections();
  EXPECT_EQ(good(log.read_from("a", 0, 1000)), sample_entries(0, 1));
}

TEST_F(PostgresOpLogTest, SaysThatTheConnectionWasCutInTheMiddle) {
  PostgresOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  PostgresMeddler other(address_);
  other.run("BEGIN");
  other.run("SELECT 1 FROM icome.designs FOR UPDATE");
  auto appending =
      std::async(std::launch::async, [&] { return append_to(log, "a", 0, fence, sample_entries(0, 1)); });
  wait_for_waiting();
  cut_connections("wait_event_type = 'Lock'");
  const AppendError problem = appending.get().value();
  other.run("ROLLBACK");
  EXPECT_EQ(problem.problem, AppendProblem::Store);
  EXPECT_EQ(problem.message,
            place() +
                ": the connection to the database was lost (FATAL:  terminating connection due to "
                "administrator command). See whether it runs, then try again.");
  EXPECT_FALSE(append_to(log, "a", 0, fence, sample_entries(0, 1)));
  EXPECT_EQ(good(log.read_from("a", 0, 1000)), sample_entries(0, 1));
}

TEST_F(PostgresOpLogTest, LosesNothingWhileItIsCutAgainAndAgain) {
  PostgresOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 600'000)).fence;
  std::atomic<bool> ends = false;
  auto cutting = std::async(std::launch::async, [&] {
    for (int i = 0; i < 20; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(i));
      cut_connections();
    }
    ends = true;
  });
  std::uint64_t last = 0;
  int losses = 0;
  while (!ends) {
    const auto problem = append_to(log, "a", last, fence, sample_entries(last, 3));
    if (!problem) {
      last += 3;
      continue;
    }
    ASSERT_EQ(problem->problem, AppendProblem::Store) << problem->message;
    ++losses;
    auto row = log.find("a");
    while (!row) row = log.find("a");
    ASSERT_GE((*row)->sequence, last);
    ASSERT_LE((*row)->sequence, last + 3);
    last = (*row)->sequence;
  }
  cutting.get();
  EXPECT_EQ(good(log.read_from("a", 0, ~std::uint64_t{0})), sample_entries(0, last));
  std::printf("cut in the middle of an append %d times, %llu edits\n", losses,
              static_cast<unsigned long long>(last));
}

TEST_F(PostgresOpLogTest, WaitsForNobodyForEver) {
  PostgresOpLog log = opened(kShortPatience);
  good(log.create("a"));
  PostgresMeddler other(address_);
  other.run("BEGIN");
  other.run("SELECT 1 FROM icome.designs FOR UPDATE");
  EXPECT_EQ(
      append_to(log, "a", 0, 1, {}).value().message,
      place() +
          ": somebody kept it locked, or it was too busy, for too long. Nothing was changed; try again.");
  other.run("ROLLBACK");
  EXPECT_EQ(append_to(log, "a", 0, 1, {}).value().problem, AppendProblem::Fenced);
}

TEST_F(PostgresOpLogTest, WaitsForNoSilentDatabaseForEver) {
  PostgresOpLog log = opened(kShortPatience);
  good(log.create("a"));
  shared_postgres().signal(SIGSTOP);
  const std::int64_t begin = base::steady_nanoseconds();
  const std::string sentence = sentence_of(log.find("a"));
  const std::string again = sentence_of(log.find("a"));
  const double seconds = double(base::steady_nanoseconds() - begin) * 1e-9;
  shared_postgres().signal(SIGCONT);
  EXPECT_EQ(sentence, place() +
                          ": the connection to the database was lost (it does not answer). See whether it "
                          "runs, then try again.");
  EXPECT_NE(again.find("timeout expired"), std::string::npos) << again;
  EXPECT_GE(seconds, 3.0);
  EXPECT_TRUE(good(log.find("a")));
}

/// A commit waits for a copy of the database that never comes, and nothing counts as saved meanwhile.
TEST_F(PostgresOpLogTest, AcknowledgesNothingThatACopyDoesNotHave) {
  PostgresOpLog log = opened(kShortPatience);
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 600'000)).fence;
  PostgresMeddler administrator(shared_postgres().address("postgres"));
  const auto ask_for_copies = [&](const std::string& names) {
    administrator.run("ALTER SYSTEM SET synchronous_standby_names = '" + names + "'");
    administrator.run("SELECT pg_reload_conf()");
    while (PostgresMeddler(address_).run("SHOW synchronous_standby_names") != names)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  };
  ask_for_copies("nobody");
  const AppendError problem = append_to(log, "a", 0, fence, sample_entries(0, 1)).value();
  ask_for_copies("");
  EXPECT_EQ(problem.problem, AppendProblem::Store);
  EXPECT_EQ(
      problem.message,
      place() +
          ": the connection to the database was lost (it does not answer). See whether it runs, then try "
          "again. Whether the last change was saved is not known.");
  const std::uint64_t last = good(opened().find("a")).value().sequence;
  EXPECT_FALSE(append_to(log, "a", last, fence, sample_entries(last, 1)));
}

/// A trigger stands for others that change the same at once: it fails the first times, which a sequence
/// counts.
TEST_F(PostgresOpLogTest, TriesAgainWhereOthersWereInTheWay) {
  PostgresOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  meddle("CREATE SEQUENCE tries");
  meddle(
      "CREATE FUNCTION be_in_the_way() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN IF nextval('tries') <= 3 "
      "THEN "
      "RAISE EXCEPTION 'in the way' USING ERRCODE = '40001'; END IF; RETURN NEW; END $$");
  meddle(
      "CREATE TRIGGER in_the_way BEFORE INSERT ON icome.edits FOR EACH STATEMENT EXECUTE FUNCTION "
      "be_in_the_way()");
  const std::vector<Append> batches{{"a", 0, fence, sample_entries(0, 2)},
                                    {"a", 0, fence, sample_entries(0, 1)}};
  const auto results = log.append(batches);
  EXPECT_FALSE(results[0]);
  EXPECT_EQ(results[1].value().problem, AppendProblem::WrongSequence);
  EXPECT_EQ(good(log.read_from("a", 0, 1000)), sample_entries(0, 2));
  meddle("ALTER SEQUENCE tries MINVALUE -100 RESTART WITH -100");
  EXPECT_EQ(append_to(log, "a", 2, fence, sample_entries(2, 1)).value().message,
            place() + ": too many changed the same at once. Nothing was changed; try again.");
  EXPECT_EQ(good(log.find("a")).value().sequence, 2U);
}

TEST_F(PostgresOpLogTest, TakesLargeEditsAndLongKeys) {
  PostgresOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  const auto entries = sample_entries(0, 5, 7'000'000);  // more than one INSERT takes
  ASSERT_FALSE(append_to(log, "a", 0, fence, entries));
  EXPECT_EQ(good(log.read_from("a", 0, ~std::uint64_t{0})), entries);
  EXPECT_EQ(good(log.read_from("a", 1, 14'000'000)).size(), 2U);
  const std::string world = sample_edit(1, 40'000'000);
  good(log.save_snapshot("a", fence, {5, world}, 5));
  EXPECT_EQ(good(log.snapshot("a")).value().bytes, world);
  const std::string key = sample_edit(2, 100'000);
  EXPECT_EQ(good(log.author("a", key, "Ann")).author, 1U);
  EXPECT_EQ(good(log.author("a", key + "x", "Ann")).author, 2U);
  EXPECT_EQ(good(log.author("a", key, "Ann")).author, 1U);
}

TEST_F(PostgresOpLogTest, ReadsMoreEditsThanOneStatementGives) {
  PostgresOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  ASSERT_FALSE(append_to(log, "a", 0, fence, sample_entries(0, 10'000, 10)));
  EXPECT_EQ(good(log.read_from("a", 0, ~std::uint64_t{0})), sample_entries(0, 10'000, 10));
  EXPECT_EQ(good(log.read_from("a", 7, 40'960)).size(), 4096U) << "just one statement's";
  EXPECT_EQ(good(log.read_from("a", 7, 40'970)).size(), 4097U);
  EXPECT_EQ(good(log.read_from("a", 7, 55'555)).size(), 5555U);
}

TEST_F(PostgresOpLogTest, KnowsNoDesignWhoseNameIsNoText) {
  PostgresOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  for (const std::string& name : {std::string("a\0", 2), std::string("\xff")}) {
    EXPECT_FALSE(log.create(name));
    EXPECT_FALSE(good(log.find(name)));
    EXPECT_FALSE(log.lease(name, "server", 1000));
    good(log.release(name, "server"));
    const std::vector<Append> batches{{name, 0, fence, sample_entries(0, 1)}, {"a", 0, fence, {}}};
    const auto results = log.append(batches);
    EXPECT_EQ(results[0].value().problem, AppendProblem::NoDesign);
    EXPECT_FALSE(results[1]) << "others are not in the way of it";
  }
}

TEST_F(PostgresOpLogTest, RefusesANewerVersion) {
  (void)opened();
  meddle("UPDATE icome.store SET version = 3");
  EXPECT_EQ(opening_sentence(), place() +
                                    ": its store is that of a newer version of icome (store version 3, this "
                                    "one knows 2). Use that version.");
  meddle("DELETE FROM icome.store");
  EXPECT_EQ(opening_sentence(),
            place() + ": the store in it is damaged (it has no version). Restore a backup of the database.");
}

TEST_F(PostgresOpLogTest, TakesAStoreFromBeforeThereWereSums) {
  PostgresOpLog before = opened();
  good(before.create("a"));
  const std::uint64_t fence = good(before.lease("a", "server", 60'000)).fence;
  ASSERT_FALSE(append_to(before, "a", 0, fence, sample_entries(0, 3)));
  good(before.save_snapshot("a", fence, {1, "a world"}, 0));
  meddle("ALTER TABLE icome.edits DROP COLUMN sum");
  meddle("ALTER TABLE icome.snapshots DROP COLUMN sum");
  meddle("ALTER TABLE icome.authors DROP COLUMN name");
  meddle("UPDATE icome.store SET version = 1");
  PostgresOpLog log = opened();
  EXPECT_EQ(good(log.read_from("a", 0, 100'000)), sample_entries(0, 3));
  EXPECT_EQ(good(log.snapshot("a")).value().bytes, "a world");
  ASSERT_FALSE(append_to(log, "a", 3, fence, sample_entries(3, 1)));
  meddle("UPDATE icome.edits SET at = at + 1");
  EXPECT_EQ(good(log.read_from("a", 0, 1)).size(), 1U) << "it has no sum";
  EXPECT_EQ(sentence_of(log.read_from("a", 3, 100'000)),
            "a: the edit 4 is not what was written: the store is damaged. Restore a backup.");
  good(log.save_snapshot("a", fence, {2, "the world"}, 0));
  meddle("UPDATE icome.snapshots SET bytes = 'thy world'");
  EXPECT_EQ(sentence_of(log.snapshot("a")),
            "a: the snapshot of 2 is not what was written: the store is damaged. Restore a backup.");
}

TEST_F(PostgresOpLogTest, RefusesAnotherProgramsSchema) {
  meddle("CREATE SCHEMA icome");
  meddle("CREATE TABLE icome.designs (what text)");
  EXPECT_EQ(opening_sentence(),
            place() + ": its schema icome is that of another program. Choose another database.");
  meddle("DROP TABLE icome.designs");
  EXPECT_TRUE(PostgresOpLog::open(address_)) << "an empty one was made for us";
}

TEST_F(PostgresOpLogTest, SaysThatATableIsGone) {
  PostgresOpLog log = opened();
  meddle("DROP TABLE icome.revoked");
  EXPECT_EQ(
      sentence_of(log.revoked()),
      place() +
          ": the store in it is damaged (relation \"icome.revoked\" does not exist). Restore a backup of "
          "the database.");
  EXPECT_TRUE(good(log.designs()).empty()) << "the connection goes on";
}

TEST_F(PostgresOpLogTest, SaysWhatIsWrongWithAnAddressButNoPassword) {
  const auto sentence = [](const std::string& address) { return sentence_of(PostgresOpLog::open(address)); };
  const std::string advice =
      "Write postgresql://USER:PASSWORD@HOST:PORT/DATABASE, and in the user's name and the password %40 for "
      "@, %2F "
      "for /, %3A for :, %25 for %.";
  for (const char* address :
       {"postgresql://u:sec/ret@host/db", "postgresql://u:sec@ret@host/db", "postgresql://u:sec?ret@host/db"})
    EXPECT_EQ(sentence(address),
              "The address of the database has one of / ? # @ where they cannot be. " + advice);
  for (const char* address :
       {"postgresql://u:%zzsecret@host/db", "postgresql://u:secret@host/db?nonsense=secret"})
    EXPECT_EQ(sentence(address), "The address of the database cannot be read. " + advice);
  const std::string refused = sentence("postgresql://u:secret@127.0.0.1:1/db");
  EXPECT_EQ(
      refused,
      "postgresql://127.0.0.1:1/db: cannot be connected to (connection to server at \"127.0.0.1\", port 1 "
      "failed: Connection refused). See whether PostgreSQL runs there, and whether the address, the user and "
      "the password are right.");
  const std::string wrong = sentence(shared_postgres().address("postgres", "secret"));
  EXPECT_NE(wrong.find("password authentication failed for user \"icome\""), std::string::npos) << wrong;
  EXPECT_EQ(wrong.find("secret"), std::string::npos);
  const std::string missing = sentence(shared_postgres().address("missing"));
  EXPECT_NE(missing.find("database \"missing\" does not exist"), std::string::npos) << missing;
  const std::string none = sentence(shared_postgres().address("postgres", ""));
  EXPECT_NE(none.find(": wants a password."), std::string::npos) << none;
}

TEST_F(PostgresOpLogTest, SaysThatARightIsMissing) {
  meddle("DROP ROLE IF EXISTS guest");
  meddle("CREATE ROLE guest LOGIN PASSWORD 'guest'");
  const std::string guest = "postgresql://guest:guest" + address_.substr(address_.find('@'));
  const std::string sentence = sentence_of(PostgresOpLog::open(guest));
  EXPECT_EQ(sentence,
            place() + ": the user lacks a right (permission denied for database " +
                address_.substr(address_.find("@/") + 2, address_.find('?') - address_.find("@/") - 2) +
                "). Let the database's owner grant it.");
}

TEST_F(PostgresOpLogTest, RefusesADatabaseThatKeepsNoUnicode) {
  meddle("CREATE DATABASE latin ENCODING 'LATIN1' TEMPLATE template0");
  const std::string sentence = sentence_of(PostgresOpLog::open(shared_postgres().address("latin")));
  meddle("DROP DATABASE latin");
  EXPECT_NE(sentence.find(": does not keep text as UTF-8."), std::string::npos) << sentence;
}

TEST_F(PostgresOpLogTest, IsWhatTheAddressOfADatabaseMeans) {
  EXPECT_TRUE(is_database_address("postgres://host/db"));
  EXPECT_FALSE(is_database_address("postgresql"));
  good(good(good(Store::open(address_)).log())->create("a"));
  EXPECT_TRUE(good(opened().find("a")));
  const std::string short_form = "postgres" + address_.substr(address_.find("://"));
  const Store store = good(Store::make(short_form));
  EXPECT_TRUE(good(good(store.log())->find("a")));
  EXPECT_EQ(good(store.address()), std::nullopt);
  const ServedAddress served{"10.0.0.7", 4263, ""};
  good(store.write_address(served));
  EXPECT_EQ(good(good(Store::open(address_)).address()), served);
  const Invitation invitation{good(make_invitation_id()), "a", Role::Edit, 1'000};
  const std::string token = good(good(store.signer()).sign(invitation));
  EXPECT_EQ(good(good(good(Store::open(address_)).signer()).check(token, "a", 0)), invitation)
      << "all servers of a store have one secret";
}

TEST(Store, IsShownWithoutItsSecrets) {
  EXPECT_EQ(good(Store::open("postgresql://ann:p@ss@db:5432/icome?password=x")).shown(),
            "postgresql://db:5432/icome");
  EXPECT_EQ(good(Store::open("postgres:///icome?host=/tmp")).shown(), "postgres:///icome");
}

}  // namespace
}  // namespace icome::collab
