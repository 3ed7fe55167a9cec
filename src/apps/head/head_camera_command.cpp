#include "apps/head/head_camera_command.h"

#include <fmt/format.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/terminal.h"
#include "cutout/source/frame_source.h"
#include "headcam/head_camera.h"
#include "io/new_file.h"
#include "io/number_text.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kHeadCameraSeconds = 10.0;  // of a camera

int camera_failed(const base::Error& error) {
  tell(error.message);
  return kFailed;
}

base::Result<headcam::HeadCameraAddress> head_camera_of(const std::string& address) {
  if (headcam::is_head_camera_address(address)) return headcam::parse_head_camera_address(address);
  return base::fail(address +
                    ": a camera is named camera, camera:SOURCE, camera-marker or camera-marker:SOURCE");
}

/// Shows each picture until the source ends, the seconds (of its own clock) are over, or Ctrl-C.
base::Result<void> look_at_head(const std::string& source, std::optional<double> seconds,
                                const std::function<void(const cutout::Frame&)>& look) {
  const auto frames = cutout::open_source(source, {});
  if (!frames) return tl::unexpected(frames.error());
  if (!seconds && (*frames)->is_live()) seconds = kHeadCameraSeconds;
  std::optional<double> began;
  while (!interrupted()) {
    const std::uint64_t damaged = (*frames)->damaged();
    const auto frame = (*frames)->next([] { return interrupted(); });
    if (!frame && (*frames)->damaged() > damaged) {
      tell(frame.error().message);
      continue;
    }
    if (!frame) return tl::unexpected(frame.error());
    if (!*frame) break;
    if (!began) began = (*frame)->time;
    if (seconds && (*frame)->time - *began > *seconds) break;
    look(**frame);
  }
  return {};
}

}  // namespace

int run_head_calibration(const HeadOptions& options) {
  const auto address = head_camera_of(options.calibrate);
  if (!address) return camera_failed(address.error());
  const auto finder = headcam::finder_of(address->camera);
  if (!finder) return camera_failed(finder.error());
  auto out = io::NewFile::create(options.out);
  if (!out) return camera_failed(out.error());
  StatusLine status;
  status.say("Keep still");
  headcam::HeadCalibration calibration;
  const auto looked = look_at_head(address->source, options.seconds, [&](const cutout::Frame& frame) {
    calibration.take(frame.view(), **finder);
  });
  status.clear();
  if (!looked) return camera_failed(looked.error());
  const auto camera = calibration.result(address->camera, options.distance);
  if (!camera) return camera_failed({options.calibrate + ": " + camera.error().message});
  out->write(headcam::head_camera_text(*camera));
  if (const auto finished = out->finish(); !finished) return camera_failed(finished.error());
  const Json json{{"source", address->source},          {"out", options.out.string()},
                  {"pictures", calibration.pictures()}, {"found", calibration.found()},
                  {"focal_widths", camera->focal},      {"size_mm", 1000.0 * camera->size}};
  if (options.json) return print_answer(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return print_answer(
      fmt::format("{}: found in {} of {} pictures, focal length {:.3f} widths of the picture\n",
                  options.out.string(), calibration.found(), calibration.pictures(), camera->focal));
}

int run_head_recording(const HeadOptions& options) {
  const auto address = head_camera_of(options.record);
  if (!address) return camera_failed(address.error());
  const auto finder = headcam::finder_of(address->camera);
  if (!finder) return camera_failed(finder.error());
  auto out = io::NewFile::create(options.out);
  if (!out) return camera_failed(out.error());
  out->write("# t x y z qx qy qz qw: x to the user's right, y up, z from the camera to the user\n");
  StatusLine status;
  status.say("Recording");
  int pictures = 0, found = 0;
  const auto looked = look_at_head(address->source, options.seconds, [&](const cutout::Frame& frame) {
    ++pictures;
    const auto seen = (*finder)->find(frame.view());
    if (!seen) return;
    ++found;
    const base::Vector3 place = headcam::place_of(*seen, frame.width, frame.height, address->camera);
    std::string row;
    for (const double number : {frame.time, place.x(), place.y(), place.z()}) {
      io::append_number(row, number);
      row += ' ';
    }
    out->write(row + "0 0 0 1\n");
  });
  status.clear();
  if (!looked) return camera_failed(looked.error());
  if (found == 0)
    return camera_failed({fmt::format("{}: nothing was found in {} pictures", options.record, pictures)});
  if (const auto finished = out->finish(); !finished) return camera_failed(finished.error());
  const Json json{
      {"source", address->source}, {"out", options.out.string()}, {"pictures", pictures}, {"found", found}};
  if (options.json) return print_answer(json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  return print_answer(fmt::format("{}: found in {} of {} pictures\n", options.out.string(), found, pictures));
}

}  // namespace icome::apps
