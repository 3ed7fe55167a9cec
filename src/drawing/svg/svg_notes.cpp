#include "drawing/svg/svg_notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace icome::drawing {
namespace {

constexpr std::size_t kMostNoteKinds = 100;

}  // namespace

void SvgNotes::tell(const XmlNode& node, const std::string& kind) {
  const bool is_new = told_.size() >= kMostNoteKinds && !told_.contains(kind);
  Told& told = told_[is_new ? "more of other kinds is skipped" : kind];
  told.last_line = xml_.line_of(node);
  if (told.count++ == 0) told.first_line = told.last_line;
}

std::vector<std::string> SvgNotes::lines() const {
  std::vector<std::pair<std::size_t, std::string>> sorted;
  for (const auto& [kind, told] : told_) {
    std::string line = fmt::format("{}:{}: {}", xml_.name(), told.first_line, kind);
    if (told.count > 1) line += fmt::format(" ({} times, last in line {})", told.count, told.last_line);
    sorted.emplace_back(told.first_line, std::move(line));
  }
  std::ranges::sort(sorted);
  std::vector<std::string> lines;
  for (auto& [line, text] : sorted) lines.push_back(std::move(text));
  return lines;
}

}  // namespace icome::drawing
