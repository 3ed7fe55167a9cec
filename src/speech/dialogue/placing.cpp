#include "speech/dialogue/placing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace icome::speech {
namespace {

using base::fail;
using base::Result;

constexpr double kGap = 0.25;  // of the own size, between things that stand beside each other

double half_along(const Bounds& box, const Vector3& axis) { return 0.5 * box.sizes().dot(axis.cwiseAbs()); }

Bounds centred_at(const Bounds& box, const Vector3& middle) {
  const Vector3 half = 0.5 * box.sizes();
  return {Vector3(middle - half), Vector3(middle + half)};
}

bool is_free(const Bounds& box, const std::vector<Bounds>& others) {
  // Things that only touch are not in each other's way.
  const Vector3 shrink = 1e-6 * box.sizes();
  const Bounds inner(Vector3(box.min() + shrink), Vector3(box.max() - shrink));
  return std::ranges::none_of(others, [&](const Bounds& other) { return inner.intersects(other); });
}

/// The middle beside the reference along an axis of the floor.
Vector3 beside_along(const Vector3& axis, const Bounds& bounds, const Bounds& reference) {
  const double gap = kGap * bounds.sizes().maxCoeff();
  Vector3 middle = reference.center() + (half_along(reference, axis) + gap + half_along(bounds, axis)) * axis;
  middle.y() = reference.min().y() + 0.5 * bounds.sizes().y();
  return middle;
}

/// The place, or the first one behind it in steps that is free; the place itself where all of some are taken.
Vector3 first_free(const Vector3& place, const Vector3& step, const Bounds& bounds,
                   const std::vector<Bounds>& others) {
  constexpr int kMostSteps = 50;
  for (int i = 0; i < kMostSteps; ++i)
    if (const Vector3 middle = place + i * step; is_free(centred_at(bounds, middle), others)) return middle;
  return place;
}

/// The free place on top of the reference that is nearest to its middle; where none is left, on top of what
/// lies in its middle.
Vector3 on_top(const Bounds& bounds, const Bounds& reference, const std::vector<Bounds>& others) {
  const Vector3 size = bounds.sizes(), room = 0.5 * (reference.sizes() - size);
  Vector3 middle = reference.center();
  middle.y() = reference.max().y() + 0.5 * size.y();
  constexpr int kMostPlaces = 20;  // to each side
  const auto places = [&](int axis) {
    const double step = (1.0 + kGap) * size[axis];
    return step > 0.0 && room[axis] > 0.0 ? std::min(kMostPlaces, int(room[axis] / step)) : 0;
  };
  std::vector<Vector3> all;
  for (int x = -places(0); x <= places(0); ++x)
    for (int z = -places(2); z <= places(2); ++z)
      all.emplace_back(middle + (1.0 + kGap) * Vector3(x * size.x(), 0.0, z * size.z()));
  // The right one of two that are as near comes first, as for "near".
  std::ranges::stable_sort(all, [&](const Vector3& one, const Vector3& other) {
    const double near = (one - middle).norm(), far = (other - middle).norm();
    return std::abs(near - far) > 1e-9 ? near < far : one.x() > other.x();
  });
  for (const Vector3& place : all)
    if (is_free(centred_at(bounds, place), others)) return place;
  for (std::size_t i = 0; i < others.size(); ++i)
    for (const Bounds& other : others)
      if (!is_free(centred_at(bounds, middle), {other})) middle.y() = other.max().y() + 0.5 * size.y();
  return middle;
}

}  // namespace

