#pragma once
#include "base/vector.h"
#include "world/shape/fixture.h"

namespace icome::files {

namespace flat {
struct Viewpoint;
struct Light;
}  // namespace flat

/// A fixture and where it is: VRML places lights and viewpoints by numbers, the world by the object they are
/// on, whose -z they face.
struct PlacedFixture {
  world::FixturePointer fixture;
  base::Affine3 parent_from_fixture = base::Affine3::Identity();  // rigid
};

/// Numbers that make no sense are replaced by those that VRML has by default.
PlacedFixture fixture_of(const flat::Light& light);
PlacedFixture fixture_of(const flat::Viewpoint& viewpoint);

/// Turns -z to a direction, by the shortest way (about y where it is +z): how a light or viewpoint that only
/// says where it looks is turned.
base::Matrix3 facing(const base::Vector3& direction);

}  // namespace icome::files
