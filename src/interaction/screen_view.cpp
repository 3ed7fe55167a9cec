#include "interaction/screen_view.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace icome::interaction {
namespace {

constexpr double kLeastField = 0.05, kMostField = 2.5;  // rad, of a view
constexpr double kNearestEye = 0.05;                    // of the distance at rest, before the window

constexpr std::pair<std::string_view, StereoKind> kStereoNames[] = {{"off", StereoKind::Off},
                                                                    {"anaglyph", StereoKind::Anaglyph},
                                                                    {"side-by-side", StereoKind::SideBySide},
                                                                    {"top-bottom", StereoKind::TopBottom}};

}  // namespace

double field_of(const FishTank& screen) {
  return std::clamp(2.0 * std::atan2(0.5 * screen.size.minCoeff(), screen.distance), kLeastField, kMostField);
}

View with_field(const View& view, double field) {
  View result = usable(view);
  const Vector3 middle = looked_at(result);
  result.distance *= std::tan(0.5 * result.field) / std::tan(0.5 * field);
  result.field = field;
  result.world_from_eye.translation() += middle - looked_at(result);
  return usable(result);
}

View seen_from(const View& view, const Vector3& eye) {
  const View from = usable(view);
  if (!eye.allFinite()) return from;
  const double half = std::tan(0.5 * from.field) * from.distance;
  const double nearest = std::max(kNearestEye * from.distance, half / std::tan(0.5 * kMostField));
  const double distance = std::max(from.distance + eye.z(), nearest);
  View result = from;
  result.world_from_eye.translation() =
      from.world_from_eye * Vector3(eye.x(), eye.y(), distance - from.distance);
  result.distance = distance;
  result.field = 2.0 * std::atan(half / distance);
  result.shift = (from.distance * from.shift - eye.head<2>()) / distance;
  return usable(result);
}

std::optional<StereoKind> stereo_of(std::string_view name) {
  for (const auto& [known, kind] : kStereoNames)
    if (known == name) return kind;
  return std::nullopt;
}

std::string_view name_of(StereoKind kind) { return kStereoNames[std::size_t(kind)].first; }

}  // namespace icome::interaction
