#include "files/gltf/gltf_writer.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>
#include <ostream>
#include <set>
#include <streambuf>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "base/parse_number.h"
#include "base/srgb.h"
#include "base/utf8.h"
#include "files/exact_looks.h"
#include "files/gltf/gltf_animations.h"
#include "files/gltf/gltf_buffer.h"
#include "files/gltf/gltf_looks.h"
#include "files/gltf/gltf_node.h"
#include "files/gltf/gltf_value.h"
#include "files/gltf/gltf_vertices.h"
#include "files/pictures/shown_pictures.h"
#include "files/shown_world.h"
#include "io/file_ending.h"
#include "io/new_file.h"
#include "world/metal.h"
#include "world/shape/picture_kind.h"

namespace icome::files {
namespace {

using tinygltf::Value;
using world::GeometryId;
using world::MaterialId;
using world::ObjectId;
using world::PhysicalObject;
using world::TextureId;
using world::World;

template <typename Named>
std::vector<world::Id<Named>> ids_in_order(const World::Table<Named>& table) {
  std::vector<world::Id<Named>> ids;
  for (const auto& [id, named] : table) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// Linear, as glTF requires, and precise enough to be read back unchanged.
std::vector<double> numbers_of(const world::Colour& colour) {
  std::vector<double> numbers;
  for (const float channel : colour) numbers.push_back(base::linear_from_srgb(double(channel)));
  return numbers;
}

/// Rounded to digits that stay the same when the number is read and derived again.
double settled(double number) {
  return base::parse_number<double>(fmt::format("{:.12g}", number)).value_or(number);
}

/// The fields of KHR_texture_transform; none for a frame that is flat, or stretched after being turned.
std::optional<Value> texture_transform(const world::PictureFrame& frame) {
  const auto [a, b, c, d, e, f] = upside_down(frame);
  const base::Vector2 u(a, d), v(b, e);
  constexpr double kRounding = 1e-9;  // of a cosine
  const double sizes = u.norm() * v.norm();
  if (!(sizes > 0.0) || !std::isfinite(sizes) || std::abs(u.dot(v)) > kRounding * sizes) return {};
  const double turn = std::atan2(-d, a);
  const auto pair = [](double x, double y) {
    return Value(Value::Array{Value(settled(x)), Value(settled(y))});
  };
  Value::Object fields;
  if (c != 0.0 || f != 0.0) fields["offset"] = pair(c, f);
  if (turn != 0.0) fields["rotation"] = Value(settled(turn));
  fields["scale"] = pair(u.norm(), v.dot(base::Vector2(std::sin(turn), std::cos(turn))));
  return Value(std::move(fields));
}

/// Does the frame do more than turn, stretch along its own axes and move, which is all glTF has?
bool has_shear(const base::Affine3& frame) {
  const base::Matrix3 products = frame.linear().transpose() * frame.linear();
  constexpr double kRounding = 1e-6;  // of cosines
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (std::abs(products(i, j)) > kRounding * std::sqrt(products(i, i) * products(j, j))) return true;
  }
  return false;
}

/// Puts a world into the library's model of a glTF file.
class GltfMaking {
 public:
  explicit GltfMaking(const World& world) : world_(world), shown_(world, shown_triangles) {}

