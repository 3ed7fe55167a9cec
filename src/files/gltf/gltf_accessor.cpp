#include "files/gltf/gltf_accessor.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>

#include "files/gltf/gltf_model.h"
#include "io/byte_order.h"

namespace icome::files {
namespace {

constexpr std::array<char, 64> kZeros{};       // an element of an accessor without data
constexpr std::size_t kMostZeros = 4'000'000;  // such elements: nothing in the file pays for them

std::size_t component_bytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      throw GltfError(fmt::format("{} is not a component type", type));
  }
}

std::size_t component_count(int type) {
  switch (type) {
    case TINYGLTF_TYPE_SCALAR:
      return 1;
    case TINYGLTF_TYPE_VEC2:
      return 2;
    case TINYGLTF_TYPE_VEC3:
      return 3;
    case TINYGLTF_TYPE_VEC4:
      return 4;
    default:
      throw GltfError("an accessor holds matrices where it should not");
  }
}

template <typename Number>
double number_as(const char* at) {
  return io::load<Number>(at, io::ByteOrder::LittleEndian);
}

/// A number as stored; `largest` stands for 1 in normalised numbers.
struct Raw {
  double value;
  double largest;
};

Raw raw_number(const char* at, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return {number_as<std::int8_t>(at), 127.0};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return {number_as<std::uint8_t>(at), 255.0};
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return {number_as<std::int16_t>(at), 32767.0};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return {number_as<std::uint16_t>(at), 65535.0};
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return {number_as<std::uint32_t>(at), 4294967295.0};
    default:
      return {number_as<float>(at), 1.0};
  }
}

}  // namespace

std::string_view view_bytes(const tinygltf::Model& model, int view) {
  if (view < 0 || std::size_t(view) >= model.bufferViews.size())
    throw GltfError("an accessor or a picture refers to a buffer view that is not there");
  const tinygltf::BufferView& it = model.bufferViews[view];
  if (it.buffer < 0 || std::size_t(it.buffer) >= model.buffers.size())
    throw GltfError("a buffer view refers to a buffer that is not there");
  const std::vector<unsigned char>& data = model.buffers[it.buffer].data;
  if (it.byteOffset > data.size() || it.byteLength > data.size() - it.byteOffset)
    throw GltfError("a buffer view reaches beyond its buffer");
  return {reinterpret_cast<const char*>(data.data()) + it.byteOffset, it.byteLength};
}

GltfAccessor::GltfAccessor(const tinygltf::Model& model, int index, std::size_t least, std::size_t most) {
  if (index < 0 || std::size_t(index) >= model.accessors.size())
    throw GltfError("a mesh or an animation refers to an accessor that is not there");
  const tinygltf::Accessor& it = model.accessors[index];
  count_ = it.count;
  components_ = component_count(it.type);
  type_ = it.componentType;
  normalised_ = it.normalized;
  if (components_ < least || components_ > most)
    throw GltfError(fmt::format("an accessor has {} components where {} are needed", components_, least));
  const std::size_t bytes = components_ * component_bytes(type_);
  if (it.bufferView >= 0) {
    dense_ = numbers_in(model, it.bufferView, it.byteOffset, count_, bytes, true);
  } else if (count_ > kMostZeros) {
    throw GltfError("an accessor without data has too many elements");
  }
  if (it.sparse.isSparse) read_sparse(model, index);
}

GltfAccessor::Numbers GltfAccessor::numbers_in(const tinygltf::Model& model, int view, std::size_t offset,
                                               std::size_t count, std::size_t element_bytes,
                                               bool may_have_stride) const {
  const std::string_view bytes = view_bytes(model, view);
  const std::size_t given = may_have_stride ? model.bufferViews[view].byteStride : 0;
  const std::size_t stride = given == 0 ? element_bytes : given;
  const bool inside = offset <= bytes.size() && element_bytes <= bytes.size() - offset &&
                      (count == 0 || count - 1 <= (bytes.size() - offset - element_bytes) / stride);
  if (count > 0 && !inside) throw GltfError("an accessor reaches beyond its data");
  return {count > 0 ? bytes.data() + offset : kZeros.data(), stride};
}

void GltfAccessor::read_sparse(const tinygltf::Model& model, int index) {
  const auto& sparse = model.accessors[index].sparse;
  if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
    throw GltfError("a sparse accessor counts below zero");
  const auto count = std::size_t(sparse.count);
  const int type = sparse.indices.componentType;
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
    throw GltfError("a sparse accessor's indices are not whole numbers");
  const Numbers indices = numbers_in(model, sparse.indices.bufferView, std::size_t(sparse.indices.byteOffset),
                                     count, component_bytes(type), false);
  replaced_ = numbers_in(model, sparse.values.bufferView, std::size_t(sparse.values.byteOffset), count,
                         components_ * component_bytes(type_), false);
  where_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = std::uint32_t(raw_number(indices.data + i * indices.stride, type).value);
    if (at >= count_ || (i > 0 && at <= where_.back()))
      throw GltfError("a sparse accessor's indices are out of range or order");
    where_.push_back(at);
  }
}

bool GltfAccessor::is_float() const { return type_ == TINYGLTF_COMPONENT_TYPE_FLOAT; }

const char* GltfAccessor::element_at(std::size_t element) const {
  if (!where_.empty()) {
    const auto found = std::lower_bound(where_.begin(), where_.end(), element);
    if (found != where_.end() && *found == element)
      return replaced_.data + std::size_t(found - where_.begin()) * replaced_.stride;
  }
  return dense_.data == nullptr ? kZeros.data() : dense_.data + element * dense_.stride;
}

double GltfAccessor::number(std::size_t element, std::size_t component) const {
  const Raw raw = raw_number(element_at(element) + component * component_bytes(type_), type_);
  return normalised_ ? std::max(raw.value / raw.largest, -1.0) : raw.value;
}

std::uint32_t GltfAccessor::whole(std::size_t element) const {
  const double value = raw_number(element_at(element), type_).value;
  return value >= 0.0 ? std::uint32_t(value) : 0xffffffffU;
}

}  // namespace icome::files
