#include "session/shared_edit.h"

#include <algorithm>

namespace icome::session {
namespace {

using world::Edit;
using world::EditGroup;
using world::MoveVertices;
using world::World;

/// Does the edit make new shapes of those that are there?
bool makes_shapes(const Edit& edit) {
  if (const auto* group = std::get_if<EditGroup>(&edit.what))
    return std::any_of(group->edits.begin(), group->edits.end(), makes_shapes);
  return std::holds_alternative<MoveVertices>(edit.what);
}

base::Result<SharedEdit> perform_group(World& world, const EditGroup& group) {
  EditGroup inverse, for_replicas;
  for (const Edit& edit : group.edits) {
    auto done = perform_shared(world, edit);
    if (!done) {
      // All or none, as in world::apply.
      for (auto back = inverse.edits.rbegin(); back != inverse.edits.rend(); ++back)
        (void)world::apply(world, *back);
      return tl::unexpected(done.error());
    }
    inverse.edits.push_back(std::move(done->inverse));
    for_replicas.edits.push_back(std::move(done->for_replicas));
  }
  std::reverse(inverse.edits.begin(), inverse.edits.end());
  return SharedEdit{std::move(inverse), std::move(for_replicas)};
}

}  // namespace

base::Result<SharedEdit> perform_shared(World& world, const Edit& edit) {
  const bool makes = makes_shapes(edit);
  if (const auto* group = std::get_if<EditGroup>(&edit.what); group && makes)
    return perform_group(world, *group);
  auto inverse = world::apply(world, edit);
  if (!inverse) return tl::unexpected(inverse.error());
  if (!makes) return SharedEdit{std::move(*inverse), edit};
  const world::GeometryId id = std::get<MoveVertices>(edit.what).id;
  return SharedEdit{std::move(*inverse), world::ReplaceGeometry{id, world.find(id)->shape}};
}

}  // namespace icome::session
