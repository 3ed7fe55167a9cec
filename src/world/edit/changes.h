#pragma once
#include <span>
#include <vector>

#include "world/edit/edit.h"

namespace icome::world {

/// What an edit, or the one that takes it back, may have changed, each named once. Whatever is made of a
/// world looks these up in it after the edit and brings itself up to date (the EditedQueue of thesis 5.6.1).
struct Changes {
  std::vector<ObjectId> objects = {};  // what is below an object that goes elsewhere goes along unnamed
  std::vector<GeometryId> geometries = {};
  std::vector<MaterialId> materials = {};
  std::vector<TextureId> textures = {};
  std::vector<SceneId> scenes = {};
};
Changes changes_of(const Edit& edit);
/// Of several edits, one after the other.
Changes changes_of(std::span<const Edit* const> edits);

}  // namespace icome::world
