#include "files/vrml/read/vrml_builder.h"

#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>
#include <vrml_answer_generated.h>

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "files/design_builder.h"
#include "files/vrml/read/vrml_geometries.h"
#include "files/vrml/read/vrml_materials.h"
#include "files/vrml/read/vrml_motions.h"
#include "files/vrml/read/vrml_nodes.h"
#include "files/vrml/vrml_protos.h"
#include "world/motion.h"

namespace icome::files {
namespace {

using base::Result;
using world::GeometryId;
using world::MaterialId;
using world::ObjectId;

constexpr FindingKind kFlattened = {"Objects that their transforms flatten are left out", "objects"};
constexpr FindingKind kUnlit = {"Shapes without a Material are lit here", "shapes"};
constexpr FindingKind kNoMember = {"Scenes name objects that are not there", "scenes"};

constexpr std::size_t kMostNotes = 1000;
constexpr std::size_t kLongestNote = 1000;

/// The scene in the bytes if all parts of it lie within them, else null.
const flat::Scene* verified(const world::FlatReader& reader) {
  constexpr std::size_t kFewestBytesOfOneTable = 8;  // with the offset that leads to it
  constexpr int kDeepest = 16;
  if (reader.size() > std::size_t{std::numeric_limits<std::int32_t>::max()}) return nullptr;
  flatbuffers::Verifier verifier(reader.data(), reader.size(), kDeepest,
                                 flatbuffers::uoffset_t(reader.size() / kFewestBytesOfOneTable));
  return flat::VerifySceneBuffer(verifier) ? flat::GetScene(reader.data()) : nullptr;
}

/// Upper bound of the memory for the shape of a geometry, with all data of its triangles.
std::uint64_t most_bytes_of(const flat::Geometry& geometry) {
  constexpr std::uint64_t kBytesOfTriangle =
      sizeof(geometry::TriangleMesh::Triangle) +
      3 * (sizeof(base::Vector3) + sizeof(base::Vector2) + sizeof(world::Colour));
  if (!geometry.polygons()) return 0;
  const auto ends = std::uint64_t(std::count(geometry.polygons()->begin(), geometry.polygons()->end(), -1));
  const std::uint64_t corners = geometry.polygons()->size() - ends;
  return (corners > 2 * ends ? corners - 2 * ends : 0) * kBytesOfTriangle + corners * sizeof(base::Vector3);
}

/// Makes one design.
class VrmlBuilder {
 public:
  VrmlBuilder(const VrmlSources& sources, const flat::Scene& scene, world::FlatReader& reader,
              io::TimeBudget& time_budget, io::MemoryBudget& memory)
      : sources_(sources),
        scene_(scene),
        reader_(reader),
        time_budget_(time_budget),
        memory_(memory),
        pictures_(sources.fetch_picture, sources.picture_limit, findings_),
        meshes_(sources.find_mesh, sources.picture_limit, findings_, time_budget_, memory),
        design_(memory) {}

  Result<LoadedDesign> build() {
    add_notes();
    nodes_ = nodes_of(scene_, reader_);
    read_looks();
    if (!reader_.fault().empty()) return give_up();
    find_pictured();
    if (!add_objects()) return give_up();
    add_scenes();
    add_scripts();
    if (!reader_.fault().empty()) return give_up();
    auto design = design_.take("VRML 2.0", sources_.name);
    if (!design) return design;
    append(design->remarks, notes_);
    append(design->remarks, findings_.remarks());
    return design;
  }

 private:
  /// Properties of an appearance that are known before it is used.
  struct AppearancePlan {
    bool has_picture = false;
    std::optional<MaterialId> material = {};  // once it is used
  };
  struct GeometryPlan {
    bool shows_picture = false;
    std::optional<GeometryId> shape = {};  // once it is used
  };

  static void append(std::vector<Remark>& to, const std::vector<Remark>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }

