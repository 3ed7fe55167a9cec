#include "apps/track/track_work.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "apps/terminal.h"
#include "base/parse_number.h"
#include "cutout/calibration/frame_quality.h"

namespace icome::apps {

int track_failed(const base::Error& error) {
  tell(error.message);
  return kFailed;
}

base::Result<std::optional<std::pair<int, int>>> size_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t cross = text.find('x');
  constexpr int kMostSide = 16384;
  int width = 0, height = 0;  // 0: no number
  if (cross != std::string::npos) {
    width = base::parse_number<int>(std::string_view(text).substr(0, cross)).value_or(0);
    height = base::parse_number<int>(std::string_view(text).substr(cross + 1)).value_or(0);
  }
  if (width < 1 || height < 1 || width > kMostSide || height > kMostSide)
    return base::fail(fmt::format("--size is {}; write WxH in pixels, such as 640x480", text));
  return std::pair(width, height);
}

base::Result<std::unique_ptr<cutout::FrameSource>> open_for(const TrackOptions& options) {
  const auto size = size_of(options.camera_size);
  if (!size) return tl::unexpected(size.error());
  cutout::SourceSettings settings;
  settings.rate = options.rate;
  if (*size) {
    settings.width = (*size)->first;
    settings.height = (*size)->second;
  }
  return cutout::open_source(options.source, settings);
}

base::Result<cutout::TableView> view_for(const TrackOptions& options, const cutout::Frame& frame) {
  std::filesystem::path file = options.view;
  std::error_code error;
  if (file.empty() && options.table.empty()) {
    const std::filesystem::path own = std::filesystem::path(options.source) / "view.toml";
    if (std::filesystem::is_regular_file(own, error)) {
      file = own;
      tell(fmt::format("the view is that of {}", own.string()));
    }
  }
  if (!file.empty()) return cutout::read_table_view(file);
  const double width = options.table.empty() ? 640.0 : options.table[0];
  const double height = options.table.empty() ? 480.0 : options.table[1];
  return cutout::TableView::whole_frame(frame.width, frame.height, width, height);
}

void FrameComplaints::look_at(const cutout::Frame& frame) {
  constexpr double kPause = 4.0;  // s between two looks, which take some milliseconds
  if (frame.time < next_) return;
  next_ = frame.time + kPause;
  for (const std::string& complaint : cutout::complaints_of(cutout::quality_of(frame.view()))) {
    const std::string kind = complaint.substr(0, complaint.find(':'));
    if (std::ranges::find(told_, kind) != told_.end()) continue;
    told_.push_back(kind);
    tell(complaint);
  }
}

}  // namespace icome::apps
