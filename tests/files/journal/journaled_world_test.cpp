#include "files/journal/journaled_world.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <limits>

#include "files/sample_journals.h"
#include "world/edit/history.h"

namespace icome::files {
namespace {

using world::CreateObject;
using world::Edit;
using world::hash;
using world::ObjectId;
using world::RenameObject;

constexpr JournalOptions kCreate{.create = true};

std::size_t files_in(const std::filesystem::path& folder) {
  return std::size_t(std::distance(std::filesystem::directory_iterator(folder), {}));
}

void expect_not_performed(JournaledWorld& journal, const Edit& edit, const std::string& why) {
  const std::uint64_t before = hash(journal.world());
  const std::string bytes = content_of(journal.path());
  const auto result = journal.perform(edit);
  ASSERT_FALSE(result) << why;
  EXPECT_NE(result.error().message.find(why), std::string::npos) << result.error().message;
  EXPECT_EQ(hash(journal.world()), before);
  EXPECT_EQ(content_of(journal.path()), bytes);
}

TEST(JournaledWorld, IsCreatedWhenAskedFor) {
  const ScratchFolder folder;
  const auto path = folder.path() / "new.icome";
  EXPECT_FALSE(JournaledWorld::open(path, factory()));
  EXPECT_FALSE(std::filesystem::exists(path));
  { const JournaledWorld journal = opened(path, kCreate); }
  EXPECT_TRUE(read(path).report.damage.empty());
  const auto empty = folder.write("empty.icome", "");
  { const JournaledWorld journal = opened(empty, kCreate); }
  EXPECT_EQ(content_of(empty), content_of(path));
  EXPECT_FALSE(JournaledWorld::open(folder.path() / "nowhere" / "new.icome", factory(), kCreate));
  EXPECT_FALSE(JournaledWorld::open(folder.write("text.icome", "some text"), factory(), kCreate));
}

TEST(JournaledWorld, GoesOnWhereItWasLeft) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  std::size_t done = 0;
  for (const Edit& edit : few_edits()) {
    JournaledWorld journal = opened(path, kCreate);
    EXPECT_EQ(journal.report().edits, done++);
    performed(journal, edit);
    EXPECT_TRUE(journal.sync());
    EXPECT_EQ(journal.bytes(), content_of(path).size());
  }
  EXPECT_EQ(read(path).world.objects().size(), 2u);
}

TEST(JournaledWorld, WritesNoEditThatTheWorldOrTheBytesRefuse) {
  const ScratchFolder folder;
  JournaledWorld journal = opened(folder.path() / "design.icome", kCreate);
  for (const Edit& edit : few_edits()) performed(journal, edit);
  expect_not_performed(journal, RenameObject{ObjectId{77}, "ghost"}, "not there any more");
  geometry::TriangleMesh mesh;
  mesh.triangles = {{0, 1, 2}};
  expect_not_performed(journal, world::CreateGeometry{{900}, std::make_shared<world::MeshGeometry>(mesh)},
                       "vertex that is not there");
}

TEST(JournaledWorld, TakesShapesThatAreMadeAlready) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  const world::GeometryId id{1};
  world::World main;
  world::applied(main, world::CreateGeometry{id, world::one_triangle()});
  const Edit edit = world::MoveVertices{id, {0}, {{5.0, 0.0, 0.0}}};
  {
    JournaledWorld journal = opened(path, kCreate);
    performed(journal, world::CreateGeometry{id, world::one_triangle()});
    world::applied(main, edit);
    const auto back = journal.perform(edit, world::ReplaceGeometry{id, main.find(id)->shape});
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(journal.world().find(id)->shape, main.find(id)->shape);
  }
  EXPECT_EQ(hash(read(path).world), hash(main));
  const std::string bytes = content_of(path);
  std::filesystem::remove(path);
  JournaledWorld journal = opened(path, kCreate);
  performed(journal, world::CreateGeometry{id, world::one_triangle()});
  performed(journal, edit);
  EXPECT_EQ(content_of(path), bytes) << "it is the edit that is written";
}

