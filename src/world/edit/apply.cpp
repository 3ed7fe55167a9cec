#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "world/edit/edit.h"
#include "world/edit/permit.h"
#include "world/motion.h"
#include "world/row.h"
#include "world/shape/mesh_geometry.h"

namespace icome::world {
namespace {

using base::fail;
using base::Result;

tl::unexpected<base::Error> bad_frame() {
  return fail("An object's place must be a finite transform that does not flatten it.");
}

/// The object in messages: its name in quotes or, for one without a name, "object 12".
std::string called(const PhysicalObject& object, ObjectId id) {
  return object.name.empty() ? fmt::format("object {}", id.value & IdSource::kNumberMask)
                             : fmt::format("\"{}\"", object.name);
}

}  // namespace

/// Applies edits to a world; each function gives the inverse.
class EditApplier {
 public:
  /// `alone`: nobody else reads the world or the shapes that only it holds.
  EditApplier(World& world, bool alone, Permit permit = {})
      : world_(world), alone_(alone), permit_(std::move(permit)) {}

  Result<Edit> perform(const Edit& edit) {
    const bool is_single = !std::holds_alternative<EditGroup>(edit.what);
    if (is_single && !permitted(sizeof(Edit))) return not_permitted();
    return std::visit(*this, edit.what);
  }

  Result<Edit> operator()(const CreateObject& it) {
    if (const auto fresh = check_new(it.id, world_.objects_, "object"); !fresh)
      return tl::unexpected(fresh.error());
    const PhysicalObject& object = it.object;
    if (!object.children.empty()) return fail("A new object cannot have children yet.");
    if (!can_be_placed(object.parent_from_object)) return bad_frame();
    if (object.parent && !world_.find(object.parent))
      return fail("The object to put the new one under is not there any more.");
    if (object.geometry && !world_.find(object.geometry))
      return fail("The shape that the new object should have is not there any more.");
    if (object.material && !world_.find(object.material))
      return fail("The material that the new object should have is not there any more.");
    if (const auto good = check(object.fixture); !good) return tl::unexpected(good.error());
    if (const auto good = check(object.motion); !good) return tl::unexpected(good.error());
    if (it.place > siblings(object.parent).size()) return bad_place();
    PhysicalObject& kept = world_.objects_[it.id] = object;
    kept.place_hint = std::uint32_t(it.place);
    kept.scenes = 0;
    insert(siblings(object.parent), it.place, it.id);
    use(object.geometry, 1);
    use(object.material, 1);
    remember(it.id.value);
    return Edit(DeleteObject{it.id});
  }

  Result<Edit> operator()(const DeleteObject& it) {
    const PhysicalObject* object = world_.find(it.id);
    if (!object) return gone("object");
    if (!object->children.empty())
      return fail(fmt::format("{} has objects below it: delete those too.", called(*object, it.id)));
    if (object->scenes > 0)
      return fail(fmt::format("{} is in the scene \"{}\": take it out first.", called(*object, it.id),
                              scene_with(it.id).name));
    std::vector<ObjectId>& row = siblings(object->parent);
    const CreateObject back{it.id, place_near(row, it.id, object->place_hint), *object};
    row.erase(row.begin() + std::ptrdiff_t(back.place));
    use(object->geometry, -1);
    use(object->material, -1);
    world_.objects_.erase(it.id);
    return Edit(back);
  }

  Result<Edit> operator()(const MoveObject& it) {
    const auto found = world_.objects_.find(it.id);
    if (found == world_.objects_.end()) return gone("object");
    PhysicalObject& object = found->second;
    if (!can_be_placed(it.parent_from_object)) return bad_frame();
    if (it.parent && !world_.find(it.parent))
      return fail(fmt::format("The object to put {} under is not there any more.", called(object, it.id)));
    if (it.parent && is_within(world_, it.parent, it.id))
      return fail(fmt::format("{} cannot be put under itself.", called(object, it.id)));
    std::vector<ObjectId>& from = siblings(object.parent);
    const MoveObject back{it.id, object.parent, place_near(from, it.id, object.place_hint),
                          object.parent_from_object};
    const std::size_t room = siblings(it.parent).size() - (it.parent == object.parent ? 1 : 0);
    if (it.place > room) return bad_place();
    from.erase(from.begin() + std::ptrdiff_t(back.place));
    insert(siblings(it.parent), it.place, it.id);
    object.place_hint = std::uint32_t(it.place);
    object.parent = it.parent;
    object.parent_from_object = it.parent_from_object;
    return Edit(back);
  }

