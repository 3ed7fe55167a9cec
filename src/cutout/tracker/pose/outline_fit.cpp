#include "cutout/tracker/pose/outline_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "cutout/tracker/edges/nearest_pixel.h"

namespace icome::cutout {
namespace {

constexpr double kGlanceDistance = 3.5;  // pixels to both sides of the outline
constexpr int kGlancePlaces = 9;         // of an edge
constexpr int kPlateau = 4;              // pixels along a row or column from an edge to even colour
constexpr int kNearPlateau = 2;          // where other things lie near
constexpr float kLeastHue = 0.3F;        // by which both sides of an edge differ in hue, 1 for pure colours
constexpr double kMostSamples = 48;      // of an edge
constexpr double kSupportReach = 1.2;    // pixels from the outline to an edge that supports it
constexpr double kWallLight = 0.5;       // of the light of the upper faces, that walls are taken to have
constexpr double kEdgeBlur = 0.9;        // pixels, standard deviation that edges are taken to have
constexpr int kFineWindow = 3;           // pixels
constexpr double kFarthestAlike = 2.5;  // pixels from the outline to edges that all lie within it, or outside
constexpr double kAlike = 0.4;          // pixels by which these edges may differ
constexpr std::size_t kLeastAlike = 3;  // places seen of each edge
constexpr double kLeastShareAlike = 0.6;  // of its places
constexpr double kEdgeNoise = 0.1;  // pixels, of one found edge, for its weight against what is known before

using LinearLight = std::array<float, 256>;

/// Light of a channel, which sRGB has coded.
const LinearLight& linear_light() {
  static const LinearLight kTable = [] {
    LinearLight light;
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = float(base::linear_from_srgb(double(i) / 255));
    return light;
  }();
  return kTable;
}

/// Share of a step's height that a blur of deviation kEdgeBlur leaves at a place beside it, pixels.
double blurred_step(double pixels) { return 0.5 * std::erfc(-pixels / (std::numbers::sqrt2 * kEdgeBlur)); }

/// Distance inwards from the foot of a wall that is seen so many pixels wide to where the light of the
/// triangle is `level`, pixels: wall and face are steps one after the other.
double from_foot(double wide, double level) {
  double least = -3 * kEdgeBlur, most = wide + 3 * kEdgeBlur;
  for (int i = 0; i < 10; ++i) {
    const double middle = (least + most) / 2;
    const double light = kWallLight * blurred_step(middle) + (1 - kWallLight) * blurred_step(middle - wide);
    (light < level ? least : most) = middle;
  }
  return (least + most) / 2;
}

}  // namespace

ColourClass OutlineFit::class_at(double x, double y) const {
  if (!(x > -0.5 && y > -0.5 && x < frame_.width && y < frame_.height)) return ColourClass::Other;
  const int px = nearest_pixel(x), py = nearest_pixel(y);
  if (px >= frame_.width || py >= frame_.height) return ColourClass::Other;
  return colours_->of(frame_.row(py) + 3 * px);
}

OutlineFit::EdgeInFrame OutlineFit::edge_in_frame(const TriangleShape& shape,
                                                  const std::array<Vector2, 3>& corners,
                                                  const std::array<Vector2, 3>& corner_pixels,
                                                  std::size_t edge, double clearance) const {
  const std::size_t next = (edge + 1) % 3;
  EdgeInFrame seen;
  seen.start = corner_pixels[edge];
  seen.end = corner_pixels[next];
  seen.middle = rectifier_->view().to_pixel((corners[edge] + corners[next]) / 2);
  const Vector2 way = seen.end - seen.start;
  seen.length = way.norm();
  seen.inward = Vector2(-way.y(), way.x()) / seen.length;
  if (seen.inward.dot(corner_pixels[(edge + 2) % 3] - seen.start) < 0) seen.inward = -seen.inward;
  // The blue within must be wide enough where an edge is looked for.
  const auto margin = [&](double angle) {
    return (2 + (angle < 1.5 ? clearance / std::tan(angle) : 0.0)) / seen.length;
  };
  seen.from = margin(shape.corner_angles[edge]);
  seen.to = 1 - margin(shape.corner_angles[next]);
  return seen;
}

OutlineEvidence OutlineFit::glance(const TriangleShape& shape, const Placed& placed) const {
  OutlineEvidence evidence;
  const std::array<Vector2, 3> corners = corners_of(shape, placed);
  std::array<Vector2, 3> pixels;
  for (std::size_t i = 0; i < 3; ++i) {
    pixels[i] = rectifier_->view().to_pixel(corners[i]);
    if (!pixels[i].allFinite()) return evidence;
  }
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const EdgeInFrame seen = edge_in_frame(shape, corners, pixels, edge, kGlanceDistance);
    if (!(seen.length > 4 && seen.to > seen.from)) continue;
    const Vector2 bend = seen.middle - (seen.start + seen.end) / 2;
    for (int i = 0; i < kGlancePlaces; ++i) {
      const double t = seen.from + (seen.to - seen.from) * (i + 0.5) / kGlancePlaces;
      const Vector2 at = seen.start + t * (seen.end - seen.start) + 4 * t * (1 - t) * bend;
      const Vector2 within = at + kGlanceDistance * seen.inward, beyond = at - kGlanceDistance * seen.inward;
      const ColourClass in = class_at(within.x(), within.y()), out = class_at(beyond.x(), beyond.y());
      ++evidence.places;
      ++evidence.places_of[edge];
      if (in == ColourClass::Red) {
        ++evidence.contradicted;
      } else if (in == ColourClass::Blue && out == ColourClass::Red) {
        ++evidence.supported;
        ++evidence.supported_of[edge];
      } else if (in == ColourClass::Blue && out == ColourClass::Blue) {
        ++evidence.blue_beyond;
      }
    }
  }
  return evidence;
}

