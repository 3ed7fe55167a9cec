#include "files/gltf/gltf_node.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/srgb.h"
#include "files/gltf/gltf_model.h"
#include "files/gltf/gltf_value.h"

namespace icome::files {
namespace {

using base::Affine3;

std::array<double, 3> three_of(const std::vector<double>& numbers, double otherwise) {
  if (numbers.empty()) return {otherwise, otherwise, otherwise};
  if (numbers.size() != 3) throw GltfError("a node's scale or translation has the wrong length");
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

Affine3 parent_from_node(const tinygltf::Node& node) {
  Affine3 frame = Affine3::Identity();
  if (!node.matrix.empty()) {
    if (node.matrix.size() != 16) throw GltfError("a node's matrix has the wrong length");
    // Column after column; the last row of an affine matrix has no information.
    frame.matrix().topRows<3>() = Eigen::Map<const Eigen::Matrix4d>(node.matrix.data()).topRows<3>();
    return frame;
  }
  const world::PlaceParts parts = parts_of_place(node);
  frame.translate(parts.translation);
  if (!node.rotation.empty()) frame.rotate(parts.rotation);
  frame.scale(parts.scale);
  return frame;
}

world::PlaceParts parts_of_place(const tinygltf::Node& node) {
  world::PlaceParts parts;
  parts.translation = base::Vector3(three_of(node.translation, 0.0).data());
  parts.scale = base::Vector3(three_of(node.scale, 1.0).data());
  if (node.rotation.empty()) return parts;
  if (node.rotation.size() != 4) throw GltfError("a node's rotation has the wrong length");
  parts.rotation = base::Quaternion(node.rotation.data());
  // A quaternion of unit length stays as it is to the last bit.
  constexpr double kRounding = 1e-14;
  if (!(std::abs(parts.rotation.squaredNorm() - 1.0) < kRounding)) parts.rotation.normalize();
  // Four zeros mean no rotation.
  if (parts.rotation.coeffs().isZero(0.0)) parts.rotation.setIdentity();
  return parts;
}

world::Light light_of(const tinygltf::Light& it) {
  world::Light light;
  if (it.type == "point") light.kind = world::Light::Kind::Point;
  if (it.type == "spot") light.kind = world::Light::Kind::Spot;
  if (it.color.size() == 3) light.colour = base::srgb_from_linear({it.color[0], it.color[1], it.color[2]});
  light.intensity = part_of_one(it.intensity);
  light.attenuation = {0.0F, 0.0F, 1.0F};
  constexpr double kEndless = 1e9;  // m
  light.radius = it.range > 0.0 ? std::min(it.range, kEndless) : kEndless;
  light.cut_off_angle = std::clamp(it.spot.outerConeAngle, 0.0, 0.5 * std::numbers::pi);
  light.beam_width = std::clamp(it.spot.innerConeAngle, 0.0, light.cut_off_angle);
  return light;
}

std::optional<double> field_of_view(const tinygltf::Camera& camera) {
  const double angle = camera.perspective.yfov;
  const bool usable = camera.type == "perspective" && angle > 0.0 && angle < std::numbers::pi;
  return usable ? std::optional<double>(angle) : std::nullopt;
}

}  // namespace icome::files
