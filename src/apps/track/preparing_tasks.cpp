#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/stopwatch.h"
#include "apps/terminal.h"
#include "apps/track/making_tasks.h"
#include "apps/track/track_work.h"
#include "cutout/calibration/calibration.h"
#include "cutout/calibration/learning.h"
#include "cutout/calibration/sheet.h"
#include "cutout/calibration/table_colours.h"
#include "cutout/synth/synthetic_table.h"
#include "io/new_file.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kRadianInDegrees = 57.29577951308232;
constexpr double kCalibrationSeconds = 60.0;  // of a camera, where --seconds says nothing
constexpr std::size_t kLearnFrames = 15;

cutout::CalibrationSettings calibration_settings(const TrackOptions& options) {
  cutout::CalibrationSettings settings;
  settings.thickness = options.thickness;
  if (!options.table.empty()) settings.table = base::Vector2(options.table[0], options.table[1]);
  if (options.corners.size() == 8) {
    settings.corners.emplace();
    for (std::size_t i = 0; i < 4; ++i)
      // People count from the picture's corner, frames from the middle of its first pixel.
      (*settings.corners)[i] = {options.corners[2 * i] - 0.5, options.corners[2 * i + 1] - 0.5};
  }
  return settings;
}

std::string calibration_text(const TrackOptions& options, const cutout::CalibratedView& found,
                             std::size_t frames) {
  std::string text = fmt::format("{}: ", options.calibrate.string());
  if (found.view.has_lens()) {
    text += fmt::format(
        "lens and table by {} sights of the chessboard in {} pictures, whose corners miss their places by "
        "{:.2f} pixels\n",
        found.sights, frames, found.lens_error);
    text += fmt::format("  the camera hangs {:.0f} mm above the table, which is {:.1f} x {:.1f} mm large\n",
                        found.view.camera_height(), found.view.table_width(), found.view.table_height());
  } else {
    text += fmt::format("a table of {:g} x {:g} mm by its corners\n", found.view.table_width(),
                        found.view.table_height());
  }
  return text;
}

/// Takes frames until the source or the time ends.
base::Result<std::size_t> take_frames(const TrackOptions& options, cutout::Calibration& calibration) {
  auto source = open_for(options);
  if (!source) return tl::unexpected(source.error());
  FrameComplaints complaints;
  StatusLine status;
  const Stopwatch since;
  std::size_t frames = 0;
  const bool live = (*source)->is_live();
  const double seconds = options.seconds > 0 ? options.seconds : live ? kCalibrationSeconds : 1e12;
  if (live)
    tell(fmt::format(
        "hold the chessboard up in several ways, then lay it flat on the table; {:.0f} s, or Ctrl-C when "
        "it lies there",
        seconds));
  while (!interrupted() && since.seconds() < seconds && (options.frames == 0 || frames < options.frames)) {
    auto frame = (*source)->next([] { return interrupted(); });
    if (!frame) {
      if ((*source)->damaged() == 0) return tl::unexpected(frame.error());
      tell(frame.error().message);
      continue;
    }
    if (!*frame) break;
    ++frames;
    complaints.look_at(**frame);
    const bool seen = calibration.take(**frame);
    status.say(fmt::format("Picture {}: the chessboard is {}; {} sights", frames,
                           seen ? "seen" : "not seen whole", calibration.sights()));
  }
  return frames;
}

/// Measures something in frames of the source, until it was measured often enough or the source ends.
template <typename Measured, typename Measure>
base::Result<std::vector<Measured>> measured_in_frames(const TrackOptions& options, const Measure& measure) {
  auto source = open_for(options);
  if (!source) return tl::unexpected(source.error());
  std::optional<cutout::TableView> view;
  std::vector<Measured> measured;
  std::string why = "no frame could be read";
  FrameComplaints complaints;
  for (std::size_t frames = 0; measured.size() < kLearnFrames && frames < 20 * kLearnFrames && !interrupted();
       ++frames) {
    auto frame = (*source)->next([] { return interrupted(); });
    if (!frame) return tl::unexpected(frame.error());
    if (!*frame) break;
    complaints.look_at(**frame);
    if (!view) {
      const auto made = view_for(options, **frame);
      if (!made) return tl::unexpected(made.error());
      view.emplace(*made);
    }
    if (const auto one = measure((*frame)->view(), *view)) {
      measured.push_back(*one);
    } else {
      why = one.error().message;
    }
  }
  if (measured.empty()) return base::fail(fmt::format("{}: {}", options.source, why));
  return measured;
}

std::string rgb_of(const std::array<double, 3>& bgr) {
  return fmt::format("rgb({:.0f}, {:.0f}, {:.0f})", bgr[2], bgr[1], bgr[0]);
}

}  // namespace

