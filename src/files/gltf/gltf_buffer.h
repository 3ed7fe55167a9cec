#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tinygltf {
class Model;
}

namespace icome::files {

/// The one buffer of a glTF file that is written; its model outlives it.
class GltfBuffer {
 public:
  explicit GltfBuffer(tinygltf::Model& model);

  /// A part of the buffer, aligned for any number. `target`: its use for OpenGL; 0: none.
  int add_view(const void* data, std::size_t bytes, int target);
  /// An attribute of vertices; positions need bounds.
  int add_accessor(const std::vector<std::array<float, 3>>& rows, bool with_bounds = false);
  int add_accessor(const std::vector<std::array<float, 2>>& rows);
  /// Moments of key frames (with bounds), and the values at these moments.
  int add_times(const std::vector<std::array<float, 1>>& times);
  int add_values(const std::vector<std::array<float, 3>>& ways);
  int add_values(const std::vector<std::array<float, 4>>& turns);
  /// Indices of 16 bits each where these hold them all.
  int add_indices(const std::vector<std::uint32_t>& corners, std::size_t vertices);

  /// The rows of an accessor of two numbers each, as they were added.
  std::vector<std::array<float, 2>> pairs(int accessor) const;

  /// A sentence on why the buffer cannot be written; empty as long as it can.
  const std::string& failure() const { return failure_; }

 private:
  template <std::size_t Size>
  int add_rows(const std::vector<std::array<float, Size>>& rows, bool with_bounds, int target);

  tinygltf::Model& model_;
  std::string failure_;
};

}  // namespace icome::files