OutlineFit::Outcome OutlineFit::cross(const Vector2& predicted, const Vector2& inward, const Vector2& tangent,
                                      int window, float level, Vector2& found, bool& near) const {
  // Along a row where the edge is steep, else along a column; exactly through the centres of pixels.
  const bool by_row = std::abs(inward.x()) >= std::abs(inward.y());
  const double across = by_row ? predicted.y() : predicted.x();
  if (!(across > -0.5 && across < 1e6)) return Outcome::Unknown;
  const int line = nearest_pixel(across);
  const double slope = by_row ? tangent.x() / tangent.y() : tangent.y() / tangent.x();
  const double middle = by_row ? predicted.x() + slope * (line - predicted.y())
                               : predicted.y() + slope * (line - predicted.x());
  const int lines = by_row ? frame_.height : frame_.width, size = by_row ? frame_.width : frame_.height;
  if (!(middle > -0.5 && middle < 1e6) || line >= lines) return Outcome::Unknown;
  const int centre = nearest_pixel(middle);
  const int reach = window + kPlateau + 2;
  if (centre - reach < 0 || centre + reach >= size) return Outcome::Unknown;
  const std::ptrdiff_t step = by_row ? 3 : std::ptrdiff_t(frame_.row_bytes);
  const std::uint8_t* at = by_row ? frame_.row(line) + 3 * centre : frame_.row(centre) + 3 * line;
  const int side = (by_row ? inward.x() : inward.y()) > 0 ? 1 : -1;
  const std::ptrdiff_t in = side * step;  // from a pixel to the next one inwards
  const auto signal = [&](int i) { return int(at[i * in]) - int(at[i * in + 2]); };

  const auto is_red = [&](int i) { return colours_->of(at + i * in) == ColourClass::Red; };
  const auto is_blue = [&](int i) { return colours_->of(at + i * in) == ColourClass::Blue; };

  const int threshold = colours_->threshold();
  const double ahead = side * (middle - centre);  // of the prediction from the centre, inwards
  int best = kMostWindow + 1, plateau = kPlateau;
  double best_distance = 1e9;
  int last = signal(-window - 1);
  for (int i = -window; i <= window + 1; ++i) {
    const int own = signal(i);
    if (last <= threshold && own > threshold) {
      const double distance = std::abs(i - 0.5 - ahead);
      if (distance < best_distance) {
        const bool near_too = is_red(i - 1 - kNearPlateau) && is_blue(i + kNearPlateau);
        const bool far_too = is_red(i - 1 - kPlateau) && is_blue(i + kPlateau);
        if (near_too) {
          best_distance = distance;
          best = i;
          plateau = far_too ? kPlateau : kNearPlateau;
        }
      }
    }
    last = own;
  }
  if (best > kMostWindow) {
    const ColourClass within = colours_->of(at + kPlateau * in), beyond = colours_->of(at - kPlateau * in);
    if (within == ColourClass::Red) return Outcome::Contradicted;
    return within == ColourClass::Blue && beyond == ColourClass::Blue ? Outcome::BlueBeyond
                                                                      : Outcome::Unknown;
  }
  // A pixel's light is a share of the triangle's and a share of the table's; where the triangle's is a half,
  // there is the edge, however much it is blurred and whatever shadow lies on the table beside it.
  const LinearLight& light = linear_light();
  const auto blue_of = [&](int i) { return light[at[i * in]]; };
  const auto red_of = [&](int i) { return light[at[i * in + 2]]; };
  const float table_blue = blue_of(best - plateau) + blue_of(best - 1 - plateau);
  const float table_red = red_of(best - plateau) + red_of(best - 1 - plateau);
  const float own_blue = blue_of(best + plateau - 1) + blue_of(best + plateau);
  const float own_red = red_of(best + plateau - 1) + red_of(best + plateau);
  const float determinant = own_blue * table_red - own_red * table_blue;
  if (!(determinant > kLeastHue * own_blue * table_red)) return Outcome::Unknown;
  const float scale = 2 / determinant;
  const auto share = [&](int i) { return scale * (blue_of(i) * table_red - red_of(i) * table_blue); };
  int i = best;
  float before = share(i - 1), after = share(i);
  while (i > best - 3 && before > level) after = before, before = share(--i - 1);
  while (i < best + 3 && after <= level) before = after, after = share(++i);
  if (!(before <= level && after > level)) return Outcome::Unknown;
  const double place = centre + side * (i - 1 + (level - before) / (after - before));
  near = plateau != kPlateau;
  found = by_row ? Vector2(place, line) : Vector2(line, place);
  return Outcome::Supported;
}

