#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geometry/primitive/primitive.h"
#include "haptics/contact/contact_region.h"
#include "haptics/effects/surface_force.h"

namespace icome::haptics {

/// A request to a shape for all that a tip of radius `tip` (m) can meet while its centre stays
/// within `reach` of the segment from `a` to `b`, all in the shape's own frame.
struct GatherRequest {
  Vector3 a;
  Vector3 b;
  double reach;
  double tip;
  TouchableSides sides;
  double time = 0.0;  // s, the shape's own
};

/// Takes the elements and pieces of a shape, in the shape's frame. Lives on the stack of one gather.
class ElementSink {
 public:
  ElementSink(ContactRegion& region, std::uint32_t object, const Pose& world_from_object);

  // Both return false when there is no room for more: then the rest need not be handed out.

  /// An element; `bounds` as for ContactRegion::add. Real-time safe.
  bool add(Element element, const Bounds& bounds);
  /// A piece that Shape::expand will turn into elements when a sweep comes near. Real-time safe.
  bool defer(std::uint32_t piece, const Bounds& bounds);
  /// Is the shape wanted whole, if it can tell by Shape::sweep what a tip meets?
  bool wants_whole() const { return region_.keeps_whole(); }
  /// The shape as a whole. Real-time safe.
  bool defer_whole();

 private:
  Bounds in_world(const Bounds& bounds) const;

  ContactRegion& region_;
  std::uint32_t object_;
  const Pose& world_from_object_;
  bool in_place_;  // the shape's frame is the world's
};

/// Takes the pieces that a tip can meet on its way; lives on the stack of one Shape::sweep.
class PieceVisitor {
 public:
  virtual ~PieceVisitor() = default;
  /// Returns the share of the way that still counts, which never grows. Real-time safe.
  virtual double visit(std::uint32_t piece) = 0;
};

/// Takes the elements of one piece, in the shape's frame; lives on the stack of one Shape::expand.
class PieceElements {
 public:
  explicit PieceElements(std::vector<Element>& into) : into_(into), first_(into.size()) {}

  /// Without memory left, the element is dropped and complete() turns false. Real-time safe.
  void add(const Element& element) {
    complete_ = complete_ && into_.size() < into_.capacity();
    if (complete_) into_.push_back(element);
  }
  std::span<Element> all() { return std::span(into_).subspan(first_); }
  bool complete() const { return complete_; }

 private:
  std::vector<Element>& into_;
  std::size_t first_;
  bool complete_ = true;
};

/// The hit of a straight way on a shape, in the shape's frame.
struct ShapeHit {
  double t;        // along the step, in [0, 1]
  Vector3 point;   // m, on the surface
  Vector3 normal;  // unit, out of the solid or towards the front
};

/// Something that can be touched. To add a kind of shape, derive from this and say which elements lie
/// where. Immutable once built, so that many objects and scenes may share it; whoever holds the
/// shared pointer owns it.
class Shape {
 public:
  virtual ~Shape() = default;

  /// Box around the surface, in the shape's own frame; infinite for an unlimited shape.
  virtual Bounds bounds() const = 0;

  /// Hands out every element or piece that the request can meet, and perhaps others. Real-time safe.
  virtual void gather(const GatherRequest& request, ElementSink& sink) const = 0;

  /// The elements, one or more, of a piece that gather deferred, in the shape's frame. Real-time safe.
  virtual void expand(std::uint32_t /*piece*/, double /*tip*/, TouchableSides /*sides*/,
                      PieceElements& /*elements*/) const {}

  /// Hands out the pieces within `distance` (m) of the way from `start` by `step`, in the shape's frame, as
  /// far as the way counts, roughly in their order along it, and perhaps others. Returns how many were
  /// tested. Only for shapes that gather leaves whole. Real-time safe.
  virtual std::size_t sweep(const Vector3& /*start*/, const Vector3& /*step*/, double /*distance*/,
                            PieceVisitor& /*visitor*/) const {
    return 0;
  }

  /// The nearest place of the surface when `position` is inside a solid that is touched from the
  /// front; nothing when it is not inside, or the shape has no inside. `time`: see changes(). Real-time safe.
  virtual std::optional<geometry::SurfacePoint> way_out(const Vector3& position, double time) const = 0;

  /// The place of the surface nearest to a position outside, if it is within `limit` metres and its touched
  /// side faces the position; the normal points from it to the position. Answered only by shapes that a
  /// sphere tip feels as they are. Real-time safe.
  virtual std::optional<geometry::SurfacePoint> nearest(const Vector3& /*position*/, double /*limit*/,
                                                        TouchableSides /*sides*/) const {
    return std::nullopt;
  }

  /// The hit at which start + t * step, t in [0, 1], first goes through the surface, from either side; for
  /// picking with the mouse, so it may allocate. `time`: see changes().
  virtual std::optional<ShapeHit> cast(const Vector3& start, const Vector3& step, double time) const = 0;

  /// The normal to feel at a position on element `feature`: interpolated between faces where the
  /// shape has such normals (force shading, Morgenbesser and Srinivasan 1996), else `face_normal`.
  /// Real-time safe.
  virtual Vector3 shading_normal(std::uint32_t /*feature*/, const Vector3& /*position*/,
                                 const Vector3& face_normal) const {
    return face_normal;
  }

  /// Does the shape itself change with its time (HapticObject::time, s)?
  virtual bool changes() const { return false; }

  /// Memory held, in bytes.
  virtual std::size_t bytes() const = 0;
};

}  // namespace icome::haptics
