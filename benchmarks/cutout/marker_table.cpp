#include "marker_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/aruco.hpp>
#include <vector>

#include "base/random.h"
#include "base/srgb.h"
#include "cutout/synth/sensor.h"

namespace icome::benchmarks {
namespace {

using base::Vector2;

constexpr int kMarkerCells = 8;              // with the black border
constexpr int kAllCells = kMarkerCells + 2;  // with the white one
constexpr double kCoverReach = 5;            // mm to both sides of a side that is covered
constexpr int kMarkerSamples = 4;            // along and across a pixel

cutout::LinearColour light_of(int blue, int green, int red) {
  return {float(base::linear_from_srgb(blue / 255.0)), float(base::linear_from_srgb(green / 255.0)),
          float(base::linear_from_srgb(red / 255.0))};
}

/// A square of cells on the table.
struct PlacedMarker {
  Vector2 centre, right, down;  // unit vectors as printed
  double side;                  // mm, with the white border
  std::array<std::array<bool, kMarkerCells>, kMarkerCells> white;
  std::array<double, 4> covered_from;  // shares of each side where the cover begins
};

std::array<std::array<bool, kMarkerCells>, kMarkerCells> cells_of(int id) {
  static const cv::Ptr<cv::aruco::Dictionary> kFamily =
      cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11);
  cv::Mat drawn;
  cv::aruco::drawMarker(kFamily, id, kMarkerCells * 4, drawn, 1);
  std::array<std::array<bool, kMarkerCells>, kMarkerCells> white;
  for (int row = 0; row < kMarkerCells; ++row)
    for (int column = 0; column < kMarkerCells; ++column)
      white[std::size_t(row)][std::size_t(column)] =
          drawn.at<std::uint8_t>(4 * row + 2, 4 * column + 2) > 127;
  return white;
}

/// Is the place on the cover of a side?
bool is_covered(const PlacedMarker& marker, double u, double v, double occlude) {
  if (occlude <= 0) return false;
  const double half = marker.side / 2 * kMarkerCells / kAllCells;  // of the black square
  const std::array<std::array<double, 2>, 4> along_across = {
      std::array{u + half, v + half}, std::array{v + half, u - half}, std::array{u + half, v - half},
      std::array{v + half, u + half}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double share = along_across[i][0] / (2 * half);
    if (std::abs(along_across[i][1]) < kCoverReach && share > marker.covered_from[i] &&
        share < marker.covered_from[i] + occlude)
      return true;
  }
  return false;
}

void paint_marker(cutout::LinearPicture& picture, const cutout::TableView& view, const PlacedMarker& marker,
                  double occlude) {
  static const cutout::LinearColour kWhite = light_of(225, 228, 230), kBlack = light_of(25, 25, 25),
                                    kSkin = light_of(130, 160, 215);
  const Vector2 middle = view.to_pixel(marker.centre);
  double reach = 0;
  for (const double i : {-1.0, 1.0})
    for (const double k : {-1.0, 1.0}) {
      const Vector2 corner =
          marker.centre + (marker.side / 2 + kCoverReach) * (i * marker.right + k * marker.down);
      reach = std::max(reach, (view.to_pixel(corner) - middle).cwiseAbs().maxCoeff() + 2);
    }
  const int left = std::max(0, int(middle.x() - reach)), top = std::max(0, int(middle.y() - reach));
  const int right = std::min(picture.width - 1, int(middle.x() + reach));
  const int bottom = std::min(picture.height - 1, int(middle.y() + reach));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      cutout::LinearColour sum = {0, 0, 0};
      for (int i = 0; i < kMarkerSamples * kMarkerSamples; ++i) {
        const Vector2 pixel(x - 0.5 + (i % kMarkerSamples + 0.5) / kMarkerSamples,
                            y - 0.5 + (i / kMarkerSamples + 0.5) / kMarkerSamples);
        const Vector2 own = view.to_table(pixel) - marker.centre;
        const double u = own.dot(marker.right), v = own.dot(marker.down);
        cutout::LinearColour colour = picture.at(x, y);
        if (is_covered(marker, u, v, occlude)) {
          colour = kSkin;
        } else if (std::max(std::abs(u), std::abs(v)) < marker.side / 2) {
          const double cell = marker.side / kAllCells;
          const int column = int(std::floor(u / cell + kAllCells / 2.0)) - 1;
          const int row = int(std::floor(v / cell + kAllCells / 2.0)) - 1;
          const bool inside = column >= 0 && row >= 0 && column < kMarkerCells && row < kMarkerCells;
          colour = !inside || marker.white[std::size_t(row)][std::size_t(column)] ? kWhite : kBlack;
        }
        for (std::size_t channel = 0; channel < 3; ++channel)
          sum[channel] += colour[channel] / float(kMarkerSamples * kMarkerSamples);
      }
      picture.at(x, y) = sum;
    }
}

}  // namespace

cutout::Frame marker_frame(const cutout::SyntheticOptions& options, const cutout::TableView& view,
                           const cutout::FrameTruth& truth, int number) {
  cutout::LinearPicture picture;
  picture.width = options.width;
  picture.height = options.height;
  picture.pixels.assign(std::size_t(options.width) * std::size_t(options.height), light_of(38, 32, 185));
  base::Random random(options.seed + std::uint64_t(number));
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    const cutout::KnownTriangle& triangle = options.known.triangles[i];
    PlacedMarker marker;
    marker.centre = truth.poses[i].centroid;
    // As printed, the way up is that to the apex.
    const double angle = truth.poses[i].angle;
    marker.down = {-std::cos(angle), std::sin(angle)};
    marker.right = {std::sin(angle), std::cos(angle)};
    marker.side = triangle.height / std::sqrt(std::tan(triangle.base_angle));
    marker.white = cells_of(int(i));
    for (double& from : marker.covered_from) from = random.uniform(0, 1 - std::min(1.0, options.occlude));
    paint_marker(picture, view, marker, options.occlude);
  }
  const cutout::SensorSettings sensor = {options.blur, options.noise, options.light, options.jpeg_quality};
  return cutout::developed(picture, sensor, options.seed + std::uint64_t(number), nullptr);
}

}  // namespace icome::benchmarks
