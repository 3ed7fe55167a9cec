#include "headcam/head_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/near_names.h"
#include "base/parse_number.h"
#include "io/file_bytes.h"
#include "io/toml_tree.h"

namespace icome::headcam {
namespace {

using base::Vector2;
using base::Vector3;

constexpr double kUsualFace = 0.15, kUsualMarker = 0.04;  // m
constexpr double kMillimetre = 0.001;                     // m
constexpr std::string_view kFaceCamera = "camera", kMarkerCamera = "camera-marker";

base::Error camera_fault(const std::string& source, const io::Place& place, const std::string& what) {
  return {fmt::format("{}:{}:{}: {}", source, place.line, place.column, what)};
}

bool is_within(double value, double least, double most) { return value >= least && value <= most; }

/// The name before the source and the settings.
std::string_view kind_of(std::string_view address) { return address.substr(0, address.find_first_of(":?")); }

/// Fails with what is wrong about a setting of an address.
base::Result<void> take_setting(std::string_view key, std::string_view value, HeadCamera& camera) {
  const auto number = [&](double least, double most) -> base::Result<double> {
    const auto read = base::parse_finite(value);
    if (read && is_within(*read, least, most)) return *read;
    return base::fail(fmt::format("{}={} must be a number from {:g} to {:g}", key, value, least, most));
  };
  if (key == "colour") {
    const auto colour = parse_marker_colour(value);
    if (!colour) return tl::unexpected(colour.error());
    camera.colour = *colour;
  } else if (key == "size") {
    const auto size = number(HeadCamera::kLeastSize / kMillimetre, HeadCamera::kMostSize / kMillimetre);
    if (!size) return tl::unexpected(size.error());
    camera.size = kMillimetre * *size;
  } else if (key == "field") {
    const auto field = number(10.0, 130.0);
    if (!field) return tl::unexpected(field.error());
    camera.focal = 0.5 / std::tan(0.5 * *field * std::numbers::pi / 180.0);
  } else if (key == "calibration") {
    constexpr std::uint64_t kLongest = 100'000;  // bytes
    const auto text = io::read_bytes(std::string(value), kLongest);
    if (!text) return tl::unexpected(text.error());
    const auto read = read_head_camera(*text, std::string(value));
    if (!read) return tl::unexpected(read.error());
    if (read->target != camera.target)
      return base::fail(
          fmt::format("{} is for {}", value, read->target == HeadTarget::Face ? kFaceCamera : kMarkerCamera));
    camera = *read;
  } else {
    return base::fail(fmt::format("there is no setting \"{}\"{}", key,
                                  base::suggestion(key, {"colour", "size", "field", "calibration"})));
  }
  return {};
}

/// Takes one line of a camera's file.
base::Result<void> take_member(const io::TomlMember& member, const std::string& source, HeadCamera& camera) {
  const io::TomlNode& value = member.value;
  const auto wrong = [&](const std::string& what) {
    return tl::unexpected(camera_fault(source, value.place, fmt::format("{} {}", member.key, what)));
  };
  const auto is_number = [&](double least, double most) {
    return value.kind == io::TomlNode::Kind::Number && is_within(value.number, least, most);
  };
  if (member.key == "target") {
    if (value.text != "face" && value.text != "marker") return wrong("must be \"face\" or \"marker\"");
    camera.target = value.text == "face" ? HeadTarget::Face : HeadTarget::Marker;
  } else if (member.key == "colour") {
    const auto colour = parse_marker_colour(value.text);
    if (!colour) return wrong("is wrong: " + colour.error().message);
    camera.colour = *colour;
  } else if (member.key == "focal_widths") {
    if (!is_number(HeadCamera::kLeastFocal, HeadCamera::kMostFocal))
      return wrong(
          fmt::format("must be a number from {:g} to {:g}", HeadCamera::kLeastFocal, HeadCamera::kMostFocal));
    camera.focal = value.number;
  } else if (member.key == "size_mm") {
    if (!is_number(HeadCamera::kLeastSize / kMillimetre, HeadCamera::kMostSize / kMillimetre))
      return wrong(fmt::format("must be a number from {:g} to {:g}", HeadCamera::kLeastSize / kMillimetre,
                               HeadCamera::kMostSize / kMillimetre));
    camera.size = kMillimetre * value.number;
  } else {
    return tl::unexpected(camera_fault(
        source, member.place,
        fmt::format("a head camera has no key \"{}\"{}", member.key,
                    base::suggestion(member.key, {"target", "colour", "focal_widths", "size_mm"}))));
  }
  return {};
}

}  // namespace

double HeadCamera::size_or_usual() const {
  if (size > 0.0) return size;
  return target == HeadTarget::Face ? kUsualFace : kUsualMarker;
}

/// The camera looks at the user: its right is the user's left.
Vector3 place_of(const HeadInPicture& seen, int width, int height, const HeadCamera& camera) {
  const double focal = camera.focal * width;  // pixels
  const double distance = focal * camera.size_or_usual() / seen.size;
  const Vector2 aside = (seen.centre - 0.5 * Vector2(width, height)) / focal;
  return distance * Vector3(-aside.x(), -aside.y(), 1.0);
}

base::Result<HeadCamera> read_head_camera(std::string_view text, const std::string& source) {
  const auto file = io::parse_toml(text, source);
  if (!file) return tl::unexpected(file.error());
  HeadCamera camera;
  for (const io::TomlMember& member : file->members)
    if (const auto taken = take_member(member, source, camera); !taken) return tl::unexpected(taken.error());
  return camera;
}

std::string head_camera_text(const HeadCamera& camera) {
  const auto& [red, green, blue] = camera.colour;
  std::string text = fmt::format("# A camera that looks for the user's head.\ntarget = \"{}\"\n",
                                 camera.target == HeadTarget::Face ? "face" : "marker");
  if (camera.target == HeadTarget::Marker)
    text += fmt::format("colour = \"#{:02x}{:02x}{:02x}\"\n", red, green, blue);
  return text + fmt::format(
                    "focal_widths = {:.6g}  # focal length, in widths of the picture\n"
                    "size_mm = {:.6g}  # across, of what is looked for\n",
                    camera.focal, camera.size_or_usual() / kMillimetre);
}

bool is_head_camera_address(std::string_view address) {
  return kind_of(address) == kFaceCamera || kind_of(address) == kMarkerCamera;
}

base::Result<HeadCameraAddress> parse_head_camera_address(std::string_view address) {
  HeadCameraAddress result;
  result.camera.target = kind_of(address) == kFaceCamera ? HeadTarget::Face : HeadTarget::Marker;
  std::string_view rest = address.substr(kind_of(address).size());
  std::string_view settings;
  // A question mark may also stand for a letter in the names of pictures.
  if (const std::size_t mark = rest.rfind('?'); mark != rest.npos && rest.find('=', mark) != rest.npos) {
    settings = rest.substr(mark + 1);
    rest = rest.substr(0, mark);
  }
  if (rest.size() > 1) result.source = rest.substr(1);
  while (!settings.empty()) {
    const std::string_view one = settings.substr(0, settings.find('&'));
    settings.remove_prefix(std::min(one.size() + 1, settings.size()));
    const std::size_t equals = std::min(one.find('='), one.size());
    const std::string_view value = one.substr(std::min(equals + 1, one.size()));
    if (const auto taken = take_setting(one.substr(0, equals), value, result.camera); !taken)
      return base::fail(fmt::format("{}: {}", address, taken.error().message));
  }
  return result;
}

base::Result<std::unique_ptr<HeadFinder>> finder_of(const HeadCamera& camera) {
  if (camera.target == HeadTarget::Face) return face_finder();
  return marker_finder(camera.colour);
}

void HeadCalibration::take(const cutout::FrameView& frame, HeadFinder& finder) {
  ++pictures_;
  if (const auto seen = finder.find(frame)) sizes_.push_back(seen->size / frame.width);
}

base::Result<HeadCamera> HeadCalibration::result(const HeadCamera& camera, double distance) const {
  constexpr std::size_t kLeast = 3;  // pictures
  constexpr double kSteady = 0.1;    // of the size, for the middle half of the pictures
  const char* const what = camera.target == HeadTarget::Face ? "a face" : "the marker";
  if (sizes_.size() < kLeast)
    return base::fail(fmt::format("{} was found in {} of {} pictures, of which there must be {}", what,
                                  sizes_.size(), pictures_, kLeast));
  std::vector<double> sorted = sizes_;
  std::sort(sorted.begin(), sorted.end());
  const double middle = sorted[sorted.size() / 2];
  const double spread = sorted[3 * sorted.size() / 4] - sorted[sorted.size() / 4];
  if (spread > kSteady * middle)
    return base::fail(
        fmt::format("the size of {} in the pictures goes to and fro by {:.0f} %: keep still, and see "
                    "that there is light",
                    what, 100.0 * spread / middle));
  HeadCamera result = camera;
  result.size = camera.size_or_usual();
  result.focal = middle * distance / result.size;
  if (!is_within(result.focal, HeadCamera::kLeastFocal, HeadCamera::kMostFocal))
    return base::fail(
        fmt::format("{} of {:g} mm at {:g} m would need a focal length of {:.3g} widths of the picture, "
                    "which no camera has: check the size and the distance",
                    what, result.size / kMillimetre, distance, result.focal));
  return result;
}

}  // namespace icome::headcam
