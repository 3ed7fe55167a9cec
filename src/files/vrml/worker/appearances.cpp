#include "files/vrml/worker/appearances.h"

#include <Inventor/VRMLnodes/SoVRMLAppearance.h>
#include <Inventor/VRMLnodes/SoVRMLImageTexture.h>
#include <Inventor/VRMLnodes/SoVRMLMaterial.h>
#include <Inventor/VRMLnodes/SoVRMLPixelTexture.h>
#include <Inventor/VRMLnodes/SoVRMLTextureTransform.h>
#include <Inventor/fields/SoSFString.h>
#include <Inventor/misc/SoProtoInstance.h>

#include <cmath>

#include "base/vector.h"
#include "files/vrml/worker/field_values.h"

namespace icome::files {
namespace {

template <typename Node>
const Node* node_as(const Unwrapped& it) {
  return it.node && it.node->isOfType(Node::getClassTypeId()) ? static_cast<const Node*>(it.node) : nullptr;
}

double number_in(const SoNode& node, const char* name, double missing) {
  const SoField* field = find_field(node, name, "SFFloat");
  return field ? as_written(static_cast<const SoSFFloat*>(field)->getValue()) : missing;
}

std::string string_in(const SoNode& node, const char* name) {
  const SoField* field = find_field(node, name, "SFString");
  return field ? static_cast<const SoSFString*>(field)->getValue().getString() : "";
}

/// Reads the fields that IcomeMaterial has in addition to those of a Material.
void fill_touch(const SoNode& instance, AppearanceParts& parts) {
  if (std::string name = string_in(instance, "name"); !name.empty()) parts.name = std::move(name);
  if (const double stiffness = number_in(instance, "stiffness", -1.0); stiffness >= 0.0)
    parts.stiffness = stiffness;
  if (const double damping = number_in(instance, "damping", -1.0); damping >= 0.0) parts.damping = damping;
  parts.static_friction = number_in(instance, "staticFriction", 0.0);
  parts.dynamic_friction = number_in(instance, "dynamicFriction", 0.0);
  parts.haptic_texture = string_in(instance, "hapticTexture");
}

/// Tc' = -C S R C T Tc (ISO/IEC 14772-1, 6.49), as 3 x 3 numbers; none: identity.
std::vector<double> transform_of(const SoVRMLTextureTransform& node) {
  const auto vector = [](const SbVec2f& v) { return base::Vector2(as_written(v[0]), as_written(v[1])); };
  const base::Vector2 centre = vector(node.center.getValue());
  Eigen::Affine2d all = Eigen::Affine2d::Identity();
  all.translate(-centre);
  all.scale(vector(node.scale.getValue()));
  all.rotate(as_written(node.rotation.getValue()));
  all.translate(centre);
  all.translate(vector(node.translation.getValue()));
  if (!all.matrix().allFinite() || all.matrix().isIdentity(0.0)) return {};
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = all.matrix();
  return {rows.data(), rows.data() + rows.size()};
}

}  // namespace

int Appearances::number_of(const Unwrapped& it) {
  const auto* appearance = node_as<SoVRMLAppearance>(it);
  if (!appearance) return -1;
  const Unwrapped material = wrapping_.unwrap(appearance->material, *it.file);
  const Unwrapped texture = wrapping_.unwrap(appearance->texture, *it.file);
  const Unwrapped transform = wrapping_.unwrap(appearance->textureTransform, *it.file);
  const auto [known, is_new] = appearances_.try_emplace({material.node, texture.node, transform.node}, -1);
  if (!is_new) return known->second;
  AppearanceParts parts;
  parts.name = files_.original_name((it.instance ? it.instance : it.node)->getName());
  fill_material(material, parts);
  parts.picture = picture_number(texture);
  if (const auto* node = node_as<SoVRMLTextureTransform>(transform))
    parts.texture_transform = transform_of(*node);
  known->second = answer_.add(parts);
  return known->second;
}

void Appearances::fill_material(const Unwrapped& it, AppearanceParts& parts) const {
  const auto* material = node_as<SoVRMLMaterial>(it);
  parts.lit = material != nullptr;
  if (!material) return;
  std::string name = files_.original_name((it.instance ? it.instance : it.node)->getName());
  if (!name.empty()) parts.name = std::move(name);
  parts.ambient = material->ambientIntensity.getValue();
  parts.diffuse = as_array(material->diffuseColor.getValue());
  parts.specular = as_array(material->specularColor.getValue());
  parts.emission = as_array(material->emissiveColor.getValue());
  parts.shininess = material->shininess.getValue();
  parts.transparency = material->transparency.getValue();
  if (it.instance && it.instance->getProtoName() == "IcomeMaterial") fill_touch(*it.instance, parts);
}

int Appearances::picture_number(const Unwrapped& it) {
  const auto* texture = node_as<SoVRMLTexture>(it);
  if (!texture) return -1;
  const auto [known, is_new] = pictures_.try_emplace(texture, -1);
  if (!is_new) return known->second;
  PictureParts picture;
  picture.repeat_s = texture->repeatS.getValue();
  picture.repeat_t = texture->repeatT.getValue();
  if (const auto* image = node_as<SoVRMLImageTexture>(it)) {
    picture.urls = files_.strings(image->url);
    picture.base = wrapping_.home(image->url, *it.file).path;
    if (picture.urls.empty()) return -1;
  } else if (const auto* pixels = node_as<SoVRMLPixelTexture>(it)) {
    SbVec2s size;
    int channels = 0;
    const unsigned char* bytes = pixels->image.getValue(size, channels);
    if (!bytes || size[0] <= 0 || size[1] <= 0 || channels <= 0) return -1;
    picture.width = static_cast<std::uint32_t>(size[0]);
    picture.height = static_cast<std::uint32_t>(size[1]);
    picture.channels = static_cast<std::uint32_t>(channels);
    picture.pixels = {bytes, std::size_t{picture.width} * picture.height * picture.channels};
  } else {
    return -1;
  }
  known->second = answer_.add(picture);
  return known->second;
}

}  // namespace icome::files
