#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "charts/image.h"
#include "render/model/render_shape.h"
#include "world/edit/changes.h"
#include "world/shape/picture_kind.h"
#include "world/world.h"

namespace icome::render {

using world::PictureOpacity;

/// A texture's pixels. Immutable once made.
struct RenderPicture {
  charts::Image image;
  PictureOpacity opacity = PictureOpacity::Opaque;
  bool grey = false;                           ///< one number a pixel
  std::array<bool, 2> repeats = {true, true};  ///< along u and v
};

/// The look of a surface: world::Material with linear colours. Immutable once made.
struct RenderMaterial {
  Eigen::Vector3f diffuse{0.8F, 0.8F, 0.8F};
  Eigen::Vector3f specular{0.0F, 0.0F, 0.0F};  ///< without the metallic part
  Eigen::Vector3f emission{0.0F, 0.0F, 0.0F};
  float ambient = 0.2F;                               ///< of the diffuse colour
  float metal = 0.0F;                                 ///< 0 ... 1: part of the diffuse colour that shines
  float shininess = 0.2F;                             ///< 0 ... 1
  float alpha = 1.0F;                                 ///< 1 is opaque
  bool double_sided = true;                           ///< else backs are not seen
  bool unlit = false;                                 ///< shows its diffuse colour and picture alone
  std::shared_ptr<const RenderPicture> picture = {};  ///< null: plain
  world::PictureFrame picture_frame = world::kPictureAsItLies;
  bool picture_replaces_colour = false;             ///< else they are multiplied (VRML 2.0, 4.14)
  bool picture_replaces_alpha = false;              ///< likewise
  PictureOpacity opacity = PictureOpacity::Opaque;  ///< of the picture on this surface
  float cutoff = 0.5F;                              ///< alpha below which a picture is cut out
};

/// One object as it is drawn.
struct RenderItem {
  world::ObjectId object = {};
  RenderShapePointer shape = {};  ///< null: nothing is drawn in this place
  std::shared_ptr<const RenderMaterial> material = {};
  base::Affine3 world_from_object = base::Affine3::Identity();
  base::Bounds bounds = {};  ///< m, world frame

  bool is_mirrored() const { return world_from_object.linear().determinant() < 0.0; }
};

struct RenderLight {
  world::Light light;
  base::Affine3 world_from_light;  ///< it shines along -z
  std::shared_ptr<const std::unordered_set<world::ObjectId>> group =
      {};  ///< all it shines on; null: everything
};

struct RenderViewpoint {
  std::string name;
  base::Affine3 world_from_viewpoint;  ///< it looks along -z, +y up
  double field_of_view;                ///< rad, of the shorter side of the picture
};

/// The drawn part of a world: one published version. Immutable; a later version shares all that no edit
/// touched, so that publishing costs by the edit and not by the design, and a drawing thread keeps its
/// version for as long as it likes without anybody waiting.
class RenderScene {
 public:
  static constexpr std::size_t kBlockItems = 64;

  /// Some objects, shared between versions.
  struct Block {
    std::vector<RenderItem> items;
    base::Bounds bounds;  ///< m, world frame
    std::size_t objects = 0;
    std::size_t triangles = 0;
  };

  const std::vector<std::shared_ptr<const Block>>& blocks() const { return blocks_; }
  const std::vector<RenderLight>& lights() const { return lights_; }
  const std::vector<RenderViewpoint>& viewpoints() const { return viewpoints_; }  ///< in the tree's order
  const base::Bounds& bounds() const { return bounds_; }  ///< m, world frame; empty for nothing
  std::size_t object_count() const { return object_count_; }
  std::size_t triangle_count() const { return triangle_count_; }  ///< clones counted each
  /// Sentences on things that are not drawn as they should be.
  const std::vector<std::string>& remarks() const { return remarks_; }

  /// Calls `visit` with every item that has something to draw.
  template <typename Visit>
  void for_each(Visit&& visit) const {
    for (const auto& block : blocks_) {
      for (const RenderItem& item : block->items) {
        if (item.shape) visit(item);
      }
    }
  }

