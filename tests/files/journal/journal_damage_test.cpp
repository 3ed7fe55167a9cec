// What is left of a journal when a part of its bytes is damaged: all but what the damaged record held.
#include "files/design_files.h"
#include "files/journal/file_stamp.h"
#include "files/journal/journal_format.h"
#include "files/sample_journals.h"

namespace icome::files {
namespace {

using world::CreateGeometry;
using world::CreateMaterial;
using world::CreateObject;
using world::GeometryId;
using world::IdSource;
using world::MaterialId;
using world::ObjectId;
using world::World;

#ifdef ICOME_ADDRESS_SANITIZER
constexpr std::size_t kStride = 11;  // of the places that are tried, bytes
#else
constexpr std::size_t kStride = 1;
#endif

/// A world of groups, shapes and materials, another for each seed, and of some with edits behind.
std::string design_bytes(std::uint64_t seed, const ScratchFolder& folder) {
  base::Random random(seed);
  IdSource ids;
  World world;
  std::vector<GeometryId> shapes;
  std::vector<MaterialId> materials;
  std::vector<ObjectId> objects;
  for (std::uint64_t i = 0; i < 2 + seed % 3; ++i) {
    shapes.push_back(ids.next<GeometryId>());
    world::applied(world, CreateGeometry{shapes.back(), world::box(1.0 + double(i))});
    materials.push_back(ids.next<MaterialId>());
    world::applied(world, CreateMaterial{materials.back(), {.name = "paint " + std::to_string(i)}});
  }
  for (int i = 0; i < 8; ++i) {
    world::PhysicalObject object{.name = "thing " + std::to_string(i)};
    if (!objects.empty() && random.index(2) == 0) object.parent = objects[random.index(objects.size())];
    object.geometry = shapes[random.index(shapes.size())];
    object.material = materials[random.index(materials.size())];
    objects.push_back(ids.next<ObjectId>());
    world::applied(world, CreateObject{objects.back(), 0, object});
  }
  const auto path = folder.path() / "design.icome";
  std::filesystem::remove(path);
  EXPECT_TRUE(write_journal(path, world));
  if (seed % 2 == 0) {
    JournaledWorld journal = opened(path);
    for (int i = 0; i < 4; ++i)
      performed(journal, CreateObject{ids.next<ObjectId>(), 0, {.name = "later " + std::to_string(i)}});
  }
  return content_of(path);
}

/// How many objects a damaged journal gives; what is missing is told.
std::size_t objects_left(const ScratchFolder& folder, const std::string& bytes) {
  const auto back = read_journal(write_fresh(folder, "damaged.icome", bytes), factory());
  if (!back) return 0;
  EXPECT_FALSE(back->report.damage.empty());
  return back->world.objects().size();
}

TEST(JournalDamage, AnyByteThatIsFlippedOrCutOutTakesTheObjectOfOneRecordAtMost) {
  const ScratchFolder folder(memory_folder());
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::string whole = design_bytes(seed, folder);
    const std::size_t objects = read(folder.path() / "design.icome").world.objects().size();
    for (std::size_t at = seed % kStride; at < whole.size(); at += kStride) {
      std::string flipped = whole;
      flipped[at] = char(flipped[at] ^ (1 << (at % 8)));
      ASSERT_GE(objects_left(folder, flipped) + 1, objects) << "seed " << seed << ", flipped " << at;
      std::string shorter = whole;
      shorter.erase(at, 1);
      ASSERT_GE(objects_left(folder, shorter) + 1, objects) << "seed " << seed << ", cut out " << at;
    }
  }
}

/// The content lies at a multiple of eight bytes, as edits are read where they lie.
bool makes_object(const JournalFrame& frame, const std::string& content) {
  if (frame.kind != JournalKind::Snapshot && frame.kind != JournalKind::Edit) return false;
  const auto edit = world::edit_from_bytes(content, factory());
  return edit && std::holds_alternative<CreateObject>(edit->what);
}

TEST(JournalDamage, CutOffAnywhereLeavesEveryRecordBefore) {
  const ScratchFolder folder(memory_folder());
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const std::string whole = design_bytes(seed, folder);
    std::size_t objects = 0, end = kJournalHeaderBytes;  // of the whole records before
    for (std::size_t length = kJournalHeaderBytes; length < whole.size(); ++length) {
      const auto frame = read_journal_frame(std::string_view(whole).substr(end, kJournalFrameBytes));
      ASSERT_TRUE(frame);
      if (length == end + kJournalFrameBytes + frame->padded_length()) {
        const auto content = std::string_view(whole).substr(end + kJournalFrameBytes, frame->length);
        objects += makes_object(*frame, std::string(content)) ? 1 : 0;
        end = length;
      }
      const auto back = read_journal(write_fresh(folder, "cut.icome", whole.substr(0, length)), factory());
      ASSERT_TRUE(back) << back.error().message;
      ASSERT_EQ(back->world.objects().size(), objects) << "seed " << seed << ", cut off at " << length;
    }
  }
}

