#include "cutout/synth/synthetic_table.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cutout/source/picture_bytes.h"
#include "cutout/synth/hand_shape.h"
#include "cutout/synth/motion.h"
#include "cutout/synth/sensor.h"
#include "cutout/synth/synthetic_board.h"
#include "cutout/synth/synthetic_camera.h"
#include "io/file_bytes.h"

namespace icome::cutout {
namespace {

constexpr double kPenumbra = 1.2;       // mm, of a triangle's shadow
constexpr double kHandHeight = 15.0;    // mm above the faces
constexpr double kHandPenumbra = 14.0;  // mm
constexpr double kPatchReach = 5.0;     // mm to both sides of an edge that is covered
constexpr double kRimWidth = 0.6;       // mm of a face's border, which catches the light
constexpr double kSlowest = 0.3;        // rad/s, of patches that wander along edges
constexpr int kShutterSteps = 7;
constexpr std::uint64_t kLargestPhoto = 64'000'000;  // bytes

const base::Vector2 kTowardsShadow(0.55, 0.4);  // mm on the table for each mm of height

double hash_share(std::uint64_t seed) { return base::Random(seed).uniform(); }

/// Smooth noise of wavelength 1, from -1 to 1.
double value_noise(const base::Vector2& place, std::uint64_t seed) {
  const double fx = std::floor(place.x()), fy = std::floor(place.y());
  const auto corner = [&](int i, int k) {
    const auto column = static_cast<std::uint64_t>(std::int64_t(fx) + i);
    const auto row = static_cast<std::uint64_t>(std::int64_t(fy) + k);
    return 2.0 * hash_share(seed ^ (column * 0x9e3779b97f4a7c15ULL) ^ (row * 0xc2b2ae3d27d4eb4fULL)) - 1.0;
  };
  const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
  const double u = smooth(place.x() - fx), v = smooth(place.y() - fy);
  return (corner(0, 0) * (1 - u) + corner(1, 0) * u) * (1 - v) +
         (corner(0, 1) * (1 - u) + corner(1, 1) * u) * v;
}

double soft_step(double distance, double width) {
  const double t = std::clamp(0.5 - distance / width, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

void cover(LinearColour& under, const LinearColour& over, double share, double light) {
  for (std::size_t i = 0; i < 3; ++i) under[i] = float((1.0 - share) * under[i] + share * light * over[i]);
}

void darken(LinearColour& colour, double by) {
  for (float& channel : colour) channel = float(channel * (1.0 - by));
}

using Polygon = std::vector<base::Vector2>;

/// The convex outline of points (Andrew 1979).
Polygon hull_of(Polygon points) {
  std::ranges::sort(points, [](const base::Vector2& a, const base::Vector2& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  const auto turn = [](const base::Vector2& o, const base::Vector2& a, const base::Vector2& b) {
    return (a.x() - o.x()) * (b.y() - o.y()) - (a.y() - o.y()) * (b.x() - o.x());
  };
  Polygon hull;
  for (const bool lower : {true, false}) {
    const std::size_t first = hull.size();
    for (const base::Vector2& point : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    if (lower) std::ranges::reverse(points);
  }
  return hull;
}

/// A convex outline in a plane, whose distances are told in pixels.
class Outline2 {
 public:
  /// `mm_from_pixels`: how far a pixel reaches there.
  Outline2(const Polygon& corners, const Eigen::Matrix2d& mm_from_pixels) {
    base::Vector2 middle = base::Vector2::Zero();
    for (const base::Vector2& corner : corners) middle += corner / double(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const base::Vector2 along = corners[(i + 1) % corners.size()] - corners[i];
      base::Vector2 normal = base::Vector2(along.y(), -along.x()).normalized();
      if (normal.dot(middle - corners[i]) > 0) normal = -normal;
      const double mm_of_pixel = (mm_from_pixels.transpose() * normal).norm();
      sides_.push_back({normal, normal.dot(corners[i]), 1.0 / mm_of_pixel});
    }
  }
  /// From the nearest side's line, below zero inside.
  double pixels_from(const base::Vector2& mm) const {
    double most = -1e9;
    for (const Side& side : sides_)
      most = std::max(most, (side.normal.dot(mm) - side.offset) * side.pixels_of_mm);
    return most;
  }
  double mm_from(const base::Vector2& mm) const {
    double most = -1e9;
    for (const Side& side : sides_) most = std::max(most, side.normal.dot(mm) - side.offset);
    return most;
  }

 private:
  struct Side {
    base::Vector2 normal;
    double offset;
    double pixels_of_mm;
  };
  std::vector<Side> sides_;
};

/// Something that covers part of an edge: a box along it.
struct Patch {
  base::Vector2 middle, along;  // mm; unit vector
  double half;                  // mm along the edge
};

double from_patch(const Patch& patch, const base::Vector2& mm) {
  constexpr double kRound = 1.5;
  const base::Vector2 way = mm - patch.middle;
  const double across = std::abs(way.x() * patch.along.y() - way.y() * patch.along.x());
  const base::Vector2 beyond(std::abs(way.dot(patch.along)) - patch.half + kRound,
                             across - kPatchReach + kRound);
  return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff()) - kRound;
}

/// A part of the frame.
struct PixelBox {
  int left, top, right, bottom;  // right and bottom do not belong to it
};

std::vector<std::unique_ptr<HandShape>> hands_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  std::error_code error;
  if (!folder.empty())
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (entry.path().extension() == ".png") paths.push_back(entry.path());
  std::ranges::sort(paths);
  std::vector<std::unique_ptr<HandShape>> hands;
  for (const std::filesystem::path& path : paths) {
    const auto bytes = io::read_bytes(path, kLargestPhoto);
    if (!bytes) continue;
    auto image = decode_png_with_opacity(*bytes, path.string());
    if (image && image->width > 16 && image->height > 16) hands.push_back(photo_hand(std::move(*image)));
  }
  return hands;
}

}  // namespace

struct SyntheticTable::Parts {
  SyntheticOptions options;
  SyntheticCamera camera;
  std::vector<std::array<float, 2>> slopes;  // of each pixel's ray
  LinearPicture background;
  std::vector<SyntheticScene> scenes;  // where triangles move
  std::vector<std::unique_ptr<HandShape>> hands;
  std::size_t photos = 0;

  explicit Parts(SyntheticOptions given)
      : options(std::move(given)),
        camera(SyntheticCamera::over_table(options.width, options.height, options.table_width,
                                           options.table_height, options.thickness, options.tilt)) {
    slopes.reserve(std::size_t(options.width) * std::size_t(options.height));
    for (int y = 0; y < options.height; ++y)
      for (int x = 0; x < options.width; ++x) {
        const base::Vector2 slope = camera.slope(base::Vector2(x, y));
        slopes.push_back({float(slope.x()), float(slope.y())});
      }
    paint_background();
    if (options.moving) scenes = moving_scenes(options);
    if (!options.hands) return;
    hands = hands_of(options.photos);
    photos = hands.size();
    if (hands.empty())
      for (int i = 0; i < 5; ++i) hands.push_back(drawn_hand(i));
  }

  base::Vector2 seen_at(int x, int y, double z) const {
    const auto& slope = slopes[std::size_t(y) * std::size_t(options.width) + std::size_t(x)];
    return camera.place().head<2>() + base::Vector2(slope[0], slope[1]) * (z - camera.place().z());
  }

  /// Light falls off from the lamp's corner, and to the lens' border.
  double light_at(int x, int y, const base::Vector2& mm) const {
    const double across = mm.x() / options.table_width, down = mm.y() / options.table_height;
    const base::Vector2 aside(2.0 * x / options.width - 1.0, 2.0 * y / options.height - 1.0);
    return (1.08 - 0.22 * across - 0.16 * down) * (1.0 - 0.08 * aside.squaredNorm());
  }

  void paint_background() {
    background = {options.width, options.height, {}};
    background.pixels.resize(std::size_t(options.width) * std::size_t(options.height));
    const LinearColour red = linear_colour(186, 38, 44);
    const LinearColour floor = linear_colour(104, 100, 94);
    const Eigen::Matrix2d scale =
        mm_from_pixels({0.5 * options.table_width, 0.5 * options.table_height}, options.thickness);
    const Outline2 table({{0, 0},
                          {options.table_width, 0},
                          {options.table_width, options.table_height},
                          {0, options.table_height}},
                         scale);
    for (int y = 0; y < options.height; ++y)
      for (int x = 0; x < options.width; ++x) {
        const base::Vector2 mm = seen_at(x, y, options.thickness);
        const double grain = 0.05 * value_noise(mm / 45.0, options.seed ^ 1U) +
                             0.04 * value_noise(mm / 6.0, options.seed ^ 2U) +
                             0.03 * value_noise(mm / 1.3, options.seed ^ 3U);
        const double light = light_at(x, y, mm);
        LinearColour& pixel = background.at(x, y);
        cover(pixel, floor, 1.0, light * (1.0 + 4.0 * grain));
        cover(pixel, red, std::clamp(0.5 - table.pixels_from(mm), 0.0, 1.0), light * (1.0 + grain));
      }
  }

  /// The width of a pixel at a place of the plane of that height.
  Eigen::Matrix2d mm_from_pixels(const base::Vector2& mm, double z) const {
    constexpr double kStep = 0.5;
    Eigen::Matrix2d pixels;
    for (int axis = 0; axis < 2; ++axis) {
      const base::Vector2 step = kStep * base::Vector2::Unit(axis);
      const base::Vector2 from = mm - step, to = mm + step;
      pixels.col(axis) =
          (camera.project({to.x(), to.y(), z}) - camera.project({from.x(), from.y(), z})) / (2 * kStep);
    }
    return pixels.inverse();
  }

  PixelBox box_around(const Polygon& mm, double z) const {
    constexpr double kMargin = 4.0;
    base::Vector2 least(1e9, 1e9), most(-1e9, -1e9);
    for (const base::Vector2& point : mm) {
      const base::Vector2 pixel = camera.project({point.x(), point.y(), z});
      least = least.cwiseMin(pixel);
      most = most.cwiseMax(pixel);
    }
    const auto limited = [](double at, int most_at) { return int(std::clamp(at, 0.0, double(most_at))); };
    return {limited(least.x() - kMargin, options.width), limited(least.y() - kMargin, options.height),
            limited(most.x() + kMargin + 1, options.width), limited(most.y() + kMargin + 1, options.height)};
  }

  template <typename Paint>
  void for_pixels(const PixelBox& box, const Paint& paint) const {
    for (int y = box.top; y < box.bottom; ++y)
      for (int x = box.left; x < box.right; ++x) paint(x, y);
  }

  static Polygon polygon_of(const std::array<base::Vector2, 3>& corners) {
    return {corners.begin(), corners.end()};
  }

  bool is_near_table(const TrianglePose& pose) const { return pose.centroid.x() > -options.table_width; }

  void paint_shadow(LinearPicture& picture, const KnownTriangle& triangle, const TrianglePose& pose) const {
    Polygon dark = polygon_of(synthetic_corners(triangle, pose));
    for (std::size_t i = 0; i < 3; ++i) dark.push_back(dark[i] + kTowardsShadow * options.thickness);
    const Outline2 outline(hull_of(dark), Eigen::Matrix2d::Identity());
    for_pixels(box_around(dark, options.thickness), [&](int x, int y) {
      const double distance = outline.mm_from(seen_at(x, y, options.thickness));
      if (distance < kPenumbra) darken(picture.at(x, y), options.shadow * soft_step(distance, 2 * kPenumbra));
    });
  }

  void paint_triangle(LinearPicture& picture, const KnownTriangle& triangle, const TrianglePose& pose) const {
    const Polygon face = polygon_of(synthetic_corners(triangle, pose));
    Polygon all = face;
    // Corners on the table, as they are seen in the plane of the faces.
    const double share = -camera.place().z() / (options.thickness - camera.place().z());
    for (const base::Vector2& corner : face)
      all.push_back(camera.place().head<2>() + (corner - camera.place().head<2>()) * share);
    const Eigen::Matrix2d scale = mm_from_pixels(pose.centroid, 0.0);
    const Outline2 outline(hull_of(all), scale);
    const Outline2 top(face, scale);
    const LinearColour blue = linear_colour(28, 74, 172);
    const LinearColour wall = linear_colour(18, 50, 122);
    for_pixels(box_around(all, 0.0), [&](int x, int y) {
      const base::Vector2 mm = seen_at(x, y, 0.0);
      const double whole = std::clamp(0.5 - outline.pixels_from(mm), 0.0, 1.0);
      if (whole <= 0) return;
      LinearColour& pixel = picture.at(x, y);
      const double light = light_at(x, y, mm);
      const double grain = 0.03 * value_noise((mm - pose.centroid) / 9.0, options.seed ^ 4U);
      const double rim = 0.12 * soft_step(-top.mm_from(mm) - kRimWidth, kRimWidth);
      // One share of the pixel each for table, wall and face: painted one over the other they would add up.
      const double face_share = std::clamp(0.5 - top.pixels_from(mm), 0.0, whole);
      for (std::size_t i = 0; i < 3; ++i)
        pixel[i] = float((1.0 - whole) * pixel[i] + light * ((whole - face_share) * wall[i] +
                                                             face_share * (1.0 + grain + rim) * blue[i]));
    });
  }

  std::vector<Patch> patches_of(const SyntheticScene& scene, int number, double time) const {
    std::vector<Patch> patches;
    if (options.occlude <= 0) return patches;
    const double share = std::min(1.0, options.occlude);
    for (std::size_t i = 0; i < scene.poses.size(); ++i) {
      base::Random random(options.seed ^ (0x70617463ULL + i * 0x9e3779b97f4a7c15ULL) ^
                          (options.moving ? 0 : std::uint64_t(number) << 20U));
      random.bits();
      const auto corners = synthetic_corners(options.known.triangles[i], scene.poses[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        const base::Vector2 from = corners[k];
        const double length = (corners[(k + 1) % 3] - from).norm();
        const base::Vector2 along = (corners[(k + 1) % 3] - from) / length;
        const int pieces = random.uniform() < 0.5 ? 1 : 2;
        for (int piece = 0; piece < pieces; ++piece) {
          const double phase = random.uniform(0, 2 * std::numbers::pi);
          const double pace = options.moving ? random.uniform(kSlowest, 4 * kSlowest) : 0.0;
          const double free = options.moving ? 0.5 + 0.5 * std::sin(phase + pace * time) : random.uniform();
          const double at = (piece + share / 2 + (1 - share) * free) / pieces;
          patches.push_back({from + along * (length * at), along, 0.5 * length * share / pieces});
        }
      }
    }
    return patches;
  }

  void paint_patch(LinearPicture& picture, const Patch& patch, int tone) const {
    const base::Vector2 across(-patch.along.y(), patch.along.x());
    Polygon corners;
    for (const double i : {-1.0, 1.0})
      for (const double k : {-1.0, 1.0})
        corners.push_back(patch.middle + patch.along * (i * patch.half) + across * (k * kPatchReach));
    const double pixels_of_mm = 1.0 / std::sqrt(std::abs(mm_from_pixels(patch.middle, 0.0).determinant()));
    const LinearColour skin = skin_tone(tone);
    for_pixels(box_around(corners, 0.0), [&](int x, int y) {
      const base::Vector2 mm = seen_at(x, y, 0.0);
      const double distance = from_patch(patch, mm);
      const double share = std::clamp(0.5 - distance * pixels_of_mm, 0.0, 1.0);
      const double round = 0.65 + 0.35 * std::clamp(-distance / kPatchReach, 0.0, 1.0);
      if (share > 0) cover(picture.at(x, y), skin, share, light_at(x, y, mm) * round);
    });
  }

  void paint_hand(LinearPicture& picture, const SyntheticHand& hand, bool shadow) const {
    if (hands.empty()) return;
    const HandShape& shape = *hands[std::size_t(hand.look) % hands.size()];
    const double pixels_of_mm =
        1.0 / std::sqrt(std::abs(mm_from_pixels(hand.grip, -kHandHeight).determinant()));
    for_pixels({0, 0, options.width, options.height}, [&](int x, int y) {
      const base::Vector2 mm = seen_at(x, y, shadow ? 0.0 : -kHandHeight);
      const base::Vector2 place =
          in_hand(hand, shadow ? base::Vector2(mm - kTowardsShadow * kHandHeight) : mm);
      constexpr double kFarthestAside = 200.0, kFarthestAhead = 120.0;
      if (place.x() > kFarthestAhead || std::abs(place.y()) > kFarthestAside) return;
      const HandPoint point = shape.at(place);
      if (shadow) {
        if (point.distance < kHandPenumbra)
          darken(picture.at(x, y), options.shadow * soft_step(point.distance, 2 * kHandPenumbra));
        return;
      }
      const double share = std::clamp(0.5 - point.distance * pixels_of_mm, 0.0, 1.0);
      if (share > 0) cover(picture.at(x, y), point.colour, share, light_at(x, y, mm));
    });
  }

  LinearPicture painted(const SyntheticScene& scene, int number, double time) const {
    LinearPicture picture = background;
    const auto& known = options.known.triangles;
    for (std::size_t i = 0; i < scene.poses.size(); ++i)
      if (is_near_table(scene.poses[i])) paint_shadow(picture, known[i], scene.poses[i]);
    for (std::size_t i = 0; i < scene.poses.size(); ++i)
      if (is_near_table(scene.poses[i])) paint_triangle(picture, known[i], scene.poses[i]);
    for (const SyntheticHand& hand : scene.hands) paint_hand(picture, hand, true);
    const std::vector<Patch> patches = patches_of(scene, number, time);
    for (std::size_t i = 0; i < patches.size(); ++i) paint_patch(picture, patches[i], int(i / 7));
    for (const SyntheticHand& hand : scene.hands) paint_hand(picture, hand, false);
    return picture;
  }

  /// The scene of a frame, and between frames where the shutter is open longer.
  SyntheticScene scene_at(int number) const {
    if (!options.moving) return still_scene(options, number);
    return scenes.empty() ? SyntheticScene{} : scenes[std::size_t(number) % scenes.size()];
  }

  SyntheticScene scene_between(int number, double frames) const {
    const SyntheticScene here = scene_at(number);
    const int beside = std::clamp(number + (frames < 0 ? -1 : 1), 0, options.frames - 1);
    if (!options.moving || beside == number) return here;
    const SyntheticScene there = scene_at(beside);
    SyntheticScene between = here;
    const double share = std::abs(frames);
    for (std::size_t i = 0; i < here.poses.size(); ++i) {
      between.poses[i].centroid += share * (there.poses[i].centroid - here.poses[i].centroid);
      between.poses[i].angle +=
          share * std::remainder(there.poses[i].angle - here.poses[i].angle, 2 * std::numbers::pi);
    }
    for (std::size_t i = 0; i < here.hands.size(); ++i) {
      between.hands[i].grip += share * (there.hands[i].grip - here.hands[i].grip);
      between.hands[i].angle +=
          share * std::remainder(there.hands[i].angle - here.hands[i].angle, 2 * std::numbers::pi);
    }
    return between;
  }

  LinearPicture exposed(int number) const {
    const double time = number / options.rate;
    if (!(options.exposure > 0)) return painted(scene_at(number), number, time);
    LinearPicture sum;
    for (int i = 0; i < kShutterSteps; ++i) {
      const double seconds = options.exposure * ((i + 0.5) / kShutterSteps - 0.5);
      const LinearPicture now = painted(scene_between(number, seconds * options.rate), number, time);
      if (i == 0) {
        sum = now;
        continue;
      }
      for (std::size_t k = 0; k < sum.pixels.size(); ++k)
        for (std::size_t channel = 0; channel < 3; ++channel)
          sum.pixels[k][channel] += now.pixels[k][channel];
    }
    for (LinearColour& pixel : sum.pixels)
      for (float& channel : pixel) channel /= float(kShutterSteps);
    return sum;
  }

  Made developed_of(const LinearPicture& picture, int number) const {
    Made made;
    const SensorSettings sensor = {options.blur, options.noise, options.light, options.jpeg_quality};
    made.frame =
        developed(picture, sensor, options.seed * 0x9e3779b97f4a7c15ULL + std::uint64_t(number), &made.jpeg);
    made.truth.time = made.frame.time = number / options.rate;
    return made;
  }
};

KnownTriangles usual_triangles(int count) {
  // Base angles far from 60 degrees; all of the first size have one area, the next six are larger, and so on.
  constexpr std::array<double, 6> kAngles = {70, 45, 76, 38, 52, 66};
  constexpr std::array<double, 5> kSizes = {1.0, 1.35, 0.75, 1.7, 0.55};
  constexpr double kArea = 2200.0;  // mm^2
  constexpr double kDegree = std::numbers::pi / 180.0;
  KnownTriangles known;
  for (std::size_t i = 0; i < std::size_t(std::max(0, count)); ++i) {
    const std::size_t size = i / kAngles.size();
    const double angle = (kAngles[i % kAngles.size()] + 3.1 * double(size / kSizes.size())) * kDegree;
    const double height = kSizes[size % kSizes.size()] * std::sqrt(kArea * std::tan(std::min(angle, 1.4)));
    known.triangles.push_back({fmt::format("t{}", i + 1), std::min(angle, 1.4), height, ""});
  }
  return known;
}

base::Result<void> check(const SyntheticOptions& options) {
  const auto outside = [](double value, double least, double most) {
    return !(value >= least && value <= most);
  };
  if (outside(options.width, 1, 8192) || outside(options.height, 1, 8192))
    return base::fail(fmt::format("frames of {} x {} pixels cannot be made; choose sides from 1 to 8192",
                                  options.width, options.height));
  if (outside(options.table_width, 50, 5000) || outside(options.table_height, 50, 5000))
    return base::fail(fmt::format("a table of {} x {} mm cannot be shown; choose sides from 50 to 5000",
                                  options.table_width, options.table_height));
  if (outside(options.frames, 1, 1'000'000)) return base::fail("choose 1 to 1000000 frames");
  if (outside(options.rate, 0.1, 1000)) return base::fail("choose a rate from 0.1 to 1000 frames/s");
  if (outside(options.occlude, 0, 1))
    return base::fail("the share of edges that is covered lies between 0 and 1");
  if (outside(options.thickness, 0, 50)) return base::fail("triangles are 0 to 50 mm thick");
  if (outside(options.tilt, -0.7, 0.7)) return base::fail("the camera is tilted by 0.7 rad at most");
  if (outside(options.blur, 0, 20) || outside(options.noise, 0, 100) ||
      outside(options.jpeg_quality, 0, 100) || outside(options.light, 0, 100) ||
      outside(options.exposure, 0, 1) || outside(options.shadow, 0, 1))
    return base::fail("blur, noise, light, shadow, exposure or quality of the frames is out of range");
  base::Random random(options.seed);
  const bool all = all_on_table(options, scattered(options, random));
  if (!all)
    return base::fail(fmt::format(
        "{} triangles find no place on a table of {:g} x {:g} mm; choose fewer, or a larger table",
        options.known.triangles.size(), options.table_width, options.table_height));
  return {};
}

SyntheticTable::SyntheticTable(SyntheticOptions options)
    : parts_(std::make_unique<Parts>(std::move(options))) {}
SyntheticTable::~SyntheticTable() = default;
SyntheticTable::SyntheticTable(SyntheticTable&&) noexcept = default;

SyntheticTable::Made SyntheticTable::make(int number) const {
  Made made = parts_->developed_of(parts_->exposed(number), number);
  made.truth.poses = parts_->scene_at(number).poses;
  return made;
}

SyntheticTable::Made SyntheticTable::make_empty(int number) const {
  return parts_->developed_of(parts_->background, number);
}

SyntheticTable::Made SyntheticTable::make_board(int number) const {
  const SyntheticOptions& options = parts_->options;
  const Chessboard board;
  LinearPicture picture = parts_->background;
  paint_board(picture, parts_->camera,
              board_place(number, options.frames, options.table_width, options.table_height,
                          options.thickness, board, options.seed),
              board, 0.9);
  return parts_->developed_of(picture, number);
}

TableView SyntheticTable::view() const {
  const SyntheticOptions& options = parts_->options;
  auto view = TableView::seen_by(parts_->camera.lens(), parts_->camera.pixels_from_faces(), options.width,
                                 options.height, options.table_width, options.table_height);
  if (!view)
    return TableView::whole_frame(options.width, options.height, options.table_width, options.table_height);
  view->set_thickness(options.thickness);
  return *view;
}

std::size_t SyntheticTable::photos() const { return parts_->photos; }

}  // namespace icome::cutout