  Result<Edit> operator()(const PlaceObject& it) {
    if (!can_be_placed(it.parent_from_object)) return bad_frame();
    return exchange(it, &PhysicalObject::parent_from_object, &PlaceObject::parent_from_object);
  }
  Result<Edit> operator()(const RenameObject& it) {
    return exchange(it, &PhysicalObject::name, &RenameObject::name);
  }
  Result<Edit> operator()(const ChooseGeometry& it) {
    return choose(it, &PhysicalObject::geometry, &ChooseGeometry::geometry, "shape");
  }
  Result<Edit> operator()(const ChooseMaterial& it) {
    return choose(it, &PhysicalObject::material, &ChooseMaterial::material, "material");
  }
  Result<Edit> operator()(const ChangeFixture& it) {
    if (const auto good = check(it.fixture); !good) return tl::unexpected(good.error());
    return exchange(it, &PhysicalObject::fixture, &ChangeFixture::fixture);
  }
  Result<Edit> operator()(const ChangeMotion& it) {
    if (const auto good = check(it.motion); !good) return tl::unexpected(good.error());
    return exchange(it, &PhysicalObject::motion, &ChangeMotion::motion);
  }

  Result<Edit> operator()(const CreateGeometry& it) {
    if (const auto fresh = check_new(it.id, world_.geometries_, "shape"); !fresh)
      return tl::unexpected(fresh.error());
    if (!it.shape) return fail("A shape must be something.");
    return add(it.id, it.shape);
  }
  Result<Edit> operator()(const CopyGeometry& it) {
    if (const auto fresh = check_new(it.id, world_.geometries_, "shape"); !fresh)
      return tl::unexpected(fresh.error());
    const GeometryObject* model = world_.find(it.model);
    if (!model) return fail("The shape to copy is not there any more.");
    return add(it.id, model->shape);
  }
  Result<Edit> operator()(const DeleteGeometry& it) {
    const GeometryObject* geometry = world_.find(it.id);
    if (!geometry) return gone("shape");
    if (const auto free = check_unused(geometry->users, "objects use this shape"); !free)
      return tl::unexpected(free.error());
    const CreateGeometry back{it.id, geometry->shape};
    world_.geometries_.erase(it.id);
    return Edit(back);
  }
  Result<Edit> operator()(const ReplaceGeometry& it) {
    const auto found = world_.geometries_.find(it.id);
    if (found == world_.geometries_.end()) return gone("shape");
    if (!it.shape) return fail("A shape must be something.");
    return Edit(ReplaceGeometry{it.id, std::exchange(found->second.shape, it.shape)});
  }
  Result<Edit> operator()(const MoveVertices& it) {
    const auto found = world_.geometries_.find(it.id);
    if (found == world_.geometries_.end()) return gone("shape");
    GeometryPointer& shape = found->second.shape;
    const bool made = !recipe_of(*shape).empty();
    if (alone_ && !made && shape.use_count() == 1) {
      auto before = move_vertices_of(const_cast<Geometry&>(*shape), it.vertices, it.positions);
      if (!before) return tl::unexpected(before.error());
      return Edit(MoveVertices{it.id, it.vertices, std::move(*before)});
    }
    if (!permitted(shape->bytes())) return not_permitted();
    auto moved = move_vertices(*shape, it.vertices, it.positions);
    if (!moved) return tl::unexpected(moved.error());
    GeometryPointer before = std::exchange(shape, std::move(moved->shape));
    // Moving the vertices back would not bring the recipe back.
    if (made) return Edit(ReplaceGeometry{it.id, std::move(before)});
    return Edit(MoveVertices{it.id, it.vertices, std::move(moved->before)});
  }

