#include "animation/export/picture_sequence.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "animation/export/svg_frame.h"
#include "base/parse_number.h"
#include "io/new_file.h"

namespace icome::animation {
namespace {

using base::fail;
using base::Result;
namespace fs = std::filesystem;

constexpr std::string_view kPartFolder = "frames.part-";

/// A folder beside the files to be, which takes them until all are there. What is left in it goes with it.
class PartFolder {
 public:
  static Result<PartFolder> make(const fs::path& folder) {
    remove_those_of_the_gone(folder);
    PartFolder part(folder / fmt::format("{}{}", kPartFolder, ::getpid()));
    std::error_code error;
    fs::create_directories(part.path_, error);
    if (error) return fail(fmt::format("{}: cannot be written ({}).", folder.string(), error.message()));
    return part;
  }
  PartFolder(PartFolder&& other) noexcept : path_(std::move(other.path_)) { other.path_.clear(); }
  PartFolder& operator=(PartFolder&&) = delete;
  ~PartFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }

  const fs::path& path() const { return path_; }

 private:
  explicit PartFolder(fs::path path) : path_(std::move(path)) {}

  /// Removes such folders of processes that were killed.
  static void remove_those_of_the_gone(const fs::path& folder) {
    std::error_code error;
    std::vector<fs::path> left;
    for (fs::directory_iterator it(folder.empty() ? "." : folder, error), end; !error && it != end;
         it.increment(error)) {
      const std::string name = it->path().filename().string();
      if (!name.starts_with(kPartFolder)) continue;
      const auto process = base::number_at_front<pid_t>(std::string_view(name).substr(kPartFolder.size()));
      if (process.good() && process.rest.empty() && process.value > 0 && ::kill(process.value, 0) != 0 &&
          errno == ESRCH)
        left.push_back(it->path());
    }
    for (const fs::path& each : left) fs::remove_all(each, error);
  }

  fs::path path_;  // empty once moved from
};

Result<std::string> file_of_frame(FrameMaker& maker, OutputFormat format, int frame, SvgPictures& pictures) {
  if (format == OutputFormat::Svg) {
    const CellStates states = maker.states(frame);
    return svg_frame(maker.project(), states, pictures, maker.view(states), maker.width(), maker.height(),
                     maker.has_background());
  }
  const auto drawn = maker.draw(frame);
  if (!drawn) return tl::unexpected(drawn.error());
  const auto png = charts::encode_png(image_of(**drawn));
  if (!png) return tl::unexpected(png.error());
  return std::string(png->begin(), png->end());
}

/// A file that may be replaced: none is there, or an ordinary one.
Result<void> check_replaceable(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error) || fs::is_regular_file(file, error)) return {};
  return fail(fmt::format("{}: cannot be written (not an ordinary file).", file.string()));
}

Result<void> write_whole(const fs::path& file, const std::string& bytes) {
  auto made = io::NewFile::create(file);
  if (!made) return tl::unexpected(made.error());
  made->write(bytes);
  return made->finish();
}

}  // namespace

Result<void> write_sequence(FrameMaker& maker, const OutputNames& names, ExportReport& report) {
  const FrameRange& range = maker.range();
  for (int frame = range.first; frame <= range.last; ++frame)
    if (auto free = check_replaceable(names.of(frame)); !free) return free;
  std::error_code error;
  const bool had_folder = names.folder.empty() || fs::exists(names.folder, error);
  const auto write_all = [&]() -> Result<void> {
    const auto part = PartFolder::make(names.folder);
    if (!part) return tl::unexpected(part.error());
    SvgPictures pictures(maker.pictures());
    for (int frame = range.first; frame <= range.last; ++frame) {
      if (!maker.goes_on(double(frame - range.first) / range.count())) return stopped_export();
      const auto bytes = file_of_frame(maker, names.format, frame, pictures);
      if (!bytes) return tl::unexpected(bytes.error());
      if (auto written = write_whole(part->path() / names.name_of(frame), *bytes); !written) return written;
    }
    for (int frame = range.first; frame <= range.last; ++frame) {
      const fs::path file = names.of(frame);
      fs::rename(part->path() / names.name_of(frame), file, error);
      if (error) return fail(fmt::format("{}: cannot be written ({}).", file.string(), error.message()));
      report.files.push_back(file.string());
    }
    return {};
  };
  const auto written = write_all();
  if (!written && !had_folder) fs::remove(names.folder, error);  // where it is empty
  return written;
}

}  // namespace icome::animation