  base::Result<tinygltf::Model> run() {
    model_.asset.version = "2.0";
    model_.asset.generator = "ICOME";
    for (const TextureId id : ids_in_order(world_.textures())) add_texture(id);
    for (const MaterialId id : ids_in_order(world_.materials())) add_material(id);
    add_nodes();
    for (const GeometryId id : ids_in_order(world_.geometries())) {
      if (world_.find(id)->users == 0) mesh_of(id, {});
    }
    add_root_extras();
    if (!buffer_.failure().empty()) return base::fail(buffer_.failure());
    if (model_.buffers[0].data.empty()) model_.buffers.clear();
    if (sheared_ > 0)
      remark(fmt::format("{} sheared: some programs cannot show that.",
                         sheared_ == 1 ? "1 object is" : fmt::format("{} objects are", sheared_)),
             false);
    if (grouped_lights_ > 0)
      remark(fmt::format("{} only on the group that {}, in other programs on everything.",
                         grouped_lights_ == 1 ? "1 directional light shines"
                                              : fmt::format("{} directional lights shine", grouped_lights_),
                         grouped_lights_ == 1 ? "it is in" : "they are in"),
             false);
    if (clear_parts_ > 0)
      remark("Parts of solids that their colours make clear are opaque in other programs, as they are here.",
             false);
    for (Remark& it : animations_.remarks()) remarks_.push_back(std::move(it));
    return std::move(model_);
  }

  std::vector<Remark> remarks() { return std::move(remarks_); }

 private:
  void remark(std::string text, bool loses = true) { remarks_.push_back({{}, 0, std::move(text), loses}); }

  void add_texture(TextureId id) {
    const world::Texture& it = *world_.find(id);
    tinygltf::Image image;
    image.name = base::as_utf8(it.name);
    image.mimeType = it.media_type;
    image.bufferView = buffer_.add_view(it.bytes->data(), it.bytes->size(), 0);
    if (it.media_type != "image/png" && it.media_type != "image/jpeg")
      remark(
          fmt::format("The picture \"{}\" is neither PNG nor JPEG: other programs may not show it.", it.name),
          false);
    tinygltf::Sampler sampler;
    sampler.wrapS = it.repeats[0] ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    sampler.wrapT = it.repeats[1] ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    tinygltf::Texture texture;
    texture.source = int(model_.images.size());
    texture.sampler = int(model_.samplers.size());
    textures_[id] = int(model_.textures.size());
    model_.images.push_back(std::move(image));
    model_.samplers.push_back(std::move(sampler));
    model_.textures.push_back(std::move(texture));
  }

  void add_material(MaterialId id) {
    const world::Material& it = *world_.find(id);
    const ShownMaterial shown = shown_material(world_, it);
    tinygltf::Material material;
    material.name = base::as_utf8(it.name);
    material.doubleSided = it.double_sided;
    material.emissiveFactor = numbers_of(it.emission);
    auto& pbr = material.pbrMetallicRoughness;
    const bool rough = it.roughness && shininess_of(double(*it.roughness)) == it.shininess;
    pbr.metallicFactor = double(world::metal_of(it));
    pbr.roughnessFactor = rough ? double(*it.roughness) : roughness_of(it.shininess);
    pbr.baseColorFactor = numbers_of(shown.colour);
    pbr.baseColorFactor.push_back(double(shown.opacity));
    if (shown.mode == world::AlphaMode::Blend) material.alphaMode = "BLEND";
    const bool masked = shown.mode == world::AlphaMode::Mask;
    if (masked) material.alphaMode = "MASK";
    // A surface that is clear everywhere must stay below the cutoff.
    if (masked)
      material.alphaCutoff = shown.opacity > 0.0F ? double(shown.cutoff) * double(shown.opacity) : 0.5;
    if (it.unlit) material.extensions["KHR_materials_unlit"] = Value(Value::Object{});
    if (it.unlit) use("KHR_materials_unlit");
    MaterialExtras more;
    more.transparency = shown.opacity != 1.0F - it.transparency || (masked && it.transparency > 0.0F);
    if (const world::Texture* const texture = world_.find(it.texture)) {
      pbr.baseColorTexture.index = textures_.at(it.texture);
      more.diffuse = !it.tints;
      more.by_picture = it.alpha_mode == world::AlphaMode::ByPicture && world::may_be_clear(*texture->bytes);
      more.frame = !lay_picture(it, pbr.baseColorTexture);
    }
    material.extras = extras_with(value_of(it, more));
    materials_[id] = int(model_.materials.size());
    model_.materials.push_back(std::move(material));
  }

