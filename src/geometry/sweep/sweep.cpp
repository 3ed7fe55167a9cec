#include "geometry/sweep/sweep.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace icome::geometry {
namespace {

Affine3 about_point(const Vector3& centre, const Affine3& moved) {
  return Eigen::Translation3d(centre) * moved * Eigen::Translation3d(-centre);
}

/// Does the step only turn, and move along the axis it turns about?
bool is_screw(const SweepStep& step) {
  return step.scaling == Vector3::Ones() &&
         (step.angle == 0.0 || step.translation.cross(step.axis).isZero(0.0));
}

/// The step, its angle and its translation multiplied.
Affine3 multiplied(const SweepStep& step, double times) {
  Affine3 moved = Affine3::Identity();
  if (step.angle != 0.0) moved.rotate(Eigen::AngleAxisd(times * step.angle, step.axis.stableNormalized()));
  moved.scale(step.scaling);
  return Eigen::Translation3d(times * step.translation) * about_point(step.centre, moved);
}

/// The fault of the step, and its remedy; empty when there is none.
const char* fault_of(const SweepStep& step) {
  if (!step.scaling.allFinite() || !std::isfinite(step.angle) || !step.axis.allFinite() ||
      !step.centre.allFinite() || !step.translation.allFinite())
    return "has a number that is not finite; give another";
  if (step.scaling.minCoeff() < 0.0) return "scales by less than 0; turn it by half a turn instead";
  if (step.angle != 0.0 && step.axis.isZero(0.0)) return "turns about an axis of no length; give a direction";
  if (step.repeat < 1) return "is done less than once; repeat it 1 time or more, or leave it out";
  return "";
}

}  // namespace

Affine3 motion(const SweepStep& step) { return multiplied(step, 1.0); }

base::Result<void> check_steps(std::span<const SweepStep> steps) {
  if (steps.empty()) return base::fail("there is no step to extrude by; give at least one");
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (const std::string fault = fault_of(steps[i]); !fault.empty())
      return base::fail(fmt::format("step {} {}", i + 1, fault));
  return {};
}

bool SweepWalk::next() {
  if (steps_.empty() || at_end()) return false;
  if (repeat_ == steps_[step_].repeat) {
    ++step_;
    repeat_ = 0;
    place_before_ = place_;
  }
  ++repeat_;
  const SweepStep& step = steps_[step_];
  place_ = is_screw(step) ? multiplied(step, repeat_) * place_before_ : motion(step) * place_;
  return true;
}

base::Result<std::vector<Affine3>> repeated_copies(const Affine3& step, const Vector3& pivot,
                                                   std::size_t count) {
  if (!step.matrix().allFinite() || !pivot.allFinite())
    return base::fail("the place of the first copy has a number that is not finite; place it again");
  if (count > kMaximumCopies)
    return base::fail(fmt::format("{} copies are too many; ask for {} at most", count, kMaximumCopies));
  const Matrix3 shape = step.linear();
  const double thickness = shape.col(0).norm() * shape.col(1).norm() * shape.col(2).norm();
  if (!(std::abs(shape.determinant()) > kSweepTolerance * thickness))
    return base::fail("the first copy is flattened; give it some thickness along every axis");
  if (step.matrix() == Affine3::Identity().matrix())
    return base::fail("the first copy lies where the object is; move it to where it belongs");
  std::vector<Affine3> places;
  places.reserve(count);
  Affine3 power = Affine3::Identity();
  for (std::size_t i = 0; i < count; ++i) {
    power = step * power;
    places.push_back(about_point(pivot, power));
    if (!places.back().matrix().allFinite())
      return base::fail(fmt::format("copy {} would lie beyond all numbers; ask for fewer", i + 1));
  }
  return places;
}

}  // namespace icome::geometry
