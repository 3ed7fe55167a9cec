#include "cutout/source/frame_source.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "cutout/source/picture_bytes.h"
#include "cutout/source/video_source.h"
#include "io/file_bytes.h"

namespace icome::cutout {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kLargestPicture = 512'000'000;  // bytes
constexpr double kUsualRate = 30.0;                     // frames/s

class PictureSource : public FrameSource {
 public:
  PictureSource(std::vector<std::string> paths, const SourceSettings& settings, bool several)
      : paths_(std::move(paths)), rate_(settings.rate > 0 ? settings.rate : kUsualRate), several_(several) {}

  base::Result<std::optional<Frame>> next(const std::function<bool()>& stop) override {
    if (next_ >= paths_.size() || stop()) return std::nullopt;
    const std::size_t number = next_++;
    auto frame = read(paths_[number]);
    if (!frame) {
      if (several_) ++damaged_;
      return tl::unexpected(frame.error());
    }
    frame->time = double(number) / rate_;
    return std::move(*frame);
  }
  std::uint64_t damaged() const override { return damaged_; }
  std::optional<std::size_t> count() const override { return paths_.size(); }

 private:
  static base::Result<Frame> read(const std::string& path) {
    const auto bytes = io::read_bytes(path, kLargestPicture);
    if (!bytes) return tl::unexpected(bytes.error());
    return decode_picture(*bytes, path);
  }

  std::vector<std::string> paths_;
  double rate_;
  bool several_;
  std::size_t next_ = 0;
  std::uint64_t damaged_ = 0;
};

bool is_picture_name(const fs::path& path) {
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg";
}

/// The names in a folder that fit, sorted.
template <typename Fits>
base::Result<std::vector<std::string>> pictures_in(const fs::path& folder, const Fits& fits) {
  std::vector<std::string> paths;
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error)
    return base::fail(fmt::format("{}: the folder cannot be read: {}", folder.string(), error.message()));
  for (; entries != fs::directory_iterator(); entries.increment(error)) {
    if (error) break;
    if (fits(entries->path())) paths.push_back(entries->path().string());
  }
  std::ranges::sort(paths, before_by_number);
  return paths;
}

base::Result<std::unique_ptr<FrameSource>> from_folder(const std::string& address,
                                                       const SourceSettings& settings) {
  auto paths = pictures_in(address, is_picture_name);
  if (!paths) return tl::unexpected(paths.error());
  if (paths->empty())
    return base::fail(fmt::format("{}: there is no picture in the folder (.png, .jpg or .jpeg)", address));
  return picture_source(std::move(*paths), settings, true);
}

base::Result<std::unique_ptr<FrameSource>> from_glob(const std::string& address,
                                                     const SourceSettings& settings) {
  const fs::path pattern(address);
  const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  if (folder.string().find_first_of("*?[") != std::string::npos)
    return base::fail(fmt::format("{}: * and ? stand for part of a file's name, not of a folder's", address));
  const std::string wanted = pattern.filename().string();
  auto paths = pictures_in(folder, [&](const fs::path& path) {
    return ::fnmatch(wanted.c_str(), path.filename().c_str(), FNM_PERIOD) == 0;
  });
  if (!paths) return tl::unexpected(paths.error());
  if (paths->empty()) return base::fail(fmt::format("{}: no file fits", address));
  return picture_source(std::move(*paths), settings, true);
}

/// Width of the number in a pattern such as shot%04d.png, and where it stands.
struct NumberPlace {
  std::size_t begin, end;
  int width = 0;
};

std::optional<NumberPlace> number_place(const std::string& pattern) {
  const std::size_t begin = pattern.find('%');
  if (begin == std::string::npos) return std::nullopt;
  std::size_t at = begin + 1;
  NumberPlace place{begin, 0};
  while (at < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[at])) != 0 && at < begin + 4)
    place.width = 10 * place.width + (pattern[at++] - '0');
  if (at >= pattern.size() || pattern[at] != 'd' || place.width > 20) return std::nullopt;
  place.end = at + 1;
  return place;
}

