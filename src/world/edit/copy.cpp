#include "world/edit/copy.h"

#include <unordered_map>

namespace icome::world {
namespace {

bool copies_root(Duplicate how) {
  return how == Duplicate::CopyObject || how == Duplicate::CopyObjectAndChildren ||
         how == Duplicate::CopyObjectCloneChildren;
}
bool copies_children(Duplicate how) {
  return how == Duplicate::CopyObjectAndChildren || how == Duplicate::CloneObjectCopyChildren;
}
bool takes_children(Duplicate how) { return how != Duplicate::CopyObject && how != Duplicate::CloneObject; }

/// Makes the edits of one duplication.
class Duplicator {
 public:
  Duplicator(const World& world, IdSource& ids) : world_(world), ids_(ids) {}

  void add(ObjectId model, ObjectId parent, std::size_t place, bool copy) {
    PhysicalObject object = *world_.find(model);
    object.children.clear();
    object.parent = parent;
    if (copy && object.geometry) object.geometry = copied(object.geometry);
    const ObjectId id = ids_.next<ObjectId>();
    made_.emplace(model, id);
    group_.edits.push_back(CreateObject{id, place, std::move(object)});
  }

  ObjectId made(ObjectId model) const { return made_.at(model); }
  EditGroup take() { return std::move(group_); }

 private:
  /// The duplicate's own shape, made when it is first asked for.
  GeometryId copied(GeometryId model) {
    const auto [found, fresh] = copies_.try_emplace(model);
    if (fresh) {
      found->second = ids_.next<GeometryId>();
      group_.edits.push_back(CopyGeometry{found->second, model});
    }
    return found->second;
  }

  const World& world_;
  IdSource& ids_;
  EditGroup group_;
  std::unordered_map<ObjectId, ObjectId> made_;
  std::unordered_map<GeometryId, GeometryId> copies_;
};

}  // namespace

base::Result<Duplication> duplicate(const World& world, ObjectId model, Duplicate how, ObjectId parent,
                                    IdSource& ids) {
  if (!world.find(model)) return base::fail("The object to duplicate is not there any more.");
  if (parent && !world.find(parent))
    return base::fail("The object to put the duplicate under is not there any more.");
  Duplicator duplicator(world, ids);
  const std::size_t last = parent ? world.find(parent)->children.size() : world.roots().size();
  duplicator.add(model, parent, last, copies_root(how));
  if (takes_children(how)) {
    for (const ObjectId id : subtree(world, model)) {
      const std::vector<ObjectId>& children = world.find(id)->children;
      for (std::size_t i = 0; i < children.size(); ++i)
        duplicator.add(children[i], duplicator.made(id), i, copies_children(how));
    }
  }
  const ObjectId made = duplicator.made(model);
  return Duplication{duplicator.take(), made};
}

}  // namespace icome::world