  Result<Edit> operator()(const AmendGeometry& it) {
    const auto found = world_.geometries_.find(it.id);
    if (found == world_.geometries_.end()) return gone("shape");
    GeometryPointer& shape = found->second.shape;
    if (!permitted(shape->bytes())) return not_permitted();
    auto amended = shape->amended(it.change);
    if (!amended) return tl::unexpected(amended.error());
    shape = std::move(amended->shape);
    return Edit(AmendGeometry{it.id, std::move(amended->back)});
  }

  Result<Edit> operator()(const CreateMaterial& it) {
    if (const auto fresh = check_new(it.id, world_.materials_, "material"); !fresh)
      return tl::unexpected(fresh.error());
    if (const auto good = check_material(it.material); !good) return tl::unexpected(good.error());
    Material& material = world_.materials_[it.id] = it.material;
    material.users = 0;
    use(material.texture, 1);
    remember(it.id.value);
    return Edit(DeleteMaterial{it.id});
  }
  Result<Edit> operator()(const DeleteMaterial& it) {
    const Material* material = world_.find(it.id);
    if (!material) return gone("material");
    if (const auto free = check_unused(material->users, "objects have this material"); !free)
      return tl::unexpected(free.error());
    const CreateMaterial back{it.id, *material};
    use(material->texture, -1);
    world_.materials_.erase(it.id);
    return Edit(back);
  }
  Result<Edit> operator()(const ChangeMaterial& it) {
    const auto found = world_.materials_.find(it.id);
    if (found == world_.materials_.end()) return gone("material");
    if (const auto good = check_material(it.material); !good) return tl::unexpected(good.error());
    Material& material = found->second;
    use(it.material.texture, 1);
    use(material.texture, -1);
    const std::uint32_t users = material.users;
    const ChangeMaterial back{it.id, std::exchange(material, it.material)};
    material.users = users;
    return Edit(back);
  }

  Result<Edit> operator()(const CreateTexture& it) {
    if (const auto fresh = check_new(it.id, world_.textures_, "texture"); !fresh)
      return tl::unexpected(fresh.error());
    if (!it.texture.bytes) return fail("A texture must have a picture.");
    world_.textures_[it.id] = it.texture;
    world_.textures_[it.id].users = 0;
    remember(it.id.value);
    return Edit(DeleteTexture{it.id});
  }
  Result<Edit> operator()(const DeleteTexture& it) {
    const Texture* texture = world_.find(it.id);
    if (!texture) return gone("texture");
    if (const auto free = check_unused(texture->users, "materials show this texture"); !free)
      return tl::unexpected(free.error());
    const CreateTexture back{it.id, *texture};
    world_.textures_.erase(it.id);
    return Edit(back);
  }

  Result<Edit> operator()(const CreateScene& it) {
    if (const auto fresh = check_new(it.id, world_.scenes_, "scene"); !fresh)
      return tl::unexpected(fresh.error());
    world_.scenes_[it.id] = {it.name, {}};
    remember(it.id.value);
    return Edit(DeleteScene{it.id});
  }
  Result<Edit> operator()(const DeleteScene& it) {
    const Scene* scene = world_.find(it.id);
    if (!scene) return gone("scene");
    if (!scene->roots.empty())
      return fail(fmt::format("The scene \"{}\" holds objects: take them out first.", scene->name));
    const CreateScene back{it.id, scene->name};
    world_.scenes_.erase(it.id);
    return Edit(back);
  }
  Result<Edit> operator()(const RenameScene& it) {
    const auto found = world_.scenes_.find(it.id);
    if (found == world_.scenes_.end()) return gone("scene");
    return Edit(RenameScene{it.id, std::exchange(found->second.name, it.name)});
  }
  Result<Edit> operator()(const EnterScene& it) {
    const auto found = world_.scenes_.find(it.scene);
    if (found == world_.scenes_.end()) return gone("scene");
    const auto object = world_.objects_.find(it.object);
    if (object == world_.objects_.end()) return gone("object");
    std::vector<ObjectId>& roots = found->second.roots;
    if (object->second.scenes > 0 && place_of(roots, it.object) < roots.size())
      return fail(fmt::format("{} is in the scene \"{}\" already.", called(object->second, it.object),
                              found->second.name));
    if (it.place > roots.size()) return bad_place();
    ++object->second.scenes;
    insert(roots, it.place, it.object);
    return Edit(LeaveScene{it.scene, it.object});
  }
  Result<Edit> operator()(const LeaveScene& it) {
    const auto found = world_.scenes_.find(it.scene);
    if (found == world_.scenes_.end()) return gone("scene");
    std::vector<ObjectId>& roots = found->second.roots;
    const std::size_t place = place_of(roots, it.object);
    if (place == roots.size()) return fail("The object is not in that scene.");
    roots.erase(roots.begin() + std::ptrdiff_t(place));
    --world_.objects_[it.object].scenes;
    return Edit(EnterScene{it.scene, it.object, place});
  }

