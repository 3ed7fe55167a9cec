#include "files/journal/journal.h"

#include <lzma.h>
#include <sys/stat.h>

#include "files/journal/journal_format.h"
#include "files/sample_journals.h"
#include "world/every_edit.h"

namespace icome::files {
namespace {

using world::hash;
using world::IdSource;
using world::World;

void expect_no_journal(const std::filesystem::path& path, const std::string& why) {
  const auto read = read_journal(path, factory());
  ASSERT_FALSE(read) << why;
  EXPECT_NE(read.error().message.find(why), std::string::npos) << read.error().message;
  EXPECT_TRUE(read.error().message.starts_with(path.string())) << read.error().message;
  const bool is_file = std::filesystem::is_regular_file(path);
  const std::string before = is_file ? content_of(path) : "";
  const auto opened = JournaledWorld::open(path, factory());
  ASSERT_FALSE(opened) << why;
  EXPECT_NE(opened.error().message.find(why), std::string::npos) << opened.error().message;
  EXPECT_EQ(is_file ? content_of(path) : "", before);
}

TEST(Journal, GivesBackWorldsOfEveryKindOfThing) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  World world;
  for (const world::Edit& edit : world::every_edit()) world::applied(world, edit);
  ASSERT_TRUE(write_journal(path, world));
  const ReadJournal back = read(path);
  EXPECT_EQ(hash(back.world), hash(world));
  EXPECT_EQ(back.world.last_numbers(), world.last_numbers());
  EXPECT_EQ(back.report.edits, 0u);
  EXPECT_TRUE(back.report.damage.empty());
  EXPECT_EQ(back.report.snapshot_bytes + kJournalHeaderBytes, back.report.bytes);
}

TEST(Journal, OfTheSameWorldHasTheSameBytes) {
  const ScratchFolder folder;
  World world;
  world::RandomEdits edits(3);
  for (int i = 0; i < 200; ++i) (void)apply(world, edits.next(world));
  ASSERT_TRUE(write_journal(folder.path() / "one.icome", world));
  ASSERT_TRUE(write_journal(folder.path() / "other.icome", read(folder.path() / "one.icome").world));
  EXPECT_EQ(content_of(folder.path() / "one.icome"), content_of(folder.path() / "other.icome"));
}

TEST(Journal, ReplaysToTheSameWorld) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  for (int seed = 0; seed < 50; ++seed) {
    std::filesystem::remove(path);
    world::RandomEdits edits{std::uint64_t(seed)};
    std::uint64_t kept = 0, last = 0;
    std::unordered_map<std::uint32_t, std::uint64_t> numbers;
    {
      JournaledWorld journal = opened(path, {.create = true});
      for (int i = 0; i < 60; ++i) kept += journal.perform(edits.next(journal.world())) ? 1 : 0;
      last = hash(journal.world());
      numbers = journal.world().last_numbers();
    }
    const ReadJournal back = read(path);
    ASSERT_EQ(hash(back.world), last) << seed;
    EXPECT_EQ(back.report.edits, kept);
    // A refused group may have taken numbers that nobody saw: those may be given again.
    for (const auto& [author, number] : back.world.last_numbers()) EXPECT_LE(number, numbers.at(author));
  }
}

TEST(Journal, CutOffAnywhereGivesAllWholeEditsBeforeThat) {
  const SampleJournal& sample = sample_journal();
  const ScratchFolder folder(memory_folder());
  for (std::size_t length = 0; length < sample.bytes.size(); ++length) {
    const auto path = write_fresh(folder, "cut.icome", sample.bytes.substr(0, length));
    const auto back = read_journal(path, factory());
    if (length < kJournalHeaderBytes) {
      EXPECT_FALSE(back) << length;
      continue;
    }
    ASSERT_TRUE(back) << back.error().message;
    const auto end = std::upper_bound(sample.ends.begin(), sample.ends.end(), length);
    const auto whole = std::size_t(end - sample.ends.begin());  // the snapshot, too
    if (whole == 0) {                                           // within the snapshot
      EXPECT_EQ(back->report.edits, 0u) << length;
      EXPECT_FALSE(back->report.damage.empty()) << length;
      continue;
    }
    EXPECT_EQ(back->report.edits, whole - 1) << length;
    EXPECT_EQ(hash(back->world), sample.hashes[whole - 1]) << length;
    EXPECT_EQ(back->report.lost_bytes, length - sample.ends[whole - 1]) << length;
    EXPECT_EQ(back->report.damage.empty(), sample.ends[whole - 1] == length) << length;
  }
}

