#include "files/vrml/write/vrml_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "files/shown_world.h"
#include "files/vrml/read/vrml_scanner.h"
#include "files/vrml/vrml_fixtures.h"
#include "files/vrml/vrml_names.h"
#include "files/vrml/vrml_protos.h"
#include "files/vrml/write/vrml_appearances.h"
#include "files/vrml/write/vrml_moves.h"
#include "files/vrml/write/vrml_place.h"
#include "files/vrml/write/vrml_shapes.h"
#include "files/vrml/write/vrml_text.h"
#include "io/number_text.h"
#include "world/shape/mesh_geometry.h"

namespace icome::files {
namespace {

using base::Result;
using world::GeometryId;
using world::Light;
using world::MaterialId;
using world::ObjectId;
using world::PhysicalObject;
using world::World;

template <typename Named>
std::vector<world::Id<Named>> in_order(const World::Table<Named>& table) {
  std::vector<world::Id<Named>> ids;
  for (const auto& [id, named] : table) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The DEF name of a script that can be written unchanged; nothing for one that ICOME could not read again.
std::optional<std::string> script_name(const world::Inert& inert) {
  const auto found = scan_vrml("#VRML V2.0 utf8\n" + inert.source, "a script");
  if (!found || found->scripts.size() != 1 || found->scripts[0].source != inert.source) return std::nullopt;
  return found->scripts[0].name;
}

const world::ForceEffect* effect_of(const PhysicalObject& object) {
  return object.fixture ? std::get_if<world::ForceEffect>(&*object.fixture) : nullptr;
}

/// Is the object a root that is nothing but its fixture?
bool is_bare(const PhysicalObject& object) {
  return !object.parent && object.children.empty() && !object.geometry && !object.material &&
         !object.motion && object.parent_from_object.matrix() == base::Affine3::Identity().matrix();
}

base::Vector3 in_single_precision(const base::Vector3& direction) {
  constexpr double kLeastPart = 1e-7;  // single precision changes smaller parts at each saving
  const auto part = [](double it) { return std::abs(it) < kLeastPart ? 0.0 : io::as_written(float(it)); };
  return {part(direction.x()), part(direction.y()), part(direction.z())};
}

/// In single precision, and stable against reading, normalising and writing again: a design that is opened
/// and saved is the same file. Rounding becomes stable in a step or two, or now and then runs in a small
/// cycle, of which the least is taken.
base::Vector3 written_direction(const base::Vector3& unit) {
  constexpr int kMostSteps = 16;
  base::Vector3 direction = in_single_precision(unit);
  const auto go_on = [&] { direction = in_single_precision(direction.normalized()); };
  for (int i = 0; i < kMostSteps; ++i) go_on();
  base::Vector3 least = direction;
  for (int i = 0; i < kMostSteps; ++i) {
    go_on();
    if (std::lexicographical_compare(direction.begin(), direction.end(), least.begin(), least.end()))
      least = direction;
  }
  return least;
}

/// The direction of a DirectionalLight that expresses all of the object but its name; none for others. In
/// other programs it shines on its group only if it is in the group itself.
std::optional<base::Vector3> direction_alone(const PhysicalObject& object) {
  const auto* const light = object.fixture ? std::get_if<Light>(&*object.fixture) : nullptr;
  if (light == nullptr || light->kind != Light::Kind::Directional || object.geometry || object.material ||
      object.motion || !object.children.empty())
    return {};
  constexpr double kRounding = 1e-9;
  const base::Affine3& frame = object.parent_from_object;
  const base::Vector3 direction = written_direction(frame.linear() * -base::Vector3::UnitZ());
  if (!frame.translation().isZero(kRounding) || !frame.linear().isApprox(facing(direction), 1e-6)) return {};
  return direction;
}

/// Parents before children, in the order that people see.
std::vector<ObjectId> all_objects(const World& world) {
  std::vector<ObjectId> order;
  std::vector<ObjectId> waiting(world.roots().rbegin(), world.roots().rend());
  while (!waiting.empty()) {
    order.push_back(waiting.back());
    waiting.pop_back();
    const std::vector<ObjectId>& children = world.find(order.back())->children;
    waiting.insert(waiting.end(), children.rbegin(), children.rend());
  }
  return order;
}

// Each object takes a brace and a bracket, the content of the last one a few more.
constexpr std::size_t kMostObjectsAbove = kMostNestedVrml / 2 - 5;

tl::unexpected<base::Error> objects_too_deep() {
  return base::fail(
      fmt::format("Objects lie more than {} deep within each other, which no program could read "
                  "as VRML: put some higher up, or save the design as .icome.",
                  kMostObjectsAbove));
}

}  // namespace

/// Writes one world into one file.
class VrmlWriter {
 public:
  VrmlWriter(const std::filesystem::path& path, const World& world, io::NewFile& file)
      : world_(world),
        text_(file),
        appearances_(path, world, names_, text_, remarks_),
        shapes_(text_, remarks_),
        moves_(text_, names_),
        objects_(all_objects(world)) {}