  tl::unexpected<base::Error> give_up() const {
    if (memory_.is_exceeded())
      return base::fail(fmt::format("{}: {}", sources_.name, memory_.problem().message));
    if (time_budget_.stopped()) return base::fail("interrupted");
    if (reader_.fault().empty())
      return base::fail(fmt::format("{}: making a design of it takes too long", sources_.name));
    return base::fail(fmt::format("{}: the process that reads VRML gave an answer that makes no sense: {}",
                                  sources_.name, reader_.fault()));
  }

  void add_notes() {
    if (!scene_.notes()) return;
    for (const flat::Note* note : *scene_.notes()) {
      const std::string file = reader_.text(note->file()), text = reader_.text(note->text());
      if (notes_.size() < kMostNotes)
        notes_.push_back(
            {file.substr(0, kLongestNote), std::max(0, note->line()), text.substr(0, kLongestNote)});
    }
    const std::size_t more = scene_.notes()->size() - notes_.size();
    if (more > 0)
      notes_.push_back({{}, 0, fmt::format("There are {} more remarks like the ones before.", more)});
  }

  void read_looks() {
    if (!scene_.appearances()) return;
    const std::int64_t pictures = scene_.pictures() ? scene_.pictures()->size() : 0;
    for (const flat::Appearance* appearance : *scene_.appearances()) {
      if (appearance->picture() < -1 || appearance->picture() >= pictures)
        reader_.refuse("an appearance names what is not there");
      appearances_.push_back({.has_picture = appearance->picture() >= 0});
    }
  }

  /// Marks geometries that are seen with a picture, before their shapes are made.
  void find_pictured() {
    if (scene_.geometries()) geometries_.resize(scene_.geometries()->size());
    for (const VrmlNode& node : nodes_) {
      if (node.geometry >= 0 && node.appearance >= 0 &&
          appearances_[std::size_t(node.appearance)].has_picture)
        geometries_[std::size_t(node.geometry)].shows_picture = true;
    }
  }

  /// False when the time budget ends or the answer is damaged.
  bool add_objects() {
    with_children_.assign(nodes_.size(), false);
    for (const VrmlNode& node : nodes_) {
      if (node.parent >= 0 && node.is_object && !node.is_merged)
        with_children_[std::size_t(node.parent)] = true;
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      objects_.push_back(add_object(nodes_[i]));
      const bool lasts =
          i % 1024 == 0 ? time_budget_.lasts(double(i) / double(nodes_.size())) : time_budget_.lasts();
      if (!lasts || memory_.is_exceeded() || !reader_.fault().empty()) return false;
    }
    return time_budget_.lasts(1.0) && reader_.fault().empty();
  }

  /// The object of a node, or that of the parent for one that is merged into it; none for one left out.
  ObjectId add_object(const VrmlNode& node) {
    const ObjectId parent = node.parent < 0 ? ObjectId{} : objects_[std::size_t(node.parent)];
    if (!node.is_object) return {};
    if (node.is_flat) {
      findings_.add(kFlattened, node.name);
      return {};
    }
    if (node.is_merged) return parent;
    world::PhysicalObject object;
    object.name = node.name;
    object.parent = parent;
    object.parent_from_object = node.parent_from_node;
    if (node.motion >= 0) set_going(std::size_t(node.motion), object);
    if (node.shape_from >= 0) {
      add_shape(nodes_[std::size_t(node.shape_from)], node.name, object);
    } else if (node.appearance_from >= 0) {
      object.material = material(std::size_t(nodes_[std::size_t(node.appearance_from)].appearance));
    }
    if (node.fixture_from >= 0) {
      const PlacedFixture& placed = *nodes_[std::size_t(node.fixture_from)].fixture;
      object.fixture = placed.fixture;
      if (object.fixture && stands_alone(node)) object.fixture = shining_on_all(object.fixture);
      object.parent_from_object = object.parent_from_object * placed.parent_from_fixture;
    }
    return design_.add(std::move(object));
  }

