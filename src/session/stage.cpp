#include "session/stage.h"

#include "files/file_ending.h"
#include "world/edit.h"

namespace icome::session {

namespace {

void turn(world::World& world, const base::Pose& after_from_before) {
  world::EditGroup turned;
  for (const world::ObjectId root : world.roots())
    turned.edits.push_back(
        world::PlaceObject{root, after_from_before * world.find(root)->parent_from_object});
  // Turning flattens no place that is none already.
  (void)world::apply(world, turned);
}

}  // namespace

bool stands_on_z(const std::filesystem::path& design) {
  const std::string type = files::ending_of(design).type;
  return type == ".csg" || type == ".stl";
}

base::Pose stage_from_world(bool z_up) {
  base::Pose pose = base::Pose::Identity();
  // Written out, so that what lies on the axes stays there to the last bit.
  if (z_up) pose.linear() << 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0;
  return pose;
}

void set_upright(world::World& world) { turn(world, stage_from_world(true)); }

void lay_down(world::World& world) { turn(world, stage_from_world(true).inverse()); }

}  // namespace icome::session
