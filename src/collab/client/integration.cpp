#include "collab/client/integration.h"

#include <unordered_map>
#include <utility>

#include "world/edit/edits_of.h"

namespace icome::collab {
namespace {

/// Gives the edits that make a model new ids and places; each kind by its own function.
class Renumbering {
 public:
  Renumbering(world::IdSource& ids, world::ObjectId parent, std::size_t place)
      : ids_(ids), parent_(parent), place_(place) {}

  void operator()(world::CreateObject it) {
    it.id = fresh(it.id);
    it.object.geometry = known(it.object.geometry);
    it.object.material = known(it.object.material);
    if (it.object.parent) {
      it.object.parent = known(it.object.parent);
    } else {
      it.object.parent = parent_;
      it.place = place_++;
    }
    edits_.emplace_back(std::move(it));
  }
  void operator()(world::CreateGeometry it) {
    it.id = fresh(it.id);
    edits_.emplace_back(std::move(it));
  }
  void operator()(world::CopyGeometry it) {
    it.id = fresh(it.id);
    it.model = known(it.model);
    edits_.emplace_back(it);
  }
  void operator()(world::CreateMaterial it) {
    it.id = fresh(it.id);
    it.material.texture = known(it.material.texture);
    edits_.emplace_back(std::move(it));
  }
  void operator()(world::CreateTexture it) {
    it.id = fresh(it.id);
    edits_.emplace_back(std::move(it));
  }
  void operator()(world::CreateScene it) {
    it.id = fresh(it.id);
    edits_.emplace_back(std::move(it));
  }
  void operator()(world::EnterScene it) {
    it.scene = known(it.scene);
    it.object = known(it.object);
    edits_.emplace_back(it);
  }
  /// Numbers are reserved in the design that has them; others do not make a world anew.
  template <typename Kind>
  void operator()(const Kind&) {}

  std::vector<world::Edit> take() { return std::move(edits_); }

 private:
  template <typename AnyId>
  AnyId fresh(AnyId id) {
    const auto next = ids_.next<AnyId>();
    numbers_[id.value] = next.value;
    return next;
  }
  template <typename AnyId>
  AnyId known(AnyId id) const {
    return id ? AnyId{numbers_.at(id.value)} : AnyId{};
  }

  world::IdSource& ids_;
  world::ObjectId parent_;
  std::size_t place_;
  std::unordered_map<std::uint64_t, std::uint64_t> numbers_;  // one counter serves all kinds of a world
  std::vector<world::Edit> edits_;
};

}  // namespace

world::Edit integration_of(const world::World& model, const world::World& design, world::ObjectId parent,
                           world::IdSource& ids) {
  const world::PhysicalObject* const above = design.find(parent);
  Renumbering renumbering(ids, parent, above == nullptr ? design.roots().size() : above->children.size());
  for (const world::Edit& edit : world::edits_of(model))
    std::visit([&](const auto& it) { renumbering(it); }, edit.what);
  return world::EditGroup{renumbering.take()};
}

}  // namespace icome::collab
