#include "render/model/render_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/srgb.h"
#include "render/model/picture_decoder.h"
#include "render/scene/scene_lighting.h"
#include "world/metal.h"

namespace icome::render {
namespace {

using base::Affine3;
using base::Bounds;
using base::Vector3;
using world::ObjectId;
using world::World;

Eigen::Vector3f light_of(const world::Colour& colour) {
  return Eigen::Vector3f(base::linear_from_srgb(colour).data());
}

RenderMaterial look_of(const world::Material& material) {
  RenderMaterial it;
  it.diffuse = light_of(material.diffuse);
  it.metal = world::metal_of(material);
  it.specular = (light_of(material.specular) - it.metal * it.diffuse).cwiseMax(0.0F);
  it.emission = light_of(material.emission);
  it.ambient = material.ambient;
  it.shininess = material.shininess;
  it.alpha = 1.0F - std::clamp(material.transparency, 0.0F, 1.0F);
  it.unlit = material.unlit;
  it.double_sided = material.double_sided;
  return it;
}

/// VRML 2.0, 4.14 and 6.22: a picture's own colours replace the material's, greys are multiplied; so does its
/// opacity. In glTF both are multiplied.
void lay_picture(const world::Material& material, const RenderPicture& picture, RenderMaterial& it) {
  it.picture_frame = material.picture_frame;
  it.picture_replaces_colour = !material.tints && !picture.grey;
  it.picture_replaces_alpha = !material.tints && picture.opacity != PictureOpacity::Opaque;
  it.opacity = picture.opacity;
  if (material.alpha_mode == world::AlphaMode::Opaque) it.opacity = PictureOpacity::Opaque;
  if (picture.opacity == PictureOpacity::Opaque) return;
  if (material.alpha_mode == world::AlphaMode::Blend) it.opacity = PictureOpacity::Blended;
  if (material.alpha_mode != world::AlphaMode::Mask) return;
  it.opacity = PictureOpacity::CutOut;
  it.cutoff = material.alpha_cutoff;
}

Bounds placed_bounds(const Bounds& box, const Affine3& world_from_object) {
  if (box.isEmpty()) return {};
  return box.transformed(world_from_object);
}

std::string shape_name(const World& world, world::GeometryId id) {
  for (const auto& [key, object] : world.objects()) {
    if (object.geometry == id && !object.name.empty()) return fmt::format("The shape of {}", object.name);
  }
  return "A shape";
}

constexpr double kRigid = 1e-12;  // tolerance of a transform that does not stretch

/// Sums up a block: its number of objects and triangles, and its bounds.
void tally(RenderScene::Block& block) {
  block.bounds.setEmpty();
  block.objects = block.triangles = 0;
  for (const RenderItem& item : block.items) {
    if (!item.shape) continue;
    if (!item.bounds.isEmpty()) block.bounds.extend(item.bounds);
    ++block.objects;
    block.triangles += item.shape->triangle_count();
  }
}

/// The objects that a light shines on; null for all.
std::shared_ptr<const std::unordered_set<ObjectId>> lit_objects(const World& world, ObjectId light) {
  const ObjectId group = world::lit_group(world, light);
  if (!group) return nullptr;
  const std::vector<ObjectId> objects = world::subtree(world, group);
  return std::make_shared<const std::unordered_set<ObjectId>>(objects.begin(), objects.end());
}

}  // namespace

RenderScenePointer ScenePublisher::publish(const World& world) {
  const double time = time_;
  *this = ScenePublisher(scene_);
  time_ = time;
  make_shapes(world);
  show_roots(world);
  return version(world);
}

RenderScenePointer ScenePublisher::show_scene(const World& world, world::SceneId scene) {
  hide_all();
  scene_ = scene;
  show_roots(world);
  return version(world);
}

void ScenePublisher::hide_all() {
  for (const auto& [id, slot] : std::unordered_map(slots_)) hide(id);
  for (const ObjectId id : std::unordered_set(fixed_)) hide(id);
}

void ScenePublisher::show_roots(const World& world) {
  const world::Scene* scene = scene_ ? world.find(scene_) : nullptr;
  if (scene_ && !scene) return;
  for (const ObjectId root : scene ? scene->roots : world.roots()) show(world, root);
}

RenderScenePointer ScenePublisher::update(const World& world, const world::Changes& changes) {
  forget(world, changes);
  // The objects in a light's group may have changed.
  const auto has_group = [](const RenderLight& it) { return it.group != nullptr; };
  if (!changes.objects.empty() && std::any_of(lights_.begin(), lights_.end(), has_group))
    fixtures_touched_ = true;
  if (std::find(changes.scenes.begin(), changes.scenes.end(), scene_) != changes.scenes.end()) {
    hide_all();
    show_roots(world);
  }
  for (const ObjectId id : changes.objects) {
    if (!world.find(id)) {
      hide(id);
    } else if (is_shown(world, id)) {
      show(world, id);
    } else {
      for (const ObjectId below : world::subtree(world, id)) hide(below);
    }
  }
  return version(world);
}

std::vector<world::GeometryId> ScenePublisher::changing_shapes(const World& world) const {
  std::vector<world::GeometryId> ids;
  for (const auto& [id, made] : shapes_) {
    const world::GeometryObject* const geometry = world.find(id);
    if (geometry && render::changes(*geometry->shape)) ids.push_back(id);
  }
  if (ids.empty()) return ids;
  // Stretched objects are felt as triangles of t = 0: they, and all that share their shape, are drawn so.
  for (const auto& [id, object] : world.objects()) {
    const base::Matrix3 stretch = world::world_from_object(world, id).linear();
    if ((stretch.transpose() * stretch).isIdentity(kRigid) && stretch.determinant() > 0.0) continue;
    std::erase(ids, object.geometry);
  }
  return ids;
}

RenderScenePointer ScenePublisher::at_time(const World& world, double time) {
  time_ = time;
  world::Changes changes;
  changes.geometries = changing_shapes(world);
  if (changes.geometries.empty()) return nullptr;
  forget(world, changes);
  return version(world);
}

/// Drops what was made of things that have changed, and shows anew the objects that use them.
void ScenePublisher::forget(const World& world, const world::Changes& changes) {
  std::unordered_set<world::GeometryId> shapes(changes.geometries.begin(), changes.geometries.end());
  std::unordered_set<world::MaterialId> materials(changes.materials.begin(), changes.materials.end());
  for (const auto texture : changes.textures) {
    pictures_.erase(texture);
    for (const auto& [id, material] : world.materials()) {
      if (material.texture == texture) materials.insert(id);
    }
  }
  for (const auto id : shapes) shapes_.erase(id);
  for (const auto id : materials) materials_.erase(id);
  if (shapes.empty() && materials.empty()) return;
  // A shape that could not be drawn has no slots: its objects are looked for among all.
  for (const auto& [id, object] : world.objects()) {
    if (!shapes.contains(object.geometry) && !(slots_.contains(id) && materials.contains(object.material)))
      continue;
    if (is_shown(world, id)) show_object(world, id, world::world_from_object(world, id));
  }
}

/// Makes all shapes at once: they do not depend on each other, and some take long to be made triangles.
void ScenePublisher::make_shapes(const World& world) {
  std::vector<world::GeometryId> ids;
  for (const auto& [id, geometry] : world.geometries()) {
    if (geometry.users > 0) ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end());
  // A shape that lies in memory once is made once.
  std::unordered_map<const world::Geometry*, std::size_t> places;
  std::vector<const world::Geometry*> shapes;
  for (const auto id : ids) {
    const world::Geometry* const shape = world.find(id)->shape.get();
    if (places.try_emplace(shape, shapes.size()).second) shapes.push_back(shape);
  }
  std::vector<base::Result<RenderShapePointer>> made(shapes.size());
  base::parallel_for(shapes.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) made[i] = make_render_shape(*shapes[i], time_);
  });
  for (const auto id : ids) {
    const base::Result<RenderShapePointer>& its = made[places.at(world.find(id)->shape.get())];
    Made& it = shapes_[id];
    keep(world, id, its, it);
  }
}