void OutlineFit::measure(const TriangleShape& shape, const Placed& placed, int window, double spacing,
                         std::span<const Neighbour> neighbours) {
  samples_.clear();
  std::array<Vector2, 3> corners = corners_of(shape, placed);
  // Walls that are seen below the edges move the outline of blue out.
  std::array<float, 3> levels{};
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const Vector2 normal = turned(shape.normals[edge], std::cos(placed.turn), std::sin(placed.turn));
    const Vector2 middle = (corners[edge] + corners[(edge + 1) % 3]) / 2;
    const double wide = std::max(0.0, -normal.dot(rectifier_->view().wall_at(middle))) / pixel_;
    levels[edge] = float(0.5 - 0.25 * std::clamp((wide - 0.5) / 1.5, 0.0, 1.0));
    walls_[edge] = (wide > 0 ? pixel_ * (wide - from_foot(wide, levels[edge])) : 0.0) + pixel_ * spread_;
  }
  std::array<Vector2, 3> pixels;
  for (std::size_t i = 0; i < 3; ++i) {
    pixels[i] = rectifier_->view().to_pixel(corners[i]);
    if (!pixels[i].allFinite()) return;
  }
  for (std::size_t edge = 0; edge < 3; ++edge) {
    const EdgeInFrame seen = edge_in_frame(shape, corners, pixels, edge, kNearPlateau + 1);
    if (!(seen.length > 6 && seen.to > seen.from)) continue;
    const double span = (seen.to - seen.from) * seen.length;
    const int count = std::max(1, int(std::min(span / spacing, kMostSamples)));
    const Vector2 way = seen.end - seen.start, bend = seen.middle - (seen.start + seen.end) / 2;
    const Vector2 out = -(walls_[edge] / pixel_) * seen.inward;
    for (int i = 0; i < count; ++i) {
      const double t = seen.from + (seen.to - seen.from) * (i + 0.5) / count;
      const Vector2 at = seen.start + t * way + 4 * t * (1 - t) * bend + out;
      Sample sample;
      sample.edge = int(edge);
      sample.residual = 0;
      sample.near = false;
      sample.outcome = cross(at, seen.inward, way + 4 * (1 - 2 * t) * bend, window, levels[edge],
                             sample.pixel, sample.near);
      if (sample.outcome == Outcome::Supported)
        sample.place = rectifier_->to_table(sample.pixel.x(), sample.pixel.y());
      if (sample.outcome == Outcome::BlueBeyond) {
        const Vector2 beyond = at - kPlateau * seen.inward;
        const Vector2 place = rectifier_->to_table(beyond.x(), beyond.y());
        for (const Neighbour& neighbour : neighbours)
          if ((neighbour.placed.centroid - place).norm() < neighbour.shape->reach + pixel_ &&
              depth_within(*neighbour.shape, neighbour.placed, place) > -2 * pixel_) {
            sample.outcome = Outcome::Unknown;
            break;
          }
      }
      samples_.push_back(sample);
    }
  }
}

