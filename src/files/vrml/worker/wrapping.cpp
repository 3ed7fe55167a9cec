#include "files/vrml/worker/wrapping.h"

#include <Inventor/VRMLnodes/SoVRMLParent.h>
#include <Inventor/fields/SoSFNode.h>
#include <Inventor/misc/SoProto.h>
#include <Inventor/misc/SoProtoInstance.h>
#include <Inventor/nodes/SoGroup.h>

namespace icome::files {
namespace {

/// Limits PROTOs within PROTOs, and values passed from one to the next.
constexpr int kWrappingLimit = 1000;

/// Coin puts the nodes of a PROTO that has several into a group of its own; the first one counts.
SoNode* first_node(SoNode* root) {
  if (root->getTypeId() != SoGroup::getClassTypeId()) return root;
  const auto* group = static_cast<SoGroup*>(root);
  for (int i = 0; i < group->getNumChildren(); ++i)
    if (!group->getChild(i)->isOfType(SoProto::getClassTypeId())) return group->getChild(i);
  return nullptr;
}

}  // namespace

Unwrapped Wrapping::unwrap(SoNode* node, const SceneFile& file) {
  Unwrapped it{node, nullptr, &file};
  for (int i = 0; it.node && i < kWrappingLimit; ++i) {
    SoProtoInstance* instance = SoProtoInstance::findProtoInstance(it.node);
    SoNode* inner = first_node(it.node);
    if (instance) {
      instances_[instance] = it.file;
      if (const SceneFile* home = files_.home(instance->getProtoDefinition())) it.file = home;
      if (!it.instance) it.instance = instance;
    }
    if (inner == it.node) break;
    it.node = inner;
  }
  return it;
}

Unwrapped Wrapping::unwrap(const SoSFNode& field, const SceneFile& file) {
  return unwrap(field.getValue(), home(field, file));
}

const SceneFile* Wrapping::place(const SoProtoInstance& instance) const {
  const auto found = instances_.find(&instance);
  return found == instances_.end() ? nullptr : found->second;
}

const SceneFile& Wrapping::home(const SoField& field, const SceneFile& file) const {
  const SceneFile* home = &file;
  SoField* from = nullptr;
  const SoField* value = &field;
  for (int i = 0; i < kWrappingLimit && value->getConnectedField(from) && from; ++i) {
    const auto instance = instances_.find(from->getContainer());
    if (instance == instances_.end()) break;
    home = instance->second;
    value = from;
  }
  return *home;
}

}  // namespace icome::files
