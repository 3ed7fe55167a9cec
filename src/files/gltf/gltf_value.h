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

// What ICOME puts into the `extras` of glTF files under the name "icome": that which glTF has no words for.
// docs/file-formats.md tells about every member. What comes back may be anybody's: whatever does not fit is
// taken for not there.

/// The member "icome" of an object's extras, or a value that has no members.
const tinygltf::Value& icome_extras(const tinygltf::Value& extras);
/// Extras with that member.
tinygltf::Value extras_with(tinygltf::Value icome);

/// A member; one without members or value where there is none.
const tinygltf::Value& member(const tinygltf::Value& object, const std::string& name);
std::optional<double> number_in(const tinygltf::Value& object, const std::string& name);
/// Below `count`, of something that is counted from 0.
std::optional<int> index_in(const tinygltf::Value& object, const std::string& name, std::size_t count);
std::string text_in(const tinygltf::Value& object, const std::string& name);

tinygltf::Value value_of(const world::Light& light);
std::optional<world::Light> light_of(const tinygltf::Value& value);

/// Of what the glTF of a material says there is more to it.
struct MaterialExtras {
  bool diffuse = false;       // a picture's colours replace it
  bool transparency = false;  // a picture's opacity replaces it
  bool by_picture = false;    // how it is seen through follows from its picture
  bool frame = false;         // the picture is stretched in a way that glTF cannot say: where it lies on
                              // meshes is told as it would be without, too
};
/// What the glTF of a material does not say of it.
tinygltf::Value value_of(const world::Material& material, const MaterialExtras& more);
/// Puts that back.
void complete(world::Material& material, const tinygltf::Value& value);

/// Do meshes of the material say in kGltfOwnPlaces, too, where its picture lies?
bool says_own_places(const tinygltf::Value& value);

tinygltf::Value value_of(const ShapeText& text);
ShapeText shape_text_of(const tinygltf::Value& value);

/// In [0, 1], whatever it was.
float part_of_one(double value);

}  // namespace icome::files