TEST(Journal, WithAnyByteDamagedLosesThatEditAndWhatBuildsOnIt) {
  const SampleJournal& sample = sample_journal();
  const ScratchFolder folder(memory_folder());
  for (const char flip : {'\x01', '\xff'}) {
    for (std::size_t at = 0; at < sample.bytes.size(); ++at) {
      std::string bytes = sample.bytes;
      bytes[at] = char(bytes[at] ^ flip);
      const auto path = write_fresh(folder, "flipped.icome", bytes);
      const auto back = read_journal(path, factory());
      ASSERT_TRUE(back) << at << " " << back.error().message;
      const JournalReport& report = back->report;
      ASSERT_FALSE(report.damage.empty()) << at;
      if (at < kJournalHeaderBytes) {
        EXPECT_EQ(hash(back->world), sample.hashes.back()) << at;
        EXPECT_EQ(report.lost_bytes, 0u);
        continue;
      }
      const auto damaged = std::size_t(std::upper_bound(sample.ends.begin(), sample.ends.end(), at) -
                                       sample.ends.begin());  // the part with the byte
      const std::size_t edits = sample.ends.size() - 1;
      // Of the snapshot, no edit needs what is lost.
      EXPECT_EQ(report.edits + report.lost_edits, damaged == 0 ? edits : edits - 1) << at;
      if (damaged == edits) {
        EXPECT_EQ(hash(back->world), sample.hashes[edits - 1]) << at;
      }
      EXPECT_GT(report.lost_bytes, kJournalFrameBytes - 1) << at;
      EXPECT_LE(report.damaged_from, at);
    }
  }
}

TEST(Journal, TellsHowFarItIsAndCanBeStopped) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  World world;
  for (std::uint64_t id = 1; id < 9; ++id) {
    const auto picture = std::make_shared<std::string>(std::string(1000000, 'x'));
    world::applied(world, world::CreateTexture{{id}, {"picture", "image/png", picture}});
  }
  ASSERT_TRUE(write_journal(path, world));
  std::vector<double> parts;
  const auto note = [&](double part) {
    parts.push_back(part);
    return parts.size() < 10;
  };
  ASSERT_TRUE(read_journal(path, factory(), note));
  EXPECT_GT(parts.size(), 3u);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_LE(parts.back(), 1.0);
  EXPECT_FALSE(read_journal(path, factory(), [](double) { return false; }));
}

TEST(Journal, TellsWhatIsNone) {
  const ScratchFolder folder;
  expect_no_journal(folder.write("empty.icome", ""), "is empty");
  expect_no_journal(folder.write("other.icome", "solid ascii"), "is not a design of ICOME");
  expect_no_journal(folder.write("long.icome", std::string(5000, 'x')), "is not a design of ICOME");
  expect_no_journal(folder.write("short.icome", journal_header().substr(0, 9)),
                    "damaged from its first bytes");
  expect_no_journal(folder.path(), "is a folder");
  expect_no_journal(folder.path() / "nowhere.icome", "No such file");
  const auto pipe = folder.path() / "pipe.icome";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const auto read = read_journal(pipe, factory());
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("not an ordinary file"), std::string::npos);
}

TEST(Journal, OfANewerVersionIsLeftAlone) {
  const ScratchFolder folder;
  const auto path = folder.path() / "newer.icome";
  std::string bytes = sample_journal().bytes;
  bytes[8] = 3;
  // The checksum of a header of version 3.
  const unsigned char sum[] = {0x72, 0xed, 0x28, 0x1f};
  for (int i = 0; i < 4; ++i) bytes[12 + i] = char(sum[i]);
  expect_no_journal(folder.write("newer.icome", bytes), "newer version");
}

