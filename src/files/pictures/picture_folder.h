#pragma once
#include <filesystem>
#include <string>
#include <unordered_map>

#include "base/result.h"
#include "world/world.h"

namespace icome::files {

/// The folder beside a design where its pictures are put, in their original format: "table_textures"
/// for "table.wrl". Made with the first picture. An existing file is never changed: an equal picture
/// is used again, another gets another name.
class PictureFolder {
 public:
  explicit PictureFolder(const std::filesystem::path& design);

  /// Writes the picture and gives its url relative to the design: "table_textures/wood.png". Fails, naming
  /// the file, when it cannot be written.
  base::Result<std::string> add(const world::Texture& texture);

 private:
  std::filesystem::path folder_;
  std::string name_;  // in urls
};

}  // namespace icome::files
