#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "files/design.h"
#include "files/shown_world.h"

namespace icome::apps {

/// The figures of a design that `icome info` reports. SI units, world frame.
struct DesignFigures {
  std::string file, format;
  std::size_t objects = 0;
  std::size_t clones = 0;                    // objects whose shape another has already
  std::size_t triangles = 0;                 // of all objects, as shown
  std::map<std::string, std::size_t> kinds;  // shapes by kind
  std::size_t materials = 0, textures = 0, scenes = 0, lights = 0, viewpoints = 0, scripts = 0;
  std::size_t depth = 0;  // objects on the longest path down the tree
  base::Bounds bounds;    // without endless planes
  std::size_t bytes = 0;  // of memory for shapes and pictures
  double read_seconds = 0.0;
  /// An object that moves by itself.
  struct Mover {
    std::string name;
    std::size_t keys = 0;  // key frames
    double seconds = 0.0;  // until its motion is over or begins anew
    bool loops = true;
  };
  std::vector<Mover> motions;
  std::unordered_map<world::GeometryId, std::size_t> shown;  // triangles of each shape
  std::vector<std::string> warnings;
};

/// `maker` makes the triangles that are shown and counted. `go_on` is called before each object, as making
/// triangles may take long; fails when it returns false.
base::Result<DesignFigures> figures_of(const files::LoadedDesign& design, const std::string& file,
                                       files::ShownShapes::Maker maker,
                                       const std::function<bool(std::size_t done, std::size_t all)>& go_on);

std::string json_report(const DesignFigures& figures);
/// A table, the tree of objects (at most so many lines; 0: all) and the warnings.
std::string text_report(const DesignFigures& figures, const world::World& world, std::size_t most_objects);

}  // namespace icome::apps
