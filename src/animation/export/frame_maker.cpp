#include "animation/export/frame_maker.h"

namespace icome::animation {

FrameMaker::FrameMaker(const Project& project, const StatesAt& states_at, CellPictures& pictures,
                       const ExportOptions& options, bool background)
    : project_(project),
      states_at_(states_at),
      pictures_(pictures),
      options_(options),
      range_(options.range.value_or(FrameRange{0, project.stage.length - 1})),
      background_(background),
      asked_width_(options.width > 0 ? options.width : project.stage.width),
      asked_height_(options.height > 0 ? options.height : project.stage.height),
      width_(asked_width_),
      height_(asked_height_) {}

bool FrameMaker::make_even() {
  width_ += width_ % 2;
  height_ += height_ % 2;
  return width_ != asked_width_ || height_ != asked_height_;
}

Affine2 FrameMaker::view(const CellStates& states) const {
  FrameOptions options;
  options.through_camera = options_.through_camera;
  return picture_from_stage(project_, states, options, asked_width_, asked_height_);
}

base::Result<const Pixels*> FrameMaker::draw(int frame) {
  if (pixels_.width != width_ || pixels_.height != height_) pixels_ = Pixels(width_, height_);
  const CellStates shown = states(frame);
  FrameOptions options;
  options.backdrop = background_ ? Backdrop::Everywhere : Backdrop::None;
  options.picture_from_stage = view(shown);
  draw_frame(project_, shown, pictures_, options, pixels_);
  // A drawing gets as far in its time as the machine lets it, and frames must not depend on that.
  if (pictures_.drawing_fault()) return base::fail(*pictures_.drawing_fault());
  return &pixels_;
}

tl::unexpected<base::Error> stopped_export() {
  return base::fail("the export was stopped before its end, and nothing of it is kept");
}

}  // namespace icome::animation
