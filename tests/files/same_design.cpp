#include "files/same_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "files/csg/csg_text.h"
#include "world/motion.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {
namespace {

using world::Colour;
using world::Material;
using world::MeshGeometry;
using world::PhysicalObject;
using world::World;

/// Which thing of one world is which of the other; each has one partner at most.
template <typename AnyId>
class Pairs {
 public:
  /// False when either has another partner. `fresh` tells whether they had none.
  bool pair(AnyId one, AnyId other, bool* fresh = nullptr) {
    const auto [forth, new_forth] = forth_.try_emplace(one, other);
    const auto [back, new_back] = back_.try_emplace(other, one);
    if (fresh) *fresh = new_forth;
    return forth->second == other && back->second == one;
  }

 private:
  std::unordered_map<AnyId, AnyId> forth_, back_;
};

class Comparison {
 public:
  Comparison(const World& one, const World& other, const Likeness& likeness)
      : one_(one), other_(other), likeness_(likeness) {}

  std::string run() {
    compare_rows("the world", one_.roots(), other_.roots());
    // Children are put to what waits: hierarchies may be deep.
    while (!waiting_.empty() && difference_.empty()) {
      const auto [one, other] = waiting_.back();
      waiting_.pop_back();
      compare(*one_.find(one), *other_.find(other));
    }
    if (likeness_.scenes) compare_scenes();
    return difference_;
  }

