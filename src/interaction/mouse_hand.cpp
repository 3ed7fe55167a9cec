#include "interaction/mouse_hand.h"

#include <algorithm>
#include <cmath>

namespace icome::interaction {
namespace {

constexpr double kNotch = 0.25;      // of `deepest`, by which a notch of the wheel presses deeper
constexpr double kMostNotches = 12;  // either way
constexpr double kFree = 1.05;       // times as far away, for a notch over nothing

double unit_range(double value) { return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0; }

bool all_numbers(const PickedPoint& picked) {
  return picked.point.allFinite() && picked.normal.allFinite() && std::isfinite(picked.distance) &&
         picked.distance > 0.0;
}

}  // namespace

Vector3 MouseHand::target(const Input& input) {
  const bool usable = input.ray.origin.allFinite() && input.ray.direction.allFinite() &&
                      std::isfinite(input.view_width) && std::isfinite(input.distance) &&
                      input.distance > 0.0;
  if (!usable) return last_;
  const bool pressing = unit_range(input.pressure) > 0.0;
  if (pressing_ && !pressing) extra_ = 0.0;  // the next press begins as this one did
  pressing_ = pressing;
  const double wheel =
      std::isfinite(input.wheel) ? std::clamp(input.wheel, -kMostNotches, kMostNotches) : 0.0;
  const bool something = input.picked && all_numbers(*input.picked);
  const Vector3 wanted = something ? over(*input.picked, input, wheel) : over_nothing(input, wheel);
  if (wanted.allFinite()) last_ = wanted;
  return last_;
}

// The depth is a share of the view's distance, so that it survives zooming.
Vector3 MouseHand::over_nothing(const Input& input, double wheel) {
  depth_ = std::clamp(depth_ * std::pow(kFree, wheel), 1e-3, 1e3);
  return input.ray.origin + depth_ * input.distance * input.ray.direction;
}

Vector3 MouseHand::over(const PickedPoint& picked, const Input& input, double wheel) {
  depth_ = std::clamp(picked.distance / input.distance, 1e-3, 1e3);
  extra_ = std::clamp(extra_ + wheel, -kMostNotches, kMostNotches);
  const double width = input.view_width * picked.distance;
  // Halfway between normal and sight: off a surface seen askew, but still nearly under the mouse.
  const Vector3 above = (picked.normal - input.ray.direction).stableNormalized();
  const Vector3 hover = picked.point + settings_.hover * width * above;
  const double pressure = unit_range(input.pressure) + kNotch * extra_;
  if (!(pressure > 0.0) || !(pressing_ || extra_ > 0.0)) return hover;
  const Vector3 pressed = picked.point - pressure * settings_.deepest * width * picked.normal;
  const double share =
      share_of_press(picked, arrived(picked, input, width), settings_.deepest * width, wheel != 0.0);
  return hover + share * (pressed - hover);
}

/// The share of the press to apply, in [0, 1]. A deep press at a rounded place slides off, is lifted, comes
/// back and slides again: so while the mouse rests it is only eased, slowly enough for the hand to follow.
double MouseHand::share_of_press(const PickedPoint& picked, double arrived, double deepest, bool turned) {
  constexpr double kRests = 0.25;  // of `deepest`: the mouse has not been moved
  constexpr double kEase = 0.03;   // per picture
  if (!pressing_ || (picked.point - rests_at_).norm() > kRests * deepest) share_ = 0.0;
  if (share_ == 0.0) {
    rests_at_ = picked.point;
    if (arrived == 1.0) share_ = 1.0;
    return arrived;
  }
  if (turned) {
    share_ = 1.0;
  } else if (arrived < 1.0) {
    share_ = std::max(share_ * (1.0 - kEase), kEase);
  }
  return share_;
}

/// 1 where the hand may press with all its strength, 0 where it has not arrived yet. It may lag as far as
/// it would press: friction holds it back so far.
double MouseHand::arrived(const PickedPoint& picked, const Input& input, double width) const {
  if (!input.hand || !input.hand->allFinite()) return 1.0;
  const double lag = (*input.hand - picked.point).norm() / (settings_.deepest * width);
  return std::isfinite(lag) ? std::clamp(2.0 - lag, 0.0, 1.0) : 1.0;
}

std::optional<Vector3> DragPlane::moved(const Ray& ray) const {
  constexpr double kReach = 1000.0;  // times the distance to what was grasped
  if (!ray.origin.allFinite() || !ray.direction.allFinite() || !start_.allFinite()) return std::nullopt;
  const double reach = kReach * (start_ - ray.origin).norm();
  const Ray unit{ray.origin, ray.direction.stableNormalized()};
  const auto moved =
      along_ ? moved_along(along_->stableNormalized(), unit, reach) : moved_in_plane(unit, reach);
  return moved && moved->allFinite() ? moved : std::nullopt;
}

std::optional<Vector3> DragPlane::moved_in_plane(const Ray& ray, double reach) const {
  const Vector3 normal = normal_.stableNormalized();
  const double t = normal.dot(start_ - ray.origin) / normal.dot(ray.direction);
  if (!(t > 0.0 && t <= reach)) return std::nullopt;
  return ray.origin + t * ray.direction - start_;
}

/// The movement to the point of the line that is nearest to the ray.
std::optional<Vector3> DragPlane::moved_along(const Vector3& line, const Ray& ray, double reach) const {
  const Vector3 back = start_ - ray.origin;
  const double both = line.dot(ray.direction);
  const Vector3 across = ray.direction - both * line;  // the ray's part square to the line
  const double t = back.dot(across) / across.squaredNorm();
  if (!(t > 0.0 && t <= reach)) return std::nullopt;
  return line.dot(ray.origin + t * ray.direction - start_) * line;
}

/// Unit vector from the centre to the point where the ray meets the plane.
std::optional<Vector3> DragTurn::way_to(const Ray& ray) const {
  constexpr double kFlat = 1e-3;  // sine: rays that lie flatter meet the plane anywhere
  const double climb = axis_.dot(ray.direction);
  if (!(std::abs(climb) > kFlat)) return std::nullopt;
  const double distance = axis_.dot(centre_ - ray.origin) / climb;
  if (!(distance > 0.0)) return std::nullopt;
  const Vector3 way = ray.origin + distance * ray.direction - centre_;
  const double length = way.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
  return Vector3(way / length);
}

std::optional<double> DragTurn::turned(const Ray& ray) const {
  const auto to = way_to(ray);
  if (!from_ || !to) return std::nullopt;
  return std::atan2(axis_.dot(from_->cross(*to)), from_->dot(*to));
}

}  // namespace icome::interaction
