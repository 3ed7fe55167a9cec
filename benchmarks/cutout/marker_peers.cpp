#include "marker_peers.h"

#include <array>
#include <cmath>
#include <opencv2/aruco.hpp>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

extern "C" {
#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>
}

namespace icome::benchmarks {
namespace {

using base::Vector2;
using cutout::Sighting;

/// The pose of a marker by its corners in the frame, clockwise from the upper left one as printed.
Sighting sighting_by(const cutout::TableView& view, std::size_t id, const std::array<Vector2, 4>& corners) {
  std::array<Vector2, 4> mm;
  Vector2 middle = Vector2::Zero();
  for (std::size_t i = 0; i < 4; ++i) {
    mm[i] = view.to_table(corners[i]);
    middle += mm[i] / 4;
  }
  const Vector2 up = mm[0] + mm[1] - mm[2] - mm[3];
  return {id, {middle, std::atan2(-up.y(), up.x())}, 1};
}

void keep(std::vector<Sighting>& seen, Sighting sighting, std::size_t count) {
  if (sighting.triangle < count) seen.push_back(std::move(sighting));
}

cv::Mat grey_of(const cutout::FrameView& frame) {
  const cv::Mat colour(frame.height, frame.width, CV_8UC3, const_cast<std::uint8_t*>(frame.pixels),
                       frame.row_bytes);
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

class ArucoPeer : public cutout::Tracker {
 public:
  ArucoPeer(cutout::TableView view, std::size_t count)
      : view_(std::move(view)),
        count_(count),
        family_(cv::aruco::getPredefinedDictionary(cv::aruco::DICT_APRILTAG_36h11)),
        settings_(cv::aruco::DetectorParameters::create()) {
    settings_->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
    settings_->cornerRefinementWinSize = 3;
    cv::setNumThreads(1);
  }

  base::Result<std::vector<Sighting>> see(const cutout::FrameView& frame, double) override {
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(grey_of(frame), family_, corners, ids, settings_);
    std::vector<Sighting> seen;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      std::array<Vector2, 4> places;
      for (std::size_t k = 0; k < 4; ++k) places[k] = {corners[i][k].x, corners[i][k].y};
      keep(seen, sighting_by(view_, std::size_t(ids[i]), places), count_);
    }
    return seen;
  }

 private:
  cutout::TableView view_;
  std::size_t count_;
  cv::Ptr<cv::aruco::Dictionary> family_;
  cv::Ptr<cv::aruco::DetectorParameters> settings_;
};

class AprilTagPeer : public cutout::Tracker {
 public:
  AprilTagPeer(cutout::TableView view, std::size_t count)
      : view_(std::move(view)),
        count_(count),
        family_(tag36h11_create()),
        detector_(apriltag_detector_create()) {
    apriltag_detector_add_family(detector_, family_);
    detector_->nthreads = 1;
    detector_->quad_decimate = 1;
  }
  ~AprilTagPeer() override {
    apriltag_detector_destroy(detector_);
    tag36h11_destroy(family_);
  }
  AprilTagPeer(const AprilTagPeer&) = delete;
  AprilTagPeer& operator=(const AprilTagPeer&) = delete;

  base::Result<std::vector<Sighting>> see(const cutout::FrameView& frame, double) override {
    cv::Mat grey = grey_of(frame);
    image_u8_t image = {grey.cols, grey.rows, int(grey.step), grey.data};
    zarray_t* found = apriltag_detector_detect(detector_, &image);
    std::vector<Sighting> seen;
    for (int i = 0; i < zarray_size(found); ++i) {
      apriltag_detection_t* detection = nullptr;
      zarray_get(found, i, static_cast<void*>(&detection));
      // Its corners begin at the lower left one and run the other way; pixels' centres lie at halves.
      std::array<Vector2, 4> places;
      for (std::size_t k = 0; k < 4; ++k)
        places[k] = {detection->p[3 - k][0] - 0.5, detection->p[3 - k][1] - 0.5};
      keep(seen, sighting_by(view_, std::size_t(detection->id), places), count_);
    }
    apriltag_detections_destroy(found);
    return seen;
  }

 private:
  cutout::TableView view_;
  std::size_t count_;
  apriltag_family_t* family_;
  apriltag_detector_t* detector_;
};

}  // namespace

std::unique_ptr<cutout::Tracker> make_aruco(const cutout::TableView& view, std::size_t count) {
  return std::make_unique<ArucoPeer>(view, count);
}

std::unique_ptr<cutout::Tracker> make_apriltag(const cutout::TableView& view, std::size_t count) {
  return std::make_unique<AprilTagPeer>(view, count);
}

}  // namespace icome::benchmarks