  Result<Edit> operator()(const ReserveIds& it) {
    if ((it.author >> (64 - IdSource::kNumberBits)) != 0 || it.last > IdSource::kLastNumber)
      return fail("There are no such numbers to spend: the edit is damaged.");
    if (it.last > 0) remember((std::uint64_t{it.author} << IdSource::kNumberBits) | it.last);
    return Edit(EditGroup{});
  }

  Result<Edit> operator()(const EditGroup& it) {
    EditGroup back;
    for (const Edit& edit : it.edits) {
      auto inverse = perform(edit);
      if (!inverse) {
        for (auto done = back.edits.rbegin(); done != back.edits.rend(); ++done)
          (void)std::visit(*this, done->what);
        return inverse;
      }
      back.edits.push_back(std::move(*inverse));
    }
    std::reverse(back.edits.begin(), back.edits.end());
    return Edit(std::move(back));
  }

 private:
  bool permitted(std::size_t bytes) const { return !permit_ || permit_(bytes); }
  static tl::unexpected<base::Error> not_permitted() {
    return fail("The edit takes more memory or time than it may.");
  }
  static tl::unexpected<base::Error> gone(const char* what) {
    return fail(fmt::format("The {} is not there any more.", what));
  }
  static tl::unexpected<base::Error> bad_place() {
    return fail("There are not so many objects to put it behind.");
  }

  template <typename Named>
  static Result<void> check_new(Id<Named> id, const World::Table<Named>& table, const char* what) {
    if (!id) return fail(fmt::format("A new {} needs an id.", what));
    const std::uint64_t number = id.value & IdSource::kNumberMask;
    if (number == 0 || number > IdSource::kLastNumber)
      return fail(fmt::format("A new {} cannot have the id {:#x}: numbers run from 1 to {}.", what, id.value,
                              IdSource::kLastNumber));
    if (table.count(id) != 0) return fail(fmt::format("There is a {} with this id already.", what));
    return {};
  }

  static Result<void> check_unused(std::uint32_t users, const char* what) {
    if (users > 0) return fail(fmt::format("{} {}: it cannot be deleted.", users, what));
    return {};
  }

  static Result<void> check(const MotionPointer& motion) {
    return motion ? check_motion(*motion) : Result<void>();
  }
  static Result<void> check(const FixturePointer& fixture) {
    return fixture ? std::visit([](const auto& it) { return check(it); }, *fixture) : Result<void>();
  }
  static Result<void> check(const Light& light) {
    const auto bad = [](double value) { return !std::isfinite(value) || value < 0.0; };
    if (std::any_of(light.colour.begin(), light.colour.end(), bad) ||
        std::any_of(light.attenuation.begin(), light.attenuation.end(), bad) || bad(light.intensity) ||
        bad(light.ambient) || bad(light.radius) || bad(light.cut_off_angle) || bad(light.beam_width))
      return fail("The numbers of a light must be finite and not negative.");
    return {};
  }
  static Result<void> check(const Viewpoint& viewpoint) {
    if (viewpoint.field_of_view > 0.0 && viewpoint.field_of_view < std::numbers::pi) return {};
    return fail("A field of view must lie between 0 and 180 degrees.");
  }
  static Result<void> check(const Inert&) { return {}; }
  static Result<void> check(const ForceEffect& effect) {
    if (!effect.text.empty()) return {};
    return fail("An effect must say what it is, such as \"viscous:2\".");
  }