  Result<std::vector<Remark>> write() {
    look_at_scripts();
    give_names();
    text_.add("#VRML V2.0 utf8\n");
    write_protos();
    if (const auto written = write_objects(); !written) return tl::unexpected(written.error());
    moves_.write();
    write_scenes();
    text_.finish();
    tell_what_is_left();
    return std::move(remarks_);
  }

 private:
  struct Open {
    ObjectId id;
    std::size_t next_child = 0;
    bool has_children = false;  // does it have the field?
  };

  void look_at_scripts();
  void give_names();
  void name_shapes();
  static std::string definition(const VrmlProto& proto);
  void write_protos();
  Result<void> write_objects();
  Result<Open> open(ObjectId id);
  void close(const Open& object);
  void write_frame(const base::Affine3& frame);
  Result<void> write_shape(const PhysicalObject& object);
  void write_fixture(ObjectId id, const PhysicalObject& object);
  void write_light(const Light& light, const std::string& def = {},
                   const base::Vector3& direction = -base::Vector3::UnitZ());
  void tell_of_light(ObjectId id, const PhysicalObject& object);
  void write_scenes();
  void tell_what_is_left();

  std::string name_of(ObjectId id) const {
    const auto found = object_names_.find(id);
    return found == object_names_.end() ? "" : found->second;
  }
  /// Is its real name written beside its DEF name?
  bool has_title(ObjectId id) const {
    const std::string& name = world_.find(id)->name;
    return !name.empty() && name != name_of(id);
  }