base::Result<std::unique_ptr<FrameSource>> from_numbers(const std::string& address, const NumberPlace& place,
                                                        const SourceSettings& settings) {
  constexpr int kLastFirst = 1000;  // numbers that a sequence may begin with
  const auto path_of = [&](std::size_t number) {
    return fmt::format("{}{:0{}}{}", address.substr(0, place.begin), number, place.width,
                       address.substr(place.end));
  };
  std::vector<std::string> paths;
  std::error_code error;
  for (std::size_t number = 0; number <= kLastFirst || !paths.empty(); ++number) {
    if (std::string path = path_of(number); fs::exists(path, error)) {
      paths.push_back(std::move(path));
    } else if (!paths.empty()) {
      break;
    }
  }
  if (paths.empty())
    return base::fail(fmt::format("{}: there is no picture with a number from 0 to {}, such as {}", address,
                                  kLastFirst, path_of(1)));
  return picture_source(std::move(paths), settings, true);
}

base::Result<bool> begins_as_picture(const std::string& address) {
  std::error_code error;
  if (!fs::exists(address, error))
    return base::fail(
        fmt::format("{}: there is no such file, folder or camera; see icome track --help", address));
  if (!fs::is_regular_file(address, error))
    return base::fail(fmt::format("{}: it is no ordinary file", address));
  if (fs::file_size(address, error) == 0) return base::fail(fmt::format("{}: the file is empty", address));
  if (is_picture_name(address)) return true;
  if (fs::file_size(address, error) > kLargestPicture) return false;
  std::FILE* const file = std::fopen(address.c_str(), "rb");
  if (file == nullptr) return base::fail(fmt::format("{}: it cannot be opened for reading", address));
  std::array<char, 16> first{};
  const std::size_t read = std::fread(first.data(), 1, first.size(), file);
  std::fclose(file);
  return is_picture(std::string_view(first.data(), read));
}

}  // namespace

bool before_by_number(const std::string& one, const std::string& other) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, k = 0;
  while (i < one.size() && k < other.size()) {
    if (is_digit(one[i]) && is_digit(other[k])) {
      while (i < one.size() && one[i] == '0') ++i;
      while (k < other.size() && other[k] == '0') ++k;
      const std::size_t one_from = i, other_from = k;
      while (i < one.size() && is_digit(one[i])) ++i;
      while (k < other.size() && is_digit(other[k])) ++k;
      if (i - one_from != k - other_from) return i - one_from < k - other_from;
      const int order = one.compare(one_from, i - one_from, other, other_from, k - other_from);
      if (order != 0) return order < 0;
      continue;
    }
    if (one[i] != other[k]) return one[i] < other[k];
    ++i;
    ++k;
  }
  if (one.size() - i != other.size() - k) return one.size() - i < other.size() - k;
  return one < other;
}

std::unique_ptr<FrameSource> picture_source(std::vector<std::string> paths, const SourceSettings& settings,
                                            bool several) {
  return std::make_unique<PictureSource>(std::move(paths), settings, several);
}

base::Result<std::unique_ptr<FrameSource>> open_source(const std::string& address,
                                                       const SourceSettings& settings) {
  if (address.empty()) return base::fail("the name of the source is empty");
  if (is_video_address(address)) return open_video(address, settings);
  std::error_code error;
  if (fs::is_directory(address, error)) return from_folder(address, settings);
  if (!fs::exists(address, error)) {
    if (const auto place = number_place(address)) return from_numbers(address, *place, settings);
    if (address.find_first_of("*?[") != std::string::npos) return from_glob(address, settings);
  }
  const auto picture = begins_as_picture(address);
  if (!picture) return tl::unexpected(picture.error());
  if (*picture) return picture_source({address}, settings, false);
  return open_video(address, settings);
}

}  // namespace icome::cutout
