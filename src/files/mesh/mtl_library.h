#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "files/pictures/shown_pictures.h"
#include "world/world.h"

namespace icome::files {

/// A material of an OBJ file's library, with the picture that it names.
struct MtlMaterial {
  world::Material material;  // without its texture
  std::string picture;       // a url, empty for none
  std::array<bool, 2> repeats = {true, true};
  int line = 0;  // of its name
};

/// Reads an MTL text, which may be anything: unknown lines are left out. `notes`: sentences on what is
/// left out of pictures.
std::vector<MtlMaterial> parse_mtl(std::string_view text, std::vector<std::string>& notes);

/// The material as an MTL paragraph; `shown`: the factors of its picture; `picture`: its url, empty for
/// none.
std::string mtl_text(const world::Material& material, const ShownMaterial& shown, const std::string& name,
                     const std::string& picture, std::array<bool, 2> repeats);

}  // namespace icome::files
