#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/result.h"
#include "files/vrml/read/vrml_frames.h"
#include "io/url_policy.h"

namespace icome::files {

/// Fetches files for the process that parses VRML, which can open none: those that the rules of url_policy.h
/// reach and that are VRML 2.0. A part without a header is taken only from the design's own folder and below.
class VrmlBroker {
 public:
  /// No file may have more than `size_limit` bytes, nor all together.
  /// `urls_above`: may urls lead above the design's folder?
  VrmlBroker(const std::filesystem::path& design, std::uint64_t size_limit, bool urls_above);

  struct Reply {
    VrmlFrame kind = VrmlFrame::Refused;  // or Known, or File with its name
    int file = 0;
    std::string bytes = {};  // the content, or the reason why there is none
  };
  /// Answers one Fetch with the first url that leads to a file.
  Reply fetch(int from, std::string_view urls);
  /// The files by their numbers; the design is 0.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  base::Result<Reply> fetch_one(int from, std::string_view url);
  base::Result<void> check_content(const std::filesystem::path& path, std::string_view bytes) const;

  std::filesystem::path folder_;
  io::UrlReach reach_;
  std::uint64_t bytes_left_;
  int fetches_ = 0;
  std::vector<std::filesystem::path> files_;
  std::vector<int> depths_;  // of each file: how many files lie between it and the design
  std::unordered_map<std::string, int> numbers_;
};

}  // namespace icome::files
