#include "sketch/relief/relief.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "drawing/outline/outline.h"
#include "fonts/outline_union.h"
#include "world/edit/edit.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::sketch {
namespace {

constexpr double kRingTolerance = 2e-5;  // m, by which the rims of ridges are off the true outline
constexpr double kRise = 0.002;          // of a line's height, for each ridge before it
constexpr double kFillShare = 0.3;       // of a line's height, that its fill has
constexpr double kGridSteps = 1 << 25;   // of the grid on which areas are united, across the drawing

/// Brings places on paper onto a grid of whole numbers, and meshes back.
class PaperGrid {
 public:
  explicit PaperGrid(const Drawing& drawing) : middle_(0.5 * drawing.size) {
    const Bounds2 box = drawing.bounds().merged(Bounds2(Vector2::Zero(), drawing.size));
    step_ =
        (box.max() - middle_).cwiseAbs().cwiseMax((box.min() - middle_).cwiseAbs()).maxCoeff() / kGridSteps;
  }

  Vector2 on_grid(const Vector2& place) const {
    const Vector2 whole = (place - middle_) / step_;
    return {std::round(whole.x()), std::round(-whole.y())};  // y turns over: up in a design
  }

  /// A mesh from z = -1/2 to 1/2 over the grid, as a ridge that stands on the paper.
  void to_design(geometry::TriangleMesh& mesh, double height) const {
    for (base::Vector3& at : mesh.positions) at = {step_ * at.x(), step_ * at.y(), height * (at.z() + 0.5)};
  }

 private:
  Vector2 middle_;
  double step_;
};

/// A line of straight pieces near a closed loop of cubics.
std::vector<Vector2> ring_of_loop(const std::vector<CubicBezier>& loop, const PaperGrid& grid) {
  std::vector<Vector2> ring;
  for (const CubicBezier& cubic : loop) {
    // A piece that is an n-th in t leaves its chord by |f''| / (8 n^2) at most.
    const double bend = std::max(cubic.second_derivative(0.0).norm(), cubic.second_derivative(1.0).norm());
    const int pieces = std::max(1, int(std::ceil(std::sqrt(bend / (8.0 * kRingTolerance)))));
    for (int i = 0; i < pieces; ++i) ring.push_back(grid.on_grid(cubic.at(double(i) / pieces)));
  }
  return ring;
}

/// Makes the objects of a design.
class ReliefMaker {
 public:
  ReliefMaker(const Drawing& drawing, const ReliefSettings& settings) : settings_(settings), grid_(drawing) {}

  base::Result<world::World> make(const Drawing& drawing) {
    if (settings_.sheet > 0.0) add_sheet(drawing);
    for (const Layer& layer : drawing.layers) {
      if (!layer.visible || layer.strokes.empty()) continue;
      const world::ObjectId group = add({.name = layer.name});
      for (const StrokePointer& stroke : layer.strokes) add_stroke(*stroke, group);
    }
    if (!error_.empty()) return base::fail(error_);
    if (ridges_ == 0) return base::fail("nothing of this drawing can be seen, so there is nothing to touch");
    return std::move(world_);
  }

 private:
  template <typename EditKind>
  void put(EditKind edit) {
    if (!error_.empty()) return;
    if (const auto done = world::replay(world_, world::Edit(std::move(edit))); !done)
      error_ = done.error().message;
  }

  world::ObjectId add(world::PhysicalObject object) {
    const auto id = ids_.next<world::ObjectId>();
    std::size_t place = 0;
    if (object.parent) {
      place = children_[object.parent.value]++;
    } else {
      place = roots_++;
    }
    put(world::CreateObject{id, place, std::move(object)});
    return id;
  }

  world::GeometryId add_shape(world::GeometryPointer shape) {
    const auto id = ids_.next<world::GeometryId>();
    put(world::CreateGeometry{id, std::move(shape)});
    return id;
  }

  world::MaterialId add_material(world::Material material) {
    const auto id = ids_.next<world::MaterialId>();
    put(world::CreateMaterial{id, std::move(material)});
    return id;
  }

  world::TouchProperties touch() const {
    world::TouchProperties touch;
    if (settings_.paper.stiffness > 0.0) touch.stiffness = settings_.paper.stiffness;
    touch.static_friction = settings_.paper.static_friction;
    touch.dynamic_friction = settings_.paper.dynamic_friction;
    touch.texture = settings_.paper.texture;
    return touch;
  }

  void add_sheet(const Drawing& drawing) {
    const base::Vector3 half(0.5 * drawing.size.x(), 0.5 * drawing.size.y(), 0.5 * settings_.sheet);
    world::Material material;
    material.name = std::string(settings_.paper.name);
    material.diffuse = {1.0F, 1.0F, 1.0F};
    material.touch = touch();
    world::PhysicalObject sheet = {.name = "sheet"};
    sheet.parent_from_object = base::Affine3(Eigen::Translation3d(0.0, 0.0, -0.5 * settings_.sheet));
    sheet.geometry = add_shape(std::make_shared<world::PrimitiveGeometry>(geometry::Box{half}));
    sheet.material = add_material(std::move(material));
    add(std::move(sheet));
  }

  void add_stroke(const Stroke& stroke, world::ObjectId group) {
    const double height = (settings_.height + settings_.height_by_width * stroke.curve.widest()) * rise();
    if (stroke.fill) {
      add_ridge(stroke, {ring_of_loop(stroke.curve.segments, grid_)}, kFillShare * height, *stroke.fill,
                "fill", group);
    }
    fonts::Rings rings;
    for (const drawing::OutlinePiece& piece : drawing::outline_of(stroke.curve, stroke.ends, kRingTolerance))
      rings.push_back(ring_of_loop(piece.rim, grid_));
    add_ridge(stroke, rings, height, stroke.colour, "stroke", group);
  }

  /// A factor that lets later strokes lie a little higher, so that no two tops are in one plane.
  double rise() const { return 1.0 + kRise * double(ridges_); }

  void add_ridge(const Stroke& stroke, const fonts::Rings& rings, double height, const Colour& colour,
                 const char* what, world::ObjectId group) {
    const std::vector<geometry::Outline> pieces = fonts::united(rings);
    if (pieces.empty()) return;
    auto mesh = geometry::solid_of_outlines(pieces, 1.0);
    if (!mesh) {
      error_ = fmt::format("stroke {}: {}", stroke.id.value, mesh.error().message);
      return;
    }
    grid_.to_design(*mesh, height);
    world::Material material;
    material.name = fmt::format("{} {}", what, stroke.id.value);
    material.diffuse = colour;
    material.transparency = float(1.0 - stroke.opacity);
    world::PhysicalObject ridge = {.name = material.name, .parent = group};
    ridge.geometry = add_shape(std::make_shared<world::MeshGeometry>(std::move(*mesh)));
    ridge.material = add_material(std::move(material));
    add(std::move(ridge));
    ++ridges_;
  }

  const ReliefSettings& settings_;
  PaperGrid grid_;
  world::World world_;
  world::IdSource ids_;
  std::map<std::uint64_t, std::size_t> children_;  // of each group
  std::size_t roots_ = 0;
  std::size_t ridges_ = 0;
  std::string error_;
};

}  // namespace

base::Result<world::World> relief_of(const Drawing& drawing, const ReliefSettings& settings) {
  return ReliefMaker(drawing, settings).make(drawing);
}

}  // namespace icome::sketch
