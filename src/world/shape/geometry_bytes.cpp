#include "world/shape/geometry_bytes.h"

#include <flatbuffers/flatbuffers.h>
#include <fmt/format.h>
#include <geometry_generated.h>

#include <algorithm>
#include <unordered_map>

#include "world/edit/flat_bytes.h"
#include "world/shape/geometry_check.h"

namespace icome::world {
namespace {

using base::fail;
using base::Result;
using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;
using geometry::CsgTree;

// ---- Writing ------------------------------------------------------------------------------------------

template <typename Number, typename Item>
Offset<flatbuffers::Vector<Number>> written(FlatBufferBuilder& builder, const std::vector<Item>& items) {
  static_assert(sizeof(Item) % sizeof(Number) == 0);
  if (items.empty()) return 0;
  const std::size_t bytes = items.size() * sizeof(Item);
  const auto* numbers = reinterpret_cast<const Number*>(items.data());
  return builder.CreateVector(numbers, bytes / sizeof(Number));
}

Offset<flat::Mesh> written(FlatBufferBuilder& builder, const geometry::TriangleMesh& mesh) {
  const auto positions = written<double>(builder, mesh.positions);
  const auto triangles = written<std::uint32_t>(builder, mesh.triangles);
  return flat::CreateMesh(builder, positions, triangles);
}

template <typename Table>
std::string finished(FlatBufferBuilder& builder, Offset<Table> table) {
  builder.Finish(table);
  return {reinterpret_cast<const char*>(builder.GetBufferPointer()), builder.GetSize()};
}

tl::unexpected<base::Error> too_large() {
  return fail(fmt::format("A shape of more than {} MB cannot be written: divide it.", kMostFlatBytes >> 20));
}

/// Writes the nodes of a tree, and each mesh among them once.
class CsgWriter {
 public:
  Result<std::string> write(const CsgTree& tree) {
    CsgNodeCheck check(tree.size());
    for (CsgTree::Index i = 0; i < tree.size(); ++i) {
      const CsgTree::Node& node = tree.node(i);
      if (std::string why = check.complaint(i, node); !why.empty()) return fail(std::move(why));
      if (const auto good = add(node); !good) return tl::unexpected(good.error());
    }
    const auto nodes = builder_.CreateVector(nodes_);
    const auto meshes = builder_.CreateVector(meshes_);
    return finished(builder_, flat::CreateCsg(builder_, nodes, meshes, tree.empty() ? 0 : tree.root()));
  }

 private:
  Result<void> add(const CsgTree::Node& node) {
    Offset<flatbuffers::String> text;
    std::uint32_t mesh = 0;
    auto kind = flat::NodeKind(int(flat::NodeKind::Union) + int(node.op));
    if (node.is_leaf) {
      if (std::holds_alternative<std::shared_ptr<const geometry::CsgPrimitive>>(*node.shape))
        return fail(
            fmt::format("\"{}\" in a CSG tree is a shape of your own, which cannot be written: make it "
                        "a mesh first.",
                        geometry::shape_name(*node.shape)));
      const auto* solid = std::get_if<std::shared_ptr<const geometry::MeshSolid>>(&*node.shape);
      kind = solid ? flat::NodeKind::Mesh : flat::NodeKind::Primitive;
      if (solid && !has_room_for((*solid)->mesh)) return too_large();
      if (solid) mesh = mesh_number(**solid);
      if (!solid) text = builder_.CreateString(geometry::name(std::get<geometry::Primitive>(*node.shape)));
    }
    if (builder_.GetSize() > kMostFlatBytes) return too_large();
    const auto numbers = frame_numbers(node.parent_from_node);
    const flat::Frame frame(flatbuffers::make_span(numbers));
    const auto paint = node.colour ? flat::Paint(flatbuffers::make_span(*node.colour)) : flat::Paint();
    nodes_.push_back(flat::CreateCsgNode(builder_, kind, &frame, text, mesh, node.left, node.right,
                                         node.colour ? &paint : nullptr));
    return {};
  }

  bool has_room_for(const geometry::TriangleMesh& mesh) const {
    return builder_.GetSize() + mesh.positions.size() * sizeof(Vector3) +
               mesh.triangles.size() * sizeof(geometry::TriangleMesh::Triangle) <=
           kMostFlatBytes;
  }
  std::uint32_t mesh_number(const geometry::MeshSolid& solid) {
    const auto [found, fresh] = numbers_.try_emplace(&solid, std::uint32_t(meshes_.size()));
    if (fresh) meshes_.push_back(written(builder_, solid.mesh));
    return found->second;
  }

