#include "files/journal/journal_replay.h"

#include <fmt/format.h>

#include <algorithm>

#include "files/journal/journal_mending.h"

namespace icome::files {
namespace {

std::string without_full_stop(std::string sentence) {
  if (sentence.ends_with('.')) sentence.pop_back();
  return sentence;
}

/// Replays all records that are whole and that the world accepts.
class JournalReplay {
 public:
  JournalReplay(JournalReader& reader, const world::GeometryFactory& factory, const JournalProgress& progress,
                io::MemoryBudget* memory)
      : reader_(reader), factory_(factory), progress_(progress), memory_(memory) {}

  base::Result<ReplayedJournal> run() {
    result_.report.bytes = result_.report.damaged_from = reader_.size();
    if (!reader_.header_is_good()) result_.fault = JournalFault::Header;
    while (!reader_.at_end()) {
      const std::uint64_t start = reader_.position();
      const auto record = reader_.next();
      if (!record) return tl::unexpected(record.error());
      if (*record) {
        take(**record, start);
      } else if (const auto skipped = skip(start); !skipped) {
        return tl::unexpected(skipped.error());
      }
      look_at_times();
      if (memory_ && memory_->is_exceeded()) return base::fail(memory_->problem().message);
      if (stopped_) return base::fail("interrupted");
    }
    if (!has_snapshot_) {
      result_.fault = std::max(result_.fault, JournalFault::Unfinished);
      mending_.compare(names_);
    }
    result_.report.is_torn = result_.fault == JournalFault::CutOff;
    tell();
    return std::move(result_);
  }

 private:
  /// May it go on and take so many bytes more? Reports progress now and then, also in long records.
  bool permits(std::size_t bytes) {
    constexpr std::uint32_t kAsksForOneLook = 64;
    if (memory_ && !memory_->take(bytes)) return false;
    if (asked_++ % kAsksForOneLook == 0 || bytes == 0) look();
    return !stopped_;
  }

  /// Reports progress between records, however few there are.
  void look_at_times() {
    constexpr std::uint64_t kPiece = 1U << 20U;  // bytes between two looks
    if (reader_.position() < told_ + kPiece) return;
    told_ = reader_.position();
    look();
  }

  void look() {
    if (progress_ && !stopped_) stopped_ = !progress_(double(reader_.position()) / double(reader_.size()));
  }

  /// Skips bytes that are no whole record.
  base::Result<void> skip(std::uint64_t start) {
    const auto cut_off = reader_.is_cut_off();
    if (!cut_off) return tl::unexpected(cut_off.error());
    if (const auto skipped = reader_.skip_damage(); !skipped) return skipped;
    const bool all_else_is_good = has_snapshot_ && result_.fault == JournalFault::None;
    // A record cut off by a stop of the program has nothing behind it in a journal.
    const bool torn = *cut_off && reader_.at_end();
    lose(torn && all_else_is_good ? JournalFault::CutOff : JournalFault::Damaged, start,
         reader_.position() - start,
         torn ? "it ends there within an edit" : "its bytes are not what was written");
    return {};
  }

  void take(const JournalReader::Record& record, std::uint64_t start) {
    const bool in_snapshot = record.kind != JournalKind::Edit;
    if (in_snapshot && has_snapshot_) {
      lose(JournalFault::Damaged, start, record.bytes, "its parts are out of order");
      return;
    }
    // If a damage took the end of the snapshot, this order is expected.
    if (!in_snapshot && !has_snapshot_ && places_ == 0)
      lose(JournalFault::Damaged, start, 0, "its parts are out of order");
    if (!has_snapshot_ && (!in_snapshot || record.kind == JournalKind::SnapshotEnd)) end_snapshot();
    if (record.kind == JournalKind::Contents) {
      names_ = journal_names_from_bytes(record.content);
    } else if (record.kind != JournalKind::SnapshotEnd && !perform(record, start)) {
      return;
    }
    (in_snapshot ? result_.report.snapshot_bytes : result_.report.edit_bytes) += record.bytes;
    result_.report.edits += in_snapshot ? 0 : 1;
    ++result_.records;
  }

  void end_snapshot() {
    has_snapshot_ = true;
    if (places_ > 0) mending_.compare(names_);
  }

  /// False for a record that could not be applied, not even in part.
  bool perform(const JournalReader::Record& record, std::uint64_t start) {
    const auto edit = world::edit_from_bytes(record.content, factory_, permit_);
    if (!edit) {
      lose(JournalFault::Unknown, start, record.bytes, edit.error().message);
      return false;
    }
    const auto done = world::replay(result_.world, *edit, permit_);
    if (done) return true;
    const auto refused = mending_.perform(*edit);
    if (!refused && places_ > 0) return true;
    lose(JournalFault::Refused, start, refused ? record.bytes : 0, done.error().message);
    result_.report.lost_edits += refused ? 1 : 0;
    return !refused;
  }

  void lose(JournalFault fault, std::uint64_t start, std::uint64_t bytes, std::string why) {
    JournalReport& report = result_.report;
    result_.fault = std::max(result_.fault, fault);
    report.lost_bytes += bytes;
    ++places_;
    if (start >= report.damaged_from) return;
    report.damaged_from = start;
    why_ = without_full_stop(std::move(why));
  }

  void tell() {
    JournalReport& report = result_.report;
    const auto add = [&](std::string text) { report.damage.push_back({{}, 0, std::move(text)}); };
    if (!reader_.header_is_good()) add("Its first bytes are damaged; what follows them is not lost.");
    if (result_.fault == JournalFault::CutOff) {
      add(
          fmt::format("The last edit was cut off while it was written, so its {} bytes from byte {} on are "
                      "lost; {} edits before that are kept.",
                      report.lost_bytes, report.damaged_from, report.edits));
    } else if (places_ > 0) {
      add(fmt::format(
          "It is damaged from byte {} on ({}){}: {} bytes are lost, among them {} whole edits; what is "
          "whole before and behind is kept.",
          report.damaged_from, why_, places_ > 1 ? fmt::format(", at {} places", places_) : std::string(),
          report.lost_bytes, report.lost_edits));
    }
    if (!has_snapshot_) add("Its end is missing: there may have been more than what is kept.");
    for (Remark& it : mending_.remarks()) report.damage.push_back(std::move(it));
  }

  JournalReader& reader_;
  const world::GeometryFactory& factory_;
  const JournalProgress& progress_;
  io::MemoryBudget* memory_;  // null: unlimited
  std::uint32_t asked_ = 0;
  std::uint64_t told_ = 0;  // position at the last report of progress, bytes
  bool stopped_ = false;
  const world::Permit permit_ = [this](std::size_t bytes) { return permits(bytes); };
  ReplayedJournal result_;
  JournalMending mending_{result_.world, permit_};
  JournalNames names_;
  bool has_snapshot_ = false;
  std::size_t places_ = 0;  // number of damaged places
  std::string why_;         // reason of the first one
};

}  // namespace

base::Result<ReplayedJournal> replay_journal(const io::OpenFile& file, const world::GeometryFactory& factory,
                                             const JournalProgress& progress, io::MemoryBudget* memory) {
  auto reader = JournalReader::create(file);
  if (!reader) return tl::unexpected(reader.error());
  return JournalReplay(*reader, factory, progress, memory).run();
}

}  // namespace icome::files