TEST(JournaledWorld, CarriesUndoAndRedo) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  for (int seed = 0; seed < 20; ++seed) {
    std::filesystem::remove(path);
    std::vector<std::uint64_t> hashes;
    {
      JournaledWorld journal = opened(path, kCreate);
      world::RandomEdits edits{std::uint64_t(seed)};
      world::History history;
      hashes.push_back(hash(journal.world()));
      for (int i = 0; i < 40; ++i) {
        if (history.perform(journal.sink(), edits.next(journal.world()), "edit"))
          hashes.push_back(hash(journal.world()));
      }
      while (history.can_undo()) ASSERT_TRUE(history.undo(journal.sink()));
      ASSERT_EQ(hash(journal.world()), hashes.front());
      while (history.can_redo()) ASSERT_TRUE(history.redo(journal.sink()));
    }
    const ReadJournal back = read(path);
    ASSERT_EQ(hash(back.world), hashes.back()) << seed;
    EXPECT_EQ(back.report.edits, 3 * (hashes.size() - 1));
  }
}

TEST(JournaledWorld, CutsOffATornEditAndKeepsItsBytes) {
  const SampleJournal& sample = sample_journal();
  base::Random random(5);
  for (std::size_t length = sample.ends[0]; length < sample.bytes.size(); length += 1 + random.index(15)) {
    const ScratchFolder folder(memory_folder());
    const auto path = folder.write("torn.icome", sample.bytes.substr(0, length));
    const auto end = std::upper_bound(sample.ends.begin(), sample.ends.end(), length) - 1;
    const auto edits = std::size_t(end - sample.ends.begin());
    {
      JournaledWorld journal = opened(path);
      EXPECT_EQ(hash(journal.world()), sample.hashes[edits]) << length;
      if (length == *end) {
        EXPECT_TRUE(journal.report().set_aside.empty());
        EXPECT_EQ(files_in(folder.path()), 1u);
      } else {
        EXPECT_EQ(journal.report().damage.size(), 2u);
        EXPECT_EQ(content_of(journal.report().set_aside), sample.bytes.substr(*end, length - *end)) << length;
      }
      EXPECT_EQ(content_of(path), sample.bytes.substr(0, *end));
      performed(journal, few_edits().size() > edits ? few_edits()[edits] : Edit(world::EditGroup{}));
    }
    EXPECT_EQ(read(path).report.edits, edits + 1) << length;
    EXPECT_TRUE(read(path).report.damage.empty());
  }
}

TEST(JournaledWorld, MendsDamageAndKeepsWhatIsLost) {
  const SampleJournal& sample = sample_journal();
  base::Random random(6);
  for (std::size_t at = random.index(7); at < sample.bytes.size(); at += 1 + random.index(13)) {
    const ScratchFolder folder(memory_folder());
    std::string bytes = sample.bytes;
    bytes[at] = char(bytes[at] ^ 0x10);
    const auto path = folder.write("damaged.icome", bytes);
    std::uint64_t last = 0;
    {
      JournaledWorld journal = opened(path);
      const JournalReport& report = journal.report();
      ASSERT_FALSE(report.damage.empty()) << at;
      const std::string lost = bytes.substr(report.damaged_from);
      EXPECT_EQ(report.lost_bytes > 0 ? content_of(report.set_aside) : "", lost) << at;
      performed(journal, world::CreateScene{{900}, "later"});
      last = hash(journal.world());
    }
    EXPECT_EQ(hash(read(path).world), last) << at;
    EXPECT_TRUE(read(path).report.damage.empty()) << at;
  }
}

TEST(JournaledWorld, NamesWhatIsLostAnewEachTime) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  for (const char* name : {"design.icome.lost", "design.icome.lost-2", "design.icome.lost-3"}) {
    folder.write("design.icome", sample_journal().bytes + "\x8aRE " + name);
    const JournaledWorld journal = opened(path);
    EXPECT_EQ(journal.report().set_aside, std::filesystem::canonical(folder.path()) / name);
  }
}