  /// Gives the object a motion, and places it at the motion's rest, to the last bit.
  void set_going(std::size_t index, world::PhysicalObject& object) {
    if (motions_.empty()) motions_.resize(scene_.motions()->size());
    world::MotionPointer& motion = motions_[index];
    if (!motion) motion = motion_of(*scene_.motions()->Get(std::uint32_t(index)), reader_, memory_);
    object.motion = motion;
    if (motion) object.parent_from_object = world::affine(motion->rest);
  }

  /// Is it a root and nothing but its fixture? A scoped light shines on everything then.
  bool stands_alone(const VrmlNode& node) const {
    return node.parent < 0 && node.shape_from < 0 && node.appearance_from < 0 &&
           !with_children_[std::size_t(&node - nodes_.data())];
  }
  static world::FixturePointer shining_on_all(const world::FixturePointer& fixture) {
    const auto* const light = std::get_if<world::Light>(fixture.get());
    if (light == nullptr || !light->scoped) return fixture;
    world::Light on_all = *light;
    on_all.scoped = false;
    return std::make_shared<const world::Fixture>(on_all);
  }

  void add_shape(const VrmlNode& node, const std::string& name, world::PhysicalObject& object) {
    GeometryPlan& plan = geometries_[std::size_t(node.geometry)];
    if (!plan.shape) {
      const world::GeometryPointer made =
          make_shape(*scene_.geometries()->Get(std::uint32_t(node.geometry)), plan.shows_picture);
      plan.shape = made ? design_.add(made) : GeometryId{};
    }
    if (node.appearance < 0 || !scene_.appearances()->Get(std::uint32_t(node.appearance))->lit())
      findings_.add(kUnlit, name);
    if (node.appearance >= 0) object.material = material(std::size_t(node.appearance));
    object.geometry = *plan.shape;
  }

  world::GeometryPointer make_shape(const flat::Geometry& geometry, bool shows_picture) {
    if (geometry.kind() == flat::GeometryKind::Mesh) return mesh_of_file(geometry);
    if (!memory_.has_room(most_bytes_of(geometry))) return nullptr;
    return shape_of(geometry, reader_, shows_picture, findings_, time_budget_);
  }

  world::GeometryPointer mesh_of_file(const flat::Geometry& geometry) {
    VrmlMeshNode node;
    node.name = reader_.text(geometry.name());
    node.base = reader_.text(geometry.base());
    node.unit = geometry.unit();
    node.package = reader_.text(geometry.text());
    if (geometry.urls()) {
      for (const flat::String* url : *geometry.urls()) node.urls.push_back(reader_.text(url->text()));
    }
    return reader_.fault().empty() ? meshes_.shape_of(node) : nullptr;
  }

  /// None for an appearance that is nothing but the default.
  MaterialId material(std::size_t index) {
    AppearancePlan& plan = appearances_[index];
    if (plan.material) return *plan.material;
    const flat::Appearance& appearance = *scene_.appearances()->Get(std::uint32_t(index));
    plan.material = MaterialId{};
    if (!appearance.lit() && appearance.picture() < 0) return *plan.material;
    world::Material made = material_of(appearance, reader_, findings_);
    if (made.name == kNoMaterial) return *plan.material;
    if (appearance.picture() >= 0) made.texture = texture(std::uint32_t(appearance.picture()));
    if (made.texture) made.picture_frame = picture_frame_of(appearance, reader_, findings_);
    plan.material = design_.add(std::move(made));
    return *plan.material;
  }

  world::TextureId texture(std::uint32_t index) {
    const auto [place, fresh] = textures_.try_emplace(index);
    if (!fresh) return place->second;
    const flat::Picture& from = *scene_.pictures()->Get(index);
    std::optional<world::Texture> made = from.urls() ? texture_of_file(from) : texture_of_pixels(from);
    if (!made) return {};
    made->repeats = {from.repeat_s(), from.repeat_t()};
    // One file is one texture, unless its repetition differs.
    const auto [known, unknown] = known_textures_.try_emplace({made->bytes.get(), made->repeats});
    if (unknown) known->second = design_.add(std::move(*made));
    place->second = known->second;
    return known->second;
  }

