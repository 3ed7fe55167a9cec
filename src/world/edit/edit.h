#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/result.h"
#include "world/world.h"

namespace icome::world {

struct Edit;

/// Creates an object without children. The ids of new things come from an IdSource.
struct CreateObject {
  ObjectId id;
  std::size_t place = 0;  // among its siblings-to-be
  PhysicalObject object;  // its parent in it, no children
};
/// Takes an object away that has no children and is no root of a scene; see delete_subtree.
struct DeleteObject {
  ObjectId id;
};
/// Puts a subtree under another parent, or among the roots, at a new place.
struct MoveObject {
  ObjectId id;
  ObjectId parent;
  std::size_t place = 0;  // among its siblings-to-be, itself not counted
  Affine3 parent_from_object = Affine3::Identity();
};
struct PlaceObject {
  ObjectId id;
  Affine3 parent_from_object = Affine3::Identity();
};
struct RenameObject {
  ObjectId id;
  std::string name;
};
/// Gives the object another shape of the world, or none.
struct ChooseGeometry {
  ObjectId id;
  GeometryId geometry;
};
struct ChooseMaterial {
  ObjectId id;
  MaterialId material;
};

struct ChangeFixture {
  ObjectId id;
  FixturePointer fixture;
};

/// Gives the object a motion of its own, or takes it away.
struct ChangeMotion {
  ObjectId id;
  MotionPointer motion;
};

struct CreateGeometry {
  GeometryId id;
  GeometryPointer shape;
};
/// Makes a shape that equals another but is separate from it: either can change alone.
struct CopyGeometry {
  GeometryId id;
  GeometryId model;
};
/// Deletes a shape that no object uses.
struct DeleteGeometry {
  GeometryId id;
};
/// Changes the shape of all objects that share it.
struct ReplaceGeometry {
  GeometryId id;
  GeometryPointer shape;
};
/// Moves vertices of a mesh or of a control mesh, for all objects that share it. A mesh loses its recipe;
/// the inverse is then a ReplaceGeometry.
struct MoveVertices {
  GeometryId id;
  std::vector<std::uint32_t> vertices;
  std::vector<Vector3> positions;  // m, the shape's frame; one per vertex
};

/// Makes a change that only the shape's kind understands (Geometry::amended), for all objects that share it:
/// a stroke more in a drawing.
struct AmendGeometry {
  GeometryId id;
  std::string change;  // bytes
};

struct CreateMaterial {
  MaterialId id;
  Material material;
};
struct DeleteMaterial {
  MaterialId id;
};
struct ChangeMaterial {
  MaterialId id;
  Material material;
};
struct CreateTexture {
  TextureId id;
  Texture texture;
};
struct DeleteTexture {
  TextureId id;
};

struct CreateScene {
  SceneId id;
  std::string name;
};
/// Deletes a scene without objects.
struct DeleteScene {
  SceneId id;
};
struct RenameScene {
  SceneId id;
  std::string name;
};
/// Puts the subtree of an object into a scene.
struct EnterScene {
  SceneId scene;
  ObjectId object;
  std::size_t place = 0;  // among the scene's roots
};
struct LeaveScene {
  SceneId scene;
  ObjectId object;
};

/// Reserves an author's numbers up to `last`, because whatever had them is gone, so that they are not
/// given again. This cannot be taken back.
struct ReserveIds {
  std::uint32_t author = 0;
  std::uint64_t last = 0;
};

/// Edits that belong together: all are applied, in this order, or none.
struct EditGroup {
  std::vector<Edit> edits;
};

/// A change of a world, the only way in which one changes: a plain value that can be applied and inverted.
/// Undo, the journal, the network, speech and replays all carry these.
struct Edit {
  using What = std::variant<CreateObject, DeleteObject, MoveObject, PlaceObject, RenameObject, ChooseGeometry,
                            ChooseMaterial, ChangeFixture, ChangeMotion, CreateGeometry, CopyGeometry,
                            DeleteGeometry, ReplaceGeometry, MoveVertices, AmendGeometry, CreateMaterial,
                            DeleteMaterial, ChangeMaterial, CreateTexture, DeleteTexture, CreateScene,
                            DeleteScene, RenameScene, EnterScene, LeaveScene, ReserveIds, EditGroup>;

  template <typename Kind,
            typename = std::enable_if_t<std::conjunction_v<
                std::negation<std::is_same<std::decay_t<Kind>, Edit>>, std::is_constructible<What, Kind&&>>>>
  Edit(Kind&& kind) : what(std::forward<Kind>(kind)) {}  // NOLINT(google-explicit-constructor)

  What what;
};

/// May an object be placed so? The transform must be finite and must not flatten.
bool can_be_placed(const Affine3& frame);

/// Changes the world and gives the edit that takes it back. A refused edit changes nothing, and the error
/// says why in the user's terms.
base::Result<Edit> apply(World& world, const Edit& edit);

/// Applies one edit of many that build a world which nobody reads yet: shapes that this world alone holds
/// may change in place, and there is no inverse.
base::Result<void> replay(World& world, const Edit& edit);

/// The edit that deletes an object with all below it, and the shapes that nobody uses after that. The
/// object must be in the world.
Edit delete_subtree(const World& world, ObjectId root);

}  // namespace icome::world
