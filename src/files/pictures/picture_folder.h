#pragma once
#include <filesystem>
#include <string>
#include <unordered_map>

#include "base/result.h"
#include "world/world.h"

namespace icome::files {

/// The folder beside a design where its pictures are put, as the files that they came as:
/// "table_textures" for "table.wrl". Made when the first picture comes. A file that is there is never
/// changed: the same picture is used again, another gets another name.
class PictureFolder {
 public:
  explicit PictureFolder(const std::filesystem::path& design);

  /// Writes the picture and gives its url as seen from the design: "table_textures/wood.png". Fails, naming
  /// the file, when it cannot be written.
  base::Result<std::string> add(const world::Texture& texture);

 private:
  std::filesystem::path folder_;
  std::string name_;  // in urls
};

}  // namespace icome::files
