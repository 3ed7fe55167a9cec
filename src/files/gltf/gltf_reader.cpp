#include "files/gltf/gltf_reader.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "base/clock.h"
#include "files/gltf/gltf_looks.h"
#include "files/gltf/gltf_model.h"
#include "files/gltf/gltf_motions.h"
#include "files/gltf/gltf_node.h"
#include "files/gltf/gltf_value.h"
#include "files/mesh/mesh_formats.h"
#include "io/file_bytes.h"
#include "io/file_ending.h"
#include "world/edit/edit.h"

namespace icome::files {
namespace {

using tinygltf::Value;
using world::GeometryId;
using world::ObjectId;
using world::PhysicalObject;

bool is_understood(const std::string& extension) {
  constexpr std::array<std::string_view, 5> kUnderstood{
      kGltfLights, "KHR_texture_transform", "KHR_mesh_quantization", "KHR_materials_unlit", "ICOME"};
  return std::find(kUnderstood.begin(), kUnderstood.end(), extension) != kUnderstood.end();
}

/// Extensions of looks (KHR_materials_...): without them, looks only become plainer.
bool can_be_done_without(const std::string& extension) { return extension.starts_with("KHR_materials_"); }

/// Has it extras of another program?
bool has_foreign_extras(const Value& extras) {
  if (!extras.IsObject()) return extras.Type() != tinygltf::NULL_TYPE;
  const std::vector<std::string> names = extras.Keys();
  return std::any_of(names.begin(), names.end(), [](const std::string& it) { return it != "icome"; });
}

/// Largest number of times that reading a model asks whether to go on, exact shapes aside.
std::size_t steps_in(const tinygltf::Model& model) {
  std::size_t steps = model.nodes.size() + model.meshes.size() + model.materials.size() + 1;
  for (const tinygltf::Animation& animation : model.animations) steps += animation.channels.size();
  return steps;
}

/// Reads one file into a design.
class GltfReading {
 public:
  GltfReading(const tinygltf::Model& model, DesignBuilder& builder, const DesignReadOptions& options,
              io::MemoryBudget& memory)
      : model_(model),
        builder_(builder),
        memory_(memory),
        options_(options),
        all_steps_(steps_in(model) + root_shapes().ArrayLen()),
        looks_(model, builder, memory, [this] { ask_whether_to_go_on(); }),
        motions_(model, memory, [this] { ask_whether_to_go_on(); }),
        objects_(model.nodes.size()) {}

  void run() {
    for (const std::string& extension : model_.extensionsRequired) {
      if (!is_understood(extension) && !can_be_done_without(extension))
        throw GltfError("it needs " + extension + ", which is not supported");
    }
    // Shapes that no object has are kept too.
    for (std::size_t i = 0; i < root_shapes().ArrayLen(); ++i) exact_shape(int(i));
    for (const tinygltf::Mesh& mesh : model_.meshes) {
      for (const tinygltf::Primitive& primitive : mesh.primitives) shape_of(mesh, primitive);
    }
    std::vector<std::vector<ObjectId>> scenes;
    for (const auto& [name, nodes] : scene_roots()) scenes.push_back(add_tree(nodes));
    if (scenes.size() > 1) {
      for (std::size_t i = 0; i < scenes.size(); ++i) builder_.add_scene(model_.scenes[i].name, scenes[i]);
    }
    add_own_scenes();
    remark_on_losses();
  }

 private:
  struct Visit {
    int node;
    ObjectId parent;
  };
  using NamedNodes = std::pair<std::string, std::vector<int>>;

  const Value& root_extras() const { return icome_extras(model_.extras); }
  const Value& root_shapes() const { return member(root_extras(), "shapes"); }

  /// The roots of each scene; of a file without scenes, the nodes that are nobody's children.
  std::vector<NamedNodes> scene_roots() const {
    std::vector<NamedNodes> roots;
    for (const tinygltf::Scene& scene : model_.scenes) roots.emplace_back(scene.name, scene.nodes);
    if (!roots.empty()) return roots;
    std::vector<bool> is_child(model_.nodes.size(), false);
    for (const tinygltf::Node& node : model_.nodes) {
      for (const int child : node.children) {
        if (child >= 0 && std::size_t(child) < is_child.size()) is_child[std::size_t(child)] = true;
      }
    }
    NamedNodes all;
    for (std::size_t i = 0; i < is_child.size(); ++i) {
      if (!is_child[i]) all.second.push_back(int(i));
    }
    return {all};
  }

