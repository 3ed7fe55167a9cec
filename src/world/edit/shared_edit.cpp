#include "world/edit/shared_edit.h"

#include <algorithm>

namespace icome::world {
namespace {

/// Does the edit make new shapes of those that are there?
bool makes_shapes(const Edit& edit) {
  if (const auto* group = std::get_if<EditGroup>(&edit.what))
    return std::any_of(group->edits.begin(), group->edits.end(), makes_shapes);
  return std::holds_alternative<MoveVertices>(edit.what) || std::holds_alternative<AmendGeometry>(edit.what);
}

base::Result<SharedEdit> perform_group(World& world, const EditGroup& group, const Fit& fit) {
  EditGroup inverse, for_replicas;
  for (const Edit& edit : group.edits) {
    auto done = perform_shared(world, edit, fit);
    if (!done) {
      // All or none, as in apply().
      for (auto back = inverse.edits.rbegin(); back != inverse.edits.rend(); ++back)
        (void)apply(world, *back);
      return tl::unexpected(done.error());
    }
    inverse.edits.push_back(std::move(done->inverse));
    for_replicas.edits.push_back(std::move(done->for_replicas));
  }
  std::reverse(inverse.edits.begin(), inverse.edits.end());
  return SharedEdit{std::move(inverse), std::move(for_replicas)};
}

}  // namespace

base::Result<SharedEdit> perform_shared(World& world, const Edit& edit, const Fit& fit) {
  const bool makes = makes_shapes(edit);
  const auto* const group = std::get_if<EditGroup>(&edit.what);
  if (group && (makes || fit)) return perform_group(world, *group, fit);
  const std::optional<Edit> fitted = fit ? fit(world, edit) : std::nullopt;
  const Edit& performed = fitted ? *fitted : edit;
  auto inverse = apply(world, performed);
  if (!inverse) return tl::unexpected(inverse.error());
  if (!makes) return SharedEdit{std::move(*inverse), performed};
  const auto* const moved = std::get_if<MoveVertices>(&performed.what);
  const GeometryId id = moved ? moved->id : std::get<AmendGeometry>(performed.what).id;
  return SharedEdit{std::move(*inverse), ReplaceGeometry{id, world.find(id)->shape}};
}

}  // namespace icome::world
