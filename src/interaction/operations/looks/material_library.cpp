#include "interaction/operations/looks/material_library.h"

#include <fmt/format.h>

#include <algorithm>

#include "haptics/effects/texture_text.h"

namespace icome::interaction {
namespace {

using world::Material;

// The touch properties. A force-feedback device renders walls of some 500 to 4,000 N/m well, where real ones
// are a thousand times as stiff: the order of the real ones is kept, each step being more than the 23 % that
// people tell apart (Jones and Hunter 1990, the Weber fraction of stiffness). Only skin is as soft as the
// real one, some hundred N/m under a fingertip. Friction is that of a hard, smooth tip on the dry material,
// as tables for engineers have it: rubber 1.0 and 0.8, wood 0.4 and 0.3, metal on metal that is not quite
// clean 0.2 and 0.15, skin about 0.5, ice near its melting point 0.05 and 0.03. Materials that swallow a
// knock's sound, rubber and skin, are damped more than those that ring; a device adds what keeps it stable.

Material wood() {
  return {.name = "wood",
          .diffuse = {0.65F, 0.45F, 0.27F},
          .specular = {0.10F, 0.10F, 0.10F},
          .shininess = 0.1F,
          .touch = {.stiffness = 1000.0,
                    .damping = 2.0,
                    .static_friction = 0.4,
                    .dynamic_friction = 0.3,
                    .texture = "grooves"}};  // its grain runs one way
}

Material rubber() {
  return {.name = "rubber",
          .diffuse = {0.12F, 0.12F, 0.13F},
          .specular = {0.05F, 0.05F, 0.05F},
          .shininess = 0.05F,
          .touch = {.stiffness = 500.0, .damping = 5.0, .static_friction = 1.0, .dynamic_friction = 0.8}};
}

Material ice() {
  return {.name = "ice",
          .diffuse = {0.80F, 0.92F, 0.98F},
          .specular = {0.90F, 0.95F, 1.00F},
          .shininess = 0.7F,
          .transparency = 0.35F,
          .touch = {.stiffness = 1500.0, .damping = 1.0, .static_friction = 0.05, .dynamic_friction = 0.03}};
}

Material skin() {
  return {.name = "skin",
          .diffuse = {0.89F, 0.70F, 0.60F},
          .specular = {0.15F, 0.12F, 0.12F},
          .shininess = 0.15F,
          .touch = {.stiffness = 300.0,
                    .damping = 4.0,
                    .static_friction = 0.6,
                    .dynamic_friction = 0.5,
                    .texture = "grain"}};
}

Material metal() {
  return {.name = "metal",
          .diffuse = {0.60F, 0.61F, 0.64F},
          .specular = {0.90F, 0.90F, 0.92F},
          .shininess = 0.8F,
          .touch = {.stiffness = 3500.0, .damping = 1.0, .static_friction = 0.2, .dynamic_friction = 0.15}};
}

Material glass() {
  return {.name = "glass",
          .diffuse = {0.85F, 0.95F, 0.92F},
          .specular = {1.0F, 1.0F, 1.0F},
          .shininess = 0.95F,
          .transparency = 0.7F,
          .touch = {.stiffness = 2700.0, .damping = 1.0, .static_friction = 0.12, .dynamic_friction = 0.1}};
}

Material stone() {
  return {.name = "stone",
          .diffuse = {0.50F, 0.49F, 0.46F},
          .specular = {0.05F, 0.05F, 0.05F},
          .shininess = 0.05F,
          .touch = {.stiffness = 2000.0,
                    .damping = 1.5,
                    .static_friction = 0.7,
                    .dynamic_friction = 0.6,
                    .texture = "grain"}};
}

}  // namespace

const std::vector<Material>& material_library() {
  static const std::vector<Material> kLibrary{wood(), rubber(), ice(), skin(), metal(), glass(), stone()};
  return kLibrary;
}

const Material* library_material(std::string_view name) {
  const auto found = std::ranges::find(material_library(), name, &Material::name);
  return found == material_library().end() ? nullptr : &*found;
}

const std::vector<std::string>& haptic_texture_names() {
  static const std::vector<std::string> kNames = [] {
    std::vector<std::string> names;
    for (const haptics::TextureKind& kind : haptics::texture_kinds()) names.emplace_back(kind.name);
    return names;
  }();
  return kNames;
}

std::string texture_words(const std::string& text) {
  const auto size = haptics::texture_size(text);
  if (!size) return {};
  return fmt::format("{}, {:g} mm deep every {:g} mm", text.substr(0, text.find(':')), 1e3 * size->depth,
                     1e3 * size->spacing);
}

}  // namespace icome::interaction