TEST(JournaledWorld, IsLockedAgainstOthers) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  {
    JournaledWorld journal = opened(path, kCreate);
    for (int i = 0; i < 2; ++i) {
      const auto other = JournaledWorld::open(path, factory());
      ASSERT_FALSE(other);
      EXPECT_NE(other.error().message.find("somebody works with it"), std::string::npos);
      EXPECT_TRUE(read(path).report.damage.empty());
      ASSERT_TRUE(journal.compact());  // into another file, which is locked, too
    }
    JournaledWorld moved = std::move(journal);
    EXPECT_FALSE(JournaledWorld::open(path, factory()));
  }
  EXPECT_TRUE(JournaledWorld::open(path, factory()));
}

TEST(JournaledWorld, CompactsIntoASnapshot) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  world::IdSource ids;
  JournaledWorld journal = opened(path, kCreate);
  const ObjectId kept = ids.next<ObjectId>(), gone = ids.next<ObjectId>();
  performed(journal, CreateObject{kept, 0, {.name = "kept"}});
  performed(journal, CreateObject{gone, 1, {.name = "gone"}});
  performed(journal, world::DeleteObject{gone});
  for (int i = 0; i < 100; ++i) performed(journal, RenameObject{kept, std::to_string(i)});
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  const std::uint64_t before = journal.bytes();
  ASSERT_TRUE(journal.compact());
  EXPECT_LT(journal.bytes(), before / 10);
  EXPECT_EQ(journal.bytes(), content_of(path).size());
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms::owner_all);
  performed(journal, RenameObject{kept, "last"});
  const ReadJournal back = read(path);
  EXPECT_EQ(hash(back.world), hash(journal.world()));
  EXPECT_EQ(back.report.edits, 1u);
  EXPECT_EQ(back.world.next_number(0), 3u);  // of what is gone, too
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(JournaledWorld, CompactsByItselfWhenEditsOutweighTheSnapshot) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  JournaledWorld journal = opened(path, {.create = true, .compact_from = 10000, .compact_factor = 2.0});
  performed(journal, CreateObject{{1}, 0, {}});
  std::uint64_t most = 0;
  for (int i = 0; i < 2000; ++i) {
    performed(journal, RenameObject{{1}, std::to_string(i)});
    most = std::max(most, journal.bytes());
  }
  EXPECT_LT(most, 11000u);
  EXPECT_EQ(hash(read(path).world), hash(journal.world()));
}

TEST(JournaledWorld, RestartsWithAnotherWorld) {
  const ScratchFolder folder;
  const auto path = folder.path() / "kept" / "design.icome";
  std::filesystem::create_directory(path.parent_path());
  JournaledWorld journal = opened(path, kCreate);
  performed(journal, CreateObject{{1}, 0, {.name = "first"}});
  EXPECT_TRUE(journal.is_in_place());
  std::filesystem::remove_all(path.parent_path());
  EXPECT_FALSE(journal.is_in_place());
  world::World other;
  world::applied(other, CreateObject{{2}, 0, {.name = "other"}});
  EXPECT_FALSE(journal.restart(other));
  EXPECT_NE(hash(journal.world()), hash(other));
  std::filesystem::create_directory(path.parent_path());
  ASSERT_TRUE(journal.restart(other));
  EXPECT_TRUE(journal.is_in_place());
  performed(journal, CreateObject{{3}, 0, {}});
  EXPECT_EQ(hash(read(path).world), hash(journal.world()));
  EXPECT_EQ(journal.world().objects().size(), 2u);
}

TEST(JournaledWorld, CompactsWhereALinkLeads) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome", link = folder.path() / "link.icome";
  { const JournaledWorld journal = opened(path, kCreate); }
  std::filesystem::create_symlink(path, link);
  JournaledWorld journal = opened(link);
  performed(journal, CreateObject{{1}, 0, {}});
  ASSERT_TRUE(journal.compact());
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(read(path).world.objects().size(), 1u);
}

