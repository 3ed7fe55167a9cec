#include "sample_worlds.h"

#include <array>
#include <cmath>

#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::benchmarks {

using namespace world;

namespace {

GeometryPointer box_of(double size) {
  return std::make_shared<PrimitiveGeometry>(geometry::Box{Vector3::Constant(size)});
}

Affine3 place(std::size_t number) {
  return Affine3(Eigen::Translation3d(double(number % 100), double(number / 100), 0.0));
}

}  // namespace

World flat_world(std::size_t objects) {
  World world;
  IdSource ids;
  for (std::size_t i = 0; i < objects; ++i)
    must(apply(world, CreateObject{ids.next<ObjectId>(), i, {.name = "object " + std::to_string(i)}}));
  return world;
}

World grouped_world(std::size_t objects, bool own_shapes) {
  constexpr std::size_t kShapes = 100, kMaterials = 10, kGroup = 100;
  World world;
  IdSource ids;
  std::vector<GeometryId> shapes;
  std::vector<MaterialId> materials;
  for (std::size_t i = 0; i < (own_shapes ? objects : kShapes); ++i) {
    shapes.push_back(ids.next<GeometryId>());
    must(apply(world, CreateGeometry{shapes.back(), box_of(0.001 * double(i + 1))}));
  }
  for (std::size_t i = 0; i < kMaterials; ++i) {
    materials.push_back(ids.next<MaterialId>());
    must(apply(world, CreateMaterial{materials.back(), {.name = "material " + std::to_string(i)}}));
  }
  ObjectId parent;
  for (std::size_t i = 0; i < objects; ++i) {
    const ObjectId id = ids.next<ObjectId>();
    const bool is_group = i % kGroup == 0;
    if (is_group) parent = {};
    const std::size_t row = parent ? world.find(parent)->children.size() : world.roots().size();
    must(apply(world, CreateObject{id,
                                   row,
                                   {.name = "object " + std::to_string(i),
                                    .parent = parent,
                                    .parent_from_object = place(i),
                                    .geometry = shapes[i % shapes.size()],
                                    .material = materials[i % kMaterials]}}));
    if (is_group) parent = id;
  }
  return world;
}

GeometryPointer grid_mesh(std::size_t squares, double height) {
  geometry::TriangleMesh mesh;
  const std::size_t side = squares + 1;
  for (std::size_t i = 0; i < side * side; ++i) {
    const double x = double(i % side), y = double(i / side);
    mesh.positions.emplace_back(x, y, height * std::sin(x) * std::cos(y));
  }
  for (std::size_t i = 0; i < squares * squares; ++i) {
    const auto corner = std::uint32_t(i / squares * side + i % squares);
    const auto above = std::uint32_t(corner + side);
    mesh.triangles.push_back({corner, corner + 1, above});
    mesh.triangles.push_back({corner + 1, above + 1, above});
  }
  return std::make_shared<MeshGeometry>(std::move(mesh));
}

WorkFolder::WorkFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "icome_world_XXXXXX").string();
  const char* made = ::mkdtemp(pattern.data());
  if (made == nullptr) std::abort();
  path_ = made;
}

}  // namespace icome::benchmarks
