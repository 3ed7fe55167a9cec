#include "files/vrml/worker/scene_walk.h"

#include <Inventor/VRMLnodes/SoVRMLInline.h>
#include <Inventor/VRMLnodes/SoVRMLLOD.h>
#include <Inventor/VRMLnodes/SoVRMLParent.h>
#include <Inventor/VRMLnodes/SoVRMLShape.h>
#include <Inventor/VRMLnodes/SoVRMLSwitch.h>
#include <Inventor/VRMLnodes/SoVRMLTransform.h>
#include <Inventor/VRMLnodes/SoVRMLViewpoint.h>
#include <Inventor/VRMLnodes/SoVRMLWorldInfo.h>
#include <Inventor/fields/SoMFString.h>
#include <Inventor/fields/SoSFBool.h>
#include <Inventor/fields/SoSFString.h>
#include <Inventor/misc/SoProtoInstance.h>

#include <algorithm>
#include <utility>

#include "files/vrml/worker/field_values.h"
#include "files/vrml/worker/node_parts.h"

namespace icome::files {
namespace {

constexpr int kNodeLimit = 2'000'000;
constexpr int kWalkDepthLimit = 6000;

template <typename Node>
const Node* as(const SoNode* node) {
  return node->isOfType(Node::getClassTypeId()) ? static_cast<const Node*>(node) : nullptr;
}

/// The title of a WorldInfo among the children of a group, which names the group.
std::string title_among(const SceneFiles& files, const SoMFNode& children, int first, int last) {
  for (int i = first; i < last; ++i)
    if (const SoNode* child = children[i])
      if (const auto* info = as<SoVRMLWorldInfo>(child))
        if (info->title.getValue().getLength() > 0) return files.original(info->title.getValue().getString());
  return {};
}

}  // namespace

SceneWalk::SceneWalk(SceneFiles& files, Answer& answer)
    : files_(files),
      answer_(answer),
      wrapping_(files),
      appearances_(files, answer, wrapping_),
      geometries_(files, answer, wrapping_),
      motions_(files, answer) {}

void SceneWalk::walk(SceneFile& design) {
  design.inlined = 1;
  for (SoNode* root : design.roots) visit(root, Place{&design});
  motions_.tell_what_moves();
}

void SceneWalk::count_visit() {
  if (++visits_ > kNodeLimit)
    throw Refusal{"holds more than " + std::to_string(kNodeLimit) + " nodes, counting each USE"};
}

void SceneWalk::visit(SoNode* node, Place place) {
  if (!node) return;
  count_visit();
  if (place.depth > kWalkDepthLimit) throw Refusal{"nests nodes too deep"};
  const Unwrapped it = wrapping_.unwrap(node, *place.file);
  if (!it.node) return;
  if (!above_.insert(node).second) {
    answer_.note(place.file->told, 0, "A node that holds itself is left out there.");
    return;
  }
  NodeParts parts;
  parts.parent = place.parent;
  parts.reused = place.reused || !met_.insert(node).second;
  const std::string inner = files_.original_name(it.node->getName());
  parts.def = it.instance ? files_.original_name(it.instance->getName()) : inner;
  parts.name = parts.def.empty() ? inner : parts.def;
  const Place within{it.file, place.parent, parts.reused, place.depth + 1};
  if (const auto* shape = as<SoVRMLShape>(it.node)) {
    visit_shape(*shape, parts, within);
  } else if (const auto* part = as<SoVRMLInline>(it.node)) {
    visit_inline(*part, parts, within);
  } else if (!visit_scene(it, parts) && !visit_effect(it, parts) && !visit_group(it, parts, within) &&
             fill_light_or_viewpoint(*it.node, parts)) {
    answer_.add(parts);
  }
  above_.erase(node);
}

bool SceneWalk::visit_group(const Unwrapped& it, NodeParts& parts, const Place& place) {
  const SoMFNode* children = nullptr;
  int first = 0;
  int last = 0;
  if (const auto* group = as<SoVRMLParent>(it.node)) {
    children = &group->children;
    last = children->getNum();
    if (const auto* transform = as<SoVRMLTransform>(it.node)) {
      parts.matrix = matrix_of(*transform);
      parts.motion = motions_.number_of(*transform);
    }
  } else if (const auto* levels = as<SoVRMLLOD>(it.node)) {
    children = &levels->level;
    last = std::min(children->getNum(), 1);
  } else if (const auto* choices = as<SoVRMLSwitch>(it.node)) {
    children = &choices->choice;
    first = std::clamp(choices->whichChoice.getValue(), -1, children->getNum());
    last = first >= 0 ? std::min(first + 1, children->getNum()) : first;
    if (children->getNum() > last - first)
      answer_.note(place.file->told, 0, "Of a Switch only what it shows is kept.");
  } else {
    return false;
  }
  visit_children(*children, first, last, parts, place);
  return true;
}

void SceneWalk::visit_children(const SoMFNode& children, int first, int last, NodeParts& parts,
                               const Place& place) {
  if (std::string title = title_among(files_, children, first, last); !title.empty())
    parts.name = std::move(title);
  Place within = place;
  within.parent = answer_.add(parts);
  within.file = &wrapping_.home(children, *place.file);
  for (int i = first; i < last; ++i) visit(children[i], within);
}

void SceneWalk::visit_inline(const SoVRMLInline& it, NodeParts& parts, const Place& place) {
  Place within = place;
  within.parent = answer_.add(parts);
  SceneFile* file = files_.fetch(wrapping_.home(it.url, *place.file), files_.strings(it.url), "Inline");
  if (!file) return;
  if (file->inlined > 0) {
    answer_.note(place.file->told, 0, "An Inline of the file that it is in is left out.");
    return;
  }
  within.file = file;
  ++file->inlined;
  // A file that is inlined twice is read once; its nodes do not count as reused by USE.
  auto met = std::exchange(met_, {});
  for (SoNode* root : file->roots) visit(root, within);
  met_ = std::move(met);
  --file->inlined;
}

void SceneWalk::visit_shape(const SoVRMLShape& it, NodeParts& parts, const Place& place) {
  const Unwrapped geometry = wrapping_.unwrap(it.geometry, *place.file);
  if (geometry.node) {
    const auto number = geometries_.number_of(geometry);
    if (!number) return;
    parts.geometry = *number;
  }
  parts.appearance = appearances_.number_of(wrapping_.unwrap(it.appearance, *place.file));
  if (parts.geometry >= 0 || parts.appearance >= 0) answer_.add(parts);
}

/// IcomeScene is not an object but a list of objects.
bool SceneWalk::visit_scene(const Unwrapped& it, NodeParts& parts) {
  if (!it.instance || it.instance->getProtoName() != "IcomeScene") return false;
  const SoField* name = find_field(*it.instance, "name", "SFString");
  const SoField* members = find_field(*it.instance, "objects", "MFString");
  if (!name || !members) return false;
  parts.scene = files_.original(static_cast<const SoSFString*>(name)->getValue().getString());
  parts.members = files_.strings(*static_cast<const SoMFString*>(members));
  if (!parts.scene.empty()) answer_.add(parts);
  return true;
}

/// IcomeEffect is a group without children.
bool SceneWalk::visit_effect(const Unwrapped& it, NodeParts& parts) {
  if (!it.instance || it.instance->getProtoName() != "IcomeEffect") return false;
  const SoField* text = find_field(*it.instance, "effect", "SFString");
  const SoField* on = find_field(*it.instance, "on", "SFBool");
  if (!text || !on) return false;
  parts.force = ForceParts{files_.original(static_cast<const SoSFString*>(text)->getValue().getString()),
                           static_cast<const SoSFBool*>(on)->getValue() != FALSE};
  if (!parts.force->text.empty()) answer_.add(parts);
  return true;
}

}  // namespace icome::files
