#include "files/shown_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "files/exact_looks.h"
#include "io/file_ending.h"

namespace icome::files {
namespace {

using world::Colour;
using world::MeshGeometry;
using world::ObjectId;
using world::PhysicalObject;
using world::World;
using MadeTriangles = base::Result<std::shared_ptr<const MeshGeometry>>;

const char* const kNothingOfIt =
    "no triangles stand for it: it is empty, or nothing of it is large enough to be found.";

/// The longest side of its bounds; 1 for unlimited shapes, whose triangles() fails anyway.
double size_of(const world::Geometry& shape) {
  const double longest = shape.bounds().sizes().maxCoeff();
  return std::isfinite(longest) && longest > 0.0 ? longest : 1.0;
}

bool has_colours(const World& world, const std::vector<ShownObject>& objects) {
  return std::any_of(objects.begin(), objects.end(), [&](const ShownObject& it) {
    return !it.mesh->colours.empty() || world.find(it.object)->material;
  });
}

/// Is the recipe that of a picture projected on a mesh, without information on the shape?
bool tells_of_a_picture(std::string_view recipe) {
  const auto said = nlohmann::json::parse(recipe, nullptr, false);
  return said.is_object() && said.value("op", nlohmann::json()) == "texture";
}

/// Adds the meshes of objects to one.
class Flattening {
 public:
  Flattening(const World& world, bool with_colours) : world_(world), with_colours_(with_colours) {}

  void reserve(const std::vector<ShownObject>& objects) {
    std::size_t positions = 0;
    std::size_t triangles = 0;
    for (const ShownObject& it : objects) {
      positions += it.mesh->mesh.positions.size();
      triangles += it.mesh->mesh.triangles.size();
    }
    flat_.mesh.positions.reserve(positions);
    flat_.mesh.triangles.reserve(triangles);
  }

  void add(const ShownObject& it) {
    const auto first = std::uint32_t(flat_.mesh.positions.size());
    for (const auto& position : it.mesh->mesh.positions)
      flat_.mesh.positions.push_back(it.world_from_object * position);
    const bool mirrored = it.world_from_object.linear().determinant() < 0.0;
    const std::size_t first_triangle = flat_.mesh.triangles.size();
    for (geometry::TriangleMesh::Triangle triangle : it.mesh->mesh.triangles) {
      for (std::uint32_t& corner : triangle) corner += first;
      flat_.mesh.triangles.push_back(triangle);
    }
    if (with_colours_) add_colours(it, first, first_triangle);
    if (!mirrored) return;
    for (std::size_t t = first_triangle; t < flat_.mesh.triangles.size(); ++t)
      std::swap(flat_.mesh.triangles[t][1], flat_.mesh.triangles[t][2]);
  }

  FlatWorld take() { return std::move(flat_); }

 private:
  void add_colours(const ShownObject& it, std::uint32_t first, std::size_t first_triangle) {
    const world::Material* const material = world_.find(world_.find(it.object)->material);
    flat_.colours.resize(flat_.mesh.positions.size(), (material ? *material : world::Material{}).diffuse);
    if (it.mesh->colours.empty()) return;
    // The first colour of a vertex stays with it; each further one gets a vertex of its own.
    std::vector<bool> coloured(flat_.mesh.positions.size() - first, false);
    std::map<std::pair<std::uint32_t, Colour>, std::uint32_t> others;
    for (std::size_t t = 0; t < it.mesh->colours.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        std::uint32_t& corner = flat_.mesh.triangles[first_triangle + t][i];
        const Colour& colour = it.mesh->colours[t][i];
        if (!coloured[corner - first]) {
          coloured[corner - first] = true;
          flat_.colours[corner] = colour;
        } else if (flat_.colours[corner] != colour) {
          const auto [other, is_new] = others.try_emplace({corner, colour}, flat_.mesh.positions.size());
          if (is_new) {
            flat_.mesh.positions.push_back(base::Vector3(flat_.mesh.positions[corner]));
            flat_.colours.push_back(colour);
          }
          corner = other->second;
        }
      }
    }
  }

