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

/// The motions of the nodes by the animations of a glTF file. Several animations of one place of one node
/// are alternatives without an order in the format: the first one counts. Remarks tell what is left out.
class GltfMotions {
 public:
  using GoOn = std::function<void()>;

  /// Reads all animations. Throws GltfError where they refer to missing things, or take more memory than
  /// there is, and whatever `go_on` throws, which is called before each. The model outlives it.
  GltfMotions(const tinygltf::Model& model, io::MemoryBudget& memory, GoOn go_on);

  /// The motion of a node, whose memory is no longer counted; null: it has none.
  world::MotionPointer of(std::size_t node);
  std::vector<Remark> remarks() const { return findings_.remarks(); }

 private:
  /// The part of the place that one channel moves.
  using Part = world::KeyFrames world::Motion::*;
  struct Course {
    std::size_t node = 0;
    Part part = nullptr;
    world::KeyFrames frames;
  };
  void read(const tinygltf::Animation& animation);
  /// False: it moves nothing that is known here, which a remark tells.
  bool read(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel, Course& course);
  bool read_frames(const tinygltf::Animation& animation, int sampler, std::size_t size,
                   world::KeyFrames& frames);

  /// Gives back the memory of key frames that are not needed any more.
  void let_go(const world::KeyFrames& frames);

  const tinygltf::Model& model_;
  io::MemoryBudget& memory_;
  GoOn go_on_;
  Findings findings_;
  std::map<std::size_t, world::Motion> motions_;  // by node, without rest
};

}  // namespace icome::files
