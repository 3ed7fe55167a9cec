#include "cutout/tracker/frame_size.h"

#include <fmt/format.h>

namespace icome::cutout {

base::Result<void> check_frame_size(const FrameView& frame, const TableView& view) {
  if (frame.width == view.frame_width() && frame.height == view.frame_height()) return {};
  return base::fail(fmt::format(
      "a frame of {} x {} pixels came, but the first ones, or the view of the table, were of {} x {}",
      frame.width, frame.height, view.frame_width(), view.frame_height()));
}

}  // namespace icome::cutout
