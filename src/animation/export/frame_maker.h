#pragma once
#include "animation/export/export_animation.h"

namespace icome::animation {

/// The frames that all formats of an export draw from. Refers to what it is made of.
class FrameMaker {
 public:
  FrameMaker(const Project& project, const StatesAt& states_at, CellPictures& pictures,
             const ExportOptions& options, bool background);

  const Project& project() const { return project_; }
  CellPictures& pictures() const { return pictures_; }
  const ExportOptions& options() const { return options_; }
  const FrameRange& range() const { return range_; }
  bool has_background() const { return background_; }
  int width() const { return width_; }
  int height() const { return height_; }
  CellStates states(int frame) const { return states_at_(frame); }

  /// Makes sides even, which adds what is seen beyond the right and the lower rim; true where that was
  /// needed.
  bool make_even();

  Affine2 view(const CellStates& states) const;
  /// The frame's pixels, valid until the next one. Fails where a picture could not be drawn in its time.
  base::Result<const Pixels*> draw(int frame);
  /// Tells how far the export is; false where it is to stop.
  bool goes_on(double part) const { return !options_.progress || options_.progress(part); }

 private:
  const Project& project_;
  const StatesAt& states_at_;
  CellPictures& pictures_;
  const ExportOptions& options_;
  FrameRange range_;
  bool background_;
  int asked_width_, asked_height_;  // px
  int width_, height_;              // px
  Pixels pixels_;
};

/// The failure of an export that its progress callback ended.
tl::unexpected<base::Error> stopped_export();

}  // namespace icome::animation
