#include "files/journal/journal_lost.h"

#include <fmt/format.h>

#include <algorithm>

#include "io/new_file.h"

namespace icome::files {
namespace {

constexpr std::uint64_t kPieceOfLost = 1U << 20U;  // bytes at once

/// Calls `take` with the bytes from the first damage on, a piece at a time, until it returns false.
template <typename Take>
base::Result<bool> each_piece(const io::OpenFile& file, std::uint64_t from, std::uint64_t end,
                              const Take& take) {
  std::string piece;
  for (std::uint64_t at = from; at < end; at += piece.size()) {
    piece.resize(std::min(kPieceOfLost, end - at));
    if (const auto read = file.read(at, piece.data(), piece.size()); !read)
      return tl::unexpected(read.error());
    if (!take(std::string_view(piece))) return false;
  }
  return true;
}

/// Did an earlier opening keep the same bytes in this file?
bool is_kept_in(const std::filesystem::path& name, const io::OpenFile& journal, const JournalReport& report) {
  const auto copy = io::OpenFile::open(name, io::OpenFile::Use::Read);
  const auto size = copy ? copy->size() : base::Result<std::uint64_t>(tl::unexpected(copy.error()));
  if (!size || *size != report.bytes - report.damaged_from) return false;
  std::uint64_t at = 0;
  std::string other;
  const auto equal = each_piece(journal, report.damaged_from, report.bytes, [&](std::string_view piece) {
    other.resize(piece.size());
    const auto read = copy->read(at, other.data(), other.size());
    at += piece.size();
    return read && other == piece;
  });
  return equal && *equal;
}

}  // namespace

base::Result<void> keep_what_is_lost(const io::OpenFile& journal, JournalReport& report) {
  if (report.damaged_from >= report.bytes) return {};
  std::filesystem::path name = journal.path();
  name += ".lost";
  std::error_code error;
  bool kept = false;
  for (int i = 2; !kept && std::filesystem::exists(name, error); ++i) {
    kept = is_kept_in(name, journal, report);
    if (kept) break;
    name = journal.path();
    name += fmt::format(".lost-{}", i);
  }
  if (!kept) {
    auto copy = io::NewFile::create(name);
    if (!copy) return tl::unexpected(copy.error());
    const auto copied = each_piece(journal, report.damaged_from, report.bytes, [&](std::string_view piece) {
      copy->write(piece);
      return true;
    });
    if (!copied) return tl::unexpected(copied.error());
    if (const auto finished = copy->finish(); !finished) return finished;
  }
  report.set_aside = name;
  report.damage.push_back({{}, 0, fmt::format("All from the damage on is kept in {}.", name.string())});
  return {};
}

}  // namespace icome::files
