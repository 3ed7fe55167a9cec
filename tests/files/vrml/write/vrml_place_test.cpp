#include "files/vrml/write/vrml_place.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"

namespace icome::files {
namespace {

using base::Affine3;
using base::Matrix3;
using base::Vector3;

Affine3 with_axes(const Matrix3& axes) {
  Affine3 frame = Affine3::Identity();
  frame.linear() = axes;
  return frame;
}
Matrix3 turned(double angle, const Vector3& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// How far the fields are off, as a part of the largest axis.
double off_by(const Affine3& frame) {
  const Affine3 again = affine(vrml_place(frame));
  return (again.linear() - frame.linear()).cwiseAbs().maxCoeff() / frame.linear().cwiseAbs().maxCoeff();
}

TEST(VrmlPlace, SaysWhatPeopleWouldSay) {
  Affine3 frame(Eigen::Translation3d(0.1, -0.0, 3.0));
  frame.rotate(Eigen::AngleAxisd(0.3, -Vector3::UnitX())).scale(Vector3(2.0, 0.5, 1.0));
  const VrmlPlace fields = vrml_place(frame);
  EXPECT_EQ(fields.translation, Eigen::Vector3f(0.1F, 0.0F, 3.0F));
  EXPECT_EQ(fields.rotation, (VrmlTurn{Eigen::Vector3f::UnitX(), -0.3F}));
  EXPECT_EQ(fields.scale, Eigen::Vector3f(2.0F, 0.5F, 1.0F));
  EXPECT_EQ(fields.scale_orientation, VrmlTurn());
  EXPECT_EQ(vrml_place(Affine3::Identity()), VrmlPlace());
}

TEST(VrmlPlace, HalfATurnIsOneWhicheverWay) {
  for (const double angle : {std::numbers::pi, -std::numbers::pi, 3.1415927, 3.1415925}) {
    EXPECT_EQ(vrml_place(with_axes(turned(angle, Vector3::UnitY()))).rotation,
              (VrmlTurn{Eigen::Vector3f::UnitY(), std::numbers::pi_v<float>}));
  }
}

TEST(VrmlPlace, MirrorsByNegativeScales) {
  const VrmlPlace one = vrml_place(with_axes(Vector3(1.0, -2.0, 3.0).asDiagonal()));
  EXPECT_EQ(one.scale, Eigen::Vector3f(1.0F, -2.0F, 3.0F));
  EXPECT_EQ(one.rotation, VrmlTurn());
  const VrmlPlace all = vrml_place(with_axes(Vector3::Constant(-0.5).asDiagonal()));
  EXPECT_EQ(all.scale, Eigen::Vector3f::Constant(-0.5F));
  EXPECT_EQ(all.rotation, VrmlTurn());
}

TEST(VrmlPlace, ScalesBeyondSinglePrecisionDoNotFlatten) {
  const VrmlPlace fields = vrml_place(with_axes(Vector3(1e-60, 1e60, 1.0).asDiagonal()));
  EXPECT_GT(fields.scale.x(), 0.0F);
  EXPECT_TRUE(fields.scale.allFinite());
}

class AnyAxes {
 public:
  explicit AnyAxes(std::uint64_t seed) : random_(seed) {}

  Matrix3 turn() { return turned(random_.uniform(-3.2, 3.2), random_.direction()); }
  double size() { return (random_.index(2) == 0 ? 1.0 : -1.0) * std::pow(10.0, random_.uniform(-3.0, 3.0)); }
  Matrix3 stretched(const Vector3& sizes) {
    const Matrix3 orientation = turn();
    return turn() * orientation * sizes.asDiagonal() * orientation.transpose();
  }
  Matrix3 next() {
    switch (random_.index(9)) {
      case 0:
        return turn();
      case 1:
        return turn() * size();
      case 2:
        return turn() * Vector3(size(), size(), size()).asDiagonal();
      case 3:
        return stretched({size(), size(), size()});
      case 4: {
        const double twice = size();
        return stretched({twice, twice, size()});
      }
      case 5: {
        const double close = size();
        return stretched({close, close * (1.0 + random_.uniform() * 1e-6), close * (1.0 - 1e-7)});
      }
      case 6:
        return turned(0.25 * std::numbers::pi * double(random_.index(9)), Vector3::Unit(random_.index(3))) *
               Vector3(1.0, random_.index(2) == 0 ? -1.0 : 1.0, 2.0).asDiagonal();
      case 7:
        return turned(std::pow(10.0, random_.uniform(-12.0, 0.0)), random_.direction());
      default: {
        Matrix3 any;
        for (int i = 0; i < 9; ++i) any(i / 3, i % 3) = random_.uniform(-1.0, 1.0);
        return any;
      }
    }
  }

 private:
  base::Random random_;
};

TEST(VrmlPlace, AnyTransformComesBackToSixDecimalsAndThenStays) {
  AnyAxes axes(1);
  for (int i = 0; i < 20'000; ++i) {
    const Affine3 frame = with_axes(axes.next());
    EXPECT_LT(off_by(frame), 3e-6) << frame.linear();
    const VrmlPlace fields = vrml_place(frame);
    EXPECT_EQ(vrml_place(affine(fields)), fields) << frame.linear();
  }
}

}  // namespace
}  // namespace icome::files