TEST(Journal, ThatClaimsToBeEnormousTakesNoMemory) {
  const ScratchFolder folder;
  for (const std::uint32_t length : {0xffffffffU, 0x7fffffffU, 0x3ffffff8U}) {
    std::string bytes = sample_journal().bytes.substr(0, sample_journal().ends[2]), record;
    add_journal_record(JournalKind::Edit, 6, std::string(1000, 'x'), record);
    for (std::size_t i = 0; i < 4; ++i) record[4 + i] = char(length >> (8 * i));
    const std::uint32_t sum = lzma_crc32(reinterpret_cast<const std::uint8_t*>(record.data()), 20, 0);
    for (std::size_t i = 0; i < 4; ++i) record[20 + i] = char(sum >> (8 * i));
    for (int i = 0; i < 3; ++i) bytes += record;
    const ReadJournal back = read(folder.write("enormous.icome", bytes));
    EXPECT_EQ(back.report.edits, 2u);
    EXPECT_EQ(back.report.lost_edits, 0u);
    EXPECT_EQ(back.report.lost_bytes, 3 * record.size());
  }
}

/// A journal of these records behind the sample's snapshot and first edits.
std::string with_record(std::size_t edits, JournalKind kind, const std::string& content) {
  std::string bytes = sample_journal().bytes.substr(0, sample_journal().ends[edits]);
  // The snapshot has four records: names, numbers spent, an object and its end.
  add_journal_record(kind, 4 + edits, content, bytes);
  add_journal_record(JournalKind::Edit, 5 + edits, *world::to_bytes(world::CreateScene{{500}, "next"}),
                     bytes);
  return bytes;
}

TEST(Journal, WithAnEditThatTheWorldRefusesGoesOnBehindIt) {
  const ScratchFolder folder;
  const std::string refused = *world::to_bytes(world::DeleteObject{{77}});
  const auto path = folder.write("refused.icome", with_record(3, JournalKind::Edit, refused));
  const ReadJournal back = read(path);
  EXPECT_EQ(back.report.edits, 4u);
  EXPECT_EQ(back.report.lost_edits, 1u);
  ASSERT_EQ(back.report.damage.size(), 1u);
  EXPECT_NE(back.report.damage[0].text.find("not there any more"), std::string::npos);
  EXPECT_EQ(back.world.scenes().size(), 1u);
}

TEST(Journal, WithPartsOutOfOrderGoesOnBehindThem) {
  const ScratchFolder folder;
  const std::string edit = *world::to_bytes(world::CreateScene{{499}, "scene"});
  for (const JournalKind kind : {JournalKind::Snapshot, JournalKind::SnapshotEnd}) {
    const ReadJournal back = read(folder.write("order.icome", with_record(1, kind, edit)));
    EXPECT_EQ(back.report.edits, 2u);
    EXPECT_EQ(back.world.scenes().size(), 1u) << "what is out of order is left out";
    EXPECT_FALSE(back.report.damage.empty());
  }
}

TEST(Journal, WithWhatOnlyOthersKnowIsNotChanged) {
  const ScratchFolder folder;
  const auto path = folder.write("unknown.icome", with_record(2, JournalKind::Edit, "no edit at all"));
  const std::string before = content_of(path);
  const auto opened = JournaledWorld::open(path, factory());
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("Nothing was changed"), std::string::npos) << opened.error().message;
  EXPECT_EQ(content_of(path), before);
  EXPECT_EQ(read(path).report.edits, 3u) << "with the one behind it";
}

TEST(Journal, IsReadWithoutAnyChangeOnDisk) {
  const ScratchFolder folder;
  const auto path = folder.write("cut.icome", sample_journal().bytes.substr(0, sample_journal().ends[3] + 5));
  std::filesystem::permissions(path, std::filesystem::perms::owner_read);
  const std::string before = content_of(path);
  const ReadJournal back = read(path);
  EXPECT_TRUE(back.report.set_aside.empty());
  EXPECT_EQ(content_of(path), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Journal, IsNotWrittenWhereAShapeCannotBe) {
  const ScratchFolder folder;
  const auto path = folder.write("design.icome", sample_journal().bytes);
  World world;
  geometry::TriangleMesh bad = world::tetrahedron();
  bad.triangles[0][0] = 9;
  world::applied(world, world::CreateGeometry{{1}, std::make_shared<world::MeshGeometry>(bad)});
  const auto written = write_journal(path, world);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("vertex that is not there"), std::string::npos);
  EXPECT_EQ(content_of(path), sample_journal().bytes);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Journal, IsNotWrittenOverOneThatIsInUse) {
  const ScratchFolder folder;
  const auto path = folder.path() / "design.icome";
  const JournaledWorld journal = opened(path, {.create = true});
  const auto written = write_journal(path, World());
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find("somebody works with it"), std::string::npos);
  EXPECT_TRUE(read_journal(path, factory()));
}

}  // namespace
}  // namespace icome::files
