#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"
#include "base/vector.h"

namespace icome::world {

using base::Affine3;
using base::Bounds;
using base::Vector3;

struct MeshGeometry;
struct FlatCurves;
struct Amended;

/// The shape of an object, in the object's own frame (m). Immutable, so that threads, undo and copies
/// share it; an edit puts another in its place. Derive from it to add a kind of shape (thesis 5.6.2).
class Geometry {
 public:
  virtual ~Geometry() = default;

  /// The kind's name in files and reports: "mesh", "primitive", "loop", "csg", "implicit" or one's own.
  virtual std::string_view kind() const = 0;

  /// The built-in kinds, which visit_geometry() tells apart.
  enum class Kind : std::uint8_t { Mesh, Primitive, Loop, Csg, Implicit, OnesOwn };
  virtual Kind which() const { return Kind::OnesOwn; }

  /// Bounds of the shape; empty for one that holds nothing.
  virtual Bounds bounds() const = 0;

  /// A number that is equal for shapes equal to the last bit and almost surely different for others.
  virtual std::uint64_t hash() const = 0;

  /// Memory held, in bytes.
  virtual std::size_t bytes() const = 0;

  /// The shape's surface as triangles, for display, other programs' files and sizes that cannot be touched
  /// as they are; within `tolerance` (m, > 0) of it where the kind can tell. Fails, saying why, where that
  /// cannot be done: unlimited shapes, more than kMostTriangles.
  virtual base::Result<std::shared_ptr<const MeshGeometry>> triangles(double tolerance) const = 0;
  static constexpr std::size_t kMostTriangles = 20'000'000;

  /// The bytes from which the reader of this kind (GeometryFactory) makes an equal shape. Fails, saying
  /// why, where it could not: whatever is written can be read.
  virtual base::Result<std::string> write() const = 0;

  /// Curves that lie in the plane z = 0 of the shape's frame, to be swept, off by `tolerance` (m, > 0) at
  /// most. Fails, saying why, for shapes that are not drawn.
  virtual base::Result<FlatCurves> flat_curves(double tolerance) const;

  /// The shape after a change that only its kind understands, as bytes that may come from a stranger. Fails
  /// with a sentence where they are damaged or cannot be done, and for kinds without such changes.
  virtual base::Result<Amended> amended(std::string_view change) const;
};

using GeometryPointer = std::shared_ptr<const Geometry>;

/// A changed shape, and the change that takes it back.
struct Amended {
  GeometryPointer shape;
  std::string back;
};

}  // namespace icome::world
