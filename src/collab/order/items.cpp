#include "collab/order/items.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace icome::collab {
namespace {

template <typename AnyId>
bool holds(const world::World& world, std::uint64_t id) {
  return world.find(AnyId{id}) != nullptr;
}

/// Notes what each kind of edit changes.
struct NoteTouched {
  std::vector<Touched>& touched;

  template <typename AnyId>
  void note(AnyId id, Aspect aspect) const {
    touched.push_back({item_of(id), aspect});
  }

  void operator()(const world::CreateObject& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::DeleteObject& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::MoveObject& it) const { note(it.id, Aspect::Place); }
  void operator()(const world::PlaceObject& it) const { note(it.id, Aspect::Place); }
  void operator()(const world::RenameObject& it) const { note(it.id, Aspect::Name); }
  void operator()(const world::ChooseGeometry& it) const { note(it.id, Aspect::Shape); }
  void operator()(const world::ChooseMaterial& it) const { note(it.id, Aspect::Material); }
  void operator()(const world::ChangeFixture& it) const { note(it.id, Aspect::Fixture); }
  void operator()(const world::ChangeMotion& it) const { note(it.id, Aspect::Motion); }
  void operator()(const world::CreateGeometry& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::CopyGeometry& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::DeleteGeometry& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::ReplaceGeometry& it) const { note(it.id, Aspect::Content); }
  void operator()(const world::MoveVertices& it) const { note(it.id, Aspect::Content); }
  void operator()(const world::AmendGeometry& it) const { note(it.id, Aspect::Content); }
  void operator()(const world::CreateMaterial& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::DeleteMaterial& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::ChangeMaterial& it) const { note(it.id, Aspect::Content); }
  void operator()(const world::CreateTexture& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::DeleteTexture& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::CreateScene& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::DeleteScene& it) const { note(it.id, Aspect::Existence); }
  void operator()(const world::RenameScene& it) const { note(it.id, Aspect::Name); }
  void operator()(const world::EnterScene& it) const { note(it.scene, Aspect::Content); }
  void operator()(const world::LeaveScene& it) const { note(it.scene, Aspect::Content); }
  void operator()(const world::ReserveIds&) const {}
  void operator()(const world::EditGroup& it) const {
    for (const world::Edit& edit : it.edits) std::visit(*this, edit.what);
  }
};

/// Notes what each kind of edit needs; things that an earlier edit of its group makes are nobody else's.
struct NoteNeeds {
  Needs& needs;
  std::set<Item>& made;

  template <typename AnyId>
  void need(AnyId id) const {
    const Item item = item_of(id);
    if (!made.contains(item)) needs.items.push_back(item);
  }
  template <typename AnyId>
  void make(AnyId id) const {
    made.insert(item_of(id));
  }
  void enter(world::ObjectId parent) const {
    if (parent && !made.contains(item_of(parent))) needs.entered.push_back(parent);
  }