  /// Adds nodes with all that is below them; nodes that exist already belong to several scenes.
  std::vector<ObjectId> add_tree(const std::vector<int>& roots) {
    std::vector<Visit> open;
    const auto enter = [&](const std::vector<int>& nodes, ObjectId parent) {
      for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) open.push_back({*node, parent});
    };
    enter(roots, {});
    while (!open.empty()) {
      const Visit visit = open.back();
      open.pop_back();
      if (visit.node < 0 || std::size_t(visit.node) >= objects_.size())
        throw GltfError("its nodes do not form a tree");
      NodeObject& known = objects_[std::size_t(visit.node)];
      // A node belongs to one parent, but several scenes may show a root: this also ends cycles.
      if (known.seen && (visit.parent || (known.id && !is_root(known.id))))
        throw GltfError("its nodes do not form a tree");
      if (known.seen) continue;
      known.seen = true;
      known.id = add_node(std::size_t(visit.node), visit.parent);
      if (known.id) enter(model_.nodes[std::size_t(visit.node)].children, known.id);
    }
    std::vector<ObjectId> ids;
    for (const int node : roots) {
      const ObjectId id = objects_[std::size_t(node)].id;
      if (id && std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    }
    return ids;
  }

  bool is_root(ObjectId id) const {
    const PhysicalObject* const object = builder_.world().find(id);
    return object && !object->parent;
  }

  /// None where the node flattens its content.
  ObjectId add_node(std::size_t index, ObjectId parent) {
    ask_whether_to_go_on();
    const tinygltf::Node& node = model_.nodes[index];
    PhysicalObject object{.name = node.name, .parent = parent, .parent_from_object = parent_from_node(node)};
    object.motion = motions_.of(index);
    if (object.motion) object.parent_from_object = world::affine(object.motion->rest);
    if (!world::can_be_placed(object.parent_from_object)) {
      ++flat_nodes_;
      return {};
    }
    std::vector<world::FixturePointer> fixtures = fixtures_of(node);
    if (!fixtures.empty()) object.fixture = fixtures.front();
    const std::vector<PhysicalObject> parts = parts_of(node);
    if (parts.size() == 1) {
      renamed_meshes_ += !parts[0].name.empty() && parts[0].name != node.name ? 1 : 0;
      object.geometry = parts[0].geometry;
      object.material = parts[0].material;
    }
    const std::string name = node.name;
    const ObjectId id = builder_.add(std::move(object));
    for (std::size_t i = 0; parts.size() > 1 && i < parts.size(); ++i) {
      PhysicalObject part = parts[i];
      part.parent = id;
      builder_.add(std::move(part));
    }
    for (std::size_t i = 1; i < fixtures.size(); ++i)
      builder_.add(PhysicalObject{.name = name, .parent = id, .fixture = fixtures[i]});
    return id;
  }

  /// The shapes of a node, as objects without a place.
  std::vector<PhysicalObject> parts_of(const tinygltf::Node& node) {
    std::vector<PhysicalObject> parts;
    const Value& extras = icome_extras(node.extras);
    if (node.mesh < 0) {
      const auto shape = index_in(extras, "shape", root_shapes().ArrayLen());
      const GeometryId geometry = shape ? exact_shape(*shape) : GeometryId{};
      const int material = index_in(extras, "material", model_.materials.size()).value_or(-1);
      if (geometry || material >= 0)
        parts.push_back({.geometry = geometry, .material = looks_.material(material)});
      return parts;
    }
    if (std::size_t(node.mesh) >= model_.meshes.size())
      throw GltfError("a node refers to a mesh that is not there");
    const tinygltf::Mesh& mesh = model_.meshes[std::size_t(node.mesh)];
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const GeometryId geometry = shape_of(mesh, primitive);
      if (geometry)
        parts.push_back(
            {.name = mesh.name, .geometry = geometry, .material = looks_.material(primitive.material)});
    }
    return parts;
  }