  /// False where glTF cannot express the frame: then meshes get coordinates with it.
  bool lay_picture(const world::Material& material, tinygltf::TextureInfo& info) {
    if (material.picture_frame == world::kPictureAsItLies) return true;
    auto transform = texture_transform(material.picture_frame);
    if (!transform) return false;
    info.extensions["KHR_texture_transform"] = std::move(*transform);
    use("KHR_texture_transform");
    return true;
  }

  void use(const char* extension) {
    auto& used = model_.extensionsUsed;
    if (std::find(used.begin(), used.end(), extension) == used.end()) used.emplace_back(extension);
  }

  /// The material for a mesh. glTF multiplies a mesh's own colours with those of its material, and allows no
  /// texture on a mesh without coordinates: materials with a colour or a texture get variants for these.
  int material_for(MaterialId id, const tinygltf::Primitive& primitive) {
    const int base = materials_.at(id);
    const auto factor = model_.materials[std::size_t(base)].pbrMetallicRoughness.baseColorFactor;
    const bool textured = bool(world_.find(id)->texture);
    const bool needs_white = primitive.attributes.count("COLOR_0") > 0 &&
                             !(factor[0] == 1.0 && factor[1] == 1.0 && factor[2] == 1.0);
    const bool needs_plain = textured && primitive.attributes.count("TEXCOORD_0") == 0;
    if (!needs_white && !needs_plain) return base;
    const auto [found, is_new] =
        variants_.try_emplace({id, needs_white, needs_plain}, int(model_.materials.size()));
    if (!is_new) return found->second;
    tinygltf::Material variant = model_.materials[std::size_t(base)];
    auto& pbr = variant.pbrMetallicRoughness;
    std::vector<double> colour = numbers_of(world_.find(id)->diffuse);
    if (needs_white || primitive.attributes.count("COLOR_0") > 0) colour = {1.0, 1.0, 1.0};
    std::copy(colour.begin(), colour.end(), pbr.baseColorFactor.begin());
    if (needs_plain) pbr.baseColorTexture = tinygltf::TextureInfo();
    Value::Object extras;
    extras["variantOf"] = Value(base);
    variant.extras = extras_with(Value(std::move(extras)));
    model_.materials.push_back(std::move(variant));
    return found->second;
  }

  /// Colours that a picture replaces get a name that other programs ignore. A mesh without texture
  /// coordinates shows no picture, and its colours are seen.
  void hide_colours(const world::Material& material, tinygltf::Primitive& primitive) const {
    const auto colours = primitive.attributes.find("COLOR_0");
    if (colours == primitive.attributes.end() || primitive.attributes.count("TEXCOORD_0") == 0 ||
        !hides_colours(world_, material))
      return;
    primitive.attributes[kGltfHiddenColours] = colours->second;
    primitive.attributes.erase(colours);
  }

  /// Places the picture for other programs, if the material cannot express its frame; the coordinates
  /// without the frame are then kept in the second set, which ICOME reads.
  void lay_on(const world::Material& material, tinygltf::Primitive& primitive) {
    const auto places = primitive.attributes.find("TEXCOORD_0");
    if (places == primitive.attributes.end() || !material.texture ||
        material.picture_frame == world::kPictureAsItLies || texture_transform(material.picture_frame))
      return;
    const auto [found, is_new] = laid_.try_emplace({places->second, material.picture_frame}, 0);
    if (is_new) {
      const world::PictureFrame frame = upside_down(material.picture_frame);
      auto rows = buffer_.pairs(places->second);
      for (std::array<float, 2>& row : rows) {
        const world::Vector2 it = laid(frame, {double(row[0]), double(row[1])});
        row = {float(it.x()), float(it.y())};
      }
      found->second = buffer_.add_accessor(rows);
    }
    primitive.attributes[kGltfOwnPlaces] = places->second;
    places->second = found->second;
  }

