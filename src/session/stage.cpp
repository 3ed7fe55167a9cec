#include "session/stage.h"

#include "files/file_ending.h"

namespace icome::session {

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

}  // namespace icome::session
