#include "cutout/synth/hand_shape.h"

#include <algorithm>
#include <cmath>

#include "base/srgb.h"

namespace icome::cutout {
namespace {

/// A thick line, part of a hand: mm.
struct Finger {
  double ax, ay, bx, by, radius;
};
constexpr std::array<Finger, 13> kFingers = {{{-62, 14, -28, 17, 9.0},
                                              {-28, 17, -2, 5, 8.0},
                                              {-72, -20, -36, -26, 11.5},
                                              {-36, -26, -4, -8, 9.5},
                                              {-62, 28, -22, 29, 9.0},
                                              {-22, 29, 3, 18, 8.0},
                                              {-66, 42, -32, 44, 8.5},
                                              {-32, 44, -10, 36, 7.5},
                                              {-72, 54, -46, 57, 7.5},
                                              {-46, 57, -26, 52, 6.5},
                                              {-112, 16, -78, 18, 37.0},
                                              {-108, -2, -72, -18, 17.0},
                                              {-240, 12, -130, 14, 27.0}}};
constexpr double kWatchFrom = -182, kWatchTo = -160;  // mm along the arm
constexpr double kSleeveFrom = -196, kSleeveRadius = 40, kSleeveMiddle = 11;

double from_finger(const Finger& finger, const base::Vector2& point, double& depth) {
  const base::Vector2 a(finger.ax, finger.ay);
  const base::Vector2 along = base::Vector2(finger.bx, finger.by) - a;
  const double share = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  const double distance = (point - a - share * along).norm() - finger.radius;
  depth = std::max(depth, -distance / finger.radius);
  return distance;
}

LinearColour lit(const LinearColour& colour, double by) {
  return {float(colour[0] * by), float(colour[1] * by), float(colour[2] * by)};
}

/// Round things are darker at their sides, which face away from the lamp.
double round_light(double depth) { return 0.6 + 0.4 * std::sqrt(std::clamp(depth, 0.0, 1.0)); }

/// The blue sleeve, whose hem lies at `from`; folds run around it.
HandPoint sleeve_at(const base::Vector2& mm, double from, double middle) {
  HandPoint point;
  const double aside = std::abs(mm.y() - middle) - kSleeveRadius;
  point.distance = std::max(aside, mm.x() - from);
  const double folds = 1.0 + 0.12 * std::sin(0.11 * mm.x() + 0.05 * mm.y());
  point.colour = lit(linear_colour(38, 58, 140), folds * round_light(-aside / kSleeveRadius));
  return point;
}

class DrawnHand : public HandShape {
 public:
  explicit DrawnHand(int skin) : skin_(skin_tone(skin)) {}

  HandPoint at(const base::Vector2& mm) const override {
    const HandPoint sleeve = sleeve_at(mm, kSleeveFrom, kSleeveMiddle);
    if (sleeve.distance < 0) return sleeve;
    HandPoint point;
    double depth = 0;
    for (const Finger& finger : kFingers)
      point.distance = std::min(point.distance, from_finger(finger, mm, depth));
    point.colour = lit(skin_, round_light(depth));
    if (mm.x() > kWatchFrom && mm.x() < kWatchTo) {
      const bool dial = std::abs(mm.y() - 13) < 10;
      point.colour = dial ? linear_colour(70, 72, 75) : linear_colour(22, 22, 26);
    }
    if (sleeve.distance < point.distance) return sleeve;
    return point;
  }

