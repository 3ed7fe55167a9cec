#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "world/id.h"

namespace icome::files {

// The bytes of a journal (.icome): a header, then records one after the other. All numbers little-endian.
//
//   header   "\x89ICOME\r\n", version (u32), CRC-32 of these 12 bytes
//   record   "\x8aRE" and a letter for the kind, length of the content (u32), number of the record (u64,
//            from 0), CRC-32 of content and padding, CRC-32 of these 20 bytes; the content; zeros up to a
//            multiple of 8
//
// The first record ('C', none where there are no objects) names all objects that the file began with, so that
// losses can be told: id (u64), length of the name (u32), name, one after the other. The next make the world
// as it was when the file was written (kinds 'S', then one 'N', without content, to mark the end), the others
// ('E') are the edits since, in order. The content of 'S' and 'E' is an edit (world::to_bytes); that of 'S' a
// single one, so that a damage loses one thing. Files of version 1 have no 'C', and groups of up to 256 edits
// in 'S'.

inline constexpr std::uint32_t kJournalVersion = 2;
inline constexpr std::size_t kJournalHeaderBytes = 16;
inline constexpr std::size_t kJournalFrameBytes = 24;  // of a record before its content
inline constexpr std::string_view kJournalMarker = "\x8aRE";

enum class JournalKind : char { Contents = 'C', Snapshot = 'S', SnapshotEnd = 'N', Edit = 'E' };

std::string journal_header();

enum class JournalHeader { Good, Newer, Damaged, SomethingElse };
/// Judges the first bytes of a file; fewer than a header's are damaged if they begin like one.
JournalHeader judge_journal_header(std::string_view bytes);

/// The frame in front of a record's content.
struct JournalFrame {
  JournalKind kind = JournalKind::Edit;
  std::uint32_t length = 0;  // of the content
  std::uint64_t number = 0;
  std::uint32_t checksum = 0;

  /// Length of content and padding.
  std::uint64_t padded_length() const { return (std::uint64_t{length} + 7) / 8 * 8; }
  bool fits(std::string_view padded_content) const;
};

/// Nothing for bytes that are no frame, or a damaged one. `bytes` has the length of a frame.
std::optional<JournalFrame> read_journal_frame(std::string_view bytes);

/// The names of objects, the content of 'C'.
using JournalNames = std::vector<std::pair<world::ObjectId, std::string>>;
std::string journal_names_to_bytes(const JournalNames& names);
/// The names before the first invalid one.
JournalNames journal_names_from_bytes(std::string_view bytes);

/// Appends a whole record to `bytes`. The content is shorter than 4 GB.
void add_journal_record(JournalKind kind, std::uint64_t number, std::string_view content, std::string& bytes);

}  // namespace icome::files