  /// Index in the root's extras; -1 for shapes that are all triangles.
  int exact_shape(GeometryId id) {
    const auto [found, is_new] = exact_.try_emplace(id, -1);
    if (!is_new) return found->second;
    auto text = shape_text(*world_.find(id)->shape);
    if (!text) {
      remark("A shape is written as triangles only: " + text.error().message);
    } else if (*text) {
      found->second = int(shapes_.size());
      for (auto& [name, words] : **text) words = base::as_utf8(words);
      shapes_.push_back(value_of(**text));
    }
    return found->second;
  }

  /// The key by which meshes share accessors. Shapes that are triangles alone differ by their ids: each
  /// has its own. Exact shapes that are in memory once have their triangles in the file once.
  using Triangles = std::pair<const world::Geometry*, GeometryId>;
  Triangles triangles_of(GeometryId id) {
    return {world_.find(id)->shape.get(), exact_shape(id) >= 0 ? GeometryId{} : id};
  }

  /// The accessors of a shape, shared by meshes of several materials: those of solids with coloured parts
  /// differ by the material's colour, and those of primitives by whether there is a picture, as they need
  /// texture coordinates then.
  const tinygltf::Primitive* primitive_of(GeometryId id, const world::Material& material) {
    const Triangles triangles = triangles_of(id);
    const world::Geometry& shape = *world_.find(id)->shape;
    const bool shows_picture = bool(material.texture) && shape.kind() == "primitive";
    const world::Colour own = has_part_colours(shape) ? material.diffuse : world::Colour{};
    const auto [found, is_new] = primitives_.try_emplace({triangles, shows_picture, own});
    if (!is_new) return found->second.attributes.empty() ? nullptr : &found->second;
    auto mesh = with_exact_looks(shape, shown_.triangles(id), own);
    if (!mesh || mesh->mesh.triangles.empty()) return nullptr;
    if (shows_picture) mesh = with_picture_places(shape, mesh);
    const GltfVertices vertices = gltf_vertices(*mesh);
    tinygltf::Primitive& primitive = found->second;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = buffer_.add_accessor(vertices.positions, true);
    if (!vertices.normals.empty()) primitive.attributes["NORMAL"] = buffer_.add_accessor(vertices.normals);
    if (!vertices.coordinates.empty())
      primitive.attributes["TEXCOORD_0"] = buffer_.add_accessor(vertices.coordinates);
    if (!vertices.colours.empty()) primitive.attributes["COLOR_0"] = buffer_.add_accessor(vertices.colours);
    primitive.indices = buffer_.add_indices(vertices.corners, vertices.positions.size());
    if (vertices.smooth) smooth_.insert(triangles);
    return &primitive;
  }

  /// The mesh of a shape in a material; -1: there is nothing to show.
  int mesh_of(GeometryId geometry, MaterialId material) {
    const auto [found, is_new] = meshes_.try_emplace({geometry, material}, -1);
    if (!is_new) return found->second;
    const int exact = exact_shape(geometry);
    const world::Material plain;
    const world::Material* const own = world_.find(material);
    const tinygltf::Primitive* const shared = primitive_of(geometry, own ? *own : plain);
    if (shared == nullptr) return -1;
    clear_parts_ += has_clear_parts(*world_.find(geometry)->shape) ? 1 : 0;
    tinygltf::Primitive primitive = *shared;
    if (own) {
      hide_colours(*own, primitive);
      lay_on(*own, primitive);
      primitive.material = material_for(material, primitive);
    }
    tinygltf::Mesh mesh;
    mesh.primitives.push_back(std::move(primitive));
    Value::Object extras;
    if (exact >= 0) extras["shape"] = Value(exact);
    if (smooth_.count(triangles_of(geometry)) > 0) extras["smooth"] = Value(true);
    const std::string_view recipe = world::recipe_of(*world_.find(geometry)->shape);
    if (!recipe.empty()) extras["recipe"] = Value(base::as_utf8(recipe));
    if (!extras.empty()) mesh.extras = extras_with(Value(std::move(extras)));
    found->second = int(model_.meshes.size());
    model_.meshes.push_back(std::move(mesh));
    return found->second;
  }

