#include "animation/export/export_animation.h"

#include <fmt/format.h>

#include <array>

#include "animation/export/film.h"
#include "animation/export/frame_maker.h"
#include "animation/export/output_names.h"
#include "animation/export/picture_sequence.h"

namespace icome::animation {
namespace {

using base::fail;
using base::Result;

constexpr std::array<const char*, 6> kFormatNames = {"PNG", "SVG", "MP4", "WebM", "GIF", "APNG"};

Result<void> check_range(const Project& project, const std::optional<FrameRange>& range) {
  if (project.stage.length < 1) return fail("the animation has no frames");
  if (!range || (range->first >= 0 && range->first <= range->last && range->last < project.stage.length))
    return {};
  return fail(fmt::format("frames {} to {} cannot be written: there are those from 0 to {}", range->first,
                          range->last, project.stage.length - 1));
}

Result<void> check_sides(const ExportOptions& options) {
  const auto good = [](int side) { return side == 0 || (side >= 2 && side <= kLargestStage); };
  if (good(options.width) && good(options.height)) return {};
  return fail(fmt::format("a picture of {} x {} px cannot be written; sides go from 2 to {}", options.width,
                          options.height, kLargestStage));
}

/// Fails where a frame would be written over a picture or the sound that frames are made of.
Result<void> check_spares_sources(const Project& project, const std::filesystem::path& folder,
                                  const OutputNames& names, const FrameRange& range) {
  std::vector<std::filesystem::path> sources;
  if (project.sound) sources.push_back(folder / project.sound->file);
  for (const Layer& layer : project.layers)
    for (const Cell& cell : layer.cells)
      for (const std::string& picture : cell.pictures) sources.push_back(folder / picture);
  for (int frame = range.first; frame <= range.last; ++frame) {
    const std::filesystem::path file = names.of(frame);
    std::error_code error;
    if (!std::filesystem::exists(file, error)) continue;
    for (const std::filesystem::path& source : sources)
      if (std::filesystem::equivalent(file, source, error))
        return fail(
            fmt::format("{}: is a file that the animation is made of; choose another name", file.string()));
  }
  return {};
}

}  // namespace

Result<ExportReport> export_animation(const Project& project, const StatesAt& states_at,
                                      CellPictures& pictures, const std::string& out,
                                      const ExportOptions& options) {
  if (const auto good = check_range(project, options.range); !good) return tl::unexpected(good.error());
  if (const auto good = check_sides(options); !good) return tl::unexpected(good.error());
  const FrameRange range = options.range.value_or(FrameRange{0, project.stage.length - 1});
  const int frames = range.count();
  const auto names = output_names(out, frames);
  if (!names) return tl::unexpected(names.error());
  if (const auto good = check_spares_sources(project, pictures.folder(), *names, range); !good)
    return tl::unexpected(good.error());
  FrameMaker maker(project, states_at, pictures, options,
                   options.background || names->format == OutputFormat::Mp4);
  ExportReport report;
  report.format = kFormatNames[std::size_t(names->format)];
  report.frames = frames;
  report.seconds = frames / project.stage.rate;
  for (const PictureProblem& problem : picture_problems(project, pictures)) {
    report.remarks.push_back(fmt::format("A crossed frame is shown for a picture: {}.", problem.message));
    report.is_whole = false;
  }
  const auto written =
      is_sequence(names->format) ? write_sequence(maker, *names, report) : write_film(maker, *names, report);
  if (!written) return tl::unexpected(written.error());
  report.width = maker.width();
  report.height = maker.height();
  return report;
}

}  // namespace icome::animation