  void operator()(const world::CreateObject& it) const {
    make(it.id);
    enter(it.object.parent);
  }
  void operator()(const world::MoveObject& it) const {
    need(it.id);
    enter(it.parent);
  }
  void operator()(const world::CreateGeometry& it) const { make(it.id); }
  void operator()(const world::CopyGeometry& it) const { make(it.id); }
  void operator()(const world::CreateMaterial& it) const { make(it.id); }
  void operator()(const world::CreateTexture& it) const { make(it.id); }
  void operator()(const world::CreateScene& it) const { make(it.id); }
  void operator()(const world::EnterScene& it) const { need(it.scene); }
  void operator()(const world::LeaveScene& it) const { need(it.scene); }
  void operator()(const world::ReserveIds&) const {}
  void operator()(const world::EditGroup& it) const {
    for (const world::Edit& edit : it.edits) std::visit(*this, edit.what);
  }
  template <typename Kind>
  void operator()(const Kind& it) const {
    need(it.id);
  }
};

template <typename Value>
void keep_each_once(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

struct EditWord {
  std::string operator()(const world::CreateObject&) const { return "create"; }
  std::string operator()(const world::DeleteObject&) const { return "delete"; }
  std::string operator()(const world::MoveObject&) const { return "move"; }
  std::string operator()(const world::PlaceObject&) const { return "translate"; }
  std::string operator()(const world::RenameObject&) const { return "rename"; }
  std::string operator()(const world::ChooseGeometry&) const { return "choose shape"; }
  std::string operator()(const world::ChooseMaterial&) const { return "choose material"; }
  std::string operator()(const world::ChangeFixture&) const { return "change fixture"; }
  std::string operator()(const world::ChangeMotion&) const { return "change motion"; }
  std::string operator()(const world::CreateGeometry&) const { return "create shape"; }
  std::string operator()(const world::CopyGeometry&) const { return "copy shape"; }
  std::string operator()(const world::DeleteGeometry&) const { return "delete shape"; }
  std::string operator()(const world::ReplaceGeometry&) const { return "change shape"; }
  std::string operator()(const world::MoveVertices&) const { return "move vertices"; }
  std::string operator()(const world::AmendGeometry&) const { return "change shape"; }
  std::string operator()(const world::CreateMaterial&) const { return "create material"; }
  std::string operator()(const world::DeleteMaterial&) const { return "delete material"; }
  std::string operator()(const world::ChangeMaterial&) const { return "change material"; }
  std::string operator()(const world::CreateTexture&) const { return "create texture"; }
  std::string operator()(const world::DeleteTexture&) const { return "delete texture"; }
  std::string operator()(const world::CreateScene&) const { return "create scene"; }
  std::string operator()(const world::DeleteScene&) const { return "delete scene"; }
  std::string operator()(const world::RenameScene&) const { return "rename scene"; }
  std::string operator()(const world::EnterScene&) const { return "enter scene"; }
  std::string operator()(const world::LeaveScene&) const { return "leave scene"; }
  std::string operator()(const world::ReserveIds&) const { return "reserve ids"; }
  std::string operator()(const world::EditGroup& it) const {
    const auto is_of_object = [](const world::Edit& edit) {
      const std::vector<Touched> touched = touched_by(edit);
      return !touched.empty() && touched.front().item.kind == ItemKind::Object;
    };
    const auto found = std::find_if(it.edits.begin(), it.edits.end(), is_of_object);
    if (found != it.edits.end()) return edit_word(*found);
    return it.edits.empty() ? "group" : edit_word(it.edits.front());
  }
};

}  // namespace

bool is_there(const world::World& world, Item item) {
  switch (item.kind) {
    case ItemKind::Object:
      return holds<world::ObjectId>(world, item.id);
    case ItemKind::Shape:
      return holds<world::GeometryId>(world, item.id);
    case ItemKind::Material:
      return holds<world::MaterialId>(world, item.id);
    case ItemKind::Texture:
      return holds<world::TextureId>(world, item.id);
    case ItemKind::Scene:
      return holds<world::SceneId>(world, item.id);
  }
  return false;
}

std::string name_of(const world::World& world, Item item) {
  const auto name = [](const auto* thing) { return thing == nullptr ? std::string() : thing->name; };
  switch (item.kind) {
    case ItemKind::Object:
      return name(world.find(world::ObjectId{item.id}));
    case ItemKind::Material:
      return name(world.find(world::MaterialId{item.id}));
    case ItemKind::Texture:
      return name(world.find(world::TextureId{item.id}));
    case ItemKind::Scene:
      return name(world.find(world::SceneId{item.id}));
    case ItemKind::Shape:
      break;
  }
  return {};
}

std::string called(const world::World& world, Item item) {
  static constexpr const char* kKinds[] = {"object", "shape", "material", "texture", "scene"};
  const std::string name = name_of(world, item);
  if (!name.empty()) return fmt::format("\"{}\"", name);
  return fmt::format("{} {}", kKinds[std::size_t(item.kind)], item.id & world::IdSource::kNumberMask);
}

std::vector<Touched> touched_by(const world::Edit& edit) {
  std::vector<Touched> touched;
  std::visit(NoteTouched{touched}, edit.what);
  keep_each_once(touched);
  return touched;
}

Needs needs_of(const world::Edit& edit) {
  Needs needs;
  std::set<Item> made;
  std::visit(NoteNeeds{needs, made}, edit.what);
  keep_each_once(needs.items);
  keep_each_once(needs.entered);
  return needs;
}

std::string edit_word(const world::Edit& edit) { return std::visit(EditWord{}, edit.what); }

}  // namespace icome::collab