  void add_nodes() {
    struct Visit {
      ObjectId id;
      int parent;
    };
    std::vector<Visit> open;
    const auto enter = [&](const std::vector<ObjectId>& row, int parent) {
      for (auto id = row.rbegin(); id != row.rend(); ++id) open.push_back({*id, parent});
    };
    tinygltf::Scene scene;
    enter(world_.roots(), -1);
    model_.nodes.reserve(world_.objects().size());
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      const int index = int(model_.nodes.size());
      (visit.parent < 0 ? scene.nodes : model_.nodes[std::size_t(visit.parent)].children).push_back(index);
      nodes_[visit.id] = index;
      const PhysicalObject& object = *world_.find(visit.id);
      model_.nodes.push_back(node_of(object));
      enter(object.children, index);
    }
    if (scene.nodes.empty()) return;  // the library would write an empty scene as null
    model_.scenes.push_back(std::move(scene));
    model_.defaultScene = 0;
  }

  tinygltf::Node node_of(const PhysicalObject& object) {
    tinygltf::Node node;
    node.name = base::as_utf8(object.name);
    const base::Affine3& frame = object.parent_from_object;
    const bool moves = animations_.add(object, int(model_.nodes.size()), node);
    if (!moves && !frame.matrix().isIdentity(0.0)) {
      node.matrix.assign(frame.matrix().data(), frame.matrix().data() + 16);
      sheared_ += has_shear(frame) ? 1 : 0;
    }
    Value::Object extras;
    if (object.geometry) node.mesh = mesh_of(object.geometry, object.material);
    if (node.mesh < 0) {
      const int exact = object.geometry ? exact_shape(object.geometry) : -1;
      if (exact >= 0) extras["shape"] = Value(exact);
      if (object.geometry && exact < 0) remark("A shape without triangles is left out.");
      if (exact >= 0)
        remark(fmt::format("{} is not seen by other programs: {}", object_name(object),
                           shown_.why(object.geometry)));
      if (object.material) extras["material"] = Value(materials_.at(object.material));
    }
    if (object.fixture)
      std::visit([&](const auto& fixture) { add_fixture(fixture, node, extras); }, *object.fixture);
    if (!extras.empty()) node.extras = extras_with(Value(std::move(extras)));
    // The library would write an empty node as null.
    if (node.name.empty() && node.matrix.empty() && !moves) node.translation = {0.0, 0.0, 0.0};
    return node;
  }

  void add_fixture(const world::Light& it, tinygltf::Node& node, Value::Object& extras) {
    extras["light"] = value_of(it);
    if (!it.on) return;
    grouped_lights_ += it.scoped && it.kind == world::Light::Kind::Directional ? 1 : 0;
    constexpr std::array<const char*, 3> kTypes{"directional", "point", "spot"};
    tinygltf::Light light;
    light.type = kTypes.at(std::size_t(it.kind));
    light.color = numbers_of(it.colour);
    light.intensity = it.intensity;
    if (it.kind != world::Light::Kind::Directional) light.range = it.radius;
    constexpr double kWidest = 1.5707963;  // glTF's limit: a right angle; the inner one is less
    light.spot.outerConeAngle = std::clamp(it.cut_off_angle, 1e-3, kWidest);
    light.spot.innerConeAngle = std::clamp(it.beam_width, 0.0, 0.999 * light.spot.outerConeAngle);
    Value::Object extension;
    extension["light"] = Value(int(model_.lights.size()));
    node.extensions[kGltfLights] = Value(std::move(extension));
    model_.lights.push_back(std::move(light));
  }

