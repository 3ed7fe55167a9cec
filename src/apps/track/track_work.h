#pragma once
#include <memory>
#include <optional>
#include <string>

#include "apps/track/track_options.h"
#include "base/result.h"
#include "cutout/source/frame_source.h"
#include "cutout/tracker/tracker.h"

namespace icome::apps {

// Functions that the tasks of icome track have in common.

constexpr int kTrackInterrupted = 130;  // what shells report for Ctrl-C

/// Tells why, and gives the exit code.
int track_failed(const base::Error& error);

/// "640x480" as two numbers; nothing for an empty text.
base::Result<std::optional<std::pair<int, int>>> size_of(const std::string& text);

base::Result<std::unique_ptr<cutout::FrameSource>> open_for(const TrackOptions& options);

/// The view of a file, of a folder that was made, or, given a frame, one without a calibration.
base::Result<cutout::TableView> view_for(const TrackOptions& options, const cutout::Frame& frame);

/// Tells on standard error what is wrong with a frame; nothing that was told before.
class FrameComplaints {
 public:
  void look_at(const cutout::Frame& frame);

 private:
  std::vector<std::string> told_;
  double next_ = -1;  // s
};

}  // namespace icome::apps
