#pragma once
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tinygltf {
class Model;
}

namespace icome::files {

/// The bytes of a buffer view, checked to lie in its buffer. Throws GltfError.
std::string_view view_bytes(const tinygltf::Model& model, int view);

/// The numbers of an accessor of a model, which outlives it; each is checked to lie in its data.
class GltfAccessor {
 public:
  /// Throws GltfError, also unless an element has from `least` to `most` components.
  GltfAccessor(const tinygltf::Model& model, int index, std::size_t least, std::size_t most);

  std::size_t size() const { return count_; }
  std::size_t components() const { return components_; }
  bool is_float() const;
  double number(std::size_t element, std::size_t component) const;
  /// For accessors of whole numbers.
  std::uint32_t whole(std::size_t element) const;

 private:
  /// Numbers as stored in a buffer.
  struct Numbers {
    const char* data = nullptr;  // null: all are zero
    std::size_t stride = 0;
  };
  Numbers numbers_in(const tinygltf::Model& model, int view, std::size_t offset, std::size_t count,
                     std::size_t element_bytes, bool may_have_stride) const;
  void read_sparse(const tinygltf::Model& model, int index);
  const char* element_at(std::size_t element) const;

  std::size_t count_ = 0;
  std::size_t components_ = 0;
  int type_ = 0;
  bool normalised_ = false;
  Numbers dense_;
  Numbers replaced_;                       // in the order of `where_`
  std::vector<std::uint32_t> where_ = {};  // elements that are replaced, ascending
};

}  // namespace icome::files