  /// A key that is equal for two primitives if they can be one shape.
  std::string key_of(const tinygltf::Primitive& primitive, const GltfSurface& surface) const {
    std::string key = fmt::format("{} {} {}", primitive.mode, primitive.indices, surface.smooth);
    const auto add = [&](const std::string& name) {
      const auto found = primitive.attributes.find(name);
      const bool is_there = found != primitive.attributes.end();
      key += is_there ? fmt::format(" {}", found->second) : " -";
      return is_there;
    };
    for (const char* name : {"POSITION", "NORMAL"}) add(name);
    add(fmt::format("TEXCOORD_{}", surface.texture_set));
    if (!add(colours_name(primitive))) return key;
    for (const double part : surface.colour) key += fmt::format(",{}", part);
    return key;
  }

  /// None for primitives that are no triangles.
  GeometryId shape_of(const tinygltf::Mesh& mesh, const tinygltf::Primitive& primitive) {
    const Value& extras = icome_extras(mesh.extras);
    if (const auto exact = index_in(extras, "shape", root_shapes().ArrayLen())) {
      if (const GeometryId geometry = exact_shape(*exact)) return geometry;
    }
    if (!has_triangles(primitive)) {
      other_primitives_.insert(&primitive);
      return {};
    }
    GltfSurface surface = looks_.surface(primitive.material);
    const Value& smooth = member(extras, "smooth");
    surface.smooth = smooth.IsBool() && smooth.Get<bool>();
    const auto [found, is_new] = shapes_.try_emplace(key_of(primitive, surface));
    if (!is_new) return found->second;
    ask_whether_to_go_on();
    std::string lost;
    const auto shape = gltf_mesh(model_, primitive, surface, memory_, lost);
    std::string recipe = text_in(extras, "recipe");
    // A recipe that cannot be written again, or that describes more than this part, is dropped.
    if (recipe.size() <= world::kMostRecipeBytes && mesh.primitives.size() == 1)
      shape->recipe = std::move(recipe);
    if (!lost.empty()) builder_.remark(mesh.name.empty() ? lost : fmt::format("\"{}\": {}", mesh.name, lost));
    return found->second = keep(shape);
  }

  /// An exact shape of the root's extras; none where it cannot be made, which is told once.
  GeometryId exact_shape(int index) {
    const auto [found, is_new] = exact_.try_emplace(index);
    if (!is_new) return found->second;
    ask_whether_to_go_on();
    const auto shape = shape_from_text(shape_text_of(root_shapes().Get(index)));
    if (shape) {
      found->second = keep(*shape);
    } else {
      builder_.remark(fmt::format("An exact shape cannot be read, its triangles are taken instead: {}.",
                                  shape.error().message));
    }
    return found->second;
  }

  GeometryId keep(const world::GeometryPointer& shape) {
    const GeometryId id = builder_.add(shape);
    if (memory_.is_exceeded()) throw GltfError(memory_.problem().message);
    return id;
  }

  std::vector<world::FixturePointer> fixtures_of(const tinygltf::Node& node) {
    const auto share = [](auto fixture) {
      return std::make_shared<const world::Fixture>(std::move(fixture));
    };
    std::vector<world::FixturePointer> fixtures;
    const Value& extras = icome_extras(node.extras);
    if (const Value& inert = member(extras, "inert"); inert.IsObject())
      fixtures.push_back(share(world::Inert{text_in(inert, "type"), text_in(inert, "source")}));
    if (const Value& effect = member(extras, "effect"); effect.IsObject()) {
      const Value& on = member(effect, "on");
      if (std::string text = text_in(effect, "text"); !text.empty())
        fixtures.push_back(share(world::ForceEffect{std::move(text), !on.IsBool() || on.Get<bool>()}));
    }
    const auto own_light = light_of(member(extras, "light"));
    if (own_light) {
      fixtures.push_back(share(*own_light));
    } else if (const auto it = node.extensions.find(kGltfLights); it != node.extensions.end()) {
      const auto light = index_in(it->second, "light", model_.lights.size());
      if (!light) throw GltfError("a node refers to a light that is not there");
      fixtures.push_back(share(light_of(model_.lights[std::size_t(*light)])));
    }
    if (node.camera >= 0) {
      if (std::size_t(node.camera) >= model_.cameras.size())
        throw GltfError("a node refers to a camera that is not there");
      fixtures.push_back(share(viewpoint_from(model_.cameras[std::size_t(node.camera)])));
    }
    return fixtures;
  }

