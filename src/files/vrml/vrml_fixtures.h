#pragma once
#include "base/vector.h"
#include "world/shape/fixture.h"

namespace icome::files {

namespace flat {
struct Viewpoint;
struct Light;
}  // namespace flat

/// A fixture and its place: VRML places lights and viewpoints by numbers, the world by the object they
/// belong to, whose -z they face.
struct PlacedFixture {
  world::FixturePointer fixture;
  base::Affine3 parent_from_fixture = base::Affine3::Identity();  // rigid
};

/// Invalid numbers are replaced by VRML's defaults.
PlacedFixture fixture_of(const flat::Light& light);
PlacedFixture fixture_of(const flat::Viewpoint& viewpoint);

/// Turns -z to a direction, by the shortest way (about y where it is +z): the turn of a light or viewpoint
/// that has only a direction.
base::Matrix3 facing(const base::Vector3& direction);

}  // namespace icome::files
