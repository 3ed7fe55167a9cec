#pragma once
#include <filesystem>
#include <string>

namespace icome::io {

/// The type of a file, as its name gives it.
struct FileEnding {
  std::string type;     // in small letters: ".obj", also of "part.OBJ.xz"; empty where there is none
  bool packed = false;  // by xz
};

FileEnding ending_of(const std::filesystem::path& path);

/// The name without folders and endings: "part" of "models/part.obj.xz".
std::string bare_name(const std::filesystem::path& path);

}  // namespace icome::io
