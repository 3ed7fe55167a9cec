#include "render/csg/csg_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/decompositions.h"
#include "geometry/csg/csg_normal_form.h"
#include "geometry/mesh/weld.h"

namespace icome::render {
namespace {

using base::Bounds;
using base::Matrix3;
using base::Vector3;
using geometry::CsgFactor;
using geometry::CsgLeaf;
using geometry::CsgProduct;
using geometry::CsgTree;
using geometry::TriangleMesh;

/// Difference in growth of neighbours in rank, as a share of the solid's radius: well above the
/// resolution of a depth buffer of 24 bits, well below that of a picture.
constexpr double kApart = 4e-5;

charts::Colour colour_of(const CsgTree::Colour& c) { return {c[0], c[1], c[2]}; }

struct Ball {
  Vector3 centre;
  double radius;
};

/// A half-space as far as the ball can tell: a block under its plane.
TriangleMesh half_space_block(const CsgLeaf& leaf, const Ball& ball) {
  const Vector3 normal = (leaf.shape_from_tree().linear().transpose() * Vector3::UnitZ()).stableNormalized();
  const double height = normal.dot(ball.centre - leaf.tree_from_shape().translation());
  const Vector3 foot = ball.centre - height * normal;
  const double reach = 2.0 * ball.radius;
  const double depth = std::max(reach, reach - height);
  const Vector3 x = normal.unitOrthogonal();
  const Vector3 y = normal.cross(x);
  TriangleMesh block;
  for (const double z : {-depth, 0.0}) {
    for (const double v : {-reach, reach}) {
      for (const double u : {-reach, reach}) block.positions.push_back(foot + u * x + v * y + z * normal);
    }
  }
  block.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return block;
}

const geometry::Primitive* primitive_of(const CsgLeaf& leaf) {
  return std::get_if<geometry::Primitive>(&leaf.shape());
}

TriangleMesh mesh_of(const CsgLeaf& leaf, const Ball& ball, double tolerance) {
  const geometry::Primitive* primitive = primitive_of(leaf);
  if (primitive && std::holds_alternative<geometry::Plane>(*primitive)) return half_space_block(leaf, ball);
  TriangleMesh mesh = leaf.tessellate(tolerance * ball.radius);
  geometry::weld_equal(mesh);  // faces that only touch would part when they grow
  return mesh;
}

std::optional<unsigned> layers_of(const CsgLeaf& leaf) {
  const geometry::Primitive* primitive = primitive_of(leaf);
  if (!primitive) return std::nullopt;
  return std::holds_alternative<geometry::Torus>(*primitive) ? 2 : 1;
}

/// The planes at a vertex: sums of n nT and n, weighted by area.
struct VertexPlanes {
  Matrix3 squares = Matrix3::Zero();
  Vector3 normals = Vector3::Zero();
};

/// The step that takes all planes at a vertex outward by 1, as nearly as it can and not much farther.
Vector3 step_outward(const VertexPlanes& planes) {
  const base::SymmetricEigen eigen = base::symmetric_eigen(planes.squares);
  const double largest = eigen.values[2];
  if (!(largest > 0.0)) return Vector3::Zero();
  Vector3 step = Vector3::Zero();
  for (int i = 0; i < 3; ++i) {
    const double value = eigen.values[i];
    const Vector3 axis = eigen.vectors.col(i);
    if (value > 0.02 * largest) step += axis.dot(planes.normals) / value * axis;
  }
  constexpr double kFarthest = 4.0;
  return step.norm() > kFarthest ? Vector3(kFarthest * step.normalized()) : step;
}

void grow(TriangleMesh& mesh, double distance) {
  std::vector<VertexPlanes> planes(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 u = mesh.corner(t, 1) - mesh.corner(t, 0);
    const Vector3 v = mesh.corner(t, 2) - mesh.corner(t, 0);
    const Vector3 normal = u.stableNormalized().cross(v.stableNormalized()).stableNormalized();
    const double weight = u.norm() * v.norm();
    for (const std::uint32_t index : mesh.triangles[t]) {
      planes[index].squares += weight * normal * normal.transpose();
      planes[index].normals += weight * normal;
    }
  }
  for (std::size_t i = 0; i < planes.size(); ++i) mesh.positions[i] += distance * step_outward(planes[i]);
}

CsgOperand make_operand(const CsgFactor& factor, TriangleMesh mesh, double growth, const Ball& ball,
                        const CsgGeometryOptions& options) {
  grow(mesh, growth);
  CsgOperand operand;
  operand.mesh = make_shading_mesh(mesh, options.crease_angle);
  change_frame(operand.mesh, ball.centre, ball.radius);
  for (const ShadingMesh::Vertex& vertex : operand.mesh.vertices) {
    operand.bounds.extend(vertex.position.cast<double>());
  }
  operand.subtracted = factor.subtracted;
  operand.layers = layers_of(factor.leaf);
  if (factor.colour) operand.colour = colour_of(*factor.colour);
  return operand;
}

/// Is a point of one operand's surface on the surface of the product?
bool shows(const CsgProduct& product, const CsgFactor& own, const Vector3& point) {
  return std::all_of(product.begin(), product.end(), [&](const CsgFactor& other) {
    return &other == &own || other.leaf.inside(point) != other.subtracted;
  });
}

/// Calls `visit` on points of the triangle about `spacing` apart, its corners among them.
template <typename Visit>
void spread_over(const std::array<Vector3, 3>& corners, double spacing, Visit&& visit) {
  constexpr double kMost = 100.0;  // rows, and points in one
  std::size_t apex = 0;            // the corner opposite the shortest side
  double shortest = INFINITY;
  for (std::size_t k = 0; k < 3; ++k) {
    const double side = (corners[(k + 1) % 3] - corners[(k + 2) % 3]).norm();
    if (side < shortest) {
      shortest = side;
      apex = k;
    }
  }
  const Vector3& a = corners[apex];
  const Vector3& b = corners[(apex + 1) % 3];
  const Vector3& c = corners[(apex + 2) % 3];
  const double rows = std::clamp(std::ceil((b - a).norm() / spacing), 1.0, kMost);
  for (double row = 0.0; row <= rows; ++row) {
    const double s = row / rows;
    const double steps = std::clamp(std::ceil(s * shortest / spacing), 1.0, kMost);
    for (double i = 0.0; i <= steps; ++i) visit(Vector3(a + s * (b - a) + s * i / steps * (c - b)));
  }
}

void add_surface(std::vector<Vector3>& surface, const CsgProduct& product, const CsgFactor& own,
                 const TriangleMesh& mesh, const Ball& ball) {
  const Bounds around(ball.centre.array() - ball.radius, ball.centre.array() + ball.radius);
  constexpr std::size_t kTrianglesJudged = 6'000;
  const std::size_t stride = 1 + mesh.triangles.size() / kTrianglesJudged;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += stride) {
    const TriangleMesh::Triangle& t = mesh.triangles[i];
    const std::array<Vector3, 3> corners{mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
    spread_over(corners, 0.04 * ball.radius, [&](const Vector3& point) {
      if (around.contains(point) && shows(product, own, point)) surface.push_back(point);
    });
  }
}

base::Result<void> check(const Bounds& box, std::size_t operands, const CsgGeometryOptions& options) {
  if (!box.min().allFinite() || !box.max().allFinite()) {
    return base::fail("a solid without bounds cannot be drawn; intersect it with a box");
  }
  if (operands > options.max_operands) {
    return base::fail(
        fmt::format("its normal form has {} operands, more than the {} that are drawn as images", operands,
                    options.max_operands));
  }
  return {};
}

std::size_t count_operands(const std::vector<CsgProduct>& products) {
  std::size_t sum = 0;
  for (const CsgProduct& product : products) sum += product.size();
  return sum;
}

/// Growth of a product in steps, 0 ... 1: where faces of two products coincide, the first's lie outside.
double preference(std::size_t product, std::size_t products) {
  return static_cast<double>(products - product - 1) / static_cast<double>(products);
}

class GeometryMaker {
 public:
  GeometryMaker(const Ball& ball, const CsgGeometryOptions& options) : ball_(ball), options_(options) {
    made_.centre = ball.centre;
    made_.radius = ball.radius;
  }

