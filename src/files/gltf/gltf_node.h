#pragma once
#include <optional>

#include "world/motion.h"
#include "world/world.h"

namespace tinygltf {
class Node;
struct Light;
struct Camera;
}  // namespace tinygltf

namespace icome::files {

/// The extension that contains the lights of glTF files.
inline constexpr const char* kGltfLights = "KHR_lights_punctual";

/// A node's matrix, or its scale, then rotation, then translation. Throws GltfError where the count of
/// their numbers is wrong; the frame may be any otherwise.
base::Affine3 parent_from_node(const tinygltf::Node& node);

/// The place of a node without a matrix, part by part. Throws likewise.
world::PlaceParts parts_of_place(const tinygltf::Node& node);

/// A light in the terms of VRML 2.0: an intensity of one stands for one lux or candela.
world::Light light_of(const tinygltf::Light& light);

/// The field of view of a perspective camera, rad; none for others.
std::optional<double> field_of_view(const tinygltf::Camera& camera);

}  // namespace icome::files
