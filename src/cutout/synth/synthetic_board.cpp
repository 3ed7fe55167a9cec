#include "cutout/synth/synthetic_board.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace icome::cutout {
namespace {

constexpr int kSubsamples = 6;                               // of a pixel's side
constexpr double kSheetWidth = 297.0, kSheetHeight = 210.0;  // mm

/// White, black, or nothing beside the sheet: lightness of the sheet at a place of it; below zero beside it.
double sheet_at(const base::Vector2& mm, const Chessboard& board) {
  const base::Vector2 size(board.square * (board.columns + 1), board.square * (board.rows + 1));
  const base::Vector2 place = mm + base::Vector2(board.square, board.square);  // from the board's corner
  const base::Vector2 aside = (place - 0.5 * size).cwiseAbs();
  if (aside.x() > 0.5 * kSheetWidth || aside.y() > 0.5 * kSheetHeight) return -1;
  if (aside.x() > 0.5 * size.x() || aside.y() > 0.5 * size.y()) return 0.85;
  const auto column = std::int64_t(std::floor(place.x() / board.square));
  const auto row = std::int64_t(std::floor(place.y() / board.square));
  return (column + row) % 2 == 0 ? 0.02 : 0.85;
}

}  // namespace

void paint_board(LinearPicture& picture, const SyntheticCamera& camera,
                 const Eigen::Isometry3d& world_from_board, const Chessboard& board, double light) {
  const base::Vector3 normal = world_from_board.linear().col(2);
  const double offset = normal.dot(world_from_board.translation() - camera.place());
  const Eigen::Isometry3d board_from_world = world_from_board.inverse();
  base::Vector2 least(1e9, 1e9), most(-1e9, -1e9);
  for (const double x : {-80.0, kSheetWidth})
    for (const double y : {-80.0, kSheetHeight}) {
      const base::Vector2 pixel = camera.project(world_from_board * base::Vector3(x, y, 0));
      least = least.cwiseMin(pixel);
      most = most.cwiseMax(pixel);
    }
  const auto limited = [](double at, int most_at) { return int(std::clamp(at, 0.0, double(most_at))); };
  for (int y = limited(least.y() - 3, picture.height); y < limited(most.y() + 3, picture.height); ++y)
    for (int x = limited(least.x() - 3, picture.width); x < limited(most.x() + 3, picture.width); ++x) {
      double sum = 0, covered = 0;
      for (int i = 0; i < kSubsamples * kSubsamples; ++i) {
        const base::Vector2 pixel(x - 0.5 + (i % kSubsamples + 0.5) / kSubsamples,
                                  y - 0.5 + (double(i / kSubsamples) + 0.5) / kSubsamples);
        const base::Vector2 slope = camera.slope(pixel);
        const base::Vector3 way(slope.x(), slope.y(), 1.0);
        const base::Vector3 met = camera.place() + way * (offset / normal.dot(way));
        const double seen = sheet_at((board_from_world * met).head<2>(), board);
        if (seen < 0) continue;
        sum += seen;
        covered += 1;
      }
      const double share = covered / (kSubsamples * kSubsamples);
      for (float& channel : picture.at(x, y))
        channel = float((1 - share) * channel + light * sum / (kSubsamples * kSubsamples));
    }
}

Eigen::Isometry3d board_place(int number, int count, double table_width, double table_height, double table_z,
                              const Chessboard& board, std::uint64_t seed) {
  base::Random random(seed ^ (0x626f617264ULL + std::uint64_t(number)));
  random.bits();
  const bool flat = number + 1 >= count;
  const base::Vector3 half(0.5 * board.square * (board.columns - 1), 0.5 * board.square * (board.rows - 1),
                           0);
  const double height = flat ? 0.0 : random.uniform(60.0, 160.0);
  const double reach = flat ? 0.1 : 0.22;
  const base::Vector3 middle(table_width * random.uniform(0.5 - reach, 0.5 + reach),
                             table_height * random.uniform(0.5 - reach, 0.5 + reach), table_z - height);
  const double tilt = flat ? 0.0 : 0.55;
  Eigen::Isometry3d place = Eigen::Isometry3d::Identity();
  place.linear() = (Eigen::AngleAxisd(random.uniform(-0.5, 0.5), base::Vector3::UnitZ()) *
                    Eigen::AngleAxisd(random.uniform(-tilt, tilt), base::Vector3::UnitX()) *
                    Eigen::AngleAxisd(random.uniform(-tilt, tilt), base::Vector3::UnitY()))
                       .toRotationMatrix();
  place.translation() = middle - place.linear() * half;
  return place;
}

}  // namespace icome::cutout