  const World& world_;
  bool with_colours_;
  FlatWorld flat_;
};

std::size_t count_exact_shapes(const World& world, const std::vector<ShownObject>& shown) {
  std::unordered_set<world::GeometryId> exact;
  for (const ShownObject& it : shown) {
    const world::GeometryId geometry = world.find(it.object)->geometry;
    if (world.find(geometry)->shape->kind() != "mesh") exact.insert(geometry);
  }
  return exact.size();
}

void remark_on_losses(const World& world, const std::vector<ShownObject>& shown,
                      std::vector<Remark>& remarks) {
  std::size_t fixtures = 0;
  std::size_t motions = 0;
  std::size_t clones = 0;
  const std::size_t exact = count_exact_shapes(world, shown);
  bool nested = false;
  for (const auto& [id, object] : world.objects()) {
    fixtures += object.fixture ? 1 : 0;
    motions += object.motion ? 1 : 0;
    nested = nested || object.parent;
  }
  for (const auto& [id, geometry] : world.geometries()) {
    clones += geometry.users > 1 ? geometry.users - 1 : 0;
  }
  const auto tell = [&](std::string text) { remarks.push_back({{}, 0, std::move(text)}); };
  if (nested) tell("This format knows no hierarchy: all objects are written where they stand in the world.");
  if (clones > 0)
    tell(fmt::format("This format shares no shapes: {} written out as copies.",
                     clones == 1 ? "1 clone is" : fmt::format("{} clones are", clones)));
  if (exact > 0)
    tell(fmt::format("{} written as triangles.",
                     exact == 1 ? "1 exact shape is" : fmt::format("{} exact shapes are", exact)));
  for (Remark& it : lost_recipes(world, "This format")) remarks.push_back(std::move(it));
  if (fixtures > 0) tell("This format knows no lights, viewpoints or scripts: they are left out.");
  if (motions > 0)
    tell(fmt::format("This format knows no motions: {} left out.",
                     motions == 1 ? "1 is" : fmt::format("{} are", motions)));
  if (!world.scenes().empty()) tell("This format knows no scenes: they are left out.");
}

/// Remarks on the colours of solids' parts, for formats that do not keep these solids exactly.
void tell_of_part_colours(const World& world, bool keeps_colours, std::vector<Remark>& remarks) {
  bool coloured = false, clear = false;
  for (const auto& [id, geometry] : world.geometries()) {
    coloured = coloured || (geometry.users > 0 && has_part_colours(*geometry.shape));
    clear = clear || (geometry.users > 0 && has_clear_parts(*geometry.shape));
  }
  if (coloured && !keeps_colours)
    remarks.push_back({{}, 0, "This format knows no colours: those of parts of solids are left out."});
  if (clear && keeps_colours)
    remarks.push_back({{}, 0, "Colours of parts of solids are written without their opacity."});
}

/// The triangles of exact shapes with their looks, made once for all objects that look alike.
class ExactLooks {
 public:
  explicit ExactLooks(const World& world) : world_(world) {}

  std::shared_ptr<const MeshGeometry> of(const PhysicalObject& object,
                                         std::shared_ptr<const MeshGeometry> triangles) {
    const world::Geometry& shape = *world_.find(object.geometry)->shape;
    const world::Material* const material = world_.find(object.material);
    const Colour own =
        has_part_colours(shape) ? (material ? *material : world::Material{}).diffuse : Colour{};
    const auto [found, is_new] = made_.try_emplace({&shape, own});
    if (is_new) found->second = with_exact_looks(shape, std::move(triangles), own);
    return found->second;
  }

 private:
  const World& world_;
  std::map<std::pair<const world::Geometry*, Colour>, std::shared_ptr<const MeshGeometry>> made_;
};

}  // namespace

std::string object_name(const PhysicalObject& object) {
  return object.name.empty() ? "An object without a name" : fmt::format("\"{}\"", object.name);
}

std::vector<Remark> lost_recipes(const World& world, std::string_view format) {
  std::size_t made = 0, pictured = 0;
  for (const auto& [id, geometry] : world.geometries()) {
    const std::string_view recipe = world::recipe_of(*geometry.shape);
    if (geometry.users > 0 && !recipe.empty()) ++(tells_of_a_picture(recipe) ? pictured : made);
  }
  std::vector<Remark> remarks;
  if (made > 0)
    remarks.push_back({{},
                       0,
                       fmt::format("{} knows no parameters of shapes: {} as triangles.", format,
                                   made == 1 ? "1 shape stays" : fmt::format("{} shapes stay", made))});
  if (pictured > 0)
    remarks.push_back({{},
                       0,
                       fmt::format("{} does not keep where pictures were thrown on {} from.", format,
                                   pictured == 1 ? "1 mesh" : fmt::format("{} meshes", pictured))});
  return remarks;
}

bool shows_nothing(const World& world) {
  return std::none_of(world.objects().begin(), world.objects().end(), [&](const auto& it) {
    const world::GeometryObject* const geometry = world.find(it.second.geometry);
    if (geometry == nullptr) return false;
    const auto* const mesh = dynamic_cast<const MeshGeometry*>(geometry->shape.get());
    return mesh ? !mesh->mesh.triangles.empty() : !geometry->shape->bounds().isEmpty();
  });
}

