#include "files/vrml/read/vrml_broker.h"

#include <fmt/format.h>

#include <algorithm>

#include "files/vrml/read/vrml_header.h"
#include "io/file_bytes.h"
#include "io/gzip_bytes.h"

namespace icome::files {
namespace {

constexpr int kFetchLimit = 1000;
constexpr int kFetchDepthLimit = 16;

std::filesystem::path canonical_or_same(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path found = std::filesystem::weakly_canonical(path, error);
  return error ? path : found;
}

}  // namespace

VrmlBroker::VrmlBroker(const std::filesystem::path& design, std::uint64_t size_limit, bool urls_above)
    : reach_(design, urls_above), bytes_left_(size_limit) {
  files_.push_back(canonical_or_same(design));
  folder_ = files_.front().parent_path();
  depths_.push_back(0);
  numbers_[files_.front().string()] = 0;
}

VrmlBroker::Reply VrmlBroker::fetch(int from, std::string_view urls) {
  Reply refused{VrmlFrame::Refused, 0, "there is no url"};
  if (from < 0 || static_cast<std::size_t>(from) >= files_.size()) return refused;
  for (std::size_t begin = 0; begin <= urls.size();) {
    const std::size_t end = std::min(urls.find('\0', begin), urls.size());
    if (++fetches_ > kFetchLimit)
      return {VrmlFrame::Refused, 0, fmt::format("only {} urls of a design are followed", kFetchLimit)};
    auto reply = fetch_one(from, urls.substr(begin, end - begin));
    if (reply) return std::move(*reply);
    // The message for the first url is most likely about the file that its author meant.
    if (begin == 0) refused.bytes = reply.error().message;
    begin = end + 1;
  }
  return refused;
}

base::Result<VrmlBroker::Reply> VrmlBroker::fetch_one(int from, std::string_view url) {
  const std::filesystem::path& base = files_[static_cast<std::size_t>(from)];
  const auto path = io::find_beside(base, url, reach_);
  if (!path) return base::fail(path.error().message);
  if (const auto known = numbers_.find(path->string()); known != numbers_.end())
    return Reply{VrmlFrame::Known, known->second, {}};
  const int depth = depths_[static_cast<std::size_t>(from)] + 1;
  if (depth > kFetchDepthLimit)
    return base::fail(fmt::format("{} is not fetched: it is more than {} files away from the design",
                                  path->filename().string(), kFetchDepthLimit));
  auto bytes = io::read_bytes(*path, bytes_left_);
  if (bytes && io::is_gzip(*bytes)) bytes = io::unpack_gzip(*bytes, bytes_left_, path->string());
  if (!bytes) return base::fail(bytes.error().message);
  if (const auto checked = check_content(*path, *bytes); !checked) return base::fail(checked.error().message);
  bytes_left_ -= bytes->size();
  const int number = static_cast<int>(files_.size());
  numbers_[path->string()] = number;
  files_.push_back(*path);
  depths_.push_back(depth);
  return Reply{VrmlFrame::File, number, std::move(*bytes)};
}

base::Result<void> VrmlBroker::check_content(const std::filesystem::path& path,
                                             std::string_view bytes) const {
  const auto header = find_vrml_header(bytes);
  if (header) return {};
  // No details of a file that may be someone else's.
  if (!io::is_below(folder_, path)) return base::fail(path.string() + " is not fetched: it is not VRML 2.0");
  if (begins_like_vrml(bytes)) return {};
  return base::fail(path.string() + " " + header.error().message);
}

}  // namespace icome::files
