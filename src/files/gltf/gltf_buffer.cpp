#include "files/gltf/gltf_buffer.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace icome::files {
namespace {

constexpr std::size_t kMostBytes = 0xf0000000U;  // GLB counts with 32 bits; the JSON needs some of them

}  // namespace

GltfBuffer::GltfBuffer(tinygltf::Model& model) : model_(model) { model_.buffers.resize(1); }

int GltfBuffer::add_view(const void* data, std::size_t bytes, int target) {
  std::vector<unsigned char>& buffer = model_.buffers[0].data;
  buffer.resize((buffer.size() + 3) / 4 * 4);
  if (bytes > kMostBytes - std::min(buffer.size(), kMostBytes)) {
    failure_ = "The design is larger than a glTF file may be (4 GB).";
    return 0;
  }
  tinygltf::BufferView view;
  view.buffer = 0;
  view.byteOffset = buffer.size();
  view.byteLength = bytes;
  view.target = target;
  const auto* const first = static_cast<const unsigned char*>(data);
  buffer.insert(buffer.end(), first, first + bytes);
  model_.bufferViews.push_back(std::move(view));
  return int(model_.bufferViews.size()) - 1;
}

template <std::size_t Size>
int GltfBuffer::add_rows(const std::vector<std::array<float, Size>>& rows, bool with_bounds, int target) {
  tinygltf::Accessor accessor;
  constexpr std::array<int, 4> kTypes = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                                         TINYGLTF_TYPE_VEC4};
  accessor.bufferView = add_view(rows.data(), rows.size() * sizeof(rows[0]), target);
  accessor.componentType = TINYGLTF_COMPONENT_TYPE_FLOAT;
  accessor.type = kTypes[Size - 1];
  accessor.count = rows.size();
  if (with_bounds) {
    accessor.minValues.assign(Size, std::numeric_limits<double>::max());
    accessor.maxValues.assign(Size, std::numeric_limits<double>::lowest());
    for (const auto& row : rows) {
      for (std::size_t i = 0; i < Size; ++i) {
        accessor.minValues[i] = std::min(accessor.minValues[i], double(row[i]));
        accessor.maxValues[i] = std::max(accessor.maxValues[i], double(row[i]));
      }
    }
    const auto finite = [](double it) { return std::isfinite(it); };
    if (!std::all_of(accessor.maxValues.begin(), accessor.maxValues.end(), finite) ||
        !std::all_of(accessor.minValues.begin(), accessor.minValues.end(), finite))
      failure_ = "The design is too large for a glTF file's single precision.";
  }
  model_.accessors.push_back(std::move(accessor));
  return int(model_.accessors.size()) - 1;
}

int GltfBuffer::add_indices(const std::vector<std::uint32_t>& corners, std::size_t vertices) {
  tinygltf::Accessor accessor;
  accessor.type = TINYGLTF_TYPE_SCALAR;
  accessor.count = corners.size();
  if (vertices < 0xffff) {
    const std::vector<std::uint16_t> narrow(corners.begin(), corners.end());
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    accessor.bufferView =
        add_view(narrow.data(), narrow.size() * sizeof(narrow[0]), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  } else {
    accessor.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    accessor.bufferView =
        add_view(corners.data(), corners.size() * sizeof(corners[0]), TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
  }
  model_.accessors.push_back(std::move(accessor));
  return int(model_.accessors.size()) - 1;
}

int GltfBuffer::add_accessor(const std::vector<std::array<float, 3>>& rows, bool with_bounds) {
  return add_rows(rows, with_bounds, TINYGLTF_TARGET_ARRAY_BUFFER);
}

std::vector<std::array<float, 2>> GltfBuffer::pairs(int accessor) const {
  const tinygltf::Accessor& it = model_.accessors[std::size_t(accessor)];
  std::vector<std::array<float, 2>> rows(it.count);
  const std::vector<unsigned char>& buffer = model_.buffers[0].data;
  const std::size_t begin = model_.bufferViews[std::size_t(it.bufferView)].byteOffset;
  // A buffer that grew too large lacks parts.
  if (failure_.empty()) std::memcpy(rows.data(), buffer.data() + begin, rows.size() * sizeof(rows[0]));
  return rows;
}

int GltfBuffer::add_accessor(const std::vector<std::array<float, 2>>& rows) {
  return add_rows(rows, false, TINYGLTF_TARGET_ARRAY_BUFFER);
}

int GltfBuffer::add_times(const std::vector<std::array<float, 1>>& times) { return add_rows(times, true, 0); }

int GltfBuffer::add_values(const std::vector<std::array<float, 3>>& ways) { return add_rows(ways, false, 0); }

int GltfBuffer::add_values(const std::vector<std::array<float, 4>>& turns) {
  return add_rows(turns, false, 0);
}

}  // namespace icome::files
