#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "animation/picture/cell_pictures.h"
#include "animation/picture/laying.h"
#include "animation/project/project.h"

namespace icome::animation {

/// Another moment that is drawn faintly below the frame, in one colour or nearly so.
struct OnionSkin {
  CellStates states;
  LayingLook look = {0.3, {{0.9F, 0.2F, 0.2F}, 0.6}};
};

/// The area in which the background's colour is drawn; elsewhere the picture is clear.
enum class Backdrop : std::uint8_t { Everywhere, Stage, None };

struct FrameOptions {
  bool through_camera = true;  ///< what the camera sees, else the stage
  Backdrop backdrop = Backdrop::Everywhere;
  std::vector<OnionSkin> onion = {};  ///< the lowest first
  /// Px of the picture from px of the stage; none: the stage, or what the camera sees of its size, whole in
  /// the middle of the picture.
  std::optional<Affine2> picture_from_stage = {};
};

/// The view of a picture of that size that options ask for.
Affine2 picture_from_stage(const Project& project, const CellStates& states, const FrameOptions& options,
                           int width, int height);

/// Draws a frame onto pixels that are there, all of which it sets: visible layers, the last one in front,
/// with the pictures of their cells; a cell whose picture cannot be shown is a crossed frame. The bytes
/// depend on nothing but what is given. Takes several threads.
void draw_frame(const Project& project, const CellStates& states, CellPictures& pictures,
                const FrameOptions& options, const PixelsView& onto);
/// A new picture, of the stage's size.
Pixels draw_frame(const Project& project, const CellStates& states, CellPictures& pictures,
                  const FrameOptions& options = {});

/// The name of the picture that a cell has in a state, and of the one that is seen of it, as it is neither
/// clear nor shrunk to nothing; null where there is none.
const std::string* picture_of(const Cell& cell, const CellState& state);
const std::string* visible_picture(const Cell& cell, const CellState& state);

/// The size of a cell's picture; a stand-in's where it cannot be shown. None where it shows no picture.
std::optional<PictureSize> shown_size(const Cell& cell, const CellState& state, CellPictures& pictures);
/// Px of the stage from px of a cell's picture.
Affine2 stage_from_picture(const Cell& cell, const CellState& state);
/// The corners of a cell's picture on the stage, px: upper left, upper right, lower right, lower left as the
/// picture has them. None where it shows no picture.
std::optional<std::array<Vector2, 4>> outline_of(const Cell& cell, const CellState& state,
                                                 CellPictures& pictures);

enum class LockedCells : std::uint8_t { Skip, Take };
/// The topmost visible cell that is not nearly clear at a point of the stage (px); none where there is none.
std::optional<CellId> cell_at(const Project& project, const CellStates& states, CellPictures& pictures,
                              const Vector2& point, LockedCells locked = LockedCells::Skip);

}  // namespace icome::animation