  FlatBufferBuilder builder_;
  std::vector<Offset<flat::CsgNode>> nodes_;
  std::vector<Offset<flat::Mesh>> meshes_;
  std::unordered_map<const geometry::MeshSolid*, std::uint32_t> numbers_;
};

// ---- Reading ------------------------------------------------------------------------------------------

constexpr std::size_t kFewestBytesOfTable = 8;  // with the offset that leads to it

/// The table at the root of the bytes if all parts of it lie within them, else null.
template <typename Table>
const Table* root(FlatReader& reader) {
  if (reader.size() <= kMostReadBytes) {
    flatbuffers::Verifier verifier(reader.data(), reader.size(), 8,
                                   flatbuffers::uoffset_t(reader.size() / kFewestBytesOfTable));
    if (verifier.VerifyBuffer<Table>(nullptr)) return flatbuffers::GetRoot<Table>(reader.data());
  }
  reader.refuse("The bytes of a shape are damaged.");
  return nullptr;
}

/// A shape that was read, unless the bytes or the shape are faulty.
template <typename Shape>
Result<GeometryPointer> checked(const FlatReader& reader, Shape shape) {
  if (!reader.fault().empty()) return fail(reader.fault());
  if (std::string why = complaint(shape); !why.empty()) return fail(std::move(why));
  return GeometryPointer(std::make_shared<Shape>(std::move(shape)));
}

geometry::TriangleMesh mesh_of(FlatReader& reader, const flat::Mesh& from) {
  geometry::TriangleMesh mesh;
  mesh.positions = reader.items<Vector3>(from.positions());
  mesh.triangles = reader.items<geometry::TriangleMesh::Triangle>(from.triangles());
  return mesh;
}

geometry::Primitive primitive_of(FlatReader& reader, const flatbuffers::String* from) {
  const std::string text = reader.text(from);
  constexpr std::size_t kLongest = 200;  // three numbers, and errors of a readable length
  if (text.size() <= kLongest) {
    const auto primitive = geometry::parse_primitive(text);
    if (primitive) return *primitive;
    reader.refuse(primitive.error().message);
  }
  reader.refuse("The bytes of a primitive are damaged.");
  return geometry::Plane{};
}

/// Reads a tree; no further function is called once there is a fault.
class CsgReader {
 public:
  explicit CsgReader(std::string_view bytes) : reader_(bytes) {}

  Result<GeometryPointer> read() {
    const auto* from = root<flat::Csg>(reader_);
    if (from && from->meshes()) {
      for (const flat::Mesh* mesh : *from->meshes()) add(*mesh);
    }
    if (from && from->nodes()) {
      CsgNodeCheck check(from->nodes()->size());
      tree_.reserve(from->nodes()->size());
      for (const flat::CsgNode* node : *from->nodes()) add(*node, check);
    }
    if (from && from->root() >= std::max<std::size_t>(1, tree_.size()))
      reader_.refuse("The root of a CSG tree is not there.");
    if (!reader_.fault().empty()) return fail(reader_.fault());
    tree_.set_root(from->root());
    return GeometryPointer(std::make_shared<CsgGeometry>(std::move(tree_)));
  }

 private:
  void add(const flat::Mesh& from) {
    geometry::TriangleMesh mesh = mesh_of(reader_, from);
    // Checked before its tree is built, which relies on it.
    reader_.refuse(complaint(mesh));
    if (mesh.triangles.empty()) reader_.refuse("A mesh in a CSG tree needs triangles.");
    if (reader_.fault().empty())
      meshes_.push_back(std::make_shared<const geometry::MeshSolid>(std::move(mesh)));
  }

  void add(const flat::CsgNode& from, CsgNodeCheck& check) {
    if (!reader_.fault().empty()) return;
    const auto index = CsgTree::Index(tree_.size());
    const CsgTree::Node node = node_of(from);
    if (!reader_.fault().empty()) return;
    reader_.refuse(check.complaint(index, node));
    if (!reader_.fault().empty()) return;
    if (node.is_leaf) {
      tree_.add_leaf(*node.shape, node.parent_from_node, node.colour);
    } else {
      tree_.add(node.op, node.left, node.right, node.parent_from_node);
    }
  }

  CsgTree::Node node_of(const flat::CsgNode& from) {
    CsgTree::Node node;
    std::array<double, 12> numbers;
    for (std::uint16_t i = 0; i < 12; ++i) numbers[i] = from.frame()->numbers()->Get(i);
    node.parent_from_node = frame_of(numbers);
    node.is_leaf = from.kind() == flat::NodeKind::Primitive || from.kind() == flat::NodeKind::Mesh;
    if (from.kind() > flat::NodeKind::MAX)
      reader_.refuse("A CSG tree has an operation that is unknown here.");
    if (from.kind() == flat::NodeKind::Primitive) node.shape = primitive_of(reader_, from.primitive());
    if (from.kind() == flat::NodeKind::Mesh && from.mesh() < meshes_.size())
      node.shape = meshes_[from.mesh()];
    if (node.is_leaf && !node.shape) reader_.refuse("A mesh of a CSG tree is not there.");
    if (node.is_leaf && from.paint()) {
      CsgTree::Colour& colour = node.colour.emplace();
      for (std::uint16_t i = 0; i < 4; ++i) colour[i] = from.paint()->parts()->Get(i);
    }
    if (node.is_leaf) return node;
    node.op = geometry::CsgOperator(int(from.kind()) - int(flat::NodeKind::Union));
    node.left = from.left();
    node.right = from.right();
    return node;
  }