void ScenePublisher::keep(const World& world, world::GeometryId id,
                          const base::Result<RenderShapePointer>& made, Made& as) {
  if (!made) {
    as.remark = fmt::format("{} is not drawn: {}", shape_name(world, id), made.error().message);
    return;
  }
  as.shape = *made;
  if (as.shape->lacks_parts)
    as.remark = fmt::format("{} is drawn without its thinnest parts, which cannot be made triangles.",
                            shape_name(world, id));
}

const ScenePublisher::Made& ScenePublisher::shape(const World& world, world::GeometryId id) {
  const auto [found, is_new] = shapes_.try_emplace(id);
  const world::GeometryObject* geometry = world.find(id);
  if (!is_new || !geometry) return found->second;
  keep(world, id, make_render_shape(*geometry->shape, time_), found->second);
  return found->second;
}

const ScenePublisher::MadePicture& ScenePublisher::picture(const World& world, world::TextureId id) {
  const auto [found, is_new] = pictures_.try_emplace(id);
  const world::Texture* texture = world.find(id);
  if (!is_new || !texture) return found->second;
  auto image = decode_picture(texture->bytes ? std::string_view(*texture->bytes) : std::string_view());
  if (!image) {
    found->second.remark = fmt::format("{} is not shown: {}.",
                                       texture->name.empty() ? "A texture" : "The texture " + texture->name,
                                       image.error().message);
    return found->second;
  }
  const PictureOpacity opacity = world::opacity_of(image->rgba);
  found->second.picture = std::make_shared<const RenderPicture>(
      RenderPicture{std::move(*image), opacity, world::is_grey_picture(*texture->bytes), texture->repeats});
  return found->second;
}

