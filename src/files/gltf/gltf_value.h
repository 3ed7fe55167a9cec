#pragma once
#include <array>
#include <optional>
#include <string>

#include "files/shape_text.h"
#include "world/world.h"

namespace tinygltf {
class Value;
}

namespace icome::files {

// The data that ICOME keeps in the `extras` of glTF files under the name "icome": all that glTF cannot
// express. docs/file-formats.md tells about every member. A file may come from anybody: members that do not
// fit are treated as missing.

/// The member "icome" of an object's extras, or a value that has no members.
const tinygltf::Value& icome_extras(const tinygltf::Value& extras);
/// Extras with that member.
tinygltf::Value extras_with(tinygltf::Value icome);

/// A member; where it is missing, a value without members or content.
const tinygltf::Value& member(const tinygltf::Value& object, const std::string& name);
std::optional<double> number_in(const tinygltf::Value& object, const std::string& name);
/// The number of something that is counted from 0, if it is below `count`.
std::optional<int> index_in(const tinygltf::Value& object, const std::string& name, std::size_t count);
std::string text_in(const tinygltf::Value& object, const std::string& name);

tinygltf::Value value_of(const world::Light& light);
std::optional<world::Light> light_of(const tinygltf::Value& value);

/// The additions that a material's glTF form needs.
struct MaterialExtras {
  bool diffuse = false;       // a picture's colours replace it
  bool transparency = false;  // a picture's opacity replaces it
  bool by_picture = false;    // its transparency follows from its picture
  bool frame = false;         // glTF cannot express the stretch of the picture: its places on meshes
                              // are also written as they would be without it
};
/// The properties of the material that its glTF form lacks.
tinygltf::Value value_of(const world::Material& material, const MaterialExtras& more);
/// Sets these properties again.
void complete(world::Material& material, const tinygltf::Value& value);

/// Do the material's meshes have kGltfOwnPlaces, its picture's places without its frame?
bool says_own_places(const tinygltf::Value& value);

tinygltf::Value value_of(const ShapeText& text);
ShapeText shape_text_of(const tinygltf::Value& value);

/// Clamped to [0, 1]; any number is accepted.
float part_of_one(double value);

}  // namespace icome::files
