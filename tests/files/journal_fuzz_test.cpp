// Damaged journals must give the edits before the damage or be refused, never crash or take memory and time
// beyond their size. The sanitizer presets run this too.
#include "damage.h"
#include "files/journal_format.h"
#include "sample_journals.h"

namespace icome::files {
namespace {

#if defined(__SANITIZE_ADDRESS__)
constexpr int kDamagedJournals = 500;
#else
constexpr int kDamagedJournals = 3000;
#endif

constexpr std::array<std::string_view, 6> kNastyBytes{"\x8aRE", "\x8aREE",       "\xff\xff\xff\xff",
                                                      "EDIT",   "\x89ICOME\r\n", "----------------------"};

/// The contents of the records of a whole journal.
std::vector<std::string> contents_of(std::string_view bytes) {
  std::vector<std::string> result;
  for (std::size_t at = kJournalHeaderBytes; at < bytes.size();) {
    const auto frame = read_journal_frame(bytes.substr(at, kJournalFrameBytes));
    if (!frame) throw std::runtime_error("The sample is no journal.");
    result.emplace_back(bytes.substr(at + kJournalFrameBytes, frame->length));
    at += kJournalFrameBytes + frame->padded_length();
  }
  return result;
}

TEST(JournalFuzz, BytesThatAreDamagedGiveTheEditsBeforeThat) {
  const SampleJournal& sample = sample_journal();
  const ScratchFolder folder(memory_folder());
  base::Random random(11);
  for (int i = 0; i < kDamagedJournals; ++i) {
    const std::string bytes = damaged(sample.bytes, kNastyBytes, random);
    const auto path = write_fresh(folder, "damaged.icome", bytes);
    const auto back = read_journal(path, factory());
    if (!back) {
      EXPECT_FALSE(back.error().message.empty());
      continue;
    }
    const bool told = bytes == sample.bytes || !back->report.damage.empty();
    EXPECT_TRUE(told || bytes.size() < sample.bytes.size()) << i;  // cut off between edits
    if (back->report.snapshot_bytes + kJournalHeaderBytes == sample.ends[0]) {
      ASSERT_LT(back->report.edits, sample.hashes.size());
      EXPECT_EQ(hash(back->world), sample.hashes[back->report.edits]) << i;
    }
    if (i % 5 != 0) continue;
    const std::uint64_t read_hash = hash(back->world);
    {
      JournaledWorld journal = opened(path);
      EXPECT_EQ(hash(journal.world()), read_hash);
    }
    EXPECT_TRUE(read(path).report.damage.empty());
    std::filesystem::remove(path.string() + ".lost");
  }
}

TEST(JournalFuzz, EditsThatAreHostileBehindGoodChecksumsAreReadOrRefused) {
  const std::vector<std::string> contents = contents_of(sample_journal().bytes);
  const ScratchFolder folder(memory_folder());
  base::Random random(12);
  for (int i = 0; i < kDamagedJournals; ++i) {
    std::string bytes = journal_header();
    std::uint64_t number = 0;
    const std::size_t victim = random.index(contents.size());
    for (const std::string& content : contents) {
      const JournalKind kind = content.empty() ? JournalKind::SnapshotEnd
                               : number == 0   ? JournalKind::Snapshot
                                               : JournalKind::Edit;
      const bool hit = number == victim && !content.empty();
      add_journal_record(kind, number++, hit ? damaged(content, kNastyBytes, random) : content, bytes);
    }
    const auto path = write_fresh(folder, "hostile.icome", bytes);
    const ReadJournal back = read(path);
    (void)hash(back.world);
    for (const auto& [id, geometry] : back.world.geometries()) (void)geometry.shape->bounds();
    EXPECT_EQ(back.report.damage.empty(), back.report.lost_bytes == 0);
  }
}

}  // namespace
}  // namespace icome::files
