#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "files/gltf/gltf_buffer.h"
#include "files/remark.h"
#include "world/motion.h"

namespace tinygltf {
class Model;
class Node;
}  // namespace tinygltf

namespace icome::files {

/// Puts motions into the animations of a glTF file that is written: one animation for each cycle. Refers to
/// model and buffer.
class GltfAnimations {
 public:
  GltfAnimations(tinygltf::Model& model, GltfBuffer& buffer) : model_(model), buffer_(buffer) {}

  /// Moves the node, which will be number `index`, as the object moves; false, with nothing changed,
  /// where glTF cannot express the motion, or the object has none.
  bool add(const world::PhysicalObject& object, int index, tinygltf::Node& node);
  std::vector<Remark> remarks() const;

  /// Reason why a motion cannot be written.
  enum class Loss : std::uint8_t { Stretch, Cycles, Size };

 private:
  void add(const world::KeyFrames& frames, int node, const char* path);

  tinygltf::Model& model_;
  GltfBuffer& buffer_;
  std::map<std::pair<double, bool>, std::size_t> animations_;  // by cycle, and whether it loops
  std::size_t bent_ = 0;
  std::array<std::size_t, 3> lost_ = {};  // by Loss
};

}  // namespace icome::files