  /// `steps`: the growth of the product's first operand.
  base::Result<void> add(const CsgProduct& product, double steps) {
    const auto intersected = static_cast<double>(
        std::count_if(product.begin(), product.end(), [](const CsgFactor& f) { return !f.subtracted; }));
    CsgOperands& drawn = made_.products.emplace_back();
    double rank = 0.0;
    for (const CsgFactor& factor : product) {
      TriangleMesh mesh = mesh_of(factor.leaf, ball_, options_.tolerance);
      triangles_ += mesh.triangles.size();
      if (triangles_ > options_.max_triangles) {
        return base::fail(fmt::format("its operands have more than {} triangles", options_.max_triangles));
      }
      add_surface(made_.surface, product, factor, mesh, ball_);
      // Every subtracted operand reaches beyond all that are intersected.
      const double own = steps + (factor.subtracted ? intersected : rank++);
      drawn.push_back(make_operand(factor, std::move(mesh), own * kApart * ball_.radius, ball_, options_));
    }
    return {};
  }

  CsgGeometry take() { return std::move(made_); }

 private:
  const Ball ball_;
  const CsgGeometryOptions& options_;
  CsgGeometry made_;
  std::size_t triangles_ = 0;
};

}  // namespace

Matrix4 CsgGeometry::tree_from_buffer() const {
  Matrix4 m = Matrix4::Identity();
  m.topLeftCorner<3, 3>() *= radius;
  m.topRightCorner<3, 1>() = centre;
  return m;
}

std::size_t CsgGeometry::operand_count() const {
  std::size_t sum = 0;
  for (const CsgOperands& product : products) sum += product.size();
  return sum;
}

std::size_t CsgGeometry::triangle_count() const {
  std::size_t sum = 0;
  for (const CsgOperands& product : products) {
    for (const CsgOperand& operand : product) sum += operand.mesh.indices.size() / 3;
  }
  return sum;
}

base::Result<CsgGeometry> make_csg_geometry(const CsgTree& tree, const CsgGeometryOptions& options) {
  geometry::NormaliseOptions limits;
  limits.max_nodes = 4 * options.max_operands;
  const auto normal = geometry::normalise(tree, geometry::CsgForm::Normal, limits);
  if (!normal) return base::fail(normal.error().message);
  const std::vector<CsgProduct> products = geometry::products(normal->tree);
  const Bounds box = geometry::bounds(normal->tree);
  if (products.empty() || box.isEmpty()) return CsgGeometry{};
  const auto good = check(box, count_operands(products), options);
  if (!good) return base::fail(good.error().message);
  const double half = 0.5 * box.sizes().stableNorm();
  GeometryMaker maker({0.5 * box.min() + 0.5 * box.max(), half > 0.0 ? half : 1.0}, options);
  for (std::size_t p = 0; p < products.size(); ++p) {
    const auto added = maker.add(products[p], preference(p, products.size()));
    if (!added) return base::fail(added.error().message);
  }
  return maker.take();
}

}  // namespace icome::render
