#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/findings.h"
#include "files/pictures/picture_bytes.h"
#include "world/world.h"

namespace icome::files {

/// Gets the content of the file that `url` means in the file `base`, if it has at most `limit` bytes.
using FetchPicture = std::function<base::Result<std::string>(const std::string& base, const std::string& url,
                                                             std::uint64_t limit)>;

/// Finds the pictures of a design, each file once. Only files that begin like a picture are taken, so
/// that no other file of the reader's machine gets into a design. Refers to its arguments.
class VrmlPictures {
 public:
  /// All pictures together may have `limit` bytes.
  VrmlPictures(const FetchPicture& fetch, std::uint64_t limit, Findings& findings)
      : fetch_(fetch), left_(limit), findings_(findings) {}

  /// The first of the urls that leads to a picture; none, with a finding, when none does.
  std::optional<world::Texture> from_file(const std::string& base, const std::vector<std::string>& urls);
  /// None, with a finding, when it is invalid.
  std::optional<world::Texture> from_pixels(const PixelPicture& picture);

 private:
  using Bytes = std::shared_ptr<const std::string>;

  base::Result<Bytes> fetch(const std::string& base, const std::string& url);
  base::Result<Bytes> keep(std::string bytes);

  const FetchPicture& fetch_;
  std::uint64_t left_;  // bytes that pictures may still have
  Findings& findings_;
  std::map<std::pair<std::string, std::string>, base::Result<Bytes>> known_;  // by base and url
  std::unordered_multimap<std::size_t, Bytes> kept_;                          // by hash of the content
};

}  // namespace icome::files
