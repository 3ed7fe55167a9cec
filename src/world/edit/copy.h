#pragma once
#include "world/edit/edit.h"

namespace icome::world {

/// The six ways to duplicate of thesis 2.4.1. A copy gets a shape of its own, a clone shares the shape of
/// its model: change one, and all change. Materials are shared always.
enum class Duplicate {
  CopyObject,             // without its children
  CopyObjectAndChildren,  // "children": all that is below
  CloneObject,            // without its children
  CloneObjectAndChildren,
  CopyObjectCloneChildren,
  CloneObjectCopyChildren,
};

/// The edit that makes a duplicate, ready to be applied, and the id of the duplicate.
struct Duplication {
  Edit edit;
  ObjectId object;
};

/// Duplicates `model` and puts the result behind the last child of `parent` (none: behind the last root),
/// at the same place with respect to it as the model has to its own parent. Objects that share a shape in
/// the model share one in the duplicate too: the legs of a copied table are clones of each other, not of
/// the first table's (figure 2.9). Fails when either is not there.
base::Result<Duplication> duplicate(const World& world, ObjectId model, Duplicate how, ObjectId parent,
                                    IdSource& ids);

}  // namespace icome::world