  world::Viewpoint viewpoint_from(const tinygltf::Camera& it) {
    const auto angle = field_of_view(it);
    other_cameras_ += angle ? 0 : 1;
    return angle ? world::Viewpoint{*angle} : world::Viewpoint{};
  }

  void add_own_scenes() {
    const Value& scenes = member(root_extras(), "scenes");
    for (int i = 0; std::size_t(i) < scenes.ArrayLen(); ++i) {
      const Value& nodes = member(scenes.Get(i), "nodes");
      std::vector<ObjectId> roots;
      for (int n = 0; std::size_t(n) < nodes.ArrayLen(); ++n) {
        const int node = nodes.Get(n).IsInt() ? nodes.Get(n).GetNumberAsInt() : -1;
        if (node < 0 || std::size_t(node) >= objects_.size()) continue;
        const ObjectId id = objects_[std::size_t(node)].id;
        if (id && std::find(roots.begin(), roots.end(), id) == roots.end()) roots.push_back(id);
      }
      builder_.add_scene(text_in(scenes.Get(i), "name"), roots);
    }
  }

  void remark_on_losses() {
    const auto tell = [&](std::size_t count, const char* one, const char* several, const char* what) {
      if (count == 0) return;
      builder_.remark(count == 1 ? fmt::format("1 {} {}", one, what)
                                 : fmt::format("{} {} {}", count, several, what));
    };
    std::size_t morphs = 0;
    for (const tinygltf::Mesh& mesh : model_.meshes) {
      for (const tinygltf::Primitive& primitive : mesh.primitives)
        morphs += primitive.targets.empty() ? 0 : 1;
    }
    const auto unseen = std::size_t(
        std::count_if(objects_.begin(), objects_.end(), [](const NodeObject& it) { return !it.seen; }));
    tell(other_primitives_.size(), "primitive of points or lines is", "primitives of points or lines are",
         "left out.");
    tell(flat_nodes_, "node is", "nodes are", "left out: a scale of nothing flattens what is below.");
    tell(unseen - std::min(unseen, below_flat()), "node is", "nodes are", "left out: no scene shows it.");
    for (const Remark& it : motions_.remarks()) builder_.remark(it.text);
    tell(model_.skins.size(), "skin is", "skins are", "left out: what it moves stands as it was modelled.");
    tell(morphs, "morphing shape is", "morphing shapes are", "kept as modelled.");
    tell(other_cameras_, "camera is", "cameras are", "not in perspective, kept as a viewpoint.");
    tell_what_else_is_left();
    for (const std::string& extension : model_.extensionsUsed) {
      if (!is_understood(extension))
        builder_.remark("It uses " + extension.substr(0, 80) + ", which is left out.");
    }
  }

  /// Remarks on small losses that other programs may miss.
  void tell_what_else_is_left() {
    const auto tell = [&](std::size_t count, const char* one, const char* several, const char* what) {
      if (count > 0) builder_.remark(fmt::format("{} {} {}", count, count == 1 ? one : several, what));
    };
    std::size_t other_sets = 0, clear_colours = 0, extras = has_foreign_extras(model_.extras) ? 1 : 0;
    for (const tinygltf::Mesh& mesh : model_.meshes) {
      extras += has_foreign_extras(mesh.extras) ? 1 : 0;
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        const GltfSurface surface = looks_.surface(primitive.material);
        const std::string used = fmt::format("TEXCOORD_{}", surface.texture_set);
        for (const auto& [name, accessor] : primitive.attributes)
          other_sets += name.starts_with("TEXCOORD_") && name != used && !surface.own_places ? 1 : 0;
        const auto colours = primitive.attributes.find("COLOR_0");
        if (colours != primitive.attributes.end() && colours->second >= 0 &&
            std::size_t(colours->second) < model_.accessors.size() &&
            model_.accessors[std::size_t(colours->second)].type == TINYGLTF_TYPE_VEC4)
          ++clear_colours;
      }
    }
    for (const tinygltf::Node& node : model_.nodes) extras += has_foreign_extras(node.extras) ? 1 : 0;
    for (const tinygltf::Material& it : model_.materials) extras += has_foreign_extras(it.extras) ? 1 : 0;
    tell(other_sets, "further set of texture coordinates is", "further sets of texture coordinates are",
         "left out.");
    tell(clear_colours, "mesh has", "meshes have", "colours of vertices whose opacity is left out.");
    tell(renamed_meshes_, "name of a mesh is", "names of meshes are",
         "left out: objects are called as their nodes.");
    tell(extras, "thing has", "things have", "extras of another program, which are left out.");
    if (!model_.asset.copyright.empty())
      builder_.remark("Its note on copyright is left out: " + model_.asset.copyright.substr(0, 200));
  }

