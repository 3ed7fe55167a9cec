#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <variant>

#include "geometry/deform/texture_projection.h"
#include "interaction/operations/looks/texture_projector.h"
#include "interaction/operations/near_names.h"
#include "interaction/operations/object_frames.h"
#include "interaction/operations/placement.h"
#include "interaction/operations/shapes/shape_change.h"
#include "world/shape/solid_geometry.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::Bounds;
using base::fail;
using base::Matrix3;
using base::Result;
using geometry::TextureProjection;
using world::TextureId;

constexpr double kLeastSize = 1e-9, kMostSize = 1e9;  // m

TextureProjection projection_of(const std::string& name) {
  if (name == "box" || name == "own") return TextureProjection::Box;
  if (name == "cylindrical") return TextureProjection::Cylindrical;
  if (name == "spherical") return TextureProjection::Spherical;
  return TextureProjection::Planar;
}

/// Orientation of a projector that is not turned, whose axis is z, in an object, whose y is up. A plane lies
/// across the side along which the object is thinnest; all others stand upright.
Matrix3 untilted(TextureProjection projection, const Vector3& sizes) {
  Matrix3 lying, facing_x;
  lying << Vector3::UnitX(), -Vector3::UnitZ(), Vector3::UnitY();  // columns: seen from above
  facing_x << -Vector3::UnitZ(), Vector3::UnitY(), Vector3::UnitX();
  if (projection != TextureProjection::Planar) return lying;
  const double thinnest = sizes.minCoeff();
  if (sizes.z() == thinnest) return Matrix3::Identity();
  return sizes.y() == thinnest ? lying : facing_x;
}

/// The projector of these arguments; by default it fits round the shape.
Result<geometry::TextureProjector> projector_of(const Bounds& box, const Arguments& arguments) {
  if (box.isEmpty()) return fail("there is nothing to project on: the shape has no triangles");
  geometry::TextureProjector projector;
  projector.projection = projection_of(arguments.text("projection"));
  const Matrix3 turn = turn_of(arguments.vector("turn"));
  const Affine3 fitted = geometry::fitted_projector(box);
  const Vector3 size = arguments.has("size") ? arguments.vector("size") : Vector3(fitted.linear().diagonal());
  Affine3& frame = projector.mesh_from_projector;
  frame.linear() = turn * size.asDiagonal() * untilted(projector.projection, box.sizes());
  frame.translation() = arguments.has("at") ? arguments.vector("at") : Vector3(fitted.translation());
  return projector;
}

/// The file's name without its folders.
std::string_view last_part(std::string_view path) { return path.substr(path.find_last_of("/\\") + 1); }

Result<TextureId> named_picture(const world::World& world, const std::string& name) {
  std::vector<TextureId> found;
  std::vector<std::string> names;
  for (const auto& [id, texture] : world.textures()) {
    if (fmt::format("#{}", id.value) == name) return id;
    if (texture.name == name || last_part(texture.name) == name) found.push_back(id);
    names.emplace_back(last_part(texture.name));
  }
  if (found.empty())
    return fail(
        fmt::format("the design has no picture named '{}'{}", name, suggestion(name, std::move(names))));
  std::ranges::sort(found);
  if (found.size() > 1)
    return fail(fmt::format("there are {} pictures named '{}'; name one by its number, such as '#{}'",
                            found.size(), name, found.front().value));
  return found.front();
}

/// The picture that the object is to show, and the edit that brings it into the design where it is not there
/// yet. None where none is named.
struct ChosenPicture {
  TextureId id = {};
  std::string name = {};
  world::EditGroup creation = {};
};

/// An equal picture that the design has already, so that a file that is named twice is kept once.
TextureId same_picture(const world::World& world, const world::Texture& wanted) {
  TextureId found;
  for (const auto& [id, texture] : world.textures()) {
    const bool same = texture.name == wanted.name && texture.media_type == wanted.media_type &&
                      texture.repeats == wanted.repeats && texture.bytes && *texture.bytes == *wanted.bytes;
    if (same && (!found || id < found)) found = id;
  }
  return found;
}

Result<ChosenPicture> picture_of_file(const world::World& world, const Arguments& arguments,
                                      world::IdSource& ids) {
  auto read = arguments.picture("file");
  if (!read) return tl::unexpected(read.error());
  ChosenPicture picture{.id = same_picture(world, *read), .name = read->name};
  if (picture.id) return picture;
  picture.id = ids.next<TextureId>();
  picture.creation.edits.emplace_back(world::CreateTexture{picture.id, std::move(*read)});
  return picture;
}

