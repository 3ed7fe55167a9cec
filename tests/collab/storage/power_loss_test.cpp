// A thousand losses of power while a store is written: what append() returned from must be there, and whole.
#include <cstdio>

#include "collab/storage/power_loss_disk.h"
#include "collab/storage/sample_log.h"
#include "collab/storage/store_care.h"
#include "files/sample_files.h"
#include "memory_place.h"
#include "repeats.h"

namespace icome::collab {
namespace {

constexpr int kParts = 10, kLossesAPart = repeats(100);

/// What a program did with the store when the power failed.
struct BeforeLoss {
  std::uint64_t acknowledged = 0;  // the last edit that append() returned from
  std::uint64_t tried = 0;         // the last edit that it was given
  std::uint64_t snapshot = 0;      // the last that was saved
};

/// Appends, saves snapshots, and closes and opens the store now and then, until the power fails.
class StoreWriter {
 public:
  StoreWriter(const std::filesystem::path& path, std::uint64_t last, base::Random& random)
      : path_(path), random_(random), before_{last, last, 0} {}

  BeforeLoss run() {
    while (write_for_a_while()) continue;
    return before_;
  }

 private:
  /// Opens the store, writes and closes it; false where that failed.
  bool write_for_a_while() {
    // The true time would write other bytes, or the same, in each run.
    auto log = SqliteOpLog::open(path_, [this] { return ++now_; });
    if (!log) return false;
    const auto lease = log->lease("a", "writer", 1000);
    if (!lease) return false;
    for (std::uint64_t left = random_.index(30); left > 0; --left) {
      if (!append(*log, lease->fence)) return false;
      if (random_.index(10) == 0 && !save(*log, lease->fence)) return false;
    }
    return true;
  }

  bool append(SqliteOpLog& log, std::uint64_t fence) {
    const bool is_large = random_.index(20) == 0;  // such that the log of writes is brought into the file
    const std::size_t count = 1 + random_.index(3), size = random_.index(is_large ? 400'000 : 3000);
    before_.tried = before_.acknowledged + count;
    if (append_to(log, "a", before_.acknowledged, fence, sample_entries(before_.acknowledged, count, size)))
      return false;
    before_.acknowledged = before_.tried;
    return true;
  }

  bool save(SqliteOpLog& log, std::uint64_t fence) {
    const std::uint64_t last = before_.acknowledged;
    if (last == 0) return true;
    const Snapshot snapshot{last, sample_edit(last, random_.index(20'000))};
    if (!log.save_snapshot("a", fence, snapshot, last - random_.index(std::min<std::uint64_t>(last, 5))))
      return false;
    before_.snapshot = last;
    return true;
  }

  std::filesystem::path path_;
  base::Random& random_;
  BeforeLoss before_;
  std::int64_t now_ = 0;
};

/// What is lost or wrong in the store after the power came back; empty if nothing.
std::string what_is_lost(const std::filesystem::path& path, const BeforeLoss& before, std::uint64_t& last) {
  auto log = SqliteOpLog::open(path);
  if (!log) return log.error().message;
  const auto row = log->find("a");
  if (!row || !*row) return "the design is gone";
  last = (*row)->sequence;
  if (last < before.acknowledged || last > before.tried)
    return "the last edit is " + std::to_string(last) + ", not " + std::to_string(before.acknowledged);
  if ((*row)->snapshot_sequence < before.snapshot) return "the snapshot is an older one";
  if (const auto findings = check_store(path); !findings || !findings->empty())
    return findings ? findings->front() : findings.error().message;
  const auto entries = log->read_from("a", (*row)->snapshot_sequence, ~std::uint64_t{0});
  if (!entries) return entries.error().message;
  for (const LogEntry& it : *entries)
    if (it.edit != sample_edit(it.sequence, it.edit.size())) return "an edit has other bytes";
  return {};
}

/// Loses power again and again on one store, which is made anew where it was spoilt. Gives how often
/// something was lost.
int losses_found(std::uint64_t seed, int count, double syncs, std::string& example) {
  const files::ScratchFolder folder(memory_place());
  base::Random random(seed);
  std::filesystem::path path;
  std::uint64_t last = 0, acknowledged = 0;
  int found = 0;
  for (int i = 0; i < count; ++i) {
    if (path.empty()) {
      path = folder.path() / (std::to_string(i) + ".sqlite");
      good(good(SqliteOpLog::open(path)).create("a"));
      last = 0;
    }
    BeforeLoss before;
    {
      PowerLossDisk disk({.seed = random.bits(), .steps = random.index(400), .syncs = syncs});
      before = StoreWriter(path, last, random).run();
    }
    acknowledged += before.acknowledged - last;
    const std::string lost = what_is_lost(path, before, last);
    if (lost.empty()) continue;
    ++found;
    example = "seed " + std::to_string(seed) + ", loss " + std::to_string(i) + ": " + lost;
    path.clear();
  }
  std::printf("%d losses of power, %llu edits acknowledged, losses found: %d\n", count,
              static_cast<unsigned long long>(acknowledged), found);
  EXPECT_GT(acknowledged, std::uint64_t(count));
  return found;
}

class PowerLossTest : public testing::TestWithParam<int> {};

TEST_P(PowerLossTest, LosesNothingThatWasAcknowledged) {
  std::string example;
  EXPECT_EQ(losses_found(std::uint64_t(GetParam()), kLossesAPart, 1.0, example), 0) << example;
}

INSTANTIATE_TEST_SUITE_P(Parts, PowerLossTest, testing::Range(1, kParts + 1));

// The test of the test: on a disk that does not sync, as with synchronous=OFF, or leaves out a few syncs, it
// must find losses.
TEST(PowerLossDiskTest, FindsLossesWhereSyncsAreLeftOut) {
  std::string example;
  EXPECT_GT(losses_found(100, 20, 0.0, example), 10) << example;
  EXPECT_GT(losses_found(200, 50, 0.9, example), 0) << example;
  std::printf("such as %s\n", example.c_str());
}

}  // namespace
}  // namespace icome::collab