  const World& world_;
  std::vector<Remark> remarks_;
  VrmlNames names_;
  VrmlText text_;
  VrmlAppearances appearances_;
  VrmlShapes shapes_;
  VrmlMoves moves_;
  std::vector<ObjectId> objects_;
  std::unordered_set<ObjectId> in_scenes_;
  std::unordered_map<ObjectId, std::string> object_names_;      // DEF names, of those that have one
  std::unordered_map<GeometryId, std::string> geometry_names_;  // of those that are used again
  std::unordered_set<GeometryId> written_;
  std::unordered_set<ObjectId> with_script_;  // whose inert node can be written
  std::unordered_set<ObjectId> scripts_;      // those that are nothing else
  std::size_t inert_left_out_ = 0, inert_moved_ = 0;
};

void VrmlWriter::look_at_scripts() {
  for (const auto& [id, scene] : world_.scenes()) in_scenes_.insert(scene.roots.begin(), scene.roots.end());
  for (const ObjectId id : objects_) {
    const PhysicalObject& object = *world_.find(id);
    const auto* inert = object.fixture ? std::get_if<world::Inert>(&*object.fixture) : nullptr;
    if (!inert) continue;
    const auto name = script_name(*inert);
    if (!name) {
      ++inert_left_out_;
      continue;
    }
    with_script_.insert(id);
    names_.take(*name);
    if (is_bare(object) && object.name == *name && !in_scenes_.contains(id))
      scripts_.insert(id);
    else
      ++inert_moved_;
  }
}

void VrmlWriter::give_names() {
  // Objects whose names are valid DEF names come first.
  for (const ObjectId id : objects_) {
    const std::string& name = world_.find(id)->name;
    if (!scripts_.contains(id) && names_.take(name)) object_names_[id] = name;
  }
  for (const ObjectId id : objects_) {
    const std::string& name = world_.find(id)->name;
    const bool is_named = in_scenes_.contains(id) || world_.find(id)->motion;
    if (object_names_.contains(id) || scripts_.contains(id) || (name.empty() && !is_named)) continue;
    object_names_[id] = names_.take_like(name);
  }
  std::vector<MaterialId> materials;
  std::unordered_set<MaterialId> seen;
  for (const ObjectId id : objects_) {
    const MaterialId material = world_.find(id)->material;
    if (material && seen.insert(material).second) materials.push_back(material);
  }
  appearances_.name(materials);
  name_shapes();
}

void VrmlWriter::name_shapes() {
  for (const ObjectId id : objects_) {
    const GeometryId geometry = world_.find(id)->geometry;
    if (!geometry || world_.find(geometry)->users < 2 || geometry_names_.contains(geometry)) continue;
    const std::string& owner = world_.find(id)->name;
    geometry_names_[geometry] = names_.take_like(owner.empty() ? "shape" : owner + "_shape");
  }
}

std::string VrmlWriter::definition(const VrmlProto& proto) {
  return fmt::format("PROTO {} [\n{}{}] {{\n{}}}\n", proto.name, proto.fields,
                     proto.body ? "" : kTriangles.fields, proto.body ? proto.body : kTriangles.body);
}

void VrmlWriter::write_protos() {
  std::set<const VrmlProto*> used;
  for (const auto& [id, geometry] : world_.geometries()) {
    if (geometry.users > 0) used.insert(VrmlShapes::proto_of(*geometry.shape));
  }
  if (appearances_.need_proto()) used.insert(&kMaterialProto);
  if (std::ranges::any_of(world_.objects(), [](const auto& it) { return effect_of(it.second) != nullptr; }))
    used.insert(&kEffectProto);
  if (!world_.scenes().empty()) used.insert(&kSceneProto);
  for (const VrmlProto* proto : {&kMaterialProto, &kPrimitiveProto, &kCsgProto, &kLoopProto, &kImplicitProto,
                                 &kDrawingProto, &kEffectProto, &kSceneProto}) {
    if (used.contains(proto)) text_.add(definition(*proto));
  }
}

Result<void> VrmlWriter::write_objects() {
  std::vector<Open> open_objects;
  for (const ObjectId root : world_.roots()) {
    if (scripts_.contains(root)) {
      text_.add(std::get<world::Inert>(*world_.find(root)->fixture).source);
      continue;
    }
    auto opened = open(root);
    if (!opened) return tl::unexpected(opened.error());
    open_objects.push_back(*opened);
    while (!open_objects.empty()) {
      Open& object = open_objects.back();
      const std::vector<ObjectId>& children = world_.find(object.id)->children;
      if (object.next_child == children.size()) {
        close(object);
        open_objects.pop_back();
        continue;
      }
      if (open_objects.size() == kMostObjectsAbove) return objects_too_deep();
      auto child = open(children[object.next_child++]);
      if (!child) return tl::unexpected(child.error());
      open_objects.push_back(*child);
    }
  }
  return {};
}

Result<VrmlWriter::Open> VrmlWriter::open(ObjectId id) {
  const PhysicalObject& object = *world_.find(id);
  const std::string name = name_of(id);
  if (object.fixture) tell_of_light(id, object);
  const auto direction = direction_alone(object);
  const bool says_itself =
      direction && !has_title(id) && (!name.empty() || !direction->isApprox(-base::Vector3::UnitZ()));
  if (says_itself) {
    write_light(std::get<Light>(*object.fixture), name, *direction);
    return Open{id, 0, false};
  }
  text_.open(name.empty() ? "Transform" : fmt::format("DEF {} Transform", name));
  if (const world::Motion* const motion = moves_.motion_of(object))
    moves_.write_rest(*motion, name);
  else
    write_frame(object.parent_from_object);
  const bool has_shape = object.geometry || object.material;
  const bool has_fixture =
      object.fixture && (!std::holds_alternative<world::Inert>(*object.fixture) || with_script_.contains(id));
  const Open result{id, 0, has_title(id) || has_shape || has_fixture || !object.children.empty()};
  if (!result.has_children) return result;
  text_.open_list("children");
  if (has_title(id)) {
    text_.open("WorldInfo");
    text_.text_field("title", object.name);
    text_.close();
  }
  if (has_shape) {
    if (const auto written = write_shape(object); !written) return tl::unexpected(written.error());
  }
  if (object.fixture) write_fixture(id, object);
  return result;
}

void VrmlWriter::close(const Open& object) {
  if (object.has_children) text_.close_list();
  text_.close();
}

void VrmlWriter::write_frame(const base::Affine3& frame) {
  const VrmlPlace fields = vrml_place(frame);
  const auto turn = [&](const char* name, const VrmlTurn& it) {
    if (it.angle == 0.0F) return;
    text_.field(name, std::array{it.axis.x(), it.axis.y(), it.axis.z(), it.angle});
  };
  if (!fields.translation.isZero(0.0F)) text_.field("translation", std::span(fields.translation.data(), 3));
  turn("rotation", fields.rotation);
  if (fields.scale != Eigen::Vector3f::Ones()) text_.field("scale", std::span(fields.scale.data(), 3));
  turn("scaleOrientation", fields.scale_orientation);
}

Result<void> VrmlWriter::write_shape(const PhysicalObject& object) {
  text_.open("Shape");
  if (const auto written = appearances_.write(object.material); !written) return written;
  if (object.geometry) {
    const auto name = geometry_names_.find(object.geometry);
    const bool again = name != geometry_names_.end() && !written_.insert(object.geometry).second;
    if (again)
      text_.add("geometry USE " + name->second);
    else
      shapes_.write(*world_.find(object.geometry)->shape, name == geometry_names_.end() ? "" : name->second,
                    object.name.empty() ? "an object without a name" : fmt::format("\"{}\"", object.name));
  }
  text_.close();
  return {};
}

void VrmlWriter::write_fixture(ObjectId id, const PhysicalObject& object) {
  if (const auto* light = std::get_if<Light>(&*object.fixture)) {
    write_light(*light);
    return text_.close();
  }
  if (const auto* view = std::get_if<world::Viewpoint>(&*object.fixture)) {
    text_.open("Viewpoint");
    text_.field("position", base::Vector3(base::Vector3::Zero()));
    text_.field("fieldOfView", view->field_of_view);
    if (!object.name.empty()) text_.text_field("description", object.name);
    return text_.close();
  }
  if (const auto* effect = effect_of(object)) {
    text_.open(kEffectProto.name);
    text_.text_field("effect", effect->text);
    if (!effect->on) text_.field("on", false);
    return text_.close();
  }
  if (with_script_.contains(id)) text_.add(std::get<world::Inert>(*object.fixture).source);
}

/// Writes a light and leaves its node open.
void VrmlWriter::write_light(const Light& light, const std::string& def, const base::Vector3& direction) {
  const Light usual;
  const bool directional = light.kind == Light::Kind::Directional;
  const bool spot = light.kind == Light::Kind::Spot;
  text_.open((def.empty() ? "" : fmt::format("DEF {} ", def)) + (directional ? "DirectionalLight"
                                                                 : spot      ? "SpotLight"
                                                                             : "PointLight"));
  if (direction != -base::Vector3::UnitZ()) text_.field("direction", direction);
  if (!light.on) text_.field("on", false);
  if (light.colour != usual.colour) text_.field("color", light.colour);
  if (light.intensity != usual.intensity) text_.field("intensity", light.intensity);
  if (light.ambient != usual.ambient) text_.field("ambientIntensity", light.ambient);
  if (!directional) {
    if (light.attenuation != usual.attenuation) text_.field("attenuation", light.attenuation);
    if (light.radius != usual.radius) text_.field("radius", light.radius);
  }
  if (spot) {  // programs differ in the last decimal of the default
    text_.field("cutOffAngle", light.cut_off_angle);
    text_.field("beamWidth", light.beam_width);
  }
}

void VrmlWriter::tell_of_light(ObjectId id, const PhysicalObject& object) {
  const auto* const light = std::get_if<Light>(&*object.fixture);
  if (light == nullptr || light->kind != Light::Kind::Directional || light->scoped || !object.parent) return;
  remarks_.push_back({"", 0,
                      fmt::format("The light {} shines only on the group that it is in, as VRML 2.0 has it.",
                                  object.name.empty() ? name_of(id) : object.name)});
}

void VrmlWriter::write_scenes() {
  for (const world::SceneId id : in_order(world_.scenes())) {
    const world::Scene& scene = *world_.find(id);
    text_.open(kSceneProto.name);
    text_.text_field("name", scene.name.empty() ? "scene" : scene.name);
    if (scene.name.empty()) remarks_.push_back({"", 0, "A scene without a name is called \"scene\"."});
    text_.open_list("objects");
    for (const ObjectId root : scene.roots) text_.text_row(name_of(root));
    text_.close_list();
    text_.close();
  }
}

void VrmlWriter::tell_what_is_left() {
  const auto unused = [&](const auto& table, const char* what) {
    const auto count =
        std::count_if(table.begin(), table.end(), [](const auto& it) { return it.second.users == 0; });
    if (count > 0) remarks_.push_back({"", 0, fmt::format("{} {} left out.", count, what), false});
  };
  if (inert_left_out_ > 0)
    remarks_.push_back(
        {"", 0, fmt::format("{} nodes that are no whole VRML scripts are left out.", inert_left_out_)});
  if (inert_moved_ > 0)
    remarks_.push_back({"", 0,
                        fmt::format("{} scripts will be objects of their own, not parts of the objects that "
                                    "they are in now.",
                                    inert_moved_)});
  for (Remark& it : lost_recipes(world_, "VRML 2.0")) remarks_.push_back(std::move(it));
  for (Remark& it : appearances_.losses()) remarks_.push_back(std::move(it));
  for (Remark& it : moves_.remarks()) remarks_.push_back(std::move(it));
  unused(world_.geometries(), "shapes that no object has are");
  unused(world_.materials(), "materials that no object has are");
  unused(world_.textures(), "textures that no material shows are");
  if (text_.clipped())
    remarks_.push_back({"", 0, "Numbers beyond 3.4e38, the largest that VRML 2.0 can hold, became that."});
}

Result<std::vector<Remark>> write_vrml(const std::filesystem::path& path, const World& world) {
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  auto remarks = VrmlWriter(path, world, *file).write();
  if (!remarks) return base::fail(fmt::format("{}: {}", path.string(), remarks.error().message));
  if (const auto finished = file->finish(); !finished) return tl::unexpected(finished.error());
  return remarks;
}

}  // namespace icome::files