Result<ChosenPicture> chosen_picture(const world::World& world, const Arguments& arguments,
                                     world::IdSource& ids) {
  if (arguments.has("file") && arguments.has("picture"))
    return fail("say either a 'picture' that the design has or the 'file' of one, not both");
  if (arguments.has("file")) return picture_of_file(world, arguments, ids);
  if (!arguments.has("picture")) return ChosenPicture();
  const auto named = named_picture(world, arguments.text("picture"));
  if (!named) return tl::unexpected(named.error());
  return ChosenPicture{.id = *named, .name = world.find(*named)->name};
}

/// The picture's name, with a number behind it where a material has that name.
std::string unused_material_name(const world::World& world, std::string_view picture) {
  std::set<std::string_view> taken;
  for (const auto& [id, material] : world.materials()) taken.insert(material.name);
  std::string name(picture);
  for (int number = 2; taken.contains(name); ++number) name = fmt::format("{} {}", picture, number);
  return name;
}

/// Makes the object show the picture, in its own colours where the object had no material. A material that
/// others have stays as it is for them.
void show(const world::World& world, world::ObjectId object, const ChosenPicture& picture,
          world::IdSource& ids, world::EditGroup& group) {
  const world::MaterialId id = world.find(object)->material;
  const world::Material* now = world.find(id);
  const bool lies_so = now && now->picture_frame == world::kPictureAsItLies;
  if (lies_so && now->texture == picture.id) return;
  world::Material material = now ? *now : world::Material{.diffuse = {1.0F, 1.0F, 1.0F}};
  material.texture = picture.id;
  material.picture_frame = world::kPictureAsItLies;  // the projection alone says where it lies
  if (now && now->users == 1) {
    group.edits.push_back(world::ChangeMaterial{id, std::move(material)});
    return;
  }
  material.name = unused_material_name(world, last_part(picture.name));
  const auto own = ids.next<world::MaterialId>();
  group.edits.push_back(world::CreateMaterial{own, std::move(material)});
  group.edits.push_back(world::ChooseMaterial{object, own});
}

/// Has the shape places of its own in a picture? VRML 2.0 says so of some primitives (6.6, 6.10, 6.11, 6.42).
bool has_own_places(const world::Geometry& shape) {
  if (const auto* mesh = dynamic_cast<const world::MeshGeometry*>(&shape))
    return !mesh->texture_coordinates.empty();
  const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(&shape);
  if (!primitive) return false;
  const geometry::Primitive& it = primitive->primitive;
  return std::holds_alternative<geometry::Box>(it) || std::holds_alternative<geometry::Sphere>(it) ||
         std::holds_alternative<geometry::Cylinder>(it) || std::holds_alternative<geometry::Cone>(it);
}

/// Fails where the shape has no texture coordinates of its own and neither is a mesh nor may become one.
Result<void> check_places(const world::World& world, const ShapeChange& change, const Arguments& arguments) {
  if (has_own_places(*change.shape) || dynamic_cast<const world::MeshGeometry*>(change.shape.get()))
    return {};
  if (arguments.flag("as_mesh")) return {};
  return fail(
      fmt::format("'{}' is {}, on which a picture has no place of its own: say another 'projection' and "
                  "\"as_mesh\": true, which makes triangles of it",
                  world.find(change.object)->name, kind_in_words(*change.shape)));
}

/// The plan that gives the shape texture coordinates.
Result<Plan> plan_projection(ShapeChange& change, const Arguments& arguments, world::IdSource& ids) {
  const auto shape = mesh_to_change(change, arguments);
  if (!shape) return tl::unexpected(shape.error());
  const auto projector = projector_of((*shape)->bounds(), arguments);
  if (!projector) return tl::unexpected(projector.error());
  const auto textured = with_projector(**shape, *projector);
  if (!textured) return tl::unexpected(textured.error());
  return plan_of_shape(change, *textured, ids);
}

Result<void> check_own(const Arguments& arguments) {
  const auto is_given = [&](const char* name) { return field(arguments.given(), name) != nullptr; };
  if (is_given("at") || is_given("turn") || is_given("size"))
    return fail("'at', 'turn' and 'size' place a projector, and 'own' has none: name another 'projection'");
  if (!arguments.has("file") && !arguments.has("picture"))
    return fail("say which picture is to be shown: the 'file' of one, or a 'picture' that the design has");
  return {};
}

