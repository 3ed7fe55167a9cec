#include "interaction/operations/looks/texture_projector.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "interaction/operations/value.h"

namespace icome::interaction {
namespace {

using geometry::TextureProjection;
using geometry::TextureProjector;

constexpr std::array<std::pair<std::string_view, TextureProjection>, 4> kProjections = {
    {{"planar", TextureProjection::Planar},
     {"box", TextureProjection::Box},
     {"cylindrical", TextureProjection::Cylindrical},
     {"spherical", TextureProjection::Spherical}}};

std::string recipe_of_projector(const TextureProjector& projector) {
  const auto named =
      std::ranges::find(kProjections, projector.projection, &decltype(kProjections)::value_type::second);
  Value::List frame;  // column after column, the origin last
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) frame.emplace_back(projector.mesh_from_projector(row, column));
  return json_from_value(Value::Fields{
      {"op", "texture"}, {"projection", std::string(named->first)}, {"frame", std::move(frame)}});
}

/// Many times the length of a recipe_of_projector(): names, and twelve numbers of up to 24 characters.
constexpr std::size_t kLongestRecipe = 4096;

/// The named values of a recipe of "texture"; nothing for others.
std::optional<Value> projector_value(std::string_view recipe) {
  // Called for every selected mesh at each step of a drag: recipes of other operations are not parsed.
  const bool may_be = recipe.size() <= kLongestRecipe && recipe.find("\"texture\"") != std::string_view::npos;
  if (!may_be) return std::nullopt;
  auto value = value_from_json(recipe);
  const Value::Fields* const fields = value ? value->fields() : nullptr;
  const Value* const op = fields ? field(*fields, "op") : nullptr;
  if (!op || !op->text() || *op->text() != "texture") return std::nullopt;
  return std::move(*value);
}

std::optional<base::Affine3> frame_in(const Value::Fields& fields) {
  const Value* const said = field(fields, "frame");
  const Value::List* const numbers = said ? said->list() : nullptr;
  if (!numbers || numbers->size() != 12) return std::nullopt;
  base::Affine3 frame = base::Affine3::Identity();
  for (int i = 0; i < 12; ++i) {
    const double* const number = (*numbers)[std::size_t(i)].number();
    if (!number) return std::nullopt;
    frame(i % 3, i / 3) = *number;
  }
  return frame;
}

}  // namespace

bool tells_projector_only(std::string_view recipe) { return projector_value(recipe).has_value(); }

std::optional<TextureProjector> projector_in(const world::Geometry& shape) {
  const auto value = projector_value(world::recipe_of(shape));
  if (!value) return std::nullopt;
  const Value* const said = field(*value->fields(), "projection");
  const auto frame = frame_in(*value->fields());
  if (!said || !said->text() || !frame) return std::nullopt;
  const auto named = std::ranges::find(kProjections, std::string_view(*said->text()),
                                       &decltype(kProjections)::value_type::first);
  if (named == kProjections.end()) return std::nullopt;
  return TextureProjector{.projection = named->second, .mesh_from_projector = *frame};
}

TextureProjector moved_projector(TextureProjector projector, const base::Affine3& world_from_object,
                                 const base::Affine3& motion) {
  base::Affine3& frame = projector.mesh_from_projector;
  frame = world_from_object.inverse() * motion * world_from_object * frame;
  return projector;
}

base::Result<std::shared_ptr<const world::MeshGeometry>> with_projector(const world::MeshGeometry& mesh,
                                                                        const TextureProjector& projector) {
  auto coordinates = geometry::project_texture(mesh.mesh, projector);
  if (!coordinates) return tl::unexpected(coordinates.error());
  auto textured = std::make_shared<world::MeshGeometry>(mesh.mesh);
  textured->texture_coordinates = std::move(*coordinates);
  textured->normals = mesh.normals;
  textured->colours = mesh.colours;
  textured->recipe = recipe_of_projector(projector);
  return textured;
}

}  // namespace icome::interaction