const std::shared_ptr<const RenderMaterial>& ScenePublisher::material(const World& world,
                                                                      world::MaterialId id) {
  const world::Material* own = world.find(id);
  if (!own && !plain_) plain_ = std::make_shared<const RenderMaterial>(look_of({}));
  if (!own) return plain_;
  auto& made = materials_[id];
  if (made) return made;
  RenderMaterial it = look_of(*own);
  if (own->texture) it.picture = picture(world, own->texture).picture;
  if (it.picture) lay_picture(*own, *it.picture, it);
  return made = std::make_shared<const RenderMaterial>(std::move(it));
}

/// Is it in the scene that is drawn?
bool ScenePublisher::is_shown(const World& world, ObjectId id) const {
  if (!scene_) return true;
  const world::Scene* scene = world.find(scene_);
  return scene != nullptr && std::any_of(scene->roots.begin(), scene->roots.end(),
                                         [&](ObjectId root) { return world::is_within(world, id, root); });
}

/// A loop and no recursion: designs may be deep.
void ScenePublisher::show(const World& world, ObjectId root) {
  struct Open {
    ObjectId id;
    Affine3 world_from_object;
  };
  std::vector<Open> open{{root, world::world_from_object(world, root)}};
  while (!open.empty()) {
    const Open here = open.back();
    open.pop_back();
    show_object(world, here.id, here.world_from_object);
    for (const ObjectId child : world.find(here.id)->children)
      open.push_back({child, here.world_from_object * world.find(child)->parent_from_object});
  }
}

