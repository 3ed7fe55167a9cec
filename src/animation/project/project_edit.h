#pragma once
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "animation/project/project.h"
#include "base/result.h"

namespace icome::animation {

/// Name and state of a layer, without its cells.
struct LayerLook {
  std::string name;
  bool visible = true;
  bool locked = false;
};
/// Puts a layer without cells among the others.
struct PutLayer {
  LayerId id;
  std::size_t place = 0;
  LayerLook look;
};
/// Takes a layer away that has no cells.
struct TakeLayer {
  LayerId id;
};
struct ChangeLayer {
  LayerId id;
  LayerLook look;
};
struct MoveLayer {
  LayerId id;
  std::size_t place = 0;  ///< among the layers-to-be
};

/// Puts a new cell, with its keys, into a layer, before the one that is at `place`.
struct PutCell {
  LayerId layer;
  std::size_t place = 0;
  Cell cell;
};
/// Takes a cell away that no constraint and no mapping names.
struct TakeCell {
  CellId id;
};
/// A cell without its keys.
struct CellLook {
  std::string name;
  std::vector<std::string> pictures;
  Vector2 pivot = Vector2::Zero();  ///< px
  CellState rest;
};
/// The camera keeps its name, and has a place, an angle and a scale only.
struct ChangeCell {
  CellId id;
  CellLook look;
};
struct MoveCell {
  CellId id;
  LayerId layer;
  std::size_t place = 0;  ///< among the cells-to-be of that layer
};
/// Others for the keys of one channel at the frames from `from` up to `to`, which is included.
struct ChangeKeys {
  CellId cell;
  Channel channel = Channel::X;
  int from = 0, to = 0;
  Track keys;  ///< by frame, within these frames
};

struct ChangeStage {
  Stage stage;
};
struct ChangeSound {
  std::optional<Sound> sound;
};
/// The mark of a frame; none: there is none.
struct ChangeMark {
  int frame = 0;
  std::optional<std::string> text;
};
struct PutConstraint {
  std::size_t place = 0;
  Constraint constraint;
};
struct TakeConstraint {
  ConstraintId id;
};
/// The mapping of a triangle; it moves nothing where `mapping` is none.
struct ChangeMapping {
  std::string triangle;
  std::optional<Mapping> mapping;
};
struct SmoothHands {
  bool smooth = false;
};

/// A part of an edit. A plain value.
using ProjectChange = std::variant<PutLayer, TakeLayer, ChangeLayer, MoveLayer, PutCell, TakeCell, ChangeCell,
                                   MoveCell, ChangeKeys, ChangeStage, ChangeSound, ChangeMark, PutConstraint,
                                   TakeConstraint, ChangeMapping, SmoothHands>;

/// A change of an animation, the only way in which one changes: a plain value that can be applied and taken
/// back. Its parts are applied in order, all or none.
using ProjectEdit = std::vector<ProjectChange>;

/// Limits of what a project may hold; larger files are refused.
inline constexpr std::size_t kMostLayers = 1000;
inline constexpr std::size_t kMostCells = 1000;
inline constexpr std::size_t kMostPictures = 10'000;  // of one cell
inline constexpr std::size_t kMostConstraints = 10'000;
inline constexpr double kFarthest = 1e6;               // px
inline constexpr int kGreatestNumber = 2'000'000'000;  // of ids, and of places in lists

LayerLook look_of(const Layer& layer);
CellLook look_of(const Cell& cell);

/// Changes the project and gives the edit that takes it back. A refused edit changes nothing, and the error
/// says why: an id or a name that is not there or is there twice, a place beyond the end, numbers that are
/// not finite or out of range, a layer that has cells, a cell that a constraint or a mapping names, joints in
/// a ring.
base::Result<ProjectEdit> apply_edit(Project& project, const ProjectEdit& edit);

}  // namespace icome::animation