  Result<void> check_material(const Material& material) const {
    if (material.texture && !world_.find(material.texture))
      return fail("The material's texture is not there any more.");
    const auto finite = [](const Colour& it) {
      return std::all_of(it.begin(), it.end(), [](float part) { return std::isfinite(part); });
    };
    if (!finite({material.ambient, material.shininess, material.transparency}) || !finite(material.diffuse) ||
        !finite(material.specular) || !finite(material.emission))
      return fail("The colours, shininess and transparency of a material must be finite.");
    const PictureFrame& frame = material.picture_frame;
    if (!std::all_of(frame.begin(), frame.end(), [](double it) { return std::isfinite(it); }) ||
        !finite({material.alpha_cutoff, material.metallic.value_or(0.0F), material.roughness.value_or(0.0F)}))
      return fail("What lays a material's picture, and its metal, roughness and cutoff, must be finite.");
    const TouchProperties& touch = material.touch;
    const auto bad = [](double value) { return !std::isfinite(value) || value < 0.0; };
    if (bad(touch.stiffness.value_or(0.0)) || bad(touch.damping.value_or(0.0)) ||
        bad(touch.static_friction) || bad(touch.dynamic_friction))
      return fail("Stiffness, damping and friction must be finite and not negative.");
    if (touch.static_friction < touch.dynamic_friction)
      return fail("Static friction cannot be less than dynamic friction.");
    return {};
  }

  std::vector<ObjectId>& siblings(ObjectId parent) {
    return parent ? world_.objects_[parent].children : world_.roots_;
  }
  const Scene& scene_with(ObjectId id) const {
    const auto holds = [id](const auto& scene) {
      return place_of(scene.second.roots, id) < scene.second.roots.size();
    };
    return std::find_if(world_.scenes_.begin(), world_.scenes_.end(), holds)->second;
  }
  void use(GeometryId id, int more) {
    if (id) world_.geometries_[id].users += std::uint32_t(more);
  }
  void use(MaterialId id, int more) {
    if (id) world_.materials_[id].users += std::uint32_t(more);
  }
  void use(TextureId id, int more) {
    if (id) world_.textures_[id].users += std::uint32_t(more);
  }

  Result<Edit> add(GeometryId id, GeometryPointer shape) {
    world_.geometries_[id] = {std::move(shape), 0};
    remember(id.value);
    return Edit(DeleteGeometry{id});
  }

  template <typename Kind, typename Value>
  Result<Edit> exchange(const Kind& it, Value PhysicalObject::*member, Value Kind::*value) {
    const auto found = world_.objects_.find(it.id);
    if (found == world_.objects_.end()) return gone("object");
    Kind back = it;
    back.*value = std::exchange(found->second.*member, it.*value);
    return Edit(std::move(back));
  }

  template <typename Kind, typename AnyId>
  Result<Edit> choose(const Kind& it, AnyId PhysicalObject::*member, AnyId Kind::*value, const char* what) {
    if (it.*value && !world_.find(it.*value)) return gone(what);
    auto back = exchange(it, member, value);
    if (!back) return back;
    use(it.*value, 1);
    use(std::get<Kind>(back->what).*value, -1);
    return back;
  }

  void remember(std::uint64_t id) {
    std::uint64_t& last = world_.last_numbers_[std::uint32_t(id >> IdSource::kNumberBits)];
    last = std::max(last, id & IdSource::kNumberMask);
  }

  World& world_;
  bool alone_;
  Permit permit_;
};

bool can_be_placed(const Affine3& frame) {
  const double volume = frame.linear().determinant();
  return frame.matrix().allFinite() && std::isfinite(volume) && volume != 0.0;
}

base::Result<Edit> apply(World& world, const Edit& edit) {
  return std::visit(EditApplier(world, false), edit.what);
}

base::Result<void> replay(World& world, const Edit& edit) { return replay(world, edit, Permit()); }

base::Result<void> replay(World& world, const Edit& edit, const Permit& permit) {
  const auto inverse = EditApplier(world, true, permit).perform(edit);
  if (!inverse) return tl::unexpected(inverse.error());
  return {};
}

}  // namespace icome::world
