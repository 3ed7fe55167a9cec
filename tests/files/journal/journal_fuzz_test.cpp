// Damaged journals must give what is whole or be refused, never crash or take memory and time
// beyond their size. The sanitizer presets run this too.
#include "files/damage.h"
#include "files/journal/journal_format.h"
#include "files/sample_journals.h"

namespace icome::files {
namespace {

#ifdef ICOME_ADDRESS_SANITIZER
constexpr int kDamagedJournals = 500;
#else
constexpr int kDamagedJournals = 3000;
#endif

constexpr std::array<std::string_view, 6> kNastyBytes{"\x8aRE", "\x8aREE",       "\xff\xff\xff\xff",
                                                      "EDIT",   "\x89ICOME\r\n", "----------------------"};

/// The kinds and contents of the records of a whole journal.
std::vector<std::pair<JournalKind, std::string>> records_of(std::string_view bytes) {
  std::vector<std::pair<JournalKind, std::string>> result;
  for (std::size_t at = kJournalHeaderBytes; at < bytes.size();) {
    const auto frame = read_journal_frame(bytes.substr(at, kJournalFrameBytes));
    if (!frame) throw std::runtime_error("The sample is no journal.");
    result.emplace_back(frame->kind, bytes.substr(at + kJournalFrameBytes, frame->length));
    at += kJournalFrameBytes + frame->padded_length();
  }
  return result;
}

TEST(JournalFuzz, BytesThatAreDamagedAreToldAndMended) {
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
    const bool is_beginning = back->report.damage.empty() || back->report.is_torn;
    if (is_beginning && back->report.snapshot_bytes + kJournalHeaderBytes == sample.ends[0]) {
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
  const auto records = records_of(sample_journal().bytes);
  const ScratchFolder folder(memory_folder());
  base::Random random(12);
  for (int i = 0; i < kDamagedJournals; ++i) {
    std::string bytes = journal_header();
    std::uint64_t number = 0;
    const std::size_t victim = random.index(records.size());
    for (const auto& [kind, content] : records) {
      const bool hit = number == victim && !content.empty();
      add_journal_record(kind, number++, hit ? damaged(content, kNastyBytes, random) : content, bytes);
    }
    const auto path = write_fresh(folder, "hostile.icome", bytes);
    const ReadJournal back = read(path);
    (void)hash(back.world);
    for (const auto& [id, geometry] : back.world.geometries()) (void)geometry.shape->bounds();
    EXPECT_TRUE(back.report.lost_bytes == 0 || !back.report.damage.empty());
  }
}

}  // namespace
}  // namespace icome::files