bool OutlineFit::solve(const TriangleShape& shape, Placed& placed, const Placed& from, double reach,
                       int rounds, const PosePrior& prior, base::Matrix3& information) {
  // Iterated weights: Tukey's, which leave out what lies farther than `reach`.
  for (int round = 0; round < rounds; ++round) {
    const double cosine = std::cos(placed.turn), sine = std::sin(placed.turn);
    std::array<Vector2, 3> normals;
    for (std::size_t i = 0; i < 3; ++i) normals[i] = turned(shape.normals[i], cosine, sine);
    base::Matrix3 sum = base::Matrix3::Zero();
    base::Vector3 right = base::Vector3::Zero();
    for (Sample& sample : samples_) {
      if (sample.outcome != Outcome::Supported) continue;
      const std::size_t edge = std::size_t(sample.edge);
      const Vector2& normal = normals[edge];
      const Vector2 own = sample.place - placed.centroid;
      const double residual = normal.dot(own) - shape.offsets[edge] + walls_[edge];
      sample.residual = residual;
      const double share = residual / reach;
      if (std::abs(share) >= 1) continue;
      const double weight = (1 - share * share) * (1 - share * share);
      const base::Vector3 slope(-normal.x(), -normal.y(), -normal.y() * own.x() + normal.x() * own.y());
      sum += weight * slope * slope.transpose();
      right -= weight * residual * slope;
    }
    const double noise = kEdgeNoise * pixel_;
    information = sum / (noise * noise);
    base::Matrix3 left = information;
    const double place_weight = 1 / (prior.place * prior.place), turn_weight = 1 / (prior.turn * prior.turn);
    left.diagonal() += base::Vector3(place_weight, place_weight, turn_weight);
    right /= noise * noise;
    right.head<2>() -= place_weight * (placed.centroid - from.centroid);
    right.z() -= turn_weight * (placed.turn - from.turn);
    const base::Vector3 step = left.inverse() * right;
    if (!step.allFinite()) return false;
    placed.centroid += step.head<2>();
    placed.turn += step.z();
  }
  return true;
}