 private:
  friend class ScenePublisher;

  std::vector<std::shared_ptr<const Block>> blocks_;
  std::vector<RenderLight> lights_;
  std::vector<RenderViewpoint> viewpoints_;
  base::Bounds bounds_;
  std::size_t object_count_ = 0;
  std::size_t triangle_count_ = 0;
  std::vector<std::string> remarks_;
};

using RenderScenePointer = std::shared_ptr<const RenderScene>;

/// Makes versions of a world for drawing, on the thread that owns the world. Owns what it has made of shapes,
/// materials and pictures.
class ScenePublisher {
 public:
  /// Publishes one scene of the world or, without one, all objects.
  explicit ScenePublisher(world::SceneId scene = {}) : scene_(scene) {}

  /// Makes all anew. Pictures that cannot be read and shapes that cannot be drawn become remarks.
  RenderScenePointer publish(const world::World& world);
  /// Makes anew what has changed since the last version.
  RenderScenePointer update(const world::World& world, const world::Changes& changes);
  /// Another scene of the same world (none: all objects), of the shapes that are made already.
  RenderScenePointer show_scene(const world::World& world, world::SceneId scene);
  /// Makes anew, as of `time` (s), all shapes that change with time; from now on everything is made for
  /// that time. Null where nothing changes.
  RenderScenePointer at_time(const world::World& world, double time);
  /// Is there something that changes with time?
  bool changes(const world::World& world) const { return !changing_shapes(world).empty(); }

 private:
  struct Made {
    RenderShapePointer shape;  // null: cannot be drawn; the remark names it
    std::string remark;
  };
  struct MadePicture {
    std::shared_ptr<const RenderPicture> picture;  // null: cannot be read
    std::string remark;
  };

  std::vector<world::GeometryId> changing_shapes(const world::World& world) const;
  void make_shapes(const world::World& world);
  /// Keeps the result of making a shape, or the reason why not, and a remark on parts that it lacks.
  static void keep(const world::World& world, world::GeometryId id,
                   const base::Result<RenderShapePointer>& made, Made& as);
  const Made& shape(const world::World& world, world::GeometryId id);
  const std::shared_ptr<const RenderMaterial>& material(const world::World& world, world::MaterialId id);
  const MadePicture& picture(const world::World& world, world::TextureId id);
  void forget(const world::World& world, const world::Changes& changes);
  void hide_all();
  void show_roots(const world::World& world);
  bool is_shown(const world::World& world, world::ObjectId id) const;
  void show(const world::World& world, world::ObjectId root);
  void show_object(const world::World& world, world::ObjectId id, const base::Affine3& world_from_object);
  void hide(world::ObjectId id);
  void clear_slot(world::ObjectId id);
  RenderItem& slot_for_writing(std::size_t slot);
  void collect_fixtures(const world::World& world);
  RenderScenePointer version(const world::World& world);

  world::SceneId scene_;
  double time_ = 0.0;  // s, of shapes that change
  std::unordered_map<world::GeometryId, Made> shapes_;
  std::unordered_map<world::MaterialId, std::shared_ptr<const RenderMaterial>> materials_;
  std::unordered_map<world::TextureId, MadePicture> pictures_;
  std::shared_ptr<const RenderMaterial> plain_;             // made when wanted
  std::unordered_map<world::ObjectId, std::size_t> slots_;  // places of shown objects in the blocks
  std::vector<std::size_t> free_;                           // slots
  std::vector<std::shared_ptr<const RenderScene::Block>> blocks_;
  std::unordered_map<std::size_t, std::shared_ptr<RenderScene::Block>> written_;  // since the last version
  std::unordered_set<world::ObjectId> fixed_;  // shown objects that are a light or a viewpoint
  std::vector<RenderLight> lights_;
  std::vector<RenderViewpoint> viewpoints_;
  bool fixtures_touched_ = false;
};

}  // namespace icome::render
