#include "collab/content/content_fetcher.h"

#include <algorithm>
#include <utility>

namespace icome::collab {
namespace {

constexpr std::uint64_t kPiecesAhead = 3;  // that are asked for at a time

}  // namespace

ContentPointer ContentFetcher::outline(const ContentHash& hash, std::uint64_t size) {
  const auto found = complete_.find(hash);
  if (found != complete_.end()) return found->second;
  add_missing({0, size, hash}, false);
  return nullptr;
}

base::Result<std::optional<std::string>> ContentFetcher::whole(std::string_view bytes) {
  const auto outline = outline_from_bytes(bytes);
  if (!outline) return tl::unexpected(outline.error());
  std::vector<ContentPointer> contents;
  for (const ContentPlace& place : outline->places) {
    ContentPointer& content = complete_[place.hash];
    if (!content && cache_ && !missing_.contains(place.hash)) content = cache_->find(place.hash);
    if (content && content->size() != place.size)
      return base::fail("A content is of another size than it is said to be.");
    if (!content) add_missing(place, true);
    contents.push_back(content);
  }
  if (is_fetching()) return std::nullopt;
  in_part_.clear();
  complete_.clear();
  fetched_ = to_fetch_ = 0;
  return whole_of(*outline, contents);
}

void ContentFetcher::add_missing(const ContentPlace& place, bool is_kept) {
  const auto [missing, is_new] = missing_.emplace(place.hash, Missing{place.size, {}, is_kept});
  if (!is_new) return;
  to_fetch_ += place.size;
  const auto part = in_part_.find(place.hash);
  if (part == in_part_.end() || part->second.size() >= place.size) return;
  missing->second.bytes = std::move(part->second);
  fetched_ += missing->second.bytes.size();
}

void ContentFetcher::connection_lost() {
  for (auto& [hash, missing] : missing_)
    if (!missing.bytes.empty()) in_part_[hash] = std::move(missing.bytes);
  missing_.clear();
  asked_ = fetched_ = to_fetch_ = 0;
}

std::vector<Fetch> ContentFetcher::questions() {
  std::vector<Fetch> questions;
  if (missing_.empty()) return questions;
  const auto& [hash, first] = *missing_.begin();
  asked_ = std::max<std::uint64_t>(asked_, first.bytes.size());
  while (asked_ < first.size && asked_ + kMostWanted <= first.bytes.size() + kPiecesAhead * kMostWanted) {
    questions.push_back({hash, asked_, kMostWanted});
    asked_ += std::min(kMostWanted, first.size - asked_);
  }
  return questions;
}

base::Result<void> ContentFetcher::take(const Piece& piece) {
  if (missing_.empty() || piece.hash != missing_.begin()->first) return {};  // of one that is here by now
  Missing& first = missing_.begin()->second;
  if (piece.bytes.empty()) return base::fail("The server does not have a shape or a picture any more.");
  if (piece.offset != first.bytes.size()) return {};  // was asked for twice
  if (piece.bytes.size() > first.size - first.bytes.size())
    return base::fail("A content is longer than it is said to be.");
  first.bytes += piece.bytes;
  fetched_ += piece.bytes.size();
  if (first.bytes.size() < first.size) return {};
  if (hash_of_content(first.bytes) != piece.hash)
    return base::fail("A shape or a picture came in damaged from the server.");
  const auto content = std::make_shared<const std::string>(std::move(first.bytes));
  if (cache_ && first.is_kept) cache_->keep(piece.hash, content);
  complete_[piece.hash] = content;
  missing_.erase(missing_.begin());
  asked_ = 0;
  return {};
}

}  // namespace icome::collab
