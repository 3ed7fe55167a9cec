#include "cutout/drawn_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/srgb.h"

namespace icome::cutout {

using base::Vector2;

namespace {

DrawnColour light_of(const DrawnColour& colour) {
  return {base::linear_from_srgb(colour.blue / 255), base::linear_from_srgb(colour.green / 255),
          base::linear_from_srgb(colour.red / 255)};
}

/// May a corner of the shape lie in the pixel?
bool near_corner(const std::vector<Vector2>& corners, int x, int y) {
  for (const Vector2& pixel : corners)
    if ((pixel - Vector2(x, y)).cwiseAbs().maxCoeff() < 3) return true;
  return false;
}

}  // namespace

DrawnTable::DrawnTable(const TableView& view, DrawnColour table)
    : view_(view),
      pixels_(std::size_t(view.frame_width()) * std::size_t(view.frame_height()), light_of(table)) {}

template <typename Inside>
void DrawnTable::draw(const std::vector<Vector2>& around, DrawnColour colour, Inside&& inside) {
  const DrawnColour light = light_of(colour);
  std::vector<Vector2> pixels;
  Vector2 least = Vector2::Constant(1e9), most = Vector2::Constant(-1e9);
  for (const Vector2& mm : around) {
    const Vector2 pixel = view_.to_pixel(mm);
    pixels.push_back(pixel);
    least = least.cwiseMin(pixel);
    most = most.cwiseMax(pixel);
  }
  const int left = std::max(0, int(least.x()) - 3),
            right = std::min(view_.frame_width() - 1, int(most.x()) + 3);
  const int top = std::max(0, int(least.y()) - 3),
            bottom = std::min(view_.frame_height() - 1, int(most.y()) + 3);
  // Is the upper left corner of each pixel within?
  const int wide = std::max(0, right - left + 2), high = std::max(0, bottom - top + 2);
  std::vector<int> within(std::size_t(wide) * std::size_t(high));
  const auto corner = [&](int x, int y) -> int& {
    return within[std::size_t(y - top) * std::size_t(wide) + std::size_t(x - left)];
  };
  for (int y = top; y < top + high; ++y)
    for (int x = left; x < left + wide; ++x) corner(x, y) = inside(view_.to_table({x - 0.5, y - 0.5}));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      int in = 0;
      const int corners = corner(x, y) + corner(x + 1, y) + corner(x, y + 1) + corner(x + 1, y + 1);
      if (corners == 4) {
        in = 64;
      } else if (corners > 0 || near_corner(pixels, x, y)) {
        for (int j = 0; j < 64; ++j)
          in += inside(view_.to_table({x - 0.5 + (j % 8 + 0.5) / 8, y - 0.5 + (j / 8 + 0.5) / 8}));
      }
      const double share = in / 64.0;
      DrawnColour& own = pixels_[std::size_t(y) * std::size_t(view_.frame_width()) + std::size_t(x)];
      own.blue += share * (light.blue - own.blue);
      own.green += share * (light.green - own.green);
      own.red += share * (light.red - own.red);
    }
}

void DrawnTable::convex(const std::vector<Vector2>& corners, DrawnColour colour) {
  double area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  const double sense = area > 0 ? 1 : -1;
  draw(corners, colour, [&](const Vector2& mm) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vector2 way = corners[(i + 1) % corners.size()] - corners[i], own = mm - corners[i];
      if (sense * (way.x() * own.y() - way.y() * own.x()) < 0) return false;
    }
    return true;
  });
}

void DrawnTable::triangle(const KnownTriangle& known, const TrianglePose& pose, DrawnColour colour) {
  const auto corners = corners_of(known, pose);
  convex({corners.begin(), corners.end()}, colour);
}

void DrawnTable::disc(const Vector2& centre, double radius, DrawnColour colour) {
  std::vector<Vector2> around;
  for (int i = 0; i < 4; ++i) around.push_back(centre + radius * Vector2(i & 1 ? 1 : -1, i & 2 ? 1 : -1));
  draw(around, colour, [&](const Vector2& mm) { return (mm - centre).squaredNorm() < radius * radius; });
}

