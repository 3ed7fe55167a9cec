#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "animation/project/constraint.h"
#include "animation/project/track.h"
#include "world/shape/fixture.h"

namespace icome::animation {

using world::Colour;

/// The state of a cell at a moment. On the stage x is to the right and y down, in px, from the upper left
/// corner.
struct CellState {
  Vector2 place = Vector2::Zero();  ///< of its pivot, px
  double angle = 0;                 ///< rad, counter-clockwise as seen
  double scale = 1;                 ///< stage px per px of its picture
  double opacity = 1;               ///< 0 to 1
  int picture = 0;                  ///< place in Cell::pictures; -1: none is shown

  bool operator==(const CellState&) const = default;
};

/// The states of cells at a moment, perhaps with the camera's.
using CellStates = std::map<CellId, CellState>;

/// A thing that is moved: paper that was cut out. `scale` is stage px for one px of a picture, so all its
/// pictures should be of one size.
struct Cell {
  CellId id;
  std::string name;                   ///< unique among cells
  std::vector<std::string> pictures;  ///< files, relative to the project's: .png, .svg; or .icome#drawing
  Vector2 pivot = Vector2::Zero();  ///< px in a picture, from its upper left corner; about it the cell turns
  CellState rest;                   ///< where a channel has no keys
  Tracks tracks;

  bool operator==(const Cell&) const = default;
};

/// Cells in one plane of depth (thesis 3.4.7); later ones lie on earlier ones.
struct Layer {
  LayerId id;
  std::string name;
  bool visible = true;
  bool locked = false;  ///< hands, tools and recording leave its cells alone
  std::vector<Cell> cells;

  bool operator==(const Layer&) const = default;
};

/// The page that is filmed.
struct Stage {
  int width = 1280, height = 720;  ///< px, 2 to 8192
  double rate = 25;                ///< frames/s, 1 to 120
  int length = 100;                ///< frames, 1 to kLongestAnimation
  Colour background = {1.0F, 1.0F, 1.0F};

  bool operator==(const Stage&) const = default;
};
inline constexpr int kLongestAnimation = 1'000'000;
inline constexpr int kLargestStage = 8192;

/// The sound that goes with the frames.
struct Sound {
  std::string file;  ///< WAV, OGG or FLAC, relative to the project's
  double start = 0;  ///< s of the animation at which it begins; below 0: its beginning is cut off
  double gain = 1;   ///< 0 to 4

  bool operator==(const Sound&) const = default;
};

/// A word at a frame, such as a sound of speech for the mouth.
struct Mark {
  int frame = 0;
  std::string text;

  bool operator==(const Mark&) const = default;
};

/// The way in which a triangle of the table moves cells (thesis 3.4.7).
enum class MappingMode : std::uint8_t {
  Absolute,  ///< the cell is where the triangle is
  Relative,  ///< what the triangle was moved since it was first seen is added to the cell
  Nearest,   ///< the triangle takes the cell that lies nearest below it, and moves it as Relative does
};

struct Mapping {
  std::string triangle;  ///< id in the known list
  MappingMode mode = MappingMode::Absolute;
  CellId cell;  ///< none with Nearest

  bool operator==(const Mapping&) const = default;
};

/// A cut-out animation: a plain value. Ids are unique within it. The last layer is in front.
struct Project {
  Stage stage;
  Cell camera;  ///< without pictures: its place is what the middle of the picture shows, its scale the zoom
  std::vector<Layer> layers;
  std::optional<Sound> sound;
  std::vector<Mark> marks;  ///< by frame, one at a frame at most
  std::vector<Constraint> constraints;
  std::vector<Mapping> mappings;  ///< one for a triangle at most
  bool smooth_hands = false;      ///< steadies what triangles do (one-euro filter)
  std::uint64_t next_id = 1;      ///< greater than every id that was ever given here

  Project();  // an empty stage, its camera in the middle

  bool operator==(const Project&) const = default;

  /// The cell of that id or name, the camera included; null where there is none.
  const Cell* find(CellId id) const;
  const Cell* find(const std::string& name) const;
  const Layer* find(LayerId id) const;
  /// The layer that a cell lies in; null for the camera and where there is none.
  const Layer* layer_of(CellId id) const;
  std::size_t cell_count() const;
};

/// The id and the name of the camera.
inline constexpr CellId kCamera = CellId{1};
inline constexpr const char* kCameraName = "camera";

/// The state of a cell by its keys alone.
CellState state_at(const Cell& cell, double frame);
/// The value of a state's channel; and a state with another one.
double channel_of(const CellState& state, Channel channel);
void set_channel(CellState& state, Channel channel, double value);

/// The place on the stage (px) of a point of a cell, and the other way round; a cell of scale 0 is all at its
/// pivot.
Vector2 on_stage(const Cell& cell, const CellState& state, const PointOnCell& point);
PointOnCell on_cell(const Cell& cell, const CellState& state, const Vector2& place);

}  // namespace icome::animation