  std::optional<world::Texture> texture_of_file(const flat::Picture& from) {
    std::vector<std::string> urls;
    for (const flat::String* url : *from.urls()) urls.push_back(reader_.text(url->text()));
    const std::string base = reader_.text(from.base());
    return reader_.fault().empty() ? pictures_.from_file(base, urls) : std::nullopt;
  }

  std::optional<world::Texture> texture_of_pixels(const flat::Picture& from) {
    const std::string_view pixels = from.pixels() ? reader_.view(*from.pixels()) : std::string_view();
    return pictures_.from_pixels({from.width(), from.height(), from.channels(), pixels});
  }

  void add_scenes() {
    if (std::all_of(nodes_.begin(), nodes_.end(), [](const VrmlNode& node) { return node.is_object; }))
      return;
    const auto by_name = objects_by_def();
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].is_object) continue;
      const flat::Node& from = *scene_.nodes()->Get(std::uint32_t(i));
      const std::string name = reader_.text(from.scene());
      std::vector<ObjectId> members;
      std::unordered_set<ObjectId> known;
      std::size_t missing = 0;
      if (from.members()) {
        for (const flat::String* member : *from.members()) {
          const auto found = by_name.find(reader_.text(member->text()));
          if (found == by_name.end())
            ++missing;
          else if (known.insert(found->second).second)
            members.push_back(found->second);
        }
      }
      if (missing > 0) findings_.add(kNoMember, name, missing);
      if (reader_.fault().empty()) design_.add_scene(name, members);
    }
  }

  /// By DEF name, the node with the name itself rather than through USE.
  std::unordered_map<std::string, ObjectId> objects_by_def() const {
    std::unordered_map<std::string, ObjectId> result;
    for (const bool reused : {false, true}) {
      for (std::size_t i = 0; i < nodes_.size(); ++i) {
        if (nodes_[i].reused == reused && !nodes_[i].def.empty() && objects_[i])
          result.try_emplace(nodes_[i].def, objects_[i]);
      }
    }
    return result;
  }

  void add_scripts() {
    for (const VrmlScript& script : sources_.scripts) {
      world::PhysicalObject object;
      object.name = script.name;
      object.fixture = std::make_shared<const world::Fixture>(world::Inert{"Script", script.source});
      design_.add(std::move(object));
    }
  }

  const VrmlSources& sources_;
  const flat::Scene& scene_;
  world::FlatReader& reader_;
  io::TimeBudget& time_budget_;
  io::MemoryBudget& memory_;
  Findings findings_;
  std::vector<Remark> notes_;
  VrmlPictures pictures_;
  VrmlMeshes meshes_;
  DesignBuilder design_;
  std::vector<VrmlNode> nodes_;
  std::vector<bool> with_children_;  // nodes that have objects below them
  std::vector<AppearancePlan> appearances_;
  std::vector<GeometryPlan> geometries_;
  std::vector<world::MotionPointer> motions_;                     // null: not made yet
  std::vector<ObjectId> objects_;                                 // of the nodes
  std::unordered_map<std::uint32_t, world::TextureId> textures_;  // of the pictures that are used
  std::map<std::pair<const std::string*, std::array<bool, 2>>, world::TextureId> known_textures_;
};

}  // namespace

Result<LoadedDesign> build_vrml(std::string_view answer, const VrmlSources& sources,
                                io::TimeBudget& time_budget, io::MemoryBudget& memory, VrmlMoving* moving) {
  world::FlatReader reader(answer);
  const flat::Scene* const scene = verified(reader);
  if (!scene)
    return base::fail(
        fmt::format("{}: the process that reads VRML gave an answer that is damaged", sources.name));
  if (scene->error() && scene->error()->size() > 0)
    return base::fail(
        fmt::format("{}: {}", sources.name, scene->error()->string_view().substr(0, kLongestNote)));
  if (moving) *moving = what_moves(*scene, reader);
  return VrmlBuilder(sources, *scene, reader, time_budget, memory).build();
}

}  // namespace icome::files