/// A table with a leg of a shape and paint of its own.
struct TableJournal {
  ScratchFolder folder;
  std::string bytes;

  TableJournal() {
    World world;
    world::applied(world, CreateGeometry{{1}, world::box(1.0)});
    world::applied(world, CreateMaterial{{2}, {.name = "oak"}});
    world::applied(world, CreateObject{{3}, 0, {.name = "table"}});
    world::applied(world,
                   CreateObject{{4}, 0, {.name = "leg", .parent = {3}, .geometry = {1}, .material = {2}}});
    EXPECT_TRUE(write_journal(folder.path() / "table.icome", world));
    bytes = content_of(folder.path() / "table.icome");
  }
  /// With one byte of a record damaged. Records: names, numbers spent, material, shape, table, leg, end.
  std::filesystem::path without(std::size_t record) const {
    std::size_t at = kJournalHeaderBytes;
    for (std::size_t i = 0; i < record; ++i)
      at += kJournalFrameBytes +
            read_journal_frame(std::string_view(bytes).substr(at, kJournalFrameBytes))->padded_length();
    std::string damaged = bytes;
    damaged[at + kJournalFrameBytes] = char(damaged[at + kJournalFrameBytes] ^ 1);
    return folder.write("damaged.icome", damaged);
  }
};

bool is_told(const std::vector<Remark>& remarks, const std::string& text) {
  return std::any_of(remarks.begin(), remarks.end(),
                     [&](const Remark& it) { return it.text.find(text) != std::string::npos; });
}

TEST(JournalDamage, TellsByNameWhatHasLostItsParentShapeOrMaterial) {
  const TableJournal table;
  const ReadJournal no_material = read(table.without(2));
  EXPECT_TRUE(is_told(no_material.report.damage, "The object \"leg\" has lost its material."));
  const ReadJournal no_shape = read(table.without(3));
  EXPECT_TRUE(is_told(no_shape.report.damage, "The object \"leg\" has lost its shape."));
  EXPECT_EQ(no_shape.world.objects().size(), 2u);
  const ReadJournal no_parent = read(table.without(4));
  EXPECT_TRUE(
      is_told(no_parent.report.damage,
              "The object \"leg\" has lost \"table\", which it was a part of, and stands at the top now."));
  EXPECT_TRUE(is_told(no_parent.report.damage, "The object \"table\" is lost."));
  ASSERT_EQ(no_parent.world.roots().size(), 1u);
  EXPECT_EQ(no_parent.world.find(ObjectId{4})->geometry, GeometryId{1});
}

TEST(JournalDamage, OfNamesAloneLosesNothing) {
  const TableJournal table;
  const ReadJournal back = read(table.without(0));
  EXPECT_EQ(hash(back.world), hash(read(table.folder.path() / "table.icome").world));
  EXPECT_FALSE(back.report.damage.empty());
}