MadeTriangles shown_triangles(const world::Geometry& shape) {
  // Relative to the shape's size. Sampling a solid takes time by its third power.
  const double finest = shape.kind() == "csg" || shape.kind() == "implicit" ? 1.0 / 28.0 : 1.0 / 500.0;
  constexpr double kCoarser = 2.0;
  constexpr std::size_t kEnough = 8000;
  constexpr int kMostTries = 5;
  if (shape.bounds().isEmpty()) return std::make_shared<const MeshGeometry>(geometry::TriangleMesh{});
  double tolerance = finest * size_of(shape);
  auto best = shape.triangles(tolerance);
  for (int i = 1; best && (*best)->mesh.triangles.size() > kEnough && i < kMostTries; ++i) {
    tolerance *= kCoarser;
    auto made = shape.triangles(tolerance);
    // Solids lose parts when they get too coarse, and do not shrink beyond some size.
    if (!made || (*made)->mesh.triangles.size() >= (*best)->mesh.triangles.size()) break;
    best = std::move(made);
  }
  return best;
}

ShownShapes::Maker written_triangles(const std::filesystem::path& path) {
  static constexpr std::array<std::string_view, 4> kFlat{".obj", ".ply", ".stl", ".off"};
  const io::FileEnding ending = io::ending_of(path);
  return std::find(kFlat.begin(), kFlat.end(), ending.type) != kFlat.end() ? fine_triangles : shown_triangles;
}

MadeTriangles fine_triangles(const world::Geometry& shape) {
  if (shape.bounds().isEmpty()) return std::make_shared<const MeshGeometry>(geometry::TriangleMesh{});
  // Contoured solids take a cell of this size, and their triangles are nearer than that.
  const bool contoured = shape.kind() == "csg" || shape.kind() == "implicit";
  return shape.triangles((contoured ? 1.0 / 100.0 : 1.0 / 500.0) * size_of(shape));
}

std::shared_ptr<const MeshGeometry> ShownShapes::triangles(world::GeometryId id) {
  const world::Geometry* const shape = world_.find(id)->shape.get();
  const auto [found, is_new] = shown_.try_emplace(shape);
  if (!is_new) return found->second;
  auto made = make_(*shape);
  if (!made) {
    refusals_[shape] = made.error().message;
  } else if ((*made)->mesh.triangles.empty() && shape->kind() != "mesh") {
    refusals_[shape] = kNothingOfIt;
  } else {
    found->second = std::move(*made);
  }
  return found->second;
}

base::Result<std::vector<ShownObject>> shown_objects(const World& world, bool with_looks,
                                                     std::vector<Remark>& remarks) {
  struct Visit {
    ObjectId object;
    base::Affine3 world_from_parent;
  };
  ShownShapes shapes(world, fine_triangles);
  ExactLooks looks(world);
  std::vector<ShownObject> shown;
  std::size_t triangles = 0;
  std::string refusal;  // of the first object that has something but no triangles
  std::vector<Visit> open;
  const auto enter = [&](const std::vector<ObjectId>& row, const base::Affine3& world_from_parent) {
    for (auto id = row.rbegin(); id != row.rend(); ++id) open.push_back({*id, world_from_parent});
  };
  enter(world.roots(), base::Affine3::Identity());
  while (!open.empty()) {
    const Visit visit = open.back();
    open.pop_back();
    const PhysicalObject& object = *world.find(visit.object);
    const base::Affine3 here = visit.world_from_parent * object.parent_from_object;
    enter(object.children, here);
    if (!object.geometry) continue;
    if (auto mesh = shapes.triangles(object.geometry)) {
      triangles += mesh->mesh.triangles.size();
      if (triangles > kMostShownTriangles) {
        return base::fail(
            fmt::format("The design has more than {} triangles when clones are written out: choose a format "
                        "that shares shapes, such as .wrl or .glb.",
                        kMostShownTriangles));
      }
      if (with_looks) mesh = looks.of(object, std::move(mesh));
      shown.push_back({visit.object, std::move(mesh), here});
    } else {
      const std::string& why = shapes.why(object.geometry);
      if (why != kNothingOfIt && refusal.empty()) refusal = why;
      remarks.push_back({{}, 0, fmt::format("{} is left out: {}", object_name(object), why)});
    }
  }
  if (shown.empty() && !refusal.empty()) return base::fail("Nothing would be left of the design. " + refusal);
  remark_on_losses(world, shown, remarks);
  tell_of_part_colours(world, with_looks, remarks);
  return shown;
}

FlatWorld flatten(const World& world, const std::vector<ShownObject>& objects, bool with_colours) {
  Flattening flattening(world, with_colours && has_colours(world, objects));
  flattening.reserve(objects);
  for (const ShownObject& object : objects) flattening.add(object);
  return flattening.take();
}

}  // namespace icome::files