  FlatReader reader_;
  std::vector<std::shared_ptr<const geometry::MeshSolid>> meshes_;
  CsgTree tree_;
};

}  // namespace

Result<std::string> MeshGeometry::write() const {
  if (bytes() > kMostFlatBytes) return too_large();
  if (std::string why = complaint(*this); !why.empty()) return fail(std::move(why));
  FlatBufferBuilder builder;
  const auto positions = written<double>(builder, mesh.positions);
  const auto triangles = written<std::uint32_t>(builder, mesh.triangles);
  const auto coordinates = written<double>(builder, texture_coordinates);
  const auto corner_normals = written<double>(builder, normals);
  const auto corner_colours = written<float>(builder, colours);
  const Offset<flatbuffers::String> parameters = recipe.empty() ? 0 : builder.CreateString(recipe);
  return finished(builder, flat::CreateMesh(builder, positions, triangles, coordinates, corner_normals,
                                            corner_colours, parameters));
}

Result<GeometryPointer> read_mesh(std::string_view bytes) {
  FlatReader reader(bytes);
  const auto* from = root<flat::Mesh>(reader);
  if (!from) return fail(reader.fault());
  MeshGeometry shape(mesh_of(reader, *from));
  shape.texture_coordinates = reader.items<std::array<Vector2, 3>>(from->texture_coordinates());
  shape.normals = reader.items<std::array<Vector3, 3>>(from->normals());
  shape.colours = reader.items<std::array<Colour, 3>>(from->colours());
  shape.recipe = reader.text(from->recipe());
  return checked(reader, std::move(shape));
}

Result<std::string> LoopGeometry::write() const {
  if (bytes() > kMostFlatBytes) return too_large();
  if (std::string why = complaint(*this); !why.empty()) return fail(std::move(why));
  FlatBufferBuilder builder;
  const auto mesh = written(builder, control.mesh);
  const auto creases = written<std::uint32_t>(builder, control.creases);
  const auto corners = written<std::uint32_t>(builder, control.corners);
  return finished(builder, flat::CreateLoop(builder, mesh, creases, corners));
}

Result<GeometryPointer> read_loop(std::string_view bytes) {
  FlatReader reader(bytes);
  const auto* from = root<flat::Loop>(reader);
  if (!from) return fail(reader.fault());
  LoopGeometry shape({mesh_of(reader, *from->control()), {}, {}});
  shape.control.creases = reader.items<std::array<std::uint32_t, 2>>(from->creases());
  shape.control.corners = reader.items<std::uint32_t>(from->corners());
  return checked(reader, std::move(shape));
}

Result<std::string> PrimitiveGeometry::write() const {
  if (std::string why = complaint(primitive); !why.empty()) return fail(std::move(why));
  FlatBufferBuilder builder(256);
  const auto text = builder.CreateString(geometry::name(primitive));
  return finished(builder, flat::CreatePrimitive(builder, text, axis == Axis::Y));
}

Result<GeometryPointer> read_primitive(std::string_view bytes) {
  FlatReader reader(bytes);
  const auto* from = root<flat::Primitive>(reader);
  if (!from) return fail(reader.fault());
  const geometry::Primitive primitive = primitive_of(reader, from->text());
  if (!reader.fault().empty()) return fail(reader.fault());
  return GeometryPointer(std::make_shared<PrimitiveGeometry>(primitive, from->along_y() ? Axis::Y : Axis::Z));
}

Result<std::string> CsgGeometry::write() const { return CsgWriter().write(tree); }

Result<GeometryPointer> read_csg(std::string_view bytes) { return CsgReader(bytes).read(); }

Result<std::string> ImplicitGeometry::write() const {
  if (bytes() > kMostFlatBytes) return too_large();
  FlatBufferBuilder builder;
  const auto text = builder.CreateString(formula_);
  const Vector3 low = surface_->box().min(), high = surface_->box().max();
  const flat::Box box(flatbuffers::span<const double, 3>(low.data(), 3),
                      flatbuffers::span<const double, 3>(high.data(), 3));
  return finished(builder, flat::CreateImplicit(builder, text, &box));
}

Result<GeometryPointer> read_implicit(std::string_view bytes) {
  FlatReader reader(bytes);
  const auto* from = root<flat::Implicit>(reader);
  if (!from) return fail(reader.fault());
  const std::string formula = reader.text(from->formula());
  Bounds box;
  for (std::uint16_t i = 0; i < 3; ++i) {
    box.min()[i] = from->box()->low()->Get(i);
    box.max()[i] = from->box()->high()->Get(i);
  }
  if (!reader.fault().empty()) return fail(reader.fault());
  auto shape = ImplicitGeometry::create(formula, box);
  if (!shape) return tl::unexpected(shape.error());
  return GeometryPointer(std::move(*shape));
}

}  // namespace icome::world
