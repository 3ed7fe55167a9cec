#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "geometry/csg/meshing/csg_mesh.h"
#include "geometry/csg_trees.h"

namespace icome::geometry {
namespace {

/// A box that is a primitive of one's own: it cannot be cut out.
class OwnBox final : public CsgPrimitive {
 public:
  explicit OwnBox(const Vector3& half) : box_(Box{half}) {}
  bool inside(const Vector3& point) const override { return geometry::inside(box_, point); }
  SurfacePoint scp_from_inside(const Vector3& point) const override {
    return geometry::scp_from_inside(box_, point);
  }
  SurfacePoint scp_from_outside(const Vector3& point) const override {
    return geometry::scp_from_outside(box_, point);
  }
  Bounds bounds() const override { return geometry::bounds(box_); }
  TriangleMesh tessellate(double tolerance) const override { return geometry::tessellate(box_, tolerance); }
  std::string name() const override { return "own box"; }

 private:
  Primitive box_;
};

TEST(CsgMeshByCells, WhatIsLostIsTold) {
  // Plates of one's own cannot be cut out, and smaller cells do not find one of a micrometre.
  for (const double thickness : {0.02, 1e-6}) {
    CsgTree tree;
    const std::shared_ptr<const CsgPrimitive> own =
        std::make_shared<const OwnBox>(Vector3(0.5, 0.5, 0.5 * thickness));
    const auto plate = tree.add_leaf(own, moved(0.0, 0.0, 0.5 * thickness));
    const auto foot = tree.add_leaf(Primitive(Box{Vector3::Constant(0.2)}), moved(0.0, 0.0, -0.3));
    tree.add(CsgOperator::Union, plate, foot);
    const auto made = contour(tree, {.cell = 0.036, .measures = false});
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_EQ(made->lost.has_value(), thickness < 0.01);
    if (made->lost) {
      EXPECT_NEAR(made->lost->z(), 0.0, 1e-5);
    }
  }
}

}  // namespace
}  // namespace icome::geometry
