#pragma once
#include <span>
#include <vector>

#include "world/edit/edit.h"

namespace icome::world {

/// The ids that an edit, or its inverse, may have changed, each named once. Whatever is derived from a world
/// looks these up in it after the edit and brings itself up to date (the EditedQueue of thesis 5.6.1).
struct Changes {
  std::vector<ObjectId> objects = {};  // the descendants of a moved object are not named
  std::vector<GeometryId> geometries = {};
  std::vector<MaterialId> materials = {};
  std::vector<TextureId> textures = {};
  std::vector<SceneId> scenes = {};
};
Changes changes_of(const Edit& edit);
/// The changes of several edits, one after the other.
Changes changes_of(std::span<const Edit* const> edits);

}  // namespace icome::world
