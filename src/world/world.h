#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "world/id.h"
#include "world/shape/fixture.h"
#include "world/shape/geometry.h"

namespace icome::world {

struct Motion;
using MotionPointer = std::shared_ptr<const Motion>;  // null: none; motion.h

/// A thing in the world (thesis 2.4.1, 5.6.2): its place with respect to its parent, its shape, its look
/// and its feel. It owns nothing that it names.
struct PhysicalObject {
  std::string name = {};
  ObjectId parent = {};                 // none: a root of the world
  std::vector<ObjectId> children = {};  // in the order that people see
  Affine3 parent_from_object = Affine3::Identity();
  GeometryId geometry = {};  // none: only a group
  MaterialId material = {};  // none: the default
  FixturePointer fixture = {};
  MotionPointer motion = {};  // null: it stays

  // Kept by the world, for speed.
  std::uint32_t place_hint = 0;  // about its index among its siblings
  std::uint32_t scenes = 0;      // number of scenes that it is a root of
};

/// A shape that objects share: a clone uses the same one, a copy one of its own.
struct GeometryObject {
  GeometryPointer shape;    // never null
  std::uint32_t users = 0;  // objects that use it
};

/// The feel of a surface. Values that are not set are left to the device's own best.
struct TouchProperties {
  std::optional<double> stiffness = {};  // N/m
  std::optional<double> damping = {};    // N s/m
  double static_friction = 0.0;          // >= dynamic
  double dynamic_friction = 0.0;
  std::string texture = {};  // name of a haptic texture; empty: smooth

  bool operator==(const TouchProperties&) const = default;
};

/// The placement of a picture: the rows of the transform from texture coordinates (u, v) to the place that
/// is looked up, (0, 0) its lower left and (1, 1) its upper right.
using PictureFrame = std::array<double, 6>;
inline constexpr PictureFrame kPictureAsItLies = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0};

/// The rule by which one sees through a surface, beside its transparency.
enum class AlphaMode : std::uint8_t {
  ByPicture,  // the picture's opacity: holes and edges, or glass (VRML 2.0)
  Opaque,     // seen through nowhere, whatever the picture's opacity
  Mask,       // clear where the picture's opacity is below the cutoff
  Blend       // the picture's opacity, as of glass
};

/// The look by the model of VRML 2.0, and the feel. Always shared, never copied with objects.
struct Material {
  std::string name = {};
  float ambient = 0.2F;  // of the diffuse colour
  Colour diffuse = {0.8F, 0.8F, 0.8F};
  Colour specular = {};
  Colour emission = {};
  float shininess = 0.2F;     // in [0, 1]
  float transparency = 0.0F;  // 1: invisible
  TextureId texture = {};     // none: plain
  TouchProperties touch = {};
  // Beyond VRML 2.0, as in glTF.
  PictureFrame picture_frame = kPictureAsItLies;
  bool tints =
      false;  // the diffuse colour multiplies any picture's; else only a grey one's, and others replace it
  AlphaMode alpha_mode = AlphaMode::ByPicture;
  float alpha_cutoff = 0.5F;            // of AlphaMode::Mask, in [0, 1]
  bool unlit = false;                   // shows its own colour, whatever the light
  bool double_sided = true;             // else backs are not seen
  std::optional<float> metallic = {};   // in [0, 1]; holds while the specular colour is what follows from it
  std::optional<float> roughness = {};  // in [0, 1]; holds while the shininess is what follows from it
  std::uint32_t users = 0;              // objects that have it; kept by the world

  bool operator==(const Material&) const = default;
};

/// A picture on a surface, kept as its original file.
struct Texture {
  std::string name;        // its origin, for people
  std::string media_type;  // "image/png", "image/jpeg"
  std::shared_ptr<const std::string> bytes;
  std::array<bool, 2> repeats = {true, true};  // along u and v; else the edge is continued
  std::uint32_t users = 0;                     // materials that show it; kept by the world
};

/// A part of the world that is seen and touched together: the subtrees of some objects. A change of an
/// object shows in all its scenes.
struct Scene {
  std::string name;
  std::vector<ObjectId> roots;
};

struct Edit;

/// All objects of a design with what they share. A plain value that changes by edits only (apply in
/// edit.h); copying one copies tables but no shapes. One thread owns it.
class World {
 public:
  /// Null for things that are not there (any more). Valid until the next edit.
  const PhysicalObject* find(ObjectId id) const { return look(objects_, id); }
  const GeometryObject* find(GeometryId id) const { return look(geometries_, id); }
  const Material* find(MaterialId id) const { return look(materials_, id); }
  const Texture* find(TextureId id) const { return look(textures_, id); }
  const Scene* find(SceneId id) const { return look(scenes_, id); }

  /// The objects without a parent, in the order that people see.
  const std::vector<ObjectId>& roots() const { return roots_; }

  template <typename Named>
  using Table = std::unordered_map<Id<Named>, Named>;
  const Table<PhysicalObject>& objects() const { return objects_; }
  const Table<GeometryObject>& geometries() const { return geometries_; }
  const Table<Material>& materials() const { return materials_; }
  const Table<Texture>& textures() const { return textures_; }
  const Table<Scene>& scenes() const { return scenes_; }

  /// The first number that an IdSource of this author may give.
  std::uint64_t next_number(std::uint32_t author) const;
  /// The highest number that was ever given, by author.
  const std::unordered_map<std::uint32_t, std::uint64_t>& last_numbers() const { return last_numbers_; }

 private:
  friend class EditApplier;

  template <typename Named>
  static const Named* look(const Table<Named>& table, Id<Named> id) {
    const auto found = table.find(id);
    return found == table.end() ? nullptr : &found->second;
  }

  Table<PhysicalObject> objects_;
  Table<GeometryObject> geometries_;
  Table<Material> materials_;
  Table<Texture> textures_;
  Table<Scene> scenes_;
  std::vector<ObjectId> roots_;
  std::unordered_map<std::uint32_t, std::uint64_t> last_numbers_;
};

/// The place of an object, which is in the world, in the world's frame.
Affine3 world_from_object(const World& world, ObjectId id);

/// Is `id` this `ancestor` or below it?
bool is_within(const World& world, ObjectId id, ObjectId ancestor);

/// The objects of a subtree, parents before children.
std::vector<ObjectId> subtree(const World& world, ObjectId root);

/// Bounds of the shapes of a subtree, in the world's frame; unlimited ones, such as planes, are left out.
/// Empty where there are none.
Bounds bounds(const World& world, ObjectId root);

/// The object on whose subtree a light shines; none: on everything. A scoped one shines on its object
/// with all below it or, where that is nothing but the light, on the group that it is in.
ObjectId lit_group(const World& world, ObjectId light);

/// Equal for worlds with equal content, however they came about.
std::uint64_t hash(const World& world);

}  // namespace icome::world
