#pragma once

namespace icome::ui {

/// A person's choices of what the stage shows and how poses follow one another.
struct CutoutLook {
  bool onion = false;           // the poses before and after, faintly
  int onion_before = 1;         // poses
  int onion_after = 1;          // poses
  bool through_camera = false;  // as the camera films it, else all of the stage
  bool constraints = true;      // joints, paths and the like are drawn
  bool camera_frame = true;     // the part that the camera sees is framed
  int step = 1;                 // frames from one pose to the next: animation on ones, twos, ...
};

}  // namespace icome::ui