 private:
  bool expect(bool same, const std::string& what) {
    if (!same && difference_.empty()) difference_ = where_.empty() ? what : where_ + ": " + what;
    return same;
  }
  template <typename Value>
  bool same(const Value& one, const Value& other, const char* what) {
    return expect(one == other, fmt::format("{} {} and {}", what, one, other));
  }
  /// Numbers that count from the same size.
  template <typename Vector>
  bool near(const std::vector<Vector>& one, const std::vector<Vector>& other, const char* what) {
    if (!expect(one.size() == other.size(), fmt::format("{} {} and {}", one.size(), other.size(), what)))
      return false;
    double size = 0.0, off = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
      size = std::max(size, one[i].cwiseAbs().maxCoeff());
      off = std::max(off, (one[i] - other[i]).cwiseAbs().maxCoeff());
    }
    return expect(off <= likeness_.tolerance * size, fmt::format("{} off by {} of {}", what, off, size));
  }
  bool near(double one, double other, const char* what) {
    return expect(std::abs(one - other) <= likeness_.tolerance * std::max(std::abs(one), std::abs(other)),
                  fmt::format("{} {} and {}", what, one, other));
  }
  bool near(const Colour& one, const Colour& other, const char* what) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (!expect(std::abs(one[i] - other[i]) <= likeness_.tolerance,
                  fmt::format("{} {} and {}", what, one[i], other[i])))
        return false;
    }
    return true;
  }
  template <typename Vector>
  static std::vector<Vector> flat(const std::vector<std::array<Vector, 3>>& corners) {
    std::vector<Vector> all;
    for (const auto& of_triangle : corners) all.insert(all.end(), of_triangle.begin(), of_triangle.end());
    return all;
  }

  void compare_rows(const std::string& where, const std::vector<world::ObjectId>& one,
                    const std::vector<world::ObjectId>& other) {
    if (!expect(one.size() == other.size(),
                fmt::format("{} and {} objects below {}", one.size(), other.size(), where)))
      return;
    for (std::size_t i = one.size(); i-- > 0;) {
      objects_.pair(one[i], other[i]);
      waiting_.emplace_back(one[i], other[i]);
    }
  }

  void compare(const PhysicalObject& one, const PhysicalObject& other) {
    where_ = fmt::format("\"{}\"", one.name);
    same(one.name, other.name, "names");
    const std::vector<base::Matrix3> axes{one.parent_from_object.linear()},
        other_axes{other.parent_from_object.linear()};
    near(axes, other_axes, "axes");
    std::vector<base::Vector3> shift{one.parent_from_object.translation()},
        other_shift{other.parent_from_object.translation()};
    if (one.motion && other.motion) {  // what turns about a place far off is shifted by what its turn is off
      shift.push_back(one.motion->rest.centre);
      other_shift.push_back(other.motion->rest.centre);
    }
    near(shift, other_shift, "shift");
    if (expect(bool(one.geometry) == bool(other.geometry), "a shape and none") && one.geometry) {
      bool fresh = false;
      if (expect(geometries_.pair(one.geometry, other.geometry, &fresh), "shapes are shared otherwise") &&
          fresh)
        compare(*one_.find(one.geometry)->shape, *other_.find(other.geometry)->shape);
    }
    if (expect(bool(one.material) == bool(other.material), "a material and none") && one.material) {
      bool fresh = false;
      if (expect(materials_.pair(one.material, other.material, &fresh), "materials are shared otherwise") &&
          fresh)
        compare(*one_.find(one.material), *other_.find(other.material));
    }
    if (likeness_.fixtures) compare(one.fixture, other.fixture);
    compare_rows(where_, one.children, other.children);
  }

  void compare(const Material& one, const Material& other) {
    same(one.name, other.name, "names of materials");
    near(one.ambient, other.ambient, "ambient");
    near(one.diffuse, other.diffuse, "diffuse");
    near(one.specular, other.specular, "specular");
    near(one.emission, other.emission, "emission");
    near(one.shininess, other.shininess, "shininess");
    near(one.transparency, other.transparency, "transparency");
    for (std::size_t i = 0; i < one.picture_frame.size(); ++i)
      expect(std::abs(one.picture_frame[i] - other.picture_frame[i]) <= likeness_.tolerance,
             "frames of a picture");
    same(one.tints, other.tints, "tints");
    same(int(one.alpha_mode), int(other.alpha_mode), "alpha modes");
    near(one.alpha_cutoff, other.alpha_cutoff, "alpha cutoffs");
    same(one.unlit, other.unlit, "unlit");
    same(one.double_sided, other.double_sided, "double sided");
    near(one.metallic.value_or(-1.0F), other.metallic.value_or(-1.0F), "metallic");
    near(one.roughness.value_or(-1.0F), other.roughness.value_or(-1.0F), "roughness");
    if (likeness_.touch) {
      const world::TouchProperties &touch = one.touch, &other_touch = other.touch;
      near(touch.stiffness.value_or(-1.0), other_touch.stiffness.value_or(-1.0), "stiffness");
      near(touch.damping.value_or(-1.0), other_touch.damping.value_or(-1.0), "damping");
      near(touch.static_friction, other_touch.static_friction, "static friction");
      near(touch.dynamic_friction, other_touch.dynamic_friction, "dynamic friction");
      same(touch.texture, other_touch.texture, "haptic textures");
    }
    if (!expect(bool(one.texture) == bool(other.texture), "a texture and none") || !one.texture) return;
    bool fresh = false;
    if (expect(textures_.pair(one.texture, other.texture, &fresh), "textures are shared otherwise") && fresh)
      compare(*one_.find(one.texture), *other_.find(other.texture));
  }

  void compare(const world::Texture& one, const world::Texture& other) {
    if (likeness_.texture_names) same(one.name, other.name, "names of textures");
    same(one.media_type, other.media_type, "media types");
    expect(*one.bytes == *other.bytes, "pictures");
    expect(one.repeats == other.repeats, "repeats of a texture");
  }

  void compare(const world::FixturePointer& one, const world::FixturePointer& other) {
    if (!expect(bool(one) == bool(other), "a fixture and none") || !one) return;
    if (!expect(one->index() == other->index(), "kinds of fixtures")) return;
    if (const auto* light = std::get_if<world::Light>(&*one)) {
      const auto& same_light = std::get<world::Light>(*other);
      expect(light->kind == same_light.kind && light->on == same_light.on, "kinds of lights");
      near(light->colour, same_light.colour, "colours of lights");
      near(light->intensity, same_light.intensity, "intensity");
      near(light->ambient, same_light.ambient, "ambient light");
      if (likeness_.scopes) same(light->scoped, same_light.scoped, "groups that lights are for");
      if (light->kind == world::Light::Kind::Directional) return;
      near(light->attenuation, same_light.attenuation, "attenuation");
      near(light->radius, same_light.radius, "radius of light");
      if (light->kind == world::Light::Kind::Point) return;
      near(light->cut_off_angle, same_light.cut_off_angle, "cut-off angle");
      near(light->beam_width, same_light.beam_width, "beam width");
    } else if (const auto* view = std::get_if<world::Viewpoint>(&*one)) {
      near(view->field_of_view, std::get<world::Viewpoint>(*other).field_of_view, "field of view");
    } else if (const auto* effect = std::get_if<world::ForceEffect>(&*one)) {
      expect(*effect == std::get<world::ForceEffect>(*other), "effects");
    } else {
      const auto &inert = std::get<world::Inert>(*one), &same_inert = std::get<world::Inert>(*other);
      same(inert.type, same_inert.type, "types of inert nodes");
      same(inert.source, same_inert.source, "sources of inert nodes");
    }
  }

  void compare(const world::Geometry& one, const world::Geometry& other) {
    if (!likeness_.shapes) return compare_bounds(one, other);
    if (!same(one.kind(), other.kind(), "kinds of shapes")) return;
    if (const auto* mesh = dynamic_cast<const MeshGeometry*>(&one)) {
      const auto& same_mesh = dynamic_cast<const MeshGeometry&>(other);
      compare(mesh->mesh, same_mesh.mesh);
      near(flat(mesh->texture_coordinates), flat(same_mesh.texture_coordinates), "texture coordinates");
      near(flat(mesh->normals), flat(same_mesh.normals), "normals");
      if (likeness_.recipes) same(mesh->recipe, same_mesh.recipe, "recipes");
      if (!same(mesh->colours.size(), same_mesh.colours.size(), "colours")) return;
      for (std::size_t t = 0; t < mesh->colours.size(); ++t) {
        for (std::size_t i = 0; i < 3; ++i) near(mesh->colours[t][i], same_mesh.colours[t][i], "colours");
      }
    } else if (const auto* loop = dynamic_cast<const world::LoopGeometry*>(&one)) {
      const auto& same_loop = dynamic_cast<const world::LoopGeometry&>(other);
      compare(loop->control.mesh, same_loop.control.mesh);
      expect(loop->control.creases == same_loop.control.creases, "creases");
      expect(loop->control.corners == same_loop.control.corners, "corners");
    } else if (const auto* csg = dynamic_cast<const world::CsgGeometry*>(&one)) {
      same(csg_text(csg->tree).value_or("?"),
           csg_text(dynamic_cast<const world::CsgGeometry&>(other).tree).value_or("?"), "CSG trees");
    } else if (const auto* primitive = dynamic_cast<const world::PrimitiveGeometry*>(&one)) {
      const auto& same_primitive = dynamic_cast<const world::PrimitiveGeometry&>(other);
      same(primitive->primitive.index(), same_primitive.primitive.index(), "kinds of primitives");
      expect(primitive->axis == same_primitive.axis, "axes of primitives");
      if (!std::holds_alternative<geometry::Plane>(primitive->primitive)) compare_bounds(one, other);
    } else {
      same(one.hash(), other.hash(), "hashes of shapes");
    }
  }

  void compare(const geometry::TriangleMesh& one, const geometry::TriangleMesh& other) {
    near(one.positions, other.positions, "vertices");
    expect(one.triangles == other.triangles,
           fmt::format("triangles, {} and {}", one.triangles.size(), other.triangles.size()));
  }

  void compare_bounds(const world::Geometry& one, const world::Geometry& other) {
    const base::Bounds box = one.bounds(), same_box = other.bounds();
    if (!expect(box.isEmpty() == same_box.isEmpty(), "an empty shape and one that is not") || box.isEmpty())
      return;
    near(std::vector<base::Vector3>{box.min(), box.max()},
         std::vector<base::Vector3>{same_box.min(), same_box.max()}, "bounds");
  }

  /// In the order of ids, in which they were made.
  static std::vector<const world::Scene*> in_order(const World& world) {
    std::vector<world::SceneId> ids;
    for (const auto& [id, scene] : world.scenes()) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    std::vector<const world::Scene*> scenes;
    for (const world::SceneId id : ids) scenes.push_back(world.find(id));
    return scenes;
  }
  void compare_scenes() {
    where_ = "scenes";
    const auto scenes = in_order(one_), same_scenes = in_order(other_);
    if (!same(scenes.size(), same_scenes.size(), "numbers")) return;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      same(scenes[i]->name, same_scenes[i]->name, "names");
      const auto &roots = scenes[i]->roots, &same_roots = same_scenes[i]->roots;
      if (!same(roots.size(), same_roots.size(), "objects of one")) return;
      for (std::size_t r = 0; r < roots.size(); ++r)
        expect(objects_.pair(roots[r], same_roots[r]), "other objects in \"" + scenes[i]->name + "\"");
    }
  }

  const World &one_, &other_;
  const Likeness likeness_;
  std::string where_, difference_;
  Pairs<world::ObjectId> objects_;
  Pairs<world::GeometryId> geometries_;
  Pairs<world::MaterialId> materials_;
  Pairs<world::TextureId> textures_;
  std::vector<std::pair<world::ObjectId, world::ObjectId>> waiting_;
};

}  // namespace

std::string difference(const World& one, const World& other, const Likeness& likeness) {
  return Comparison(one, other, likeness).run();
}

}  // namespace icome::files
