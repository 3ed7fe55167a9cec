#include "files/journal/journal_reader.h"

#include <algorithm>

namespace icome::files {
namespace {

constexpr std::size_t kWindow = 1U << 20U;
constexpr std::uint64_t kWord = 8;  // edits are read in place, which must be aligned so

}  // namespace

base::Result<JournalReader> JournalReader::create(const io::OpenFile& file) {
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
  if (const auto skipped = reader.skip_damage(); !skipped) return tl::unexpected(skipped.error());
  const bool has_records = !reader.at_end();
  reader.position_ = reader.number_ = 0;
  if (has_records) return reader;
  if (header == JournalHeader::SomethingElse) return base::fail(name + ": is not a design of ICOME.");
  return base::fail(name + ": is damaged from its first bytes on; nothing of it can be read.");
}

base::Result<std::string_view> JournalReader::view(std::uint64_t offset, std::size_t count) {
  const bool is_there = offset >= window_offset_ && offset + count <= window_offset_ + window_.size();
  if (!is_there || (position_ - window_offset_) % kWord != 0) {
    // Words are aligned to records, which begin anywhere behind bytes that were cut out.
    const std::uint64_t over = (offset - position_ % kWord) % kWord;
    const std::uint64_t start = offset < over ? 0 : offset - over;
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

/// Honest bytes are scanned once or twice; others may pretend that long records begin everywhere.
base::Result<bool> JournalReader::go_on_at(std::uint64_t offset) {
  const auto frame = frame_at(offset);
  if (!frame) return tl::unexpected(frame.error());
  if (!*frame || (*frame)->number < number_) return false;
  const std::uint64_t length = (*frame)->padded_length();
  if (length > work_) return false;
  work_ -= length;
  const auto whole = is_whole(**frame, offset);
  if (!whole || !*whole) return whole;
  position_ = offset;
  number_ = (*frame)->number;
  return true;
}

base::Result<void> JournalReader::skip_damage() {
  // This record may be whole itself, with its predecessors lost.
  const auto here = go_on_at(position_);
  if (!here) return tl::unexpected(here.error());
  if (*here) return {};
  const auto frame = frame_at(position_);
  if (!frame) return tl::unexpected(frame.error());
  // Bytes within a record may look like one, such as a journal stored as a picture: skips it first.
  if (const std::uint64_t left = size_ - position_;
      *frame && (*frame)->padded_length() <= left - kJournalFrameBytes) {
    const auto found = go_on_at(position_ + kJournalFrameBytes + (*frame)->padded_length());
    if (!found) return tl::unexpected(found.error());
    if (*found) return {};
  }
  for (std::uint64_t from = position_ + 1;;) {
    const auto marker = next_marker(from);
    if (!marker) return tl::unexpected(marker.error());
    if (!*marker) break;
    const auto found = go_on_at(**marker);
    if (!found) return tl::unexpected(found.error());
    if (*found) return {};
    from = **marker + 1;
  }
  position_ = size_;
  return {};
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