Result<Plan> plan_texture(const world::World& world, const Arguments& arguments, world::IdSource& ids) {
  auto change = shape_change(world, arguments);
  if (!change) return tl::unexpected(change.error());
  const bool own = arguments.text("projection") == "own";
  if (own) {
    if (const auto good = check_own(arguments); !good) return tl::unexpected(good.error());
    if (const auto good = check_places(world, *change, arguments); !good) return tl::unexpected(good.error());
  }
  const auto picture = chosen_picture(world, arguments, ids);
  if (!picture) return tl::unexpected(picture.error());
  Plan plan{world::EditGroup(), {change->object}};
  if (!own || !has_own_places(*change->shape)) {
    auto projected = plan_projection(*change, arguments, ids);
    if (!projected || !picture->id) return projected;
    plan = std::move(*projected);
  }
  world::EditGroup group = picture->creation;
  group.edits.push_back(std::move(plan.edit));
  show(world, change->object, *picture, ids, group);
  plan.edit = std::move(group);
  return plan;
}

// ---- Move the projector -------------------------------------------------------------------------------

Result<Plan> plan_move_projector(const world::World& world, const Arguments& arguments,
                                 world::IdSource& ids) {
  const auto change = shape_change(world, arguments);
  if (!change) return tl::unexpected(change.error());
  const auto projector = projector_in(*change->shape);
  if (!projector)
    return fail(
        fmt::format("nobody knows where the picture of {} was thrown from: throw it with 'texture' first",
                    called(world, change->object)));
  const Affine3 world_from_object = world::world_from_object(world, change->object);
  const Vector3 centre = arguments.has("centre")
                             ? arguments.vector("centre")
                             : Vector3(world_from_object * projector->mesh_from_projector.translation());
  Affine3 motion = about(centre, turn_of(arguments.vector("turn")));
  motion.translation() += arguments.vector("by");
  const auto& shape = static_cast<const world::MeshGeometry&>(*change->shape);
  const auto moved = with_projector(shape, moved_projector(*projector, world_from_object, motion));
  if (!moved) return tl::unexpected(moved.error());
  return plan_of_shape(*change, *moved, ids);
}

Operation move_projector_operation() {
  return {"move-projector",
          "Move projector",
          "Look",
          "Moves and turns what the picture on an object is thrown from, so that it lies elsewhere.",
          {object_parameter("on which 'texture' has thrown a picture"),
           place_parameter("by", "how far along the axes of the world, m"),
           turn_parameter("an axis in the world, as long as the angle in degrees, right-handed; before by"),
           optional_place_parameter("centre", "what it turns about, m in the world; else its middle"),
           alone_parameter()},
          plan_move_projector};
}

// ---- Texture ------------------------------------------------------------------------------------------

std::vector<Parameter> texture_parameters() {
  return {
      object_parameter("what gets texture coordinates"),
      {.name = "projection",
       .kind = ParameterKind::Choice,
       .meaning = "how the picture is thrown on it; own: as it already lies on the shape, and on a mesh "
                  "without texture "
                  "coordinates as by box",
       .fallback = "planar",
       .choices = {"planar", "box", "cylindrical", "spherical", "own"}},
      optional_place_parameter("at",
                               "the middle of what the picture is thrown from, in the object's frame, "
                               "m; else the object's"),
      turn_parameter("how that is turned: an axis, as long as the angle in degrees; untouched it is upright, "
                     "and planar along the object's thinnest side"),
      {.name = "size",
       .kind = ParameterKind::Vector,
       .meaning = "how wide, high and deep the picture reaches once, m; else as the object",
       .least = kLeastSize,
       .most = kMostSize},
      {.name = "file",
       .kind = ParameterKind::Picture,
       .meaning = "a picture (PNG, JPEG or GIF) that becomes part of the design, for this object to show; "
                  "scripts name it "
                  "as seen from their folder"},
      {.name = "picture",
       .kind = ParameterKind::Text,
       .meaning = "one of the design's pictures, for this object to show; else its material says"},
      alone_parameter(),
      as_mesh_parameter()};
}

}  // namespace

std::vector<Operation> texture_operations() {
  return {{"texture", "Project Texture", "Look",
           "Lays a picture on an object: one of a file or of the design. By projection each corner of a mesh "
           "gets texture "
           "coordinates.",
           texture_parameters(), plan_texture},
          move_projector_operation()};
}

}  // namespace icome::interaction