 private:
  LinearColour skin_;
};

/// A photo, turned so that its arm points along x.
class PhotoHand : public HandShape {
 public:
  explicit PhotoHand(charts::Image photo) : photo_(std::move(photo)) {
    const double w = photo_.width - 1, h = photo_.height - 1;
    const std::array<std::array<base::Vector2, 2>, 4> sides = {
        {{{{0, 0}, {0, h}}}, {{{w, 0}, {w, h}}}, {{{0, 0}, {w, 0}}}, {{{0, h}, {w, h}}}}};
    const std::array<base::Vector2, 4> inwards = {{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    double most = -1;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      base::Vector2 middle;
      const double arm = arm_on(sides[i][0], sides[i][1], middle);
      if (arm <= most) continue;
      most = arm;
      cut_ = middle;
      along_ = inwards[i];
    }
    reach_ = farthest();
    constexpr double kLength = 300.0;  // mm from where the arm is cut to the tips
    scale_ = reach_ / kLength;
  }

  HandPoint at(const base::Vector2& mm) const override {
    constexpr double kSleeveOver = 45.0;  // mm of the arm that it covers
    const HandPoint sleeve = sleeve_at(mm, kSleeveOver - reach_ / scale_, 0.0);
    if (sleeve.distance < 0) return sleeve;
    const base::Vector2 across(-along_.y(), along_.x());
    const base::Vector2 place = cut_ + along_ * (reach_ + mm.x() * scale_) + across * (mm.y() * scale_);
    HandPoint point = sampled(place);
    return sleeve.distance < point.distance ? sleeve : point;
  }

 private:
  /// Opaque length of a side, and its middle.
  double arm_on(const base::Vector2& from, const base::Vector2& to, base::Vector2& middle) const {
    constexpr int kSteps = 400;
    double arm = 0;
    base::Vector2 sum = base::Vector2::Zero();
    for (int i = 0; i <= kSteps; ++i) {
      const base::Vector2 place = from + (to - from) * (double(i) / kSteps);
      const double opacity = photo_.pixel(int(place.x()), int(place.y()))[3] / 255.0;
      arm += opacity;
      sum += opacity * place;
    }
    middle = arm > 0 ? base::Vector2(sum / arm) : base::Vector2(0.5 * (from + to));
    return arm * (to - from).norm();
  }

  double farthest() const {
    double far = 1;
    for (int y = 0; y < photo_.height; y += 2)
      for (int x = 0; x < photo_.width; x += 2)
        if (photo_.pixel(x, y)[3] > 127) far = std::max(far, along_.dot(base::Vector2(x, y) - cut_));
    return far;
  }

  /// Opacity stands for the distance: half of it lies on the outline, a pixel of the photo within it is
  /// clear.
  HandPoint sampled(const base::Vector2& place) const {
    const int x = int(std::floor(place.x())), y = int(std::floor(place.y()));
    if (x < 0 || y < 0 || x + 1 >= photo_.width || y + 1 >= photo_.height) return {};
    const double u = place.x() - x, v = place.y() - y;
    std::array<double, 4> sum{};
    double colour_weight = 0;
    for (const auto& [column, row, weight] : {std::tuple(x, y, (1 - u) * (1 - v)),
                                              {x + 1, y, u * (1 - v)},
                                              {x, y + 1, (1 - u) * v},
                                              {x + 1, y + 1, u * v}}) {
      const std::uint8_t* const pixel = photo_.pixel(column, row);
      const double opacity = weight * pixel[3] / 255.0;
      for (std::size_t i = 0; i < 3; ++i) sum[i] += opacity * base::linear_from_srgb(pixel[i] / 255.0);
      colour_weight += opacity;
      sum[3] += opacity;
    }
    HandPoint point;
    if (colour_weight <= 0) return point;
    point.colour = {float(sum[2] / colour_weight), float(sum[1] / colour_weight),
                    float(sum[0] / colour_weight)};
    point.distance = (0.5 - sum[3]) / scale_;
    return point;
  }

  charts::Image photo_;
  base::Vector2 cut_ = base::Vector2::Zero();  // pixels
  base::Vector2 along_ = base::Vector2::UnitX();
  double reach_ = 1;  // pixels from the cut to the tips
  double scale_ = 1;  // pixels in a mm
};

}  // namespace

LinearColour linear_colour(double red, double green, double blue) {
  return {float(base::linear_from_srgb(blue / 255.0)), float(base::linear_from_srgb(green / 255.0)),
          float(base::linear_from_srgb(red / 255.0))};
}

LinearColour skin_tone(int number) {
  const std::array<std::array<double, 3>, 5> tones = {
      {{224, 172, 145}, {198, 134, 98}, {141, 85, 60}, {245, 200, 175}, {92, 56, 42}}};
  const auto& tone = tones[std::size_t(number) % tones.size()];
  return linear_colour(tone[0], tone[1], tone[2]);
}

std::unique_ptr<HandShape> drawn_hand(int skin) { return std::make_unique<DrawnHand>(skin); }
std::unique_ptr<HandShape> photo_hand(charts::Image photo) {
  return std::make_unique<PhotoHand>(std::move(photo));
}

base::Vector2 in_hand(const SyntheticHand& hand, const base::Vector2& mm) {
  const base::Vector2 along(std::cos(hand.angle), -std::sin(hand.angle));
  const base::Vector2 across(-along.y(), along.x());
  const base::Vector2 way = mm - hand.grip;
  return {way.dot(along), (hand.left ? -1.0 : 1.0) * way.dot(across)};
}

}  // namespace icome::cutout
