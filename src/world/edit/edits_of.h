#pragma once
#include <vector>

#include "world/edit/edit.h"

namespace icome::world {

/// The edits that turn an empty world into an equal one: the same ids, orders and scenes, and no number is
/// given twice. None is a group, and the same world gives the same edits. They share the world's shapes, and
/// make copies that nobody has changed as copies again.
std::vector<Edit> edits_of(const World& world);

}  // namespace icome::world
