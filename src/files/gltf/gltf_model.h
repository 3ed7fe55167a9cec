#pragma once
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "files/design.h"
#include "io/memory_budget.h"

namespace tinygltf {
class Model;
}

namespace icome::files {

/// Thrown within the sources that read glTF, and caught where a Result leaves them.
struct GltfError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A glTF 2.0 file as read by tinygltf, after the checks that it does not make itself: nothing in it is
/// trusted yet, except that buffers have the bytes that they claim.
struct GltfModel {
  std::shared_ptr<const tinygltf::Model> model;
  std::string format;              // "binary glTF 2.0", "glTF 2.0"
  std::vector<std::string> notes;  // sentences on missing pictures, and on files elsewhere
};

/// `bytes` are those of the file at `path`, beside which buffers and pictures are found. Throws GltfError.
GltfModel load_gltf(std::string_view bytes, const std::filesystem::path& path,
                    const DesignReadOptions& options, io::MemoryBudget& memory);

}  // namespace icome::files