Vector3 middle_beside(const std::string& side, const Bounds& bounds, const Bounds& reference,
                      const ViewerAxes& axes, const std::vector<Bounds>& others) {
  const double half = 0.5 * bounds.sizes().y(), gap = kGap * bounds.sizes().maxCoeff();
  const auto beside = [&](const Vector3& axis) {
    const Vector3 step = (2.0 * half_along(bounds, axis) + gap) * axis;
    return first_free(beside_along(axis, bounds, reference), step, bounds, others);
  };
  Vector3 middle = reference.center();
  const Vector3 up = (2.0 * half + gap) * Vector3::UnitY();
  if (side == "left") return beside(Vector3(-axes.right));
  if (side == "right") return beside(axes.right);
  if (side == "front") return beside(axes.towards);
  if (side == "behind") return beside(Vector3(-axes.towards));
  if (side == "on") return on_top(bounds, reference, others);
  if (side == "near") {
    for (const Vector3& axis : {axes.right, Vector3(-axes.right), axes.towards, Vector3(-axes.towards)}) {
      middle = beside_along(axis, bounds, reference);
      if (is_free(centred_at(bounds, middle), others)) break;
    }
    return middle;
  }
  if (side == "above") {
    middle.y() = reference.max().y() + gap + half;
    return first_free(middle, up, bounds, others);
  }
  if (side == "below") {
    middle.y() = reference.min().y() - gap - half;
    return first_free(middle, -up, bounds, others);
  }
  return middle;  // inside
}

Vector3 free_middle(const Bounds& bounds, const std::vector<Bounds>& others) {
  const Vector3 origin = Vector3::Zero();
  if (bounds.isEmpty() || is_free(centred_at(bounds, origin), others)) return origin;
  constexpr int kRings = 8, kAround = 8;
  const double step = (1.0 + kGap) * std::max(bounds.sizes().x(), bounds.sizes().z());
  for (int ring = 1; ring <= kRings; ++ring)
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kAround;
      const Vector3 middle(ring * step * std::cos(angle), 0.0, -ring * step * std::sin(angle));
      if (is_free(centred_at(bounds, middle), others)) return middle;
    }
  // All of that is full: beside everything.
  Bounds all;
  for (const Bounds& other : others) all.extend(other);
  return {all.max().x() + step, 0.0, 0.0};
}

std::vector<Bounds> bounds_of_others(const world::World& world, const std::vector<ObjectId>& but) {
  std::vector<Bounds> boxes;
  for (const ObjectId root : speakable_objects(world, true)) {
    const auto is_moved = [&](ObjectId id) { return world::is_within(world, id, root); };
    if (std::ranges::any_of(but, is_moved)) continue;
    if (const Bounds box = world::bounds(world, root); !box.isEmpty()) boxes.push_back(box);
  }
  return boxes;
}

Result<Vector3> said_middle(const Phrase& where, const Bounds& bounds, References& references,
                            const Situation& at, const std::vector<ObjectId>& moved) {
  if (where.part("middle")) return Vector3(Vector3::Zero());
  if (const Phrase* here = where.part("here")) {
    // The place is where the hand was at the last word of it.
    const auto hand = at.stage.pointer(at.time_of(here->end - 1));
    if (!hand) return fail("There is no hand here to show the place.");
    return Vector3(hand->world_from_pointer.translation());
  }
  const auto said = [&](const Phrase& phrase) {
    const std::size_t sides = phrase.has("between") ? 2 : phrase.part("side") ? 1 : 0;
    return sides > 0 && phrase.all("reference").size() == sides;
  };
  const Phrase* const known = where.part("beside");
  if (known == nullptr || !said(*known)) return fail("The vocabulary's <where> says no place that is known.");
  const Phrase& beside = *known;
  std::vector<Bounds> boxes;
  for (const Phrase* part : beside.all("reference")) {
    const auto id = references.single(*part);
    if (!id) return tl::unexpected(id.error());
    if (std::ranges::find(moved, *id) != moved.end()) return fail("It cannot stand beside itself.");
    Bounds box = world::bounds(at.world, *id);
    if (box.isEmpty()) box = Bounds(Vector3(middle_of(at.world, *id)));
    boxes.push_back(box);
  }
  if (beside.has("between")) return Vector3(0.5 * (boxes[0].center() + boxes[1].center()));
  return middle_beside(beside.part("side")->tag(), bounds, boxes[0], references.axes(),
                       bounds_of_others(at.world, moved));
}

}  // namespace icome::speech