void ScenePublisher::show_object(const World& world, ObjectId id, const Affine3& world_from_object) {
  const world::PhysicalObject& object = *world.find(id);
  const bool is_fixed = object.fixture && (std::holds_alternative<world::Light>(*object.fixture) ||
                                           std::holds_alternative<world::Viewpoint>(*object.fixture));
  if (fixed_.erase(id) > 0 || is_fixed) fixtures_touched_ = true;
  if (is_fixed) fixed_.insert(id);
  const RenderShapePointer own = object.geometry ? shape(world, object.geometry).shape : nullptr;
  if (!own || (own->mesh.indices.empty() && !own->solid)) {
    clear_slot(id);
    return;
  }
  const auto [place, is_new] = slots_.try_emplace(id, 0);
  if (is_new) {
    if (free_.empty()) {
      const std::size_t first = blocks_.size() * RenderScene::kBlockItems;
      for (std::size_t i = RenderScene::kBlockItems; i-- > 0;) free_.push_back(first + i);
      blocks_.push_back(std::make_shared<const RenderScene::Block>(
          RenderScene::Block{std::vector<RenderItem>(RenderScene::kBlockItems), {}, 0, 0}));
    }
    place->second = free_.back();
    free_.pop_back();
  }
  slot_for_writing(place->second) = {id, own, material(world, object.material), world_from_object,
                                     placed_bounds(own->bounds, world_from_object)};
}

void ScenePublisher::hide(ObjectId id) {
  if (fixed_.erase(id) > 0) fixtures_touched_ = true;
  clear_slot(id);
}

void ScenePublisher::clear_slot(ObjectId id) {
  const auto found = slots_.find(id);
  if (found == slots_.end()) return;
  slot_for_writing(found->second) = {};
  free_.push_back(found->second);
  slots_.erase(found);
}

RenderItem& ScenePublisher::slot_for_writing(std::size_t slot) {
  const std::size_t block = slot / RenderScene::kBlockItems;
  auto& own = written_[block];
  if (!own) own = std::make_shared<RenderScene::Block>(*blocks_[block]);
  return own->items[slot % RenderScene::kBlockItems];
}

void ScenePublisher::collect_fixtures(const World& world) {
  lights_.clear();
  viewpoints_.clear();
  std::vector<ObjectId> open(world.roots().rbegin(), world.roots().rend());
  while (!open.empty()) {
    const ObjectId id = open.back();
    open.pop_back();
    const world::PhysicalObject& object = *world.find(id);
    open.insert(open.end(), object.children.rbegin(), object.children.rend());
    if (!fixed_.contains(id) || !object.fixture) continue;
    const Affine3 place = world::world_from_object(world, id);
    if (const auto* light = std::get_if<world::Light>(object.fixture.get()))
      lights_.push_back({*light, place, lit_objects(world, id)});
    if (const auto* view = std::get_if<world::Viewpoint>(object.fixture.get()))
      viewpoints_.push_back({object.name, place, view->field_of_view});
  }
}

RenderScenePointer ScenePublisher::version(const World& world) {
  for (auto& [block, own] : written_) {
    tally(*own);
    blocks_[block] = std::move(own);
  }
  written_.clear();
  if (fixtures_touched_) collect_fixtures(world);
  fixtures_touched_ = false;
  auto scene = std::make_shared<RenderScene>();
  scene->blocks_ = blocks_;
  scene->lights_ = lights_;
  scene->viewpoints_ = viewpoints_;
  for (const auto& block : blocks_) {
    if (!block->bounds.isEmpty()) scene->bounds_.extend(block->bounds);
    scene->object_count_ += block->objects;
    scene->triangle_count_ += block->triangles;
  }
  for (const auto& [id, made] : shapes_) {
    if (!made.remark.empty()) scene->remarks_.push_back(made.remark);
  }
  for (const auto& [id, made] : pictures_) {
    if (!made.remark.empty()) scene->remarks_.push_back(made.remark);
  }
  if (std::string more = lights_left_out(*scene); !more.empty()) scene->remarks_.push_back(std::move(more));
  std::sort(scene->remarks_.begin(), scene->remarks_.end());
  return scene;
}

}  // namespace icome::render
