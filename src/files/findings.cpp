#include "files/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace icome::files {

void Findings::add(const FindingKind& kind, const std::string& owner, std::size_t count) {
  auto place =
      std::find_if(found_.begin(), found_.end(), [&](const Found& found) { return found.kind == &kind; });
  if (place == found_.end()) place = found_.insert(found_.end(), {&kind, owner, 0, 0});
  ++place->owners;
  place->count += count;
}

void Findings::tell(std::string text) {
  constexpr std::size_t kMostTold = 100;
  if (told_.size() < kMostTold)
    told_.push_back({{}, 0, std::move(text)});
  else
    ++untold_;
}

std::vector<Remark> Findings::remarks() const {
  std::vector<Remark> result;
  for (const Found& found : found_) {
    std::string where = found.owners == 1 ? quoted_name(found.first)
                                          : fmt::format("{} {}, first {}", found.owners, found.kind->owners,
                                                        quoted_name(found.first));
    if (found.count > 0) where = fmt::format("{} of {}", found.count, where);
    result.push_back({{}, 0, fmt::format("{}: {}.", found.kind->text, where)});
  }
  result.insert(result.end(), told_.begin(), told_.end());
  if (untold_ > 0)
    result.push_back({{}, 0, fmt::format("There are {} more remarks like the ones before.", untold_)});
  return result;
}

std::string quoted_name(const std::string& name) {
  constexpr std::size_t kLongest = 60;
  if (name.empty()) return "one without a name";
  std::string text = "\"";
  for (const char c : name.substr(0, kLongest)) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte < 0x20 || byte == 0x7f ? ' ' : c;
  }
  return text + (name.size() > kLongest ? "...\"" : "\"");
}

}  // namespace icome::files