TEST(JournaledWorld, TakesAwayWhatAKilledCompactionLeft) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  { const JournaledWorld journal = opened(path, kCreate); }
  folder.write("design.icome.part-4711", "half a journal");
  folder.write("design.icome.part-time", "something else");
  const JournaledWorld journal = opened(path);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "design.icome.part-4711"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "design.icome.part-time"));
}

/// Lets no file of this program grow beyond a size, as a full disk does.
class FullDisk {
 public:
  explicit FullDisk(std::uint64_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_);
    std::signal(SIGXFSZ, old_handler_);
  }

 private:
  rlimit old_{};
  void (*old_handler_)(int) = nullptr;
};

TEST(JournaledWorld, RefusesEditsWhileTheDiskIsFull) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  JournaledWorld journal = opened(path, kCreate);
  performed(journal, CreateObject{{1}, 0, {}});
  for (std::uint64_t room = 0; room < 200; room += 7) {
    const FullDisk full(journal.bytes() + room);
    expect_not_performed(journal, RenameObject{{1}, std::string(300, 'x')}, "The edit was not done");
  }
  performed(journal, RenameObject{{1}, "later"});
  EXPECT_EQ(hash(read(path).world), hash(journal.world()));
}

TEST(JournaledWorld, StaysAsItIsWhereItCannotBeCompacted) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  JournaledWorld journal = opened(path, {.create = true, .compact_from = 0, .compact_factor = 3.0});
  const auto picture = std::make_shared<std::string>(std::string(100, 'x'));
  for (std::uint64_t i = 1; i < 20; ++i)
    performed(journal, world::CreateTexture{{i}, {"picture", "image/png", picture}});
  ASSERT_FALSE(journal.compact_problem());
  // Writing where all names are those of folders is as impossible as without room, and edits can still be
  // written.
  std::vector<std::string> beside{path.string() + ".part-" + std::to_string(::getpid())};
  for (int i = 1; i <= 100; ++i) beside.push_back(beside[0] + "-" + std::to_string(i));
  for (const std::string& name : beside) std::filesystem::create_directory(name);
  EXPECT_FALSE(journal.compact());
  for (int i = 0; i < 200; ++i) performed(journal, world::CreateScene{{std::uint64_t(100 + i)}, ""});
  ASSERT_TRUE(journal.compact_problem());
  EXPECT_EQ(hash(read(path).world), hash(journal.world()));
  for (const std::string& name : beside) std::filesystem::remove(name);
  EXPECT_TRUE(journal.compact());
  EXPECT_FALSE(journal.compact_problem());
  EXPECT_EQ(hash(read(path).world), hash(journal.world()));
}

TEST(JournaledWorld, ThatMayNotBeWrittenIsRefused) {
  const ScratchFolder folder;
  const auto path = folder.write("design.icome", sample_journal().bytes);
  std::filesystem::permissions(path, std::filesystem::perms::owner_read);
  const pid_t child = ::fork();
  if (child == 0) {
    constexpr uid_t kNobody = 65534;  // root may do everything
    if (::geteuid() == 0 && ::seteuid(kNobody) != 0) ::_exit(1);
    const auto journal = JournaledWorld::open(path, factory());
    const bool told = !journal && journal.error().message.find("Permission denied") != std::string::npos;
    ::_exit(told ? 0 : 2);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << status;
}

TEST(JournaledWorld, IsNotOpenedWhereLostBytesCannotBeKept) {
  const ScratchFolder folder;
  const auto path = folder.write("design.icome", sample_journal().bytes + std::string(1000, '-'));
  const std::string before = content_of(path);
  {
    const FullDisk full(500);
    const auto journal = JournaledWorld::open(path, factory());
    ASSERT_FALSE(journal);
    EXPECT_NE(journal.error().message.find("Nothing was changed"), std::string::npos);
  }
  EXPECT_EQ(content_of(path), before);
  EXPECT_EQ(files_in(folder.path()), 1u);
}

}  // namespace
}  // namespace icome::files
