#include "cutout/calibration/chessboard.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace icome::cutout {
namespace {

constexpr std::size_t kFewestSights = 4;
constexpr double kWorstError = 1.5;       // pixels
constexpr double kLeastTurn = 0.17;       // rad, between the most different sights
constexpr double kWidestLooked = 1600.0;  // pixels; larger frames are first looked at smaller

std::vector<cv::Point3f> board_points(const Chessboard& board) {
  std::vector<cv::Point3f> points;
  for (std::size_t i = 0; i < board.corners(); ++i) {
    const base::Vector2 corner = board.corner(i);
    points.emplace_back(float(corner.x()), float(corner.y()), 0.0F);
  }
  return points;
}

std::vector<cv::Point2f> image_points(const BoardSight& sight) {
  std::vector<cv::Point2f> points;
  for (const base::Vector2& corner : sight) points.emplace_back(float(corner.x()), float(corner.y()));
  return points;
}

BoardPose pose_of(const cv::Mat& turn, const cv::Mat& way) {
  cv::Mat matrix;
  cv::Rodrigues(turn, matrix);
  BoardPose pose = BoardPose::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) pose.linear()(i, k) = matrix.at<double>(i, k);
    pose.translation()[i] = way.at<double>(i);
  }
  return pose;
}

cv::Mat pinhole_of(const Lens& lens) {
  return (cv::Mat_<double>(3, 3) << lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1);
}
cv::Mat bending_of(const Lens& lens) {
  return (cv::Mat_<double>(1, 5) << lens.k1, lens.k2, lens.p1, lens.p2, lens.k3);
}

/// The greatest angle between the normals of boards.
double greatest_turn(const std::vector<BoardPose>& poses) {
  double greatest = 0;
  for (const BoardPose& one : poses)
    for (const BoardPose& other : poses) {
      const double cosine = one.linear().col(2).dot(other.linear().col(2));
      greatest = std::max(greatest, std::acos(std::clamp(cosine, -1.0, 1.0)));
    }
  return greatest;
}

}  // namespace

std::optional<BoardSight> find_chessboard(const FrameView& frame, const Chessboard& board) {
  if (frame.width < 40 || frame.height < 40) return std::nullopt;
  const cv::Mat picture(frame.height, frame.width, CV_8UC3, const_cast<std::uint8_t*>(frame.pixels),
                        frame.row_bytes);
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  const double shrink = std::min(1.0, kWidestLooked / std::max(frame.width, frame.height));
  cv::Mat small = grey;
  if (shrink < 1.0) cv::resize(grey, small, cv::Size(), shrink, shrink, cv::INTER_AREA);
  std::vector<cv::Point2f> corners;
  constexpr int kFlags =
      cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_FAST_CHECK;
  if (!cv::findChessboardCorners(small, cv::Size(board.columns, board.rows), corners, kFlags))
    return std::nullopt;
  for (cv::Point2f& corner : corners) {
    corner.x = float((corner.x + 0.5) / shrink - 0.5);
    corner.y = float((corner.y + 0.5) / shrink - 0.5);
  }
  double spacing = 1e9;
  for (std::size_t i = 1; i < corners.size(); ++i)
    spacing = std::min(spacing, cv::norm(corners[i] - corners[i - 1]));
  const int reach = std::clamp(int(0.35 * spacing), 2, 15);
  cv::cornerSubPix(grey, corners, cv::Size(reach, reach), cv::Size(-1, -1),
                   cv::TermCriteria(cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 60, 1e-4));
  BoardSight sight;
  for (const cv::Point2f& corner : corners) sight.emplace_back(corner.x, corner.y);
  return sight;
}

base::Result<LensCalibration> calibrate_lens(const std::vector<BoardSight>& sights, const Chessboard& board,
                                             int frame_width, int frame_height) {
  if (sights.size() < kFewestSights)
    return base::fail(
        fmt::format("the chessboard was seen whole in {} pictures; the lens needs {} or more, from "
                    "several directions",
                    sights.size(), kFewestSights));
  std::vector<std::vector<cv::Point3f>> places(sights.size(), board_points(board));
  std::vector<std::vector<cv::Point2f>> seen;
  for (const BoardSight& sight : sights) seen.push_back(image_points(sight));
  cv::Mat pinhole, bending;
  std::vector<cv::Mat> turns, ways;
  LensCalibration found;
  // A fifth number of the bending cannot be told from the others by a board that rarely fills the corners.
  found.error = cv::calibrateCamera(places, seen, cv::Size(frame_width, frame_height), pinhole, bending,
                                    turns, ways, cv::CALIB_FIX_K3);
  found.lens = {pinhole.at<double>(0, 0), pinhole.at<double>(1, 1), pinhole.at<double>(0, 2),
                pinhole.at<double>(1, 2), bending.at<double>(0),    bending.at<double>(1),
                bending.at<double>(2),    bending.at<double>(3),    0.0};
  for (std::size_t i = 0; i < turns.size(); ++i) found.poses.push_back(pose_of(turns[i], ways[i]));
  if (greatest_turn(found.poses) < kLeastTurn)
    return base::fail(
        "the chessboard was seen from one direction only; tilt it by 30 degrees and more to several sides");
  if (!(found.error < kWorstError))
    return base::fail(
        fmt::format("the chessboard's corners miss their places by {:.1f} pixels; is the sheet flat, "
                    "and printed at its true size?",
                    found.error));
  return found;
}

base::Result<BoardPose> locate_board(const BoardSight& sight, const Chessboard& board, const Lens& lens) {
  cv::Mat turn, way;
  if (!cv::solvePnP(board_points(board), image_points(sight), pinhole_of(lens), bending_of(lens), turn, way))
    return base::fail("the place of the chessboard on the table cannot be told");
  return pose_of(turn, way);
}

}  // namespace icome::cutout
