#pragma once
#include <memory>

#include "cutout/tracker/tracker.h"

namespace icome::benchmarks {

/// OpenCV's detector of ArUco markers, with corners refined to sub-pixel, one thread; its sightings are of
/// the markers' middles and ways up.
std::unique_ptr<cutout::Tracker> make_aruco(const cutout::TableView& view, std::size_t count);
/// The AprilTag library, with frames at full size, one thread.
std::unique_ptr<cutout::Tracker> make_apriltag(const cutout::TableView& view, std::size_t count);

}  // namespace icome::benchmarks
