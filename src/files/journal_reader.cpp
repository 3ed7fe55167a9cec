#include "files/journal_reader.h"

#include <algorithm>

namespace icome::files {
namespace {

constexpr std::size_t kWindow = 1U << 20U;
constexpr std::uint64_t kWord = 8;  // edits are read where they lie, which must be at such a place

}  // namespace

base::Result<JournalReader> JournalReader::create(const OpenFile& file) {
  const auto size = file.size();
  if (!size) return tl::unexpected(size.error());
  const std::string name = file.path().string();
  if (*size == 0) return base::fail(name + ": is empty, not a design of ICOME.");
  JournalReader reader(file, *size);
  const auto bytes = reader.view(0, std::min<std::uint64_t>(*size, kJournalHeaderBytes));
  if (!bytes) return tl::unexpected(bytes.error());
  const JournalHeader header = judge_journal_header(*bytes);
  if (header == JournalHeader::Newer)
    return base::fail(name + ": was written by a newer version of ICOME: open it with that.");
  if (header == JournalHeader::Good) return reader;
  const auto first = reader.frame_at(kJournalHeaderBytes);
  if (!first) return tl::unexpected(first.error());
  reader.header_is_good_ = false;
  if (*first && (*first)->number == 0) return reader;
  if (header == JournalHeader::SomethingElse) return base::fail(name + ": is not a design of ICOME.");
  return base::fail(name + ": is damaged from its first bytes on; nothing of it can be read.");
}

base::Result<std::string_view> JournalReader::view(std::uint64_t offset, std::size_t count) {
  if (offset < window_offset_ || offset + count > window_offset_ + window_.size()) {
    const std::uint64_t start = offset / kWord * kWord;
    const std::uint64_t least = offset + count - start;
    window_offset_ = start;
    window_.resize(std::min(size_ - start, std::max<std::uint64_t>(least, kWindow)));
    if (const auto good = file_->read(start, window_.data(), window_.size()); !good) {
      window_.clear();
      return tl::unexpected(good.error());
    }
  }
  return std::string_view(window_).substr(offset - window_offset_, count);
}

base::Result<std::optional<JournalFrame>> JournalReader::frame_at(std::uint64_t offset) {
  if (size_ < kJournalFrameBytes || offset > size_ - kJournalFrameBytes) return std::nullopt;
  const auto bytes = view(offset, kJournalFrameBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  return read_journal_frame(*bytes);
}

base::Result<bool> JournalReader::is_whole(const JournalFrame& frame, std::uint64_t offset) {
  const std::uint64_t start = offset + kJournalFrameBytes;
  if (frame.padded_length() > size_ - start) return false;
  const auto content = view(start, frame.padded_length());
  if (!content) return tl::unexpected(content.error());
  return frame.fits(*content);
}

base::Result<std::optional<JournalReader::Record>> JournalReader::next() {
  const auto frame = frame_at(position_);
  if (!frame) return tl::unexpected(frame.error());
  if (!*frame || (*frame)->number != number_) return std::nullopt;
  const auto whole = is_whole(**frame, position_);
  if (!whole) return tl::unexpected(whole.error());
  if (!*whole) return std::nullopt;
  const auto content = view(position_ + kJournalFrameBytes, (*frame)->length);
  if (!content) return tl::unexpected(content.error());
  const Record record{(*frame)->kind, *content, kJournalFrameBytes + (*frame)->padded_length()};
  position_ += record.bytes;
  ++number_;
  return record;
}

base::Result<bool> JournalReader::is_cut_off() {
  if (at_end()) return false;
  const std::uint64_t left = size_ - position_;
  if (left < kJournalFrameBytes) {
    const auto bytes = view(position_, std::min<std::size_t>(left, kJournalMarker.size()));
    if (!bytes) return tl::unexpected(bytes.error());
    return kJournalMarker.starts_with(*bytes);
  }
  const auto frame = frame_at(position_);
  if (!frame) return tl::unexpected(frame.error());
  return *frame && (*frame)->number == number_ && (*frame)->padded_length() > left - kJournalFrameBytes;
}

base::Result<std::uint64_t> JournalReader::whole_edits_behind(std::uint64_t from) {
  std::uint64_t count = 0;
  // Honest bytes are looked at once; others may pretend that very many long records begin everywhere.
  std::uint64_t work = 4 * (size_ - from);
  while (true) {
    const auto found = next_marker(from);
    if (!found) return tl::unexpected(found.error());
    if (!*found) return count;
    from = **found;
    const auto frame = frame_at(from);
    if (!frame) return tl::unexpected(frame.error());
    const std::uint64_t length = *frame ? (*frame)->padded_length() : 0;
    if (length > work) return count;
    work -= length;
    const auto whole = *frame ? is_whole(**frame, from) : base::Result<bool>(false);
    if (!whole) return tl::unexpected(whole.error());
    count += *whole && (*frame)->kind != JournalKind::SnapshotEnd ? 1 : 0;
    from += *whole ? kJournalFrameBytes + length : 1;
  }
}

base::Result<std::optional<std::uint64_t>> JournalReader::next_marker(std::uint64_t from) {
  while (from + kJournalFrameBytes <= size_) {
    const auto bytes = view(from, std::min<std::uint64_t>(kWindow / 2, size_ - from));
    if (!bytes) return tl::unexpected(bytes.error());
    if (const std::size_t found = bytes->find(kJournalMarker); found != bytes->npos) return from + found;
    from += bytes->size() - kJournalMarker.size() + 1;
  }
  return std::nullopt;
}

}  // namespace icome::files
