#include <algorithm>
#include <map>

#include "world/edit/edit.h"
#include "world/row.h"

namespace icome::world {

Edit delete_subtree(const World& world, ObjectId root) {
  EditGroup group;
  std::map<GeometryId, std::uint32_t> let_go;
  std::vector<ObjectId> objects = subtree(world, root);
  std::reverse(objects.begin(), objects.end());
  for (const ObjectId id : objects) {
    const PhysicalObject& object = *world.find(id);
    if (object.scenes > 0) {
      for (const auto& [scene, it] : world.scenes()) {
        if (place_of(it.roots, id) < it.roots.size()) group.edits.push_back(LeaveScene{scene, id});
      }
    }
    group.edits.push_back(DeleteObject{id});
    if (object.geometry) ++let_go[object.geometry];
  }
  for (const auto& [geometry, users] : let_go) {
    if (world.find(geometry)->users == users) group.edits.push_back(DeleteGeometry{geometry});
  }
  return group;
}

}  // namespace icome::world