int run_track_colours(const TrackOptions& options) {
  auto view = cutout::read_table_view(options.view);
  if (!view) return track_failed(view.error());
  const auto measured = measured_in_frames<cutout::TableColours>(options, cutout::measure_colours);
  if (!measured) return track_failed(measured.error());
  const cutout::TableColours colours = cutout::mean_of(*measured);
  view->set_colours(colours);
  if (const auto written = cutout::write_table_view(*view, options.view); !written)
    return track_failed(written.error());
  if (options.json) {
    const auto rgb = [](const std::array<double, 3>& bgr) { return Json{bgr[2], bgr[1], bgr[0]}; };
    const Json json = {{"view", options.view.string()},
                       {"frames", measured->size()},
                       {"table_rgb", rgb(colours.table_bgr)},
                       {"triangle_rgb", rgb(colours.triangle_bgr)}};
    return print_answer(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  }
  return print_answer(fmt::format("{}: the table is {}, the triangle {}, by {}\n", options.view.string(),
                                  rgb_of(colours.table_bgr), rgb_of(colours.triangle_bgr),
                                  how_many(measured->size(), "frame")));
}

int run_track_calibrate(const TrackOptions& options) {
  cutout::Calibration calibration(calibration_settings(options));
  const auto frames = take_frames(options, calibration);
  if (!frames) return track_failed(frames.error());
  const auto found = calibration.finish();
  if (!found) return track_failed({fmt::format("{}: {}", options.source, found.error().message)});
  for (const std::string& note : found->notes) tell(note);
  if (const auto written = cutout::write_table_view(found->view, options.calibrate); !written)
    return track_failed(written.error());
  if (!options.json) return print_answer(calibration_text(options, *found, *frames));
  const Json json = {{"view", options.calibrate.string()},
                     {"pictures", *frames},
                     {"sights", found->sights},
                     {"lens_error_px", found->lens_error},
                     {"table_mm", {found->view.table_width(), found->view.table_height()}},
                     {"camera_height_mm", found->view.camera_height()},
                     {"notes", found->notes}};
  return print_answer(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

int run_track_sheet(const TrackOptions& options) {
  cutout::KnownTriangles known;
  if (!options.known.empty()) {
    auto read = cutout::read_known_triangles(options.known);
    if (!read) return track_failed(read.error());
    known = std::move(*read);
  } else {
    known = cutout::usual_triangles(int(options.triangles));
  }
  for (const std::string& warning : cutout::warnings_of(known)) tell(warning);
  const cutout::Sheet sheet = cutout::make_sheet({}, known);
  for (const std::string& note : sheet.notes) tell(note);
  auto file = io::NewFile::create(options.sheet);
  if (!file) return track_failed(file.error());
  file->write(sheet.pdf);
  if (const auto written = file->finish(); !written) return track_failed(written.error());
  return print_answer(fmt::format("{}: {} pages of A4; print at true size, and check the line of 100 mm\n",
                                  options.sheet.string(), sheet.pages));
}

int run_track_learn(const TrackOptions& options) {
  cutout::KnownTriangles known;
  std::error_code error;
  if (std::filesystem::exists(options.known, error)) {
    auto read = cutout::read_known_triangles(options.known);
    if (!read) return track_failed(read.error());
    known = std::move(*read);
  }
  for (const cutout::KnownTriangle& triangle : known.triangles)
    if (triangle.id == options.id)
      return track_failed(
          {fmt::format("{}: there is a triangle '{}' already", options.known.string(), options.id)});
  const auto measured = measured_in_frames<cutout::LearntTriangle>(options, cutout::learn_triangle);
  if (!measured) return track_failed(measured.error());
  const cutout::LearntTriangle learnt = cutout::middle_of(*measured);
  known.triangles.push_back({options.id, learnt.base_angle, learnt.height, options.cell});
  // The text is read as anybody would read it, before it takes the place of the list.
  const std::string text = cutout::known_triangles_text(known);
  if (const auto good = cutout::read_known_triangles(text, options.known.string()); !good)
    return track_failed(good.error());
  auto file = io::NewFile::create(options.known);
  if (!file) return track_failed(file.error());
  file->write(text);
  if (const auto written = file->finish(); !written) return track_failed(written.error());
  for (const std::string& warning : cutout::warnings_of(known)) tell(warning);
  return print_answer(fmt::format(
      "{}: '{}' has base angles of {:.2f} degrees and a height of {:.2f} mm, by {}\n", options.known.string(),
      options.id, learnt.base_angle * kRadianInDegrees, learnt.height, how_many(measured->size(), "frame")));
}

}  // namespace icome::apps
