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

/// Thrown among the sources that read glTF, and caught where a Result leaves them.
struct GltfError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A glTF 2.0 file as tinygltf gives it, after the checks that it does not make itself: nothing of it has
/// been taken at its word yet but that buffers have the bytes that they say.
struct GltfModel {
  std::shared_ptr<const tinygltf::Model> model;
  std::string format;              // "binary glTF 2.0", "glTF 2.0"
  std::vector<std::string> notes;  // sentences on pictures that are not there, and on what lies elsewhere
};

/// `bytes` are of the file at `path`, beside which buffers and pictures are looked for. Throws GltfError.
GltfModel load_gltf(std::string_view bytes, const std::filesystem::path& path,
                    const DesignReadOptions& options, io::MemoryBudget& memory);

}  // namespace icome::files
