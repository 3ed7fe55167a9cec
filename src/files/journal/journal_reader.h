#pragma once
#include <optional>
#include <string>

#include "files/journal/journal_format.h"
#include "io/open_file.h"

namespace icome::files {

/// Walks over the records of a journal, which may be damaged anywhere: it takes no more memory than the file
/// has bytes. Reads an open file, which outlives it; bytes appended meanwhile are left out.
class JournalReader {
 public:
  /// Fails for a file that is no journal or one of a newer version. A journal whose header alone is damaged
  /// can be read.
  static base::Result<JournalReader> create(const io::OpenFile& file);

  bool header_is_good() const { return header_is_good_; }
  /// Size of the file, bytes.
  std::uint64_t size() const { return size_; }
  /// Offset of the next record.
  std::uint64_t position() const { return position_; }
  bool at_end() const { return position_ == size_; }

  struct Record {
    JournalKind kind = JournalKind::Edit;
    std::string_view content = {};  // until the next call
    std::uint64_t bytes = 0;        // of the file, with frame and padding
  };
  /// The next record if it is whole and has the expected number, else nothing, and the position stays. Fails
  /// where the disk does.
  base::Result<std::optional<Record>> next();
  /// Continues behind a damage: at the next whole record with a later number, wherever it begins, or
  /// at the end of the file.
  base::Result<void> skip_damage();
  /// Does the file end within the record that begins here, as when it was being written?
  base::Result<bool> is_cut_off();

 private:
  explicit JournalReader(const io::OpenFile& file, std::uint64_t size)
      : file_(&file), size_(size), work_(4 * size) {}
  base::Result<std::optional<JournalFrame>> frame_at(std::uint64_t offset);
  base::Result<bool> is_whole(const JournalFrame& frame, std::uint64_t offset);
  base::Result<std::string_view> view(std::uint64_t offset, std::size_t count);
  base::Result<std::optional<std::uint64_t>> next_marker(std::uint64_t from);
  base::Result<bool> go_on_at(std::uint64_t offset);

  const io::OpenFile* file_;
  std::uint64_t size_;
  bool header_is_good_ = true;
  std::uint64_t position_ = kJournalHeaderBytes;
  std::uint64_t number_ = 0;  // of the next record
  std::uint64_t work_;        // bytes that skipping may still examine
  std::string window_;        // the part of the file that was read last
  std::uint64_t window_offset_ = 0;
};

}  // namespace icome::files
