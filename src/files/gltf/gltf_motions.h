#pragma once
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "files/findings.h"
#include "io/memory_budget.h"
#include "world/motion.h"

namespace tinygltf {
struct Animation;
struct AnimationChannel;
class Model;
}  // namespace tinygltf

namespace icome::files {

/// What the animations of a glTF file do to its nodes. Those that move one place of one node are choices
/// between which the format has no order: the first one counts. What cannot be taken is told.
class GltfMotions {
 public:
  using GoOn = std::function<void()>;

  /// Reads all of them. Throws GltfError where they refer to what is not there, or take more memory than
  /// there is, and what `go_on` does, which is asked before each. The model outlives it.
  GltfMotions(const tinygltf::Model& model, io::MemoryBudget& memory, GoOn go_on);

  /// The motion of a node, whose memory counts no more; null: it has none.
  world::MotionPointer of(std::size_t node);
  std::vector<Remark> remarks() const { return findings_.remarks(); }

 private:
  /// What one channel moves.
  using Part = world::KeyFrames world::Motion::*;
  struct Course {
    std::size_t node = 0;
    Part part = nullptr;
    world::KeyFrames frames;
  };
  void read(const tinygltf::Animation& animation);
  /// False: it moves nothing that is known here, which is told.
  bool read(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel, Course& course);
  bool read_frames(const tinygltf::Animation& animation, int sampler, std::size_t size,
                   world::KeyFrames& frames);

  /// These key frames are needed no more.
  void let_go(const world::KeyFrames& frames);

  const tinygltf::Model& model_;
  io::MemoryBudget& memory_;
  GoOn go_on_;
  Findings findings_;
  std::map<std::size_t, world::Motion> motions_;  // by node, without rest
};

}  // namespace icome::files
