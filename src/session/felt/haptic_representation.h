#pragma once
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "haptics/contact/haptic_scene.h"
#include "haptics/effects/texture_text.h"
#include "haptics/servo/effect_feed.h"
#include "session/felt/felt_shape.h"
#include "world/edit/changes.h"

namespace icome::session {

struct HapticRepresentationSettings {
  FeltSettings felt = {};
  base::Affine3 world_from_design = base::Affine3::Identity();  // where the world of the edits lies
  /// The haptic texture of a name; null for one that is not known.
  std::function<std::shared_ptr<const haptics::HapticTexture>(std::string_view name)> texture =
      [](std::string_view name) { return haptics::make_texture(name).value_or(nullptr); };
  /// Time (s) in which an object glides, evenly, to where an edit has put it, so that a dragged one pushes
  /// a hand without steps; 0: it is there at once.
  double glide_seconds = 0.0;
  /// The time (s) of motions and changes; never goes back.
  std::function<double()> clock = [] { return 0.0; };
};

/// The objects of a world by the ids of its haptic scene. Immutable.
class TouchedNames {
 public:
  struct Name {
    std::uint32_t generation = 0;
    world::ObjectId object = {};  // none: not given away
  };
  explicit TouchedNames(std::vector<Name> names = {}) : names_(std::move(names)) {}

  std::optional<world::ObjectId> object(base::ObjectId haptic_id) const;

 private:
  std::vector<Name> names_;  // by index
};

/// The touchable part of a world: one HapticObject for each object with a shape, of the whole world or of one
/// of its scenes (thesis 5.6.1: the haptic thread's own representation). Shapes are made once for all objects
/// that share one and are stretched alike, and kept for as long as they are used, also by scenes that are not
/// shown; an edit makes only those anew that it changed. One thread owns it; the compiled scene is immutable
/// and may be given to the servo.
class HapticRepresentation {
 public:
  explicit HapticRepresentation(HapticRepresentationSettings settings = {});

  /// Represents another world from now on. No shape that was made before is used again, and no name.
  void open(const world::World& world, world::SceneId scene = {});

  /// Represents this scene from now on, or the whole world. Shapes made for it before are used again.
  void show(const world::World& world, world::SceneId scene = {});

  /// Follows an edit (or several) that the world has been through since the last call.
  void follow(const world::World& world, const world::Changes& changes);

  /// The scene that the servo touches; never null.
  const std::shared_ptr<const haptics::HapticScene>& scene() const { return scene_; }

  /// The effects of the scene that are on, in the order of their objects' ids; those of unknown texts are
  /// left out.
  const std::vector<haptics::PlacedEffect>& effects() const { return effects_; }

  /// Names go both ways. Objects that cannot be touched, or are gone, have none.
  std::optional<base::ObjectId> haptic_id(world::ObjectId object) const;
  std::optional<world::ObjectId> object(base::ObjectId haptic_id) const;
  /// object() for another thread; never null, and unchanged until a name is given or taken away.
  const std::shared_ptr<const TouchedNames>& names();

  /// The felt shape of an object; null when it has no shape or is not in the scene.
  FeltShapePointer felt(world::ObjectId object) const;

  /// The objects that cannot be touched or are not quite themselves, one sentence each.
  std::vector<std::string> remarks(const world::World& world) const;

  /// Counts of the work since the beginning.
  struct Work {
    std::size_t shapes = 0;    // made
    std::size_t compiled = 0;  // scenes compiled anew
    std::size_t moved = 0;     // scenes made of the last by moving objects
  };
  const Work& work() const { return work_; }

 private:
  struct Member {
    std::uint64_t seen = 0;  // the last survey that found it in the scene
    base::Affine3 world_from_object = base::Affine3::Identity();
    world::GeometryId geometry = {};
    world::MaterialId material = {};
    FeltShapePointer felt = nullptr;
    std::optional<std::uint32_t> slot = {};  // none: it cannot be touched
    world::FixturePointer effect = nullptr;  // a ForceEffect, or null
  };
  struct Slot {
    haptics::HapticObject object;
    world::ObjectId world_id = {};  // none: free
    double set_off = 0.0;           // s, when it was put where it is
  };
  struct ShapeKey {
    world::GeometryId geometry;
    std::array<double, 9> stretch;
    auto operator<=>(const ShapeKey&) const = default;
  };
  /// An object to bring up to date, and its place.
  struct Due {
    world::ObjectId id;
    base::Affine3 world_from_object;
  };
  class Update;

  void survey(const world::World& world);
  base::Affine3 place(const world::World& world, world::ObjectId id) const;
  void collect(const world::World& world, world::ObjectId root, std::vector<Due>& due);
  bool in_scene(const world::World& world, world::ObjectId id) const;
  void note_object(const world::World& world, world::ObjectId id, std::vector<Due>& due);
  void forget(world::ObjectId id);
  void outdate_shapes(world::GeometryId geometry);
  void forget_unused();
  void put(std::uint32_t slot, const base::Pose& world_from_felt);
  void go_on();
  std::shared_ptr<const haptics::HapticTexture> texture(const std::string& name);
  haptics::Surface surface_of(const world::World& world, const Member& member);
  void publish();
  static bool placeable(const Member& effect);
  void list_effects();

  HapticRepresentationSettings settings_;
  world::SceneId shown_ = {};                        // none: the whole world
  std::unordered_set<world::ObjectId> shown_roots_;  // of the scene that is shown
  std::unordered_map<world::ObjectId, Member> members_;
  std::map<ShapeKey, FeltShapePointer> shapes_;
  std::map<ShapeKey, FeltShapePointer> outdated_;  // by the edits that are being followed
  std::vector<ShapeKey> released_;                 // may have lost their last user
  std::map<std::string, std::shared_ptr<const haptics::HapticTexture>> textures_;  // null: not known
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> free_slots_;
  std::shared_ptr<const TouchedNames> names_;  // null: to be made anew
  std::vector<std::uint32_t> going_;           // slots with a motion, and others that had one
  std::vector<std::uint32_t> moved_;           // slots, since the last published scene
  bool stale_ = false;                         // moving objects is not enough
  bool effects_stale_ = false;
  std::vector<haptics::PlacedEffect> effects_;
  std::uint64_t surveys_ = 0;
  std::shared_ptr<const haptics::HapticScene> scene_;
  Work work_;
};

}  // namespace icome::session
