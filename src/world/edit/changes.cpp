#include "world/edit/changes.h"

#include <algorithm>

namespace icome::world {
namespace {

/// Notes what each kind of edit names.
struct NoteChanges {
  Changes& changes;

  void note(ObjectId id) const { changes.objects.push_back(id); }
  void note(GeometryId id) const { changes.geometries.push_back(id); }
  void note(MaterialId id) const { changes.materials.push_back(id); }
  void note(TextureId id) const { changes.textures.push_back(id); }
  void note(SceneId id) const { changes.scenes.push_back(id); }

  template <typename Kind>
  void operator()(const Kind& it) const {
    note(it.id);
  }
  void operator()(const EnterScene& it) const { note(it.scene); }
  void operator()(const LeaveScene& it) const { note(it.scene); }
  void operator()(const ReserveIds&) const {}
  void operator()(const EditGroup& it) const {
    for (const Edit& edit : it.edits) std::visit(*this, edit.what);
  }
};

template <typename AnyId>
void keep_each_once(std::vector<AnyId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

}  // namespace

Changes changes_of(const Edit& edit) {
  const Edit* const only = &edit;
  return changes_of(std::span(&only, 1));
}

Changes changes_of(std::span<const Edit* const> edits) {
  Changes changes;
  for (const Edit* edit : edits) std::visit(NoteChanges{changes}, edit->what);
  keep_each_once(changes.objects);
  keep_each_once(changes.geometries);
  keep_each_once(changes.materials);
  keep_each_once(changes.textures);
  keep_each_once(changes.scenes);
  return changes;
}

}  // namespace icome::world
