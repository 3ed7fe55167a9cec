#include "io/url_policy.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "io/file_bytes.h"

namespace icome::io {
namespace {

/// As much of a url as a sentence can bear: it may be a whole picture.
std::string url_text(std::string_view url) {
  constexpr std::size_t kShown = 80;
  std::string text(url.substr(0, kShown));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return "'" + text + (url.size() > kShown ? "...'" : "'");
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_url_digit(char c) { return c >= '0' && c <= '9'; }

int hexadecimal(char c) {
  if (is_url_digit(c)) return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// The length of `http` in `http:...`, of `C` in `C:\`; 0: there is none.
std::size_t scheme_length(std::string_view url) {
  std::size_t length = 0;
  while (length < url.size() && (is_letter(url[length]) || is_url_digit(url[length]) ||
                                 std::string_view("+-.").find(url[length]) != std::string_view::npos))
    ++length;
  return length < url.size() && url[length] == ':' && length > 0 && is_letter(url[0]) ? length : 0;
}

std::string percent_decoded(std::string_view url) {
  std::string decoded;
  for (std::size_t i = 0; i < url.size(); ++i) {
    const int high = url[i] == '%' && i + 2 < url.size() ? hexadecimal(url[i + 1]) : -1;
    const int low = high >= 0 ? hexadecimal(url[i + 2]) : -1;
    decoded += low >= 0 ? static_cast<char>(high * 16 + low) : url[i];
    if (low >= 0) i += 2;
  }
  return decoded;
}

/// The names that a url may mean: as it stands, without the escapes of urls, and as Windows programs
/// write it.
std::vector<std::string> meanings(std::string_view url) {
  std::vector<std::string> names = {std::string(url), percent_decoded(url)};
  names.push_back(names.back());
  std::replace(names.back().begin(), names.back().end(), '\\', '/');
  return names;
}

/// The reason why a name does not count from the file that it stands in; null if it does.
const char* objection(const std::string& name) {
  if (name.empty()) return "it is empty";
  if (name.find('\0') != std::string::npos) return "it holds a zero byte";
  if (scheme_length(name) > 0) return "only files that came with the design are, by relative urls";
  if (name.front() == '/') return "it names a place on this machine; only relative urls are followed";
  return nullptr;
}

/// The absolute name that a url of this machine has: `/a` of `/a`, `file:/a`, `file:///a` and
/// `file://localhost/a`; else nothing.
std::string_view absolute_name(std::string_view url) {
  constexpr std::string_view kScheme = "file:", kHere = "//localhost/", kNoHost = "///";
  if (url.starts_with(kScheme)) {
    url.remove_prefix(kScheme.size());
    if (url.starts_with(kHere)) url.remove_prefix(kHere.size() - 1);
    if (url.starts_with(kNoHost)) url.remove_prefix(kNoHost.size() - 1);
  }
  return url.starts_with('/') && !url.starts_with("//") ? url : std::string_view();
}

/// The place that a name means if no link stands in it, but for those in the folder it counts from.
std::filesystem::path textual_place(const std::filesystem::path& name) {
  std::error_code error;
  const std::filesystem::path normal = name.lexically_normal();
  std::filesystem::path known = normal.parent_path();
  // Parts of a path that do not exist have no links.
  const std::filesystem::path resolved = std::filesystem::weakly_canonical(known, error);
  return (error ? known : resolved) / normal.filename();
}

tl::unexpected<base::Error> leads_above(std::string_view url) {
  return base::fail(
      fmt::format("{} is not fetched: it leads above the folder of the design; for a design that you trust, "
                  "\"icome convert --urls-above\" follows it",
                  url_text(url)));
}

}  // namespace

UrlReach::UrlReach(const std::filesystem::path& design, bool above) : above_(above) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(design, error);
  folders_ = {std::filesystem::weakly_canonical(whole.parent_path(), error),
              std::filesystem::weakly_canonical(whole, error).parent_path()};
}

bool UrlReach::is_within(const std::filesystem::path& path) const {
  return std::any_of(folders_.begin(), folders_.end(), [&](const std::filesystem::path& folder) {
    return !folder.empty() && is_below(folder, path);
  });
}

void UrlReach::note(const std::filesystem::path& found) {
  if (is_within(found)) return;
  if (std::find(found_above_.begin(), found_above_.end(), found) == found_above_.end())
    found_above_.push_back(found);
}

std::vector<std::string> UrlReach::sentences() const {
  std::vector<std::string> sentences;
  for (const std::filesystem::path& path : found_above_)
    sentences.push_back(fmt::format(
        "{} lies above the design's folder: it is taken in, and goes into what is saved.", path.string()));
  return sentences;
}

bool is_below(const std::filesystem::path& folder, const std::filesystem::path& path) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

base::Result<std::filesystem::path> find_installed_or_beside(const std::filesystem::path& base_file,
                                                             std::string_view url,
                                                             const std::filesystem::path& installed,
                                                             UrlReach& reach) {
  const std::string_view name = absolute_name(url);
  if (name.empty()) return find_beside(base_file, url, reach);
  const auto refused = [&](const std::string& why) {
    return base::fail(fmt::format("{} is not fetched: {}", url_text(url), why));
  };
  const std::string decoded = percent_decoded(name);
  if (decoded.find('\0') != std::string::npos) return refused("it holds a zero byte");
  // Both must lie there before links are looked at, and without ways up, so that nothing is learnt of other
  // places: `..` behind a link leads to where no text says.
  for (const std::string& meaning : {std::string(name), decoded}) {
    const std::filesystem::path path(meaning);
    if (std::find(path.begin(), path.end(), "..") != path.end())
      return refused("of this machine only names without \"..\" are");
    if (!is_below(installed, path.lexically_normal()))
      return refused(fmt::format("of this machine only what lies below {} is", installed.string()));
  }
  for (const std::string& meaning : {std::string(name), decoded}) {
    std::error_code error;
    const std::filesystem::path found =
        std::filesystem::canonical(std::filesystem::path(meaning).lexically_normal(), error);
    if (error || !std::filesystem::is_regular_file(found, error)) continue;
    const std::filesystem::path folder = std::filesystem::canonical(installed, error);
    if (!error && is_below(folder, found)) return found;
    return refused(fmt::format("it is a link to what does not lie below {}", installed.string()));
  }
  return refused("there is no such file");
}

base::Result<std::filesystem::path> find_beside(const std::filesystem::path& base_file, std::string_view url,
                                                UrlReach& reach) {
  std::string_view name = url;
  if (name.size() > 5 && name.substr(0, 5) == "file:") name.remove_prefix(5);
  // EXTERNPROTO urls name a PROTO after the file.
  name = name.substr(0, name.find('#'));
  const std::vector<std::string> names = meanings(name);
  for (const std::string& meaning : names)
    if (const char* why = objection(meaning))
      return base::fail(fmt::format("{} is not fetched: {}", url_text(url), why));
  const std::filesystem::path folder = base_file.has_parent_path() ? base_file.parent_path() : ".";
  for (const std::string& meaning : names) {
    std::error_code error;
    const std::filesystem::path there = std::filesystem::absolute(folder / meaning, error);
    // Checked before the file is looked for, so that nothing is learnt of other places; links come later.
    if (!reach.may_lead_above() && !reach.is_within(textual_place(there))) return leads_above(url);
    const std::filesystem::path found = std::filesystem::canonical(there, error);
    if (error || !std::filesystem::is_regular_file(found, error)) continue;
    if (!reach.may_lead_above() && !reach.is_within(found)) return leads_above(url);
    reach.note(found);
    return found;
  }
  return base::fail(fmt::format("{} is not fetched: there is no such file", url_text(url)));
}

base::Result<std::string> fetch_beside(const std::filesystem::path& base_file, std::string_view url,
                                       std::uint64_t limit, UrlReach& reach) {
  const auto found = find_beside(base_file, url, reach);
  if (!found) return base::fail(found.error().message);
  auto bytes = read_bytes(*found, limit);
  if (!bytes) return base::fail(fmt::format("{} is not fetched: {}", url_text(url), bytes.error().message));
  return bytes;
}

}  // namespace icome::io
