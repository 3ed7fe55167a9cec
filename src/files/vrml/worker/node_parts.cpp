#include "files/vrml/worker/node_parts.h"

#include <Inventor/SbRotation.h>
#include <Inventor/VRMLnodes/SoVRMLDirectionalLight.h>
#include <Inventor/VRMLnodes/SoVRMLPointLight.h>
#include <Inventor/VRMLnodes/SoVRMLSpotLight.h>
#include <Inventor/VRMLnodes/SoVRMLTransform.h>
#include <Inventor/VRMLnodes/SoVRMLViewpoint.h>

#include <algorithm>
#include <cmath>

#include "base/vector.h"
#include "files/vrml/worker/field_values.h"

namespace icome::files {
namespace {

struct AxisAngle {
  std::array<double, 3> axis = {0.0, 0.0, 1.0};
  double angle = 0.0;
};

/// Does the turn give Coin's rotation exactly?
bool is_kept(const AxisAngle& turn, const SbRotation& rotation) {
  const SbVec3f axis(static_cast<float>(turn.axis[0]), static_cast<float>(turn.axis[1]),
                     static_cast<float>(turn.axis[2]));
  return axis.length() > 0.0F && SbRotation(axis, static_cast<float>(turn.angle)) == rotation;
}

/// Coin keeps a rotation as a quaternion in single precision. The numbers of the file are the roundest that
/// give this one, or a multiple of 15 degrees, which is then meant whatever digits of it the file has;
/// without such numbers, the file had too many digits to be kept.
AxisAngle axis_angle(const SbRotation& rotation) {
  const float* const kept = rotation.getValue();
  // Not by the cosine, as Coin does it, which hardly distinguishes small angles.
  const base::Vector3 sine(kept[0], kept[1], kept[2]);
  const double length = sine.norm();
  if (!(length > 0.0)) return {};
  const base::Vector3 axis = sine / length;
  const double angle = 2.0 * std::atan2(length, kept[3]);
  constexpr double kStep = M_PI / 12.0;
  const double step = std::round(angle / kStep) * kStep;
  const auto round_to = [](double number, double unit) { return std::round(number * unit) / unit; };
  for (double unit = 10.0; unit < 1e8; unit *= 10.0) {
    // The length of the axis in the file may differ from one by the decimals that it lacks.
    for (const double off : {0.0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1.0, -1.0}) {
      const base::Vector3 scaled = axis * (1.0 + off / unit);
      AxisAngle round = {{round_to(scaled[0], unit), round_to(scaled[1], unit), round_to(scaled[2], unit)},
                         round_to(angle, unit)};
      if (is_kept(round, rotation)) return round;
      round.angle = step;
      if (is_kept(round, rotation)) return round;
    }
  }
  return {{axis[0], axis[1], axis[2]}, angle};
}

base::Vector3 vector(const SbVec3f& v) { return base::Vector3(as_written(v).data()); }

base::Quaternion quaternion(const AxisAngle& turn) {
  const base::Vector3 axis(turn.axis.data());
  if (turn.angle == 0.0 || axis.isZero(0.0)) return base::Quaternion::Identity();
  return base::Quaternion(Eigen::AngleAxisd(turn.angle, axis.stableNormalized()));
}

base::Matrix3 rotation(const SoSFRotation& field) {
  const AxisAngle turn = axis_angle(field.getValue());
  const base::Vector3 axis(turn.axis.data());
  if (turn.angle == 0.0 || axis.isZero(0.0)) return base::Matrix3::Identity();
  return Eigen::AngleAxisd(turn.angle, axis.stableNormalized()).toRotationMatrix();
}

void fill_light(const SoVRMLLight& node, LightParts& light) {
  light.on = node.on.getValue();
  light.colour = as_array(node.color.getValue());
  light.intensity = node.intensity.getValue();
  light.ambient = node.ambientIntensity.getValue();
}

}  // namespace

std::array<double, 12> matrix_of(const SoVRMLTransform& transform) {
  const base::Vector3 scale = vector(transform.scale.getValue());
  base::Matrix3 linear = rotation(transform.rotation);
  if (scale.isOnes(0.0)) {
    // Its orientation has no effect.
  } else if (scale.x() == scale.y() && scale.y() == scale.z()) {
    linear *= scale.x();
  } else {
    const base::Matrix3 along = rotation(transform.scaleOrientation);
    linear = linear * along * scale.asDiagonal() * along.transpose();
  }
  base::Vector3 moved = vector(transform.translation.getValue());
  const base::Vector3 centre = vector(transform.center.getValue());
  if (!linear.isIdentity(0.0)) moved += centre - linear * centre;
  std::array<double, 12> rows{};
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(rows.data());
  matrix << linear, moved;
  if (!matrix.allFinite()) matrix.setIdentity();
  return rows;
}

std::array<double, 17> rest_of(const SoVRMLTransform& transform) {
  std::array<double, 17> rest{};
  auto* end = rest.begin();
  const auto put = [&end](const auto& numbers) { end = std::copy(numbers.begin(), numbers.end(), end); };
  put(as_written(transform.translation.getValue()));
  put(turn_as_written(transform.rotation.getValue()));
  put(as_written(transform.scale.getValue()));
  put(as_written(transform.center.getValue()));
  put(turn_as_written(transform.scaleOrientation.getValue()));
  return rest;
}

std::array<double, 4> turn_as_written(const SbRotation& turn) {
  const base::Quaternion written = quaternion(axis_angle(turn));
  return {written.x(), written.y(), written.z(), written.w()};
}

bool fill_light_or_viewpoint(const SoNode& node, NodeParts& parts) {
  if (node.isOfType(SoVRMLViewpoint::getClassTypeId())) {
    const auto& view = static_cast<const SoVRMLViewpoint&>(node);
    const AxisAngle turn = axis_angle(view.orientation.getValue());
    parts.viewpoint = ViewpointParts{as_written(view.fieldOfView.getValue()), ViewpointParts().position,
                                     turn.axis, turn.angle};
    // Coin's own default is the origin, against the standard.
    if (!view.position.isDefault()) parts.viewpoint->position = as_written(view.position.getValue());
    // The text that viewers show in their menus.
    if (view.description.getValue().getLength() > 0) parts.name = view.description.getValue().getString();
    return true;
  }
  if (!node.isOfType(SoVRMLLight::getClassTypeId())) return false;
  LightParts& light = parts.light.emplace();
  fill_light(static_cast<const SoVRMLLight&>(node), light);
  if (node.isOfType(SoVRMLDirectionalLight::getClassTypeId())) {
    light.direction = as_written(static_cast<const SoVRMLDirectionalLight&>(node).direction.getValue());
  } else if (node.isOfType(SoVRMLPointLight::getClassTypeId())) {
    const auto& from = static_cast<const SoVRMLPointLight&>(node);
    light.kind = LightParts::Kind::Point;
    light.location = as_written(from.location.getValue());
    light.attenuation = as_written(from.attenuation.getValue());
    light.radius = as_written(from.radius.getValue());
  } else {
    const auto& from = static_cast<const SoVRMLSpotLight&>(node);
    light.kind = LightParts::Kind::Spot;
    light.location = as_written(from.location.getValue());
    light.direction = as_written(from.direction.getValue());
    light.attenuation = as_written(from.attenuation.getValue());
    light.radius = as_written(from.radius.getValue());
    light.cut_off_angle = as_written(from.cutOffAngle.getValue());
    light.beam_width = as_written(from.beamWidth.getValue());
  }
  return true;
}

}  // namespace icome::files
