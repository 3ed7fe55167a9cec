#include "files/journal_replay.h"

#include <fmt/format.h>

namespace icome::files {
namespace {

/// Replays records until the end or the first that cannot be.
class JournalReplay {
 public:
  JournalReplay(JournalReader& reader, const world::GeometryFactory& factory, const JournalProgress& progress)
      : reader_(reader), factory_(factory), progress_(progress) {}

  base::Result<ReplayedJournal> run() {
    if (!reader_.header_is_good()) result_.fault = JournalFault::Header;
    bool more = true;
    while (more) {
      result_.end = reader_.position();
      const auto record = reader_.next();
      if (!record) return tl::unexpected(record.error());
      more = *record && take(**record);
      if (!go_on()) return base::fail("interrupted");
    }
    const auto judged = judge_end();
    if (!judged) return tl::unexpected(judged.error());
    return std::move(result_);
  }

 private:
  bool go_on() {
    constexpr std::uint64_t kPiece = 1U << 20U;  // bytes between two calls
    if (!progress_ || reader_.position() < told_ + kPiece) return true;
    told_ = reader_.position();
    return progress_(double(told_) / double(reader_.size()));
  }

  /// Gives false for what cannot be replayed.
  bool take(const JournalReader::Record& record) {
    const bool in_snapshot = record.kind != JournalKind::Edit;
    if (in_snapshot == has_snapshot_) return stop(JournalFault::Damaged, "its parts are out of order");
    if (record.kind == JournalKind::SnapshotEnd) {
      has_snapshot_ = true;
    } else {
      const auto edit = world::edit_from_bytes(record.content, factory_);
      if (!edit) return stop(JournalFault::Unknown, edit.error().message);
      if (const auto done = world::replay(result_.world, *edit); !done)
        return stop(JournalFault::Refused, done.error().message);
    }
    (in_snapshot ? result_.report.snapshot_bytes : result_.report.edit_bytes) += record.bytes;
    result_.report.edits += in_snapshot ? 0 : 1;
    ++result_.records;
    return true;
  }

  bool stop(JournalFault fault, std::string why) {
    result_.fault = fault;
    why_ = std::move(why);
    return false;
  }

  base::Result<void> judge_end() {
    JournalReport& report = result_.report;
    report.bytes = reader_.size();
    report.lost_bytes = reader_.size() - result_.end;
    if (why_.empty() && report.lost_bytes > 0) {
      const auto cut_off = reader_.is_cut_off();
      if (!cut_off) return tl::unexpected(cut_off.error());
      const bool all_else_is_good = has_snapshot_ && reader_.header_is_good();
      stop(*cut_off && all_else_is_good ? JournalFault::CutOff : JournalFault::Damaged,
           *cut_off ? "it ends there within an edit" : "its bytes are not what was written");
    }
    if (report.lost_bytes == 0 && !has_snapshot_) result_.fault = JournalFault::Unfinished;
    if (report.lost_bytes > 0) {
      const auto behind = reader_.whole_edits_behind(result_.end);
      if (!behind) return tl::unexpected(behind.error());
      report.lost_edits = *behind;
      // What follows a record that was cut off is no journal that was only ever added to.
      if (*behind > 0 && result_.fault == JournalFault::CutOff)
        stop(JournalFault::Damaged, "its bytes are not what was written");
    }
    tell();
    return {};
  }

  void tell() {
    const JournalReport& report = result_.report;
    const auto add = [&](std::string text) { result_.report.damage.push_back({{}, 0, std::move(text)}); };
    if (!reader_.header_is_good()) add("Its first bytes are damaged; what follows them is not lost.");
    const std::string kept = has_snapshot_ ? fmt::format("{} edits before that are kept", report.edits)
                                           : std::string("only a part of the design before that is kept");
    switch (result_.fault) {
      case JournalFault::None:
      case JournalFault::Header:
        break;
      case JournalFault::CutOff:
        add(
            fmt::format("The last edit was cut off while it was written, so its {} bytes from byte {} on are "
                        "lost; {}.",
                        report.lost_bytes, result_.end, kept));
        break;
      case JournalFault::Unfinished:
        add("It ends before the whole design was written; only a part of it is kept.");
        break;
      case JournalFault::Damaged:
      case JournalFault::Refused:
      case JournalFault::Unknown:
        add(
            fmt::format("It is damaged from byte {} on ({}); {}, the {} bytes behind are lost, among them {} "
                        "whole edits.",
                        result_.end, without_full_stop(why_), kept, report.lost_bytes, report.lost_edits));
    }
  }

  static std::string without_full_stop(std::string sentence) {
    if (sentence.ends_with('.')) sentence.pop_back();
    return sentence;
  }

  JournalReader& reader_;
  const world::GeometryFactory& factory_;
  const JournalProgress& progress_;
  std::uint64_t told_ = 0;  // how far progress was told, bytes
  ReplayedJournal result_;
  bool has_snapshot_ = false;
  std::string why_;
};

}  // namespace

base::Result<ReplayedJournal> replay_journal(const OpenFile& file, const world::GeometryFactory& factory,
                                             const JournalProgress& progress) {
  auto reader = JournalReader::create(file);
  if (!reader) return tl::unexpected(reader.error());
  return JournalReplay(*reader, factory, progress).run();
}

}  // namespace icome::files
