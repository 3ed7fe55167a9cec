#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "files/byte_order.h"
#include "files/mesh_formats.h"

namespace icome::files {
namespace {

using geometry::TriangleMesh;
using geometry::Vector3;
using nlohmann::json;

/// The nodes of a small file may show one mesh again and again: this bounds what they can ask for.
constexpr std::size_t kMaximumTriangles = 50'000'000;

/// Thrown in this file only, as the JSON library throws too; parse_glb() catches both.
struct Malformed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The codes that glTF 2.0 took over from OpenGL.
enum ComponentType { Int8 = 5120, UInt8 = 5121, Int16 = 5122, UInt16 = 5123, UInt32 = 5125, Float = 5126 };
enum PrimitiveMode { Triangles = 4, Strip = 5, Fan = 6 };

/// A whole number of the object, at most `limit`; `otherwise` where there is none.
std::uint64_t whole(const json& object, const char* key, std::uint64_t limit,
                    std::optional<std::uint64_t> otherwise = {}) {
  const auto found = object.find(key);
  if (found == object.end() && otherwise) return *otherwise;
  if (found == object.end()) throw Malformed(fmt::format("'{}' is missing", key));
  if (!found->is_number_unsigned() || found->get<std::uint64_t>() > limit)
    throw Malformed(fmt::format("'{}' is out of range", key));
  return found->get<std::uint64_t>();
}

/// The member of the root's array that `object[key]` refers to.
const json& referred(const json& root, const char* array, const json& object, const char* key) {
  const json& members = root.at(array);
  if (members.empty()) throw Malformed(fmt::format("there are no {}", array));
  return members.at(whole(object, key, members.size() - 1));
}

/// The two parts of the file.
struct Chunks {
  std::string_view json;
  std::string_view binary;
};

Chunks split(std::string_view bytes) {
  constexpr std::size_t kHeader = 12;
  Chunks chunks;
  const auto word = [&](std::size_t at) {
    return load<std::uint32_t>(bytes.data() + at, ByteOrder::LittleEndian);
  };
  if (bytes.size() < kHeader + 8) throw Malformed("it is cut short");
  if (word(4) != 2) throw Malformed(fmt::format("it is of version {}; only 2 can be read", word(4)));
  for (std::size_t at = kHeader; bytes.size() - at >= 8;) {
    const std::size_t length = word(at);
    const std::string_view type = bytes.substr(at + 4, 4);
    at += 8;
    if (length > bytes.size() - at) throw Malformed("it is cut short");
    if (type == "JSON") chunks.json = bytes.substr(at, length);
    if (type == std::string_view("BIN\0", 4)) chunks.binary = bytes.substr(at, length);
    at += length;
  }
  return chunks;
}

/// Evenly spaced numbers within the binary chunk, checked to lie in it.
class Accessor {
 public:
  Accessor(const json& root, const json& accessor, std::string_view binary, std::size_t components)
      : components_(components) {
    if (accessor.contains("sparse")) throw Malformed("it has sparse accessors, which are not supported");
    const json& view = referred(root, "bufferViews", accessor, "bufferView");
    const json& buffer = referred(root, "buffers", view, "buffer");
    if (buffer.contains("uri")) throw Malformed("it keeps its data in another file");
    const std::size_t view_begin = whole(view, "byteOffset", binary.size(), 0);
    const std::size_t view_size = whole(view, "byteLength", binary.size() - view_begin);
    const std::size_t begin = whole(accessor, "byteOffset", view_size, 0);
    type_ = whole(accessor, "componentType", Float);
    normalized_ = accessor.value("normalized", false);
    count_ = whole(accessor, "count", view_size);
    const std::size_t size = components * component_size();
    stride_ = whole(view, "byteStride", binary.size(), size);
    if (count_ > 0 && begin + (count_ - 1) * stride_ + size > view_size)
      throw Malformed("an accessor reaches beyond its data");
    data_ = binary.data() + view_begin + begin;
  }

  std::size_t count() const { return count_; }
  bool is_float() const { return type_ == Float; }