Frame DrawnTable::frame(double noise, std::uint64_t seed) const {
  Frame frame;
  frame.width = view_.frame_width();
  frame.height = view_.frame_height();
  frame.bgr.resize(3 * pixels_.size());
  base::Random random(seed);
  std::vector<double> codes(4096);
  for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = 255 * base::srgb_from_linear(double(i) / 4095);
  std::vector<double> one(pixels_.size()), other(pixels_.size());
  const auto at = [&](int x, int y) {
    return std::size_t(std::clamp(y, 0, frame.height - 1)) * std::size_t(frame.width) +
           std::size_t(std::clamp(x, 0, frame.width - 1));
  };
  for (std::size_t channel = 0; channel < 3; ++channel) {
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      one[i] = channel == 0 ? pixels_[i].blue : channel == 1 ? pixels_[i].green : pixels_[i].red;
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x)
        other[at(x, y)] = 0.25 * one[at(x - 1, y)] + 0.5 * one[at(x, y)] + 0.25 * one[at(x + 1, y)];
    for (int y = 0; y < frame.height; ++y)
      for (int x = 0; x < frame.width; ++x) {
        const double light = 0.25 * other[at(x, y - 1)] + 0.5 * other[at(x, y)] + 0.25 * other[at(x, y + 1)];
        const double place = 4095 * std::clamp(light, 0.0, 1.0);
        const std::size_t below = std::min(std::size_t(place), std::size_t(4094));
        const double value = codes[below] + (place - double(below)) * (codes[below + 1] - codes[below]);
        // The sum of four even numbers is near enough to a normal one.
        const std::uint64_t bits = random.bits();
        double sum = 0;
        for (int i = 0; i < 64; i += 16) sum += double(bits >> i & 0xffff) / 65536;
        const double off = noise * std::numbers::sqrt3 * (sum - 2);
        frame.bgr[3 * at(x, y) + channel] = std::uint8_t(std::clamp(value + off + 0.5, 0.0, 255.0));
      }
  }
  return frame;
}

KnownTriangles drawn_triangles(std::size_t count) {
  // Base angles that keep away from 60 degrees and whose corners differ from one another.
  static constexpr double kAngles[] = {40, 68, 48, 74, 54, 35, 79};
  KnownTriangles known;
  for (std::size_t i = 0; i < count; ++i) {
    KnownTriangle triangle;
    triangle.id = std::to_string(i);
    triangle.base_angle = kAngles[i % 7] * std::numbers::pi / 180;
    // Equal areas: narrow ones are higher.
    const double area = 1700.0 + 900.0 * double(i / 7);
    triangle.height = std::sqrt(area * std::tan(triangle.base_angle));
    known.triangles.push_back(triangle);
  }
  return known;
}

std::vector<TrianglePose> scattered(const KnownTriangles& known, const TableView& view,
                                    base::Random& random) {
  std::vector<TrianglePose> poses;
  std::vector<double> reaches;
  for (const KnownTriangle& triangle : known.triangles) {
    const double half_base = triangle.height / std::tan(triangle.base_angle);
    const double reach = std::max(2 * triangle.height / 3, std::hypot(triangle.height / 3, half_base)) + 6;
    for (int attempt = 0; attempt < 5000; ++attempt) {
      TrianglePose pose;
      pose.centroid = {random.uniform(reach, view.table_width() - reach),
                       random.uniform(reach, view.table_height() - reach)};
      pose.angle = random.uniform(-std::numbers::pi, std::numbers::pi);
      bool free = true;
      for (std::size_t i = 0; i < poses.size(); ++i)
        free &= (poses[i].centroid - pose.centroid).norm() > reaches[i] + reach;
      if (!free && attempt < 4999) continue;
      poses.push_back(pose);
      reaches.push_back(reach);
      break;
    }
  }
  return poses;
}

}  // namespace icome::cutout