/// As version 1 wrote a design: no names, and all in one group.
TEST(JournalDamage, JournalsOfVersion1AreRead) {
  std::string bytes = journal_header();
  bytes[8] = 1;
  const unsigned char sum[] = {0xf9, 0x25, 0x21, 0xb5};
  for (int i = 0; i < 4; ++i) bytes[12 + std::size_t(i)] = char(sum[i]);
  world::EditGroup group;
  group.edits.emplace_back(CreateObject{{1}, 0, {.name = "table"}});
  group.edits.emplace_back(CreateObject{{2}, 0, {.name = "leg", .parent = {1}}});
  add_journal_record(JournalKind::Snapshot, 0, *world::to_bytes(group), bytes);
  add_journal_record(JournalKind::SnapshotEnd, 1, {}, bytes);
  add_journal_record(JournalKind::Edit, 2, *world::to_bytes(world::RenameObject{{2}, "foot"}), bytes);
  const ScratchFolder folder;
  const auto path = folder.write("old.icome", bytes);
  const ReadJournal back = read(path);
  EXPECT_TRUE(back.report.damage.empty()) << back.report.damage.front().text;
  EXPECT_EQ(back.world.find(ObjectId{2})->name, "foot");
  {
    JournaledWorld journal = opened(path);
    performed(journal, world::RenameObject{{1}, "desk"});
  }
  EXPECT_EQ(read(path).world.find(ObjectId{1})->name, "desk");
  EXPECT_TRUE(read(path).report.damage.empty());
}

TEST(JournalDamage, OpeningADesignKeepsWhatIsLostOnce) {
  const TableJournal table;
  const auto path = table.without(4);
  const std::string before = content_of(path);
  for (int i = 0; i < 3; ++i) {
    const auto design = read_design(path);
    ASSERT_TRUE(design) << design.error().message;
    EXPECT_TRUE(is_told(design->remarks, "damaged.icome.lost"));
  }
  EXPECT_EQ(content_of(path), before);
  const std::string lost = content_of(path.string() + ".lost");
  EXPECT_FALSE(lost.empty());
  EXPECT_TRUE(before.ends_with(lost));
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".lost-2"));
}

TEST(JournalDamage, IsAReasonNotToReplaceAFile) {
  const TableJournal table;
  EXPECT_FALSE(why_not_replace(table.folder.path() / "table.icome", std::nullopt));
  EXPECT_FALSE(why_not_replace(table.folder.path() / "none.icome", std::nullopt));
  for (std::size_t record = 0; record < 6; ++record) {
    const auto why = why_not_replace(table.without(record), std::nullopt);
    ASSERT_TRUE(why) << record;
    EXPECT_NE(why->find("damaged.icome: this file is damaged"), std::string::npos) << *why;
  }
  for (const std::size_t less : {1U, 24U, 100U})
    EXPECT_TRUE(why_not_replace(
        table.folder.write("cut.icome", std::string_view(table.bytes).substr(0, table.bytes.size() - less)),
        std::nullopt));
  EXPECT_TRUE(why_not_replace(table.folder.write("text.icome", "somebody's notes"), std::nullopt));
}

TEST(FileStamp, TellsThatAnotherProgramChangedAFile) {
  const ScratchFolder folder;
  const auto path = folder.write("a.obj", "v 0 0 0\n");
  const auto seen = stamp_of(path);
  ASSERT_TRUE(seen);
  EXPECT_FALSE(why_not_replace(path, seen));
  folder.write("a.obj", "v 0 0 1\nv 0 0 2\n");
  const auto why = why_not_replace(path, seen);
  ASSERT_TRUE(why);
  EXPECT_NE(why->find("another program has changed this file"), std::string::npos);
  std::filesystem::remove(path);
  EXPECT_FALSE(why_not_replace(path, seen)) << "there is nothing to lose";
  EXPECT_FALSE(stamp_of(folder.path()));
}

}  // namespace
}  // namespace icome::files