  double number(std::size_t element, std::size_t component) const {
    const char* const at = data_ + element * stride_ + component * component_size();
    constexpr ByteOrder kOrder = ByteOrder::LittleEndian;
    switch (type_) {
      case Int8:
        return scaled(load<std::int8_t>(at, kOrder), 127.0);
      case UInt8:
        return scaled(load<std::uint8_t>(at, kOrder), 255.0);
      case Int16:
        return scaled(load<std::int16_t>(at, kOrder), 32767.0);
      case UInt16:
        return scaled(load<std::uint16_t>(at, kOrder), 65535.0);
      case UInt32:
        return load<std::uint32_t>(at, kOrder);
      default:
        return load<float>(at, kOrder);
    }
  }

 private:
  double scaled(double value, double largest) const {
    return normalized_ ? std::max(value / largest, -1.0) : value;
  }

  std::size_t component_size() const {
    switch (type_) {
      case Int8:
      case UInt8:
        return 1;
      case Int16:
      case UInt16:
        return 2;
      case UInt32:
      case Float:
        return 4;
      default:
        throw Malformed(fmt::format("{} is not a component type", type_));
    }
  }

  std::size_t components_;
  std::uint64_t type_ = 0;
  bool normalized_ = false;
  std::size_t count_ = 0;
  std::size_t stride_ = 0;
  const char* data_ = nullptr;
};

/// The node's transform into its parent's frame: a matrix, or scale, then rotation, then translation.
Eigen::Affine3d parent_from(const json& node) {
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  if (const auto matrix = node.find("matrix"); matrix != node.end()) {
    for (int i = 0; i < 16; ++i) transform.matrix()(i % 4, i / 4) = matrix->at(i).get<double>();
    return transform;
  }
  const auto vector = [&](const char* key, const std::vector<double>& otherwise) {
    std::vector<double> numbers = node.value(key, otherwise);
    if (numbers.size() != otherwise.size()) throw Malformed(fmt::format("'{}' has the wrong length", key));
    return numbers;
  };
  const std::vector<double> t = vector("translation", {0, 0, 0});
  const std::vector<double> r = vector("rotation", {0, 0, 0, 1});
  const std::vector<double> s = vector("scale", {1, 1, 1});
  transform.translate(Vector3(t[0], t[1], t[2]));
  transform.rotate(Eigen::Quaterniond(r[3], r[0], r[1], r[2]));
  transform.scale(Vector3(s[0], s[1], s[2]));
  return transform;
}

class GlbReading {
 public:
  explicit GlbReading(std::string_view bytes) : chunks_(split(bytes)), root_(json::parse(chunks_.json)) {
    for (const json& extension : root_.value("extensionsRequired", json::array()))
      if (extension.get<std::string>().find("compression") != std::string::npos)
        throw Malformed(fmt::format("it needs {}, which is not supported", extension.get<std::string>()));
  }

  TriangleMesh run() {
    const json& nodes = root_.at("nodes");
    std::vector<bool> seen(nodes.size(), false);
    struct Visit {
      std::uint64_t node;
      Eigen::Affine3d scene_from_parent;
    };
    std::vector<Visit> open;
    const auto enter = [&](const json& list, const Eigen::Affine3d& scene_from_parent) {
      for (const json& index : list) {
        // A node belongs to one parent: this also ends every circle.
        if (!index.is_number_unsigned() || index.get<std::uint64_t>() >= nodes.size() ||
            seen[index.get<std::uint64_t>()])
          throw Malformed("its nodes do not form a tree");
        seen[index.get<std::uint64_t>()] = true;
        open.push_back({index.get<std::uint64_t>(), scene_from_parent});
      }
    };
    enter(first_nodes(), Eigen::Affine3d::Identity());
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const json& node = nodes.at(visit.node);
      const Eigen::Affine3d scene_from_node = visit.scene_from_parent * parent_from(node);
      if (node.contains("mesh")) add_mesh(referred(root_, "meshes", node, "mesh"), scene_from_node);
      enter(node.value("children", json::array()), scene_from_node);
    }
    return std::move(mesh_);
  }

  std::vector<std::string> notes() const {
    if (others_ == 0) return {};
    return {fmt::format("{} of points or lines left out",
                        others_ == 1 ? "1 primitive" : fmt::format("{} primitives", others_))};
  }

