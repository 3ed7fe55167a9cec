#include "files/vrml/read/vrml_motions.h"

#include <flatbuffers/flatbuffers.h>
#include <vrml_answer_generated.h>

#include <memory>
#include <utility>
#include <vector>

#include "world/motion.h"

namespace icome::files {
namespace {

world::KeyFrames key_frames_of(const flat::KeyFrames* from, world::FlatReader& reader) {
  if (!from) return {};
  return {.times = reader.items<double>(from->times()),
          .values = reader.items<double>(from->values()),
          .cycle = from->cycle(),
          .loops = from->loops()};
}

std::uint64_t memory_for(const flat::Motion& motion) {
  std::uint64_t numbers = 0;
  for (const flat::KeyFrames* it : {motion.translation(), motion.rotation(), motion.scale()}) {
    if (!it) continue;
    numbers += (it->times() ? it->times()->size() : 0) + (it->values() ? it->values()->size() : 0);
  }
  return sizeof(world::Motion) + numbers * sizeof(double);
}

world::PlaceParts place_of(const std::vector<double>& numbers) {
  const double* const from = numbers.data();
  return {.translation = base::Vector3(from),
          .rotation = base::Quaternion(from + 3),
          .scale = base::Vector3(from + 7),
          .centre = base::Vector3(from + 10),
          .stretch_axes = base::Quaternion(from + 13)};
}

}  // namespace

world::MotionPointer motion_of(const flat::Motion& from, world::FlatReader& reader,
                               io::MemoryBudget& memory) {
  constexpr std::size_t kRestNumbers = 17;
  if (!memory.has_room(memory_for(from))) return nullptr;
  const std::vector<double> rest = reader.items<double>(from.rest());
  world::Motion motion;
  if (rest.size() == kRestNumbers) motion.rest = place_of(rest);
  motion.translation = key_frames_of(from.translation(), reader);
  motion.rotation = key_frames_of(from.rotation(), reader);
  motion.scale = key_frames_of(from.scale(), reader);
  if (rest.size() != kRestNumbers || !world::check_motion(motion)) {
    reader.refuse("a motion cannot be played");
    return nullptr;
  }
  return std::make_shared<const world::Motion>(std::move(motion));
}

VrmlMoving what_moves(const flat::Scene& scene, world::FlatReader& reader) {
  VrmlMoving result;
  if (!scene.moving()) return result;
  for (const flat::Moving* moving : *scene.moving()) {
    VrmlTaken& taken = result[reader.text(moving->file())];
    for (const int line : reader.items<int>(moving->routes())) taken.routes.insert(line);
    if (!moving->nodes()) continue;
    for (const flat::String* name : *moving->nodes()) taken.nodes.insert(reader.text(name->text()));
  }
  return result;
}

}  // namespace icome::files