  /// Number of nodes below flat ones, which were left out with them.
  std::size_t below_flat() const {
    std::size_t count = 0;
    std::vector<bool> counted(objects_.size(), false);
    std::vector<int> open;
    for (std::size_t i = 0; i < objects_.size(); ++i) {
      if (objects_[i].seen && !objects_[i].id) open.push_back(int(i));
    }
    while (!open.empty()) {
      const int node = open.back();
      open.pop_back();
      for (const int child : model_.nodes[std::size_t(node)].children) {
        if (child < 0 || std::size_t(child) >= counted.size() || counted[std::size_t(child)]) continue;
        counted[std::size_t(child)] = true;
        count += objects_[std::size_t(child)].seen ? 0 : 1;
        open.push_back(child);
      }
    }
    return count;
  }

  /// Throws when the person stops it, or the file takes longer than allowed.
  void ask_whether_to_go_on() {
    ++steps_;
    const double seconds = 1e-9 * double(base::steady_nanoseconds() - started_);
    if (seconds > options_.seconds_limit)
      throw GltfError(fmt::format("it takes longer than {:.0f} s", options_.seconds_limit));
    if (options_.progress && !options_.progress(std::min(double(steps_) / double(all_steps_), 1.0)))
      throw GltfError("interrupted");
  }

  const tinygltf::Model& model_;
  DesignBuilder& builder_;
  io::MemoryBudget& memory_;
  const DesignReadOptions& options_;
  // Declared before looks and motions, which ask whether to go on while they are made.
  std::int64_t started_ = base::steady_nanoseconds();
  std::size_t steps_ = 0;
  std::size_t all_steps_;
  GltfLooks looks_;
  GltfMotions motions_;
  struct NodeObject {
    bool seen = false;
    ObjectId id = {};
  };
  std::vector<NodeObject> objects_;
  std::unordered_map<std::string, GeometryId> shapes_;
  std::unordered_map<int, GeometryId> exact_;
  std::set<const tinygltf::Primitive*> other_primitives_;  // that are no triangles
  std::size_t flat_nodes_ = 0;
  std::size_t other_cameras_ = 0;
  std::size_t renamed_meshes_ = 0;
};

}  // namespace

base::Result<LoadedDesign> read_gltf_bytes(std::string_view bytes, const std::filesystem::path& path,
                                           const DesignReadOptions& options, io::MemoryBudget& memory) {
  const std::string name = path.string();
  if (io::ending_of(path).type == ".glb" && !bytes.starts_with("glTF"))
    return base::fail(name + ": does not begin with 'glTF', so it is not a GLB file");
  try {
    const GltfModel loaded = load_gltf(bytes, path, options, memory);
    DesignBuilder builder(memory);
    GltfReading(*loaded.model, builder, options, memory).run();
    for (const std::string& sentence : loaded.notes) builder.remark(sentence);
    return builder.take(loaded.format, name);
  } catch (const GltfError& problem) {
    return base::fail(fmt::format("{}: is not a {} file that can be read: {}", name,
                                  bytes.starts_with("glTF") ? "GLB" : "glTF", problem.what()));
  }
}

base::Result<LoadedDesign> read_gltf(const std::filesystem::path& path, const DesignReadOptions& options,
                                     io::MemoryBudget& memory) {
  io::TimeBudget time_budget(options.progress);
  constexpr io::FileParts kSoonDone = {0.0, 0.0};  // short beside the rest
  const bool packed = io::ending_of(path).packed;
  const auto bytes = io::read_unpacked(path, options.size_limit, packed, kSoonDone, time_budget, memory);
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return base::fail(path.string() + ": the file is empty");
  auto design = read_gltf_bytes(*bytes, path, options, memory);
  if (design && packed) design->format += ", xz";
  return design;
}

}  // namespace icome::files