 private:
  /// The nodes of the scene to show, which is the first unless the file says otherwise.
  json first_nodes() const {
    const json& scenes = root_.at("scenes");
    if (scenes.empty()) throw Malformed("it has no scene");
    return scenes.at(whole(root_, "scene", scenes.size() - 1, 0)).value("nodes", json::array());
  }

  void add_mesh(const json& mesh, const Eigen::Affine3d& scene_from_mesh) {
    for (const json& primitive : mesh.at("primitives")) {
      const std::uint64_t mode = whole(primitive, "mode", Fan, Triangles);
      if (mode < Triangles || !primitive.at("attributes").contains("POSITION"))
        ++others_;
      else
        add_primitive(primitive, mode, scene_from_mesh);
    }
  }

  void add_primitive(const json& primitive, std::uint64_t mode, const Eigen::Affine3d& scene_from_mesh) {
    const json& attributes = primitive.at("attributes");
    const Accessor positions(root_, referred(root_, "accessors", attributes, "POSITION"), chunks_.binary, 3);
    const auto first = static_cast<std::uint32_t>(mesh_.positions.size());
    std::vector<std::uint32_t> corners = read_corners(primitive, positions.count());
    if (mesh_.triangles.size() + corners.size() > kMaximumTriangles ||
        mesh_.positions.size() + positions.count() > 3 * kMaximumTriangles)
      throw Malformed(fmt::format("its nodes ask for more than {} triangles", kMaximumTriangles));
    for (std::size_t v = 0; v < positions.count(); ++v)
      mesh_.positions.push_back(
          scene_from_mesh * Vector3(positions.number(v, 0), positions.number(v, 1), positions.number(v, 2)));
    const bool mirrored = scene_from_mesh.linear().determinant() < 0.0;
    const std::size_t step = mode == Triangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < corners.size(); i += step) {
      TriangleMesh::Triangle triangle{corners[mode == Fan ? 0 : i], corners[i + 1], corners[i + 2]};
      // In a strip every second triangle runs the other way round.
      if ((mode == Strip && i % 2 == 1) != mirrored) std::swap(triangle[1], triangle[2]);
      for (std::uint32_t& corner : triangle) corner += first;
      mesh_.triangles.push_back(triangle);
    }
  }

  /// The indices of the primitive; without any, all its positions in their order.
  std::vector<std::uint32_t> read_corners(const json& primitive, std::size_t positions) const {
    std::vector<std::uint32_t> corners;
    if (!primitive.contains("indices")) {
      for (std::uint32_t v = 0; v < positions; ++v) corners.push_back(v);
      return corners;
    }
    const Accessor indices(root_, referred(root_, "accessors", primitive, "indices"), chunks_.binary, 1);
    if (indices.is_float()) throw Malformed("its indices are not whole numbers");
    corners.reserve(indices.count());
    for (std::size_t i = 0; i < indices.count(); ++i) {
      const double index = indices.number(i, 0);
      if (!(index >= 0.0 && index < static_cast<double>(positions)))
        throw Malformed(
            fmt::format("face refers to vertex {}; the {} vertices are numbered from 0", index, positions));
      corners.push_back(static_cast<std::uint32_t>(index));
    }
    return corners;
  }

  Chunks chunks_;
  json root_;
  TriangleMesh mesh_;
  std::size_t others_ = 0;
};

}  // namespace

base::Result<ParsedMesh> parse_glb(std::string_view bytes, const std::string& name) {
  if (!bytes.starts_with("glTF"))
    return base::fail(name + ": does not begin with 'glTF', so it is not a GLB file");
  try {
    GlbReading reading(bytes);
    TriangleMesh mesh = reading.run();
    return ParsedMesh{std::move(mesh), "GLB", reading.notes()};
  } catch (const Malformed& problem) {
    return base::fail(fmt::format("{}: is not a GLB file that can be read: {}", name, problem.what()));
  } catch (const json::exception&) {
    return base::fail(name +
                      ": is not a GLB file that can be read: its JSON does not describe a glTF 2.0 model");
  }
}

}  // namespace icome::files
