#include "speech/dialogue/things.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parse_number.h"
#include "base/srgb.h"
#include "world/shape/visit_geometry.h"

namespace icome::speech {
namespace {

using world::Colour;
using world::World;

std::string kind_of(const geometry::Primitive& primitive) {
  struct Names {
    std::string operator()(const geometry::Plane&) const { return "plane"; }
    std::string operator()(const geometry::Box&) const { return "box"; }
    std::string operator()(const geometry::Sphere&) const { return "sphere"; }
    std::string operator()(const geometry::Cylinder&) const { return "cylinder"; }
    std::string operator()(const geometry::Cone&) const { return "cone"; }
    std::string operator()(const geometry::Torus&) const { return "torus"; }
    std::string operator()(const geometry::Capsule&) const { return "capsule"; }
  };
  return std::visit(Names{}, primitive);
}

/// The shape that a mesh was made as, such as a pyramid.
std::string kind_of(const world::MeshGeometry& mesh) {
  if (mesh.recipe.empty()) return "mesh";
  const auto recipe = interaction::value_from_json(mesh.recipe);
  if (!recipe || !recipe->fields()) return "mesh";
  const auto* const shape = interaction::field(*recipe->fields(), "shape");
  return shape && shape->text() ? *shape->text() : "mesh";
}

/// CIE 1976 L*a*b* of a colour under D65.
Vector3 lab_of(const Colour& colour) {
  const auto linear = base::linear_from_srgb(colour);
  const Vector3 rgb(linear[0], linear[1], linear[2]);
  base::Matrix3 xyz_from_rgb;
  xyz_from_rgb << 0.4124564, 0.3575761, 0.1804375, 0.2126729, 0.7151522, 0.0721750, 0.0193339, 0.1191920,
      0.9503041;
  const Vector3 white(0.95047, 1.0, 1.08883);
  const Vector3 xyz = (xyz_from_rgb * rgb).cwiseQuotient(white);
  const auto root = [](double part) {
    constexpr double kEdge = 216.0 / 24389.0, kSlope = 24389.0 / 27.0;
    return part > kEdge ? std::cbrt(part) : (kSlope * part + 16.0) / 116.0;
  };
  const double x = root(xyz.x()), y = root(xyz.y()), z = root(xyz.z());
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

/// The word of a table for a meaning; empty where there is none.
std::string word_for(const std::vector<WordMeaning>& table, std::string_view meaning) {
  const auto found = std::ranges::find(table, meaning, &WordMeaning::meaning);
  return found == table.end() ? std::string() : found->words;
}

/// The word of a table of numbers whose ratio to `value` is nearest to 1.
std::string nearest_size(const std::vector<WordMeaning>& sizes, double value) {
  std::string nearest;
  double least = 0.0;
  for (const WordMeaning& size : sizes) {
    const auto number = base::parse_number<double>(size.meaning);
    if (!number || !(value > 0.0)) continue;
    const double distance = std::abs(std::log(value / *number));
    if (!nearest.empty() && distance >= least) continue;
    nearest = size.words;
    least = distance;
  }
  return nearest;
}

}  // namespace

std::string shape_kind(const World& world, ObjectId id) {
  const world::PhysicalObject* const object = world.find(id);
  const world::GeometryObject* const geometry = object ? world.find(object->geometry) : nullptr;
  if (!geometry) return "group";
  return world::visit_geometry(
      *geometry->shape, [](const world::MeshGeometry& it) { return kind_of(it); },
      [](const world::PrimitiveGeometry& it) { return kind_of(it.primitive); },
      [](const world::Geometry& it) { return std::string(it.kind()); });
}

Colour colour_of(const World& world, ObjectId id) {
  const world::PhysicalObject* const object = world.find(id);
  const world::Material* const material = object ? world.find(object->material) : nullptr;
  return material ? material->diffuse : world::Material().diffuse;
}

std::optional<Colour> colour_from_hex(const std::string& hex) {
  constexpr std::size_t kLength = 7;
  if (hex.size() != kLength || hex.front() != '#') return std::nullopt;
  const auto rgb = base::parse_number<std::uint32_t>(std::string_view(hex).substr(1), 16);
  if (!rgb) return std::nullopt;
  const auto part = [&](unsigned shift) { return float((*rgb >> shift) & 0xffU) / 255.0F; };
  return Colour{part(16), part(8), part(0)};
}

std::string nearest_colour(const std::vector<WordMeaning>& colours, const Colour& colour) {
  const Vector3 wanted = lab_of(colour);
  std::string nearest;
  double least = 0.0;
  for (const WordMeaning& word : colours) {
    const auto known = colour_from_hex(word.meaning);
    if (!known) continue;
    const double distance = (lab_of(*known) - wanted).norm();
    if (!nearest.empty() && distance >= least) continue;
    nearest = word.meaning;
    least = distance;
  }
  return nearest;
}

double extent_of(const World& world, ObjectId id) {
  const Bounds box = world::bounds(world, id);
  return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

Vector3 middle_of(const World& world, ObjectId id) {
  const Bounds box = world::bounds(world, id);
  return box.isEmpty() ? Vector3(world::world_from_object(world, id).translation()) : Vector3(box.center());
}

std::vector<ObjectId> speakable_objects(const World& world, bool top) {
  std::vector<ObjectId> objects;
  if (top) {
    for (const ObjectId root : world.roots()) {
      const auto below = world::subtree(world, root);
      const auto has_shape = [&](ObjectId id) { return bool(world.find(id)->geometry); };
      if (std::ranges::any_of(below, has_shape)) objects.push_back(root);
    }
  } else {
    for (const auto& [id, object] : world.objects())
      if (object.geometry) objects.push_back(id);
  }
  std::ranges::sort(objects);
  return objects;
}

std::string looks_in_words(const Vocabulary& vocabulary, const World& world, ObjectId id) {
  const std::string kind = shape_kind(world, id);
  if (kind == "group") return "group";
  std::string noun = word_for(vocabulary.table("shape"), kind);
  if (noun.empty()) noun = word_for(vocabulary.table("kind"), kind);
  if (noun.empty()) noun = "thing";
  const auto& colours = vocabulary.table("colour");
  const std::string colour = word_for(colours, nearest_colour(colours, colour_of(world, id)));
  const std::string size = nearest_size(vocabulary.table("size"), extent_of(world, id));
  return fmt::format("{}{}{}{}{}", size, size.empty() ? "" : " ", colour, colour.empty() ? "" : " ", noun);
}

}  // namespace icome::speech