  void add_fixture(const world::Viewpoint& it, tinygltf::Node& node, Value::Object&) {
    tinygltf::Camera camera;
    camera.type = "perspective";
    camera.perspective.yfov = it.field_of_view;
    camera.perspective.znear = 0.01;
    camera.perspective.zfar = 1e5;  // the library cannot leave it out
    node.camera = int(model_.cameras.size());
    model_.cameras.push_back(std::move(camera));
  }

  static void add_fixture(const world::Inert& it, tinygltf::Node&, Value::Object& extras) {
    Value::Object inert;
    inert["type"] = Value(base::as_utf8(it.type));
    inert["source"] = Value(base::as_utf8(it.source));
    extras["inert"] = Value(std::move(inert));
  }

  static void add_fixture(const world::ForceEffect& it, tinygltf::Node&, Value::Object& extras) {
    Value::Object effect;
    effect["text"] = Value(base::as_utf8(it.text));
    effect["on"] = Value(it.on);
    extras["effect"] = Value(std::move(effect));
  }

  void add_root_extras() {
    Value::Object icome;
    if (!shapes_.empty()) icome["shapes"] = Value(std::move(shapes_));
    Value::Array scenes;
    for (const world::SceneId id : ids_in_order(world_.scenes())) {
      const world::Scene& it = *world_.find(id);
      Value::Array nodes;
      for (const ObjectId root : it.roots) nodes.emplace_back(nodes_.at(root));
      Value::Object scene;
      scene["name"] = Value(base::as_utf8(it.name));
      scene["nodes"] = Value(std::move(nodes));
      scenes.emplace_back(std::move(scene));
    }
    if (!scenes.empty()) icome["scenes"] = Value(std::move(scenes));
    if (!icome.empty()) model_.extras = extras_with(Value(std::move(icome)));
  }

  const World& world_;
  ShownShapes shown_;
  tinygltf::Model model_;
  GltfBuffer buffer_{model_};
  GltfAnimations animations_{model_, buffer_};
  std::unordered_map<TextureId, int> textures_;
  std::unordered_map<MaterialId, int> materials_;
  std::map<std::tuple<MaterialId, bool, bool>, int> variants_;  // white, without texture
  std::unordered_map<GeometryId, int> exact_;
  // By whether they have texture coordinates, and the colour of parts without their own.
  std::map<std::tuple<Triangles, bool, world::Colour>, tinygltf::Primitive> primitives_;
  std::map<std::pair<int, world::PictureFrame>, int> laid_;  // accessors of coordinates
  std::set<Triangles> smooth_;
  std::map<std::pair<GeometryId, MaterialId>, int> meshes_;
  std::unordered_map<ObjectId, int> nodes_;
  Value::Array shapes_;
  std::vector<Remark> remarks_;
  std::size_t sheared_ = 0, grouped_lights_ = 0, clear_parts_ = 0;
};

/// A stream buffer that writes into the file.
class FileBuffer final : public std::streambuf {
 public:
  explicit FileBuffer(io::NewFile& file) : file_(file) {}

 protected:
  std::streamsize xsputn(const char* data, std::streamsize count) override {
    file_.write({data, std::size_t(count)});
    return count;
  }
  int_type overflow(int_type letter) override {
    const char one = traits_type::to_char_type(letter);
    file_.write({&one, 1});
    return letter;
  }

 private:
  io::NewFile& file_;
};

}  // namespace

base::Result<std::vector<Remark>> write_gltf(const std::filesystem::path& path, const World& world) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  GltfMaking making(world);
  const auto model = making.run();
  if (!model) return base::fail(fmt::format("{}: {}", path.string(), model.error().message));
  FileBuffer buffer(*file);
  std::ostream stream(&buffer);
  tinygltf::TinyGLTF library;
  const bool binary = io::ending_of(path).type == ".glb";
  if (!library.WriteGltfSceneToStream(&*model, stream, !binary, binary))
    return base::fail(path.string() + ": cannot be written as glTF.");
  if (const auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
  return making.remarks();
}

}  // namespace icome::files
