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
HandPoint sleeve_at(const base::Vector2& mm, double from, double middle, double radius) {
  HandPoint point;
  const double aside = std::abs(mm.y() - middle) - radius;
  point.distance = std::max(aside, mm.x() - from);
  const double folds = 1.0 + 0.12 * std::sin(0.11 * mm.x() + 0.05 * mm.y());
  point.colour = lit(linear_colour(38, 58, 140), folds * round_light(-aside / radius));
  return point;
}

class DrawnHand : public HandShape {
 public:
  explicit DrawnHand(int skin) : skin_(skin_tone(skin)) {}

  HandPoint at(const base::Vector2& mm) const override {
    const HandPoint sleeve = sleeve_at(mm, kSleeveFrom, kSleeveMiddle, kSleeveRadius);
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

/// A photo, turned so that its arm, from where the photo's border cuts it to the middle of all, points along
/// x.
class PhotoHand : public HandShape {
 public:
  explicit PhotoHand(charts::Image photo) : photo_(std::move(photo)) {
    base::Vector2 middle = base::Vector2::Zero();
    double opaque = 0, opaque_cut = 0;
    for (int y = 0; y < photo_.height; ++y)
      for (int x = 0; x < photo_.width; ++x) {
        if (photo_.pixel(x, y)[3] < 128) continue;
        middle += base::Vector2(x, y);
        ++opaque;
        if (x > 0 && y > 0 && x + 1 < photo_.width && y + 1 < photo_.height) continue;
        cut_ += base::Vector2(x, y);
        ++opaque_cut;
      }
    if (opaque > 0) middle /= opaque;
    cut_ = opaque_cut > 0 ? base::Vector2(cut_ / opaque_cut) : base::Vector2(middle.x(), photo_.height);
    if ((middle - cut_).norm() > 1) along_ = (middle - cut_).normalized();
    find_tip();
    constexpr double kLength = 240.0;  // mm from where the arm is cut to the tips
    scale_ = std::max(1.0, along_.dot(tip_ - cut_)) / kLength;
    sleeve_from_ = along_.dot(cut_ - tip_) / scale_ + 60.0;
    fit_sleeve();
    measure_distances();
  }

  HandPoint at(const base::Vector2& mm) const override {
    const HandPoint sleeve = sleeve_at(mm, sleeve_from_, sleeve_middle_, sleeve_radius_);
    if (sleeve.distance < 0) return sleeve;
    const base::Vector2 across(-along_.y(), along_.x());
    HandPoint point;
    if (mm.x() > sleeve_from_)
      point = sampled(tip_ + along_ * (mm.x() * scale_) + across * (mm.y() * scale_));
    return sleeve.distance < point.distance ? sleeve : point;
  }

 private:
  /// The sleeve is a little wider than the arm at its hem.
  void fit_sleeve() {
    constexpr double kWidest = 200.0, kSlack = 6.0;  // mm
    const base::Vector2 across(-along_.y(), along_.x());
    double least = kWidest, most = -kWidest;
    for (double y = -kWidest; y <= kWidest; y += 1.0) {
      const base::Vector2 place = tip_ + along_ * (sleeve_from_ * scale_) + across * (y * scale_);
      const int column = int(place.x()), row = int(place.y());
      if (column < 0 || row < 0 || column >= photo_.width || row >= photo_.height) continue;
      if (photo_.pixel(column, row)[3] < 128) continue;
      least = std::min(least, y);
      most = std::max(most, y);
    }
    if (most < least) return;
    sleeve_middle_ = 0.5 * (least + most);
    sleeve_radius_ = 0.5 * (most - least) + kSlack;
  }

  /// Distances from the outline by two sweeps (Rosenfeld and Pfaltz 1966), pixels, below zero inside.
  void measure_distances() {
    const int w = photo_.width, h = photo_.height;
    const auto swept = [&](bool inside) {
      std::vector<float> far(std::size_t(w) * std::size_t(h));
      const auto at = [&](int x, int y) -> float& {
        return far[std::size_t(y) * std::size_t(w) + std::size_t(x)];
      };
      const auto relax = [&](int x, int y, int i, int k, float step) {
        if (x + i >= 0 && x + i < w && y + k >= 0 && y + k < h)
          at(x, y) = std::min(at(x, y), at(x + i, y + k) + step);
      };
      for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) at(x, y) = (photo_.pixel(x, y)[3] >= 128) == inside ? 1e6F : 0.0F;
      for (const int way : {-1, 1})
        for (int row = 0; row < h; ++row)
          for (int column = 0; column < w; ++column) {
            const int x = way < 0 ? column : w - 1 - column, y = way < 0 ? row : h - 1 - row;
            relax(x, y, way, 0, 1.0F);
            relax(x, y, 0, way, 1.0F);
            relax(x, y, way, way, 1.4142F);
            relax(x, y, -way, way, 1.4142F);
          }
      return far;
    };
    distances_ = swept(false);
    const std::vector<float> within = swept(true);
    for (std::size_t i = 0; i < distances_.size(); ++i)
      distances_[i] = distances_[i] > 0 ? distances_[i] - 0.5F : 0.5F - within[i];
  }

  void find_tip() {
    double far = -1e9;
    for (int y = 0; y < photo_.height; ++y)
      for (int x = 0; x < photo_.width; ++x) {
        const base::Vector2 place(x, y);
        if (photo_.pixel(x, y)[3] < 128 || along_.dot(place) <= far) continue;
        far = along_.dot(place);
        tip_ = place;
      }
  }

  HandPoint sampled(const base::Vector2& place) const {
    const int x = int(std::floor(place.x())), y = int(std::floor(place.y()));
    if (x < 0 || y < 0 || x + 1 >= photo_.width || y + 1 >= photo_.height) return {};
    const double u = place.x() - x, v = place.y() - y;
    HandPoint point;
    point.distance = 0;
    std::array<double, 3> sum{};
    double opaque = 0;
    const std::array<double, 4> weights = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    for (int i = 0; i < 4; ++i) {
      const int column = x + i % 2, row = y + i / 2;
      const double weight = weights[std::size_t(i)];
      const std::uint8_t* const pixel = photo_.pixel(column, row);
      const double opacity = weight * pixel[3] / 255.0;
      opaque += opacity;
      for (std::size_t channel = 0; channel < 3; ++channel)
        sum[channel] += opacity * base::linear_from_srgb(pixel[channel] / 255.0);
      point.distance +=
          weight * distances_[std::size_t(row) * std::size_t(photo_.width) + std::size_t(column)] / scale_;
    }
    if (opaque > 0) point.colour = {float(sum[2] / opaque), float(sum[1] / opaque), float(sum[0] / opaque)};
    return point;
  }

  charts::Image photo_;
  base::Vector2 cut_ = base::Vector2::Zero();  // where the arm ends, pixels
  base::Vector2 tip_ = base::Vector2::Zero();  // what reaches farthest, pixels
  base::Vector2 along_ = -base::Vector2::UnitY();
  double scale_ = 1;                                                            // pixels in a mm
  double sleeve_middle_ = 0, sleeve_from_ = 0, sleeve_radius_ = kSleeveRadius;  // mm
  std::vector<float> distances_;                                                // from the outline, pixels
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
