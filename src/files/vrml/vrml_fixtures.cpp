#include "files/vrml/vrml_fixtures.h"

#include <flatbuffers/flatbuffers.h>
#include <vrml_answer_generated.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/decompositions.h"

namespace icome::files {
namespace {

using base::Vector3;

/// `value` where it lies in [low, high], else the nearer end, or `otherwise` where it is no number.
template <typename Number>
Number within(Number value, Number low, Number high, Number otherwise) {
  return std::isnan(value) ? otherwise : std::clamp(value, low, high);
}

float part_of_one(float value, float otherwise) { return within(value, 0.0F, 1.0F, otherwise); }

/// `otherwise` where it is missing or not finite.
Vector3 vector_of(const flat::Vec3* from, const Vector3& otherwise) {
  const Vector3 result = from ? Vector3(from->x(), from->y(), from->z()) : otherwise;
  return result.allFinite() ? result : otherwise;
}

}  // namespace

base::Matrix3 facing(const Vector3& direction) {
  const double length = direction.stableNorm();
  if (!(length > 0.0) || !std::isfinite(length)) return base::Matrix3::Identity();
  const Vector3 to = direction / length;
  if (to == -Vector3::UnitZ()) return base::Matrix3::Identity();
  if (to == Vector3::UnitZ()) return Eigen::AngleAxisd(std::numbers::pi, Vector3::UnitY()).toRotationMatrix();
  return base::rotation_between(-Vector3::UnitZ(), to).toRotationMatrix();
}

PlacedFixture fixture_of(const flat::Light& from) {
  world::Light light;
  PlacedFixture result;
  if (from.kind() == flat::LightKind::Point) light.kind = world::Light::Kind::Point;
  if (from.kind() == flat::LightKind::Spot) light.kind = world::Light::Kind::Spot;
  light.scoped = light.kind == world::Light::Kind::Directional;
  light.on = from.on();
  if (const flat::Rgb* colour = from.colour())
    light.colour = {part_of_one(colour->r(), 1.0F), part_of_one(colour->g(), 1.0F),
                    part_of_one(colour->b(), 1.0F)};
  light.intensity = part_of_one(from.intensity(), 1.0F);
  light.ambient = part_of_one(from.ambient(), 0.0F);
  if (light.kind != world::Light::Kind::Directional) {
    const Vector3 attenuation = vector_of(from.attenuation(), Vector3::UnitX()).cwiseMax(0.0).cwiseMin(1e30);
    light.attenuation = {float(attenuation.x()), float(attenuation.y()), float(attenuation.z())};
    light.radius = within(from.radius(), 0.0, 1e30, light.radius);
    result.parent_from_fixture.translation() = vector_of(from.location(), Vector3::Zero());
  }
  if (light.kind == world::Light::Kind::Spot) {
    constexpr double kRightAngle = 0.5 * std::numbers::pi;
    light.cut_off_angle = within(from.cut_off_angle(), 0.0, kRightAngle, light.cut_off_angle);
    light.beam_width = within(from.beam_width(), 0.0, kRightAngle, light.beam_width);
  }
  if (light.kind != world::Light::Kind::Point)
    result.parent_from_fixture.linear() = facing(vector_of(from.direction(), -Vector3::UnitZ()));
  result.fixture = std::make_shared<const world::Fixture>(light);
  return result;
}

PlacedFixture fixture_of(const flat::Viewpoint& from) {
  PlacedFixture result;
  world::Viewpoint viewpoint;
  const double field = from.field_of_view();
  if (field > 0.0 && field < std::numbers::pi) viewpoint.field_of_view = field;
  const Vector3 axis = vector_of(from.axis(), Vector3::UnitZ());
  const double length = axis.stableNorm();
  if (std::isfinite(from.angle()) && length > 0.0 && std::isfinite(length))
    result.parent_from_fixture.linear() = Eigen::AngleAxisd(from.angle(), axis / length).toRotationMatrix();
  result.parent_from_fixture.translation() = vector_of(from.position(), Vector3::Zero());
  result.fixture = std::make_shared<const world::Fixture>(viewpoint);
  return result;
}

}  // namespace icome::files
