#pragma once
#include <span>

#include "files/vrml/worker/wrapping.h"

class SoMFColor;
class SoMFFloat;
class SoMFInt32;
class SoMFVec2f;
class SoMFVec3f;

namespace icome::files {

/// The numbers of a field in place; Coin keeps vectors and colours as plain floats.
std::span<const float> floats(const SoMFFloat& field);
std::span<const float> floats(const SoMFVec2f& field);
std::span<const float> floats(const SoMFVec3f& field);
std::span<const float> floats(const SoMFColor& field);
std::span<const int> indices(const SoMFInt32& field);

/// Null: it is missing or of another type. (`Base` is complete where this is used.)
template <typename Node, typename Base = SoNode>
const Node* geometry_as(const Unwrapped& it) {
  const Base* node = it.node;
  return node && node->isOfType(Node::getClassTypeId()) ? static_cast<const Node*>(node) : nullptr;
}

}  // namespace icome::files