std::optional<double> OutlineFit::common_inwards() {
  std::array<double, 3> middles{};
  for (std::size_t edge = 0; edge < 3; ++edge) {
    residuals_.clear();
    std::size_t samples = 0;
    for (const Sample& sample : samples_) {
      if (std::size_t(sample.edge) != edge) continue;
      ++samples;
      if (sample.outcome == Outcome::Supported && std::abs(sample.residual) < kFarthestAlike * pixel_)
        residuals_.push_back(sample.residual / pixel_);
    }
    if (residuals_.size() < kLeastAlike || double(residuals_.size()) < kLeastShareAlike * double(samples))
      return std::nullopt;
    const auto middle = residuals_.begin() + std::ptrdiff_t(residuals_.size() / 2);
    std::nth_element(residuals_.begin(), middle, residuals_.end());
    middles[edge] = *middle;
  }
  const double mean = (middles[0] + middles[1] + middles[2]) / 3;
  for (const double middle : middles)
    if (std::abs(middle - mean) > kAlike) return std::nullopt;
  return mean;
}

void OutlineFit::judge(const TriangleShape& shape, const Placed& placed, OutlineEvidence& evidence) {
  evidence = {};
  supported_pixels_.clear();
  const double cosine = std::cos(placed.turn), sine = std::sin(placed.turn);
  std::array<Vector2, 3> normals;
  for (std::size_t i = 0; i < 3; ++i) normals[i] = turned(shape.normals[i], cosine, sine);
  double squares = 0;
  for (const Sample& sample : samples_) {
    const std::size_t edge = std::size_t(sample.edge);
    ++evidence.places;
    ++evidence.places_of[edge];
    if (sample.outcome == Outcome::Contradicted) ++evidence.contradicted;
    if (sample.outcome == Outcome::BlueBeyond) ++evidence.blue_beyond;
    if (sample.outcome != Outcome::Supported) continue;
    const double off = normals[edge].dot(sample.place - placed.centroid) - shape.offsets[edge] + walls_[edge];
    if (std::abs(off) > kSupportReach * pixel_) {
      evidence.contradicted += !sample.near;
      continue;
    }
    ++evidence.supported;
    ++evidence.supported_of[edge];
    squares += off * off;
    supported_pixels_.push_back(sample.pixel);
  }
  evidence.rms = evidence.supported ? std::sqrt(squares / evidence.supported) / pixel_ : 0.0;
}

OutlineFitted OutlineFit::fit(const TriangleShape& shape, const Placed& from, double window,
                              const PosePrior& prior, std::span<const Neighbour> neighbours) {
  OutlineFitted fitted;
  fitted.placed = from;
  pixel_ = rectifier_->mm_per_pixel(from.centroid);
  supported_pixels_.clear();
  if (!(pixel_ < 1e3)) return fitted;
  const int wide = std::clamp(int(std::ceil(window)), kFineWindow, kMostWindow);
  if (wide > kFineWindow) {
    measure(shape, fitted.placed, wide, 5, {});
    if (!solve(shape, fitted.placed, from, (wide + 2) * pixel_, 2, prior, fitted.information) ||
        !solve(shape, fitted.placed, from, 3 * pixel_, 2, prior, fitted.information))
      return fitted;
    fitted.inwards = common_inwards();
  }
  for (int round = 0; round < 2; ++round) {
    const Placed before = fitted.placed;
    measure(shape, fitted.placed, kFineWindow, 2, neighbours);
    if (!solve(shape, fitted.placed, from, 2 * pixel_, 1, prior, fitted.information) ||
        !solve(shape, fitted.placed, from, 1 * pixel_, 2, prior, fitted.information))
      return fitted;
    const double moved = (fitted.placed.centroid - before.centroid).norm() +
                         std::abs(fitted.placed.turn - before.turn) * shape.reach;
    if (moved < 1.0 * pixel_) break;
  }
  judge(shape, fitted.placed, fitted.evidence);
  return fitted;
}

}  // namespace icome::cutout
