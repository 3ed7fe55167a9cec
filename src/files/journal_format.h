#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace icome::files {

// The bytes of a journal (.icome): a header, then records one after the other. All numbers little-endian.
//
//   header   "\x89ICOME\r\n", version (u32), CRC-32 of these 12 bytes
//   record   "\x8aRE" and a letter for the kind, length of the content (u32), number of the record (u64,
//            from 0), CRC-32 of content and padding, CRC-32 of these 20 bytes; the content; zeros up to a
//            multiple of 8
//
// The first records make the world as it was when the file was written (kinds 'S', then one 'N' to say that
// this is all), the others ('E') are what was done since, in order. The content of 'S' and 'E' is an edit
// (world::to_bytes); 'N' has none.

inline constexpr std::uint32_t kJournalVersion = 1;
inline constexpr std::size_t kJournalHeaderBytes = 16;
inline constexpr std::size_t kJournalFrameBytes = 24;  // of a record before its content
inline constexpr std::string_view kJournalMarker = "\x8aRE";

enum class JournalKind : char { Snapshot = 'S', SnapshotEnd = 'N', Edit = 'E' };

std::string journal_header();

enum class JournalHeader { Good, Newer, Damaged, SomethingElse };
/// Of the first bytes of a file; fewer than a header has are damaged if they begin like one.
JournalHeader judge_journal_header(std::string_view bytes);

/// What stands before a record's content.
struct JournalFrame {
  JournalKind kind = JournalKind::Edit;
  std::uint32_t length = 0;  // of the content
  std::uint64_t number = 0;
  std::uint32_t checksum = 0;

  /// Of content and padding.
  std::uint64_t padded_length() const { return (std::uint64_t{length} + 7) / 8 * 8; }
  bool fits(std::string_view padded_content) const;
};

/// Nothing for bytes that are no frame, or damaged ones. As many bytes as a frame has.
std::optional<JournalFrame> read_journal_frame(std::string_view bytes);

/// Appends a whole record to `bytes`. The content is shorter than 4 GB.
void add_journal_record(JournalKind kind, std::uint64_t number, std::string_view content, std::string& bytes);

}  // namespace icome::files
