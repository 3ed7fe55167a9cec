#include "haptics/thesis/loop_renderer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "geometry/tree/triangle_tree.h"

namespace icome::haptics {
namespace {

using geometry::LoopLevel;
using geometry::LoopLevels;
using geometry::TriangleMesh;

/// On which side of the line from a to b, seen along z, does p lie? Swapping a and b turns the sign exactly.
double side(const Vector3& a, const Vector3& b, const Vector3& p) {
  return (a.x() - p.x()) * (b.y() - p.y()) - (a.y() - p.y()) * (b.x() - p.x());
}

/// Is p to the left of the edge? A point on an edge belongs to one of the two triangles that share it.
bool left_of(double at, const Vector3& a, const Vector3& b) {
  if (at != 0.0) return at > 0.0;
  return a.y() != b.y() ? a.y() < b.y() : a.x() > b.x();
}

/// Does the ray from p along +z cross the triangle? Neighbours leave no crack and count no edge twice.
bool ray_crosses(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& p) {
  if (a.z() < p.z() && b.z() < p.z() && c.z() < p.z()) return false;
  const double ab = side(a, b, p), bc = side(b, c, p), ca = side(c, a, p);
  const bool left = left_of(ab, a, b);
  if (left != left_of(bc, b, c) || left != left_of(ca, c, a)) return false;
  const double area = ab + bc + ca;
  if (area == 0.0) return false;
  return (bc * (a.z() - p.z()) + ca * (b.z() - p.z()) + ab * (c.z() - p.z())) / area > 0.0;
}

/// The point of a surface by its face, with the limit normals of the corners interpolated.
geometry::SurfacePoint scp_on(const LoopLevel& level, std::uint32_t face, const Vector3& point) {
  const Vector3& a = level.mesh.corner(face, 0);
  const Vector3 to_b = level.mesh.corner(face, 1) - a, to_c = level.mesh.corner(face, 2) - a;
  const Vector3 area = to_b.cross(to_c);
  const double whole = area.squaredNorm();
  const auto& [na, nb, nc] = level.corner_normals[face];
  Vector3 normal = level.normals[na];
  if (whole > 0.0) {
    const double at_b = (point - a).cross(to_c).dot(area) / whole;
    const double at_c = to_b.cross(point - a).dot(area) / whole;
    normal = (1.0 - at_b - at_c) * normal + at_b * level.normals[nb] + at_c * level.normals[nc];
  }
  const double length = normal.norm();
  return {point, length > 0.0 ? Vector3(normal / length) : level.normals[na]};
}

constexpr std::uint64_t face_key(int level, std::uint32_t face) { return std::uint64_t(level) << 32 | face; }

}  // namespace

LoopWorkspace::FaceSet::FaceSet(std::size_t most) : most_(most) {
  std::size_t slots = 1;
  while (slots < 2 * most) slots *= 2;
  slots_.resize(slots);
}

void LoopWorkspace::FaceSet::clear() {
  size_ = 0;
  if (++stamp_ != 0) return;
  std::fill(slots_.begin(), slots_.end(), Slot{});
  stamp_ = 1;
}

bool LoopWorkspace::FaceSet::insert(std::uint64_t key) {
  if (full()) return false;
  constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15;  // Knuth's multiplicative hashing
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t at = std::size_t(key * kSpread >> 32) & mask;; at = (at + 1) & mask) {
    Slot& slot = slots_[at];
    if (slot.stamp == stamp_ && slot.key == key) return false;
    if (slot.stamp == stamp_) continue;
    slot = {key, stamp_};
    ++size_;
    return true;
  }
}

LoopWorkspace::LoopWorkspace() : extended_(kMostFaces / 4), settled_(kMostFaces) {
  for (std::vector<std::uint32_t>* faces : {&selected_, &next_, &seeds_}) faces->reserve(kMostFaces);
}

/// The descent of one point through the levels. Lives on the stack of a call.
class LoopDescent {
 public:
  LoopDescent(const LoopRenderer& renderer, const Vector3& point, LoopWorkspace& space)
      : renderer_(renderer), levels_(*renderer.levels_), point_(point), space_(space) {
    space_.settled_.clear();
    space_.selected_.clear();
  }

  /// Tests inside or outside, thesis 5.4.2.
  void test_inside() {
    look_at_control_mesh();
    while (at_ < levels_.finest() && descend()) {
      const bool parity = crossed() % 2 == 1;
      if (std::exchange(inside_, parity) != parity) return;
    }
  }

  /// Finds the SCP, thesis 5.4.3, after the test: only the closest face matters from here on.
  geometry::SurfacePoint find_scp() {
    if (at_ < levels_.finest() && complete_) {
      space_.seeds_.clear();
      while (at_ < levels_.finest() && descend()) space_.seeds_.clear();
    }
    const bool kept = kept_.squared < active_.squared;
    const Closest& closest = kept ? kept_ : active_;
    return scp_on(levels_.level(closest.level), closest.face, closest.point);
  }

  LoopRenderer::Test report() const { return {inside_, at_, crossed(), checks_, complete_}; }
  std::size_t checks() const { return checks_; }

 private:
  using Fate = LoopRenderer::Fate;

  struct Closest {
    double squared = std::numeric_limits<double>::infinity();
    Vector3 point = Vector3::Zero();
    std::uint32_t face = 0;
    int level = 0;
  };

  std::size_t crossed() const { return active_crossings_ + kept_crossings_; }

  void look_at_control_mesh() {
    const auto count = std::uint32_t(levels_.level(0).mesh.triangles.size());
    start_level(0);
    for (std::uint32_t face = 0; face < count; ++face) look_at(face);
    inside_ = crossed() % 2 == 1;
  }

  void start_level(int level) {
    at_ = level;
    active_ = {};
    active_crossings_ = 0;
    space_.seeds_.clear();
  }

  /// Checks one face of the present level.
  void look_at(std::uint32_t face) {
    if (!check(at_, face, active_)) return;
    ++active_crossings_;
    if (space_.seeds_.size() < space_.seeds_.capacity()) {
      space_.seeds_.push_back(face);
    } else {
      complete_ = false;
    }
  }

  bool check(int level, std::uint32_t face, Closest& closest) {
    ++checks_;
    const TriangleMesh& mesh = levels_.level(level).mesh;
    const geometry::Corners corners{mesh.corner(face, 0), mesh.corner(face, 1), mesh.corner(face, 2)};
    const Vector3 near = geometry::nearest_point(corners, point_);
    const double squared = (near - point_).squaredNorm();
    if (squared < closest.squared) closest = {squared, near, face, level};
    return ray_crosses(corners[0], corners[1], corners[2], point_);
  }

  /// Replaces the selected faces by the children of the 1-neighbourhoods of crossed and closest faces, and
  /// checks these. False when there is nothing to subdivide, or too much.
  bool descend() {
    if (!complete_ || !select_children()) return false;
    std::swap(space_.selected_, space_.next_);
    start_level(at_ + 1);
    for (const std::uint32_t face : space_.selected_) look_at(face);
    return true;
  }

  bool select_children() {
    space_.next_.clear();
    space_.extended_.clear();
    if (active_.squared < std::numeric_limits<double>::infinity()) extend(active_.face);
    for (const std::uint32_t face : space_.seeds_) extend(face);
    return complete_ && !space_.next_.empty();
  }

  /// Selects the children of the faces around the vertices of a face.
  void extend(std::uint32_t face) {
    const LoopLevel& level = levels_.level(at_);
    for (const std::uint32_t vertex : level.mesh.triangles[face]) {
      for (const std::uint32_t around : level.faces_around(vertex)) {
        if (space_.extended_.insert(face_key(at_, around))) {
          subdivide(around);
        } else if (space_.extended_.full()) {
          complete_ = false;
          return;
        }
      }
    }
  }

  void subdivide(std::uint32_t face) {
    if (renderer_.fate(at_, face) == Fate::Divided) {
      for (std::uint32_t child = 0; child < 4; ++child) space_.next_.push_back(4 * face + child);
      return;
    }
    int level = at_;
    for (; renderer_.fate(level, face) == Fate::Absent; face /= 4) --level;
    if (space_.settled_.full()) complete_ = false;
    if (!space_.settled_.insert(face_key(level, face))) return;
    if (check(level, face, kept_)) ++kept_crossings_;
  }

  const LoopRenderer& renderer_;
  const LoopLevels& levels_;
  const Vector3& point_;
  LoopWorkspace& space_;
  int at_ = 0;
  bool inside_ = false;
  bool complete_ = true;
  Closest active_, kept_;  // among the present level's faces, and among those that stay as they are
  std::size_t active_crossings_ = 0, kept_crossings_ = 0;
  std::size_t checks_ = 0;
};

LoopRenderer::LoopRenderer(std::shared_ptr<const LoopLevels> levels, const LoopRendererSettings& settings)
    : levels_(std::move(levels)) {
  if (settings.adaptive) decide_fates();
}

void LoopRenderer::decide_fates() {
  const auto area = [](const TriangleMesh& mesh, std::size_t face) {
    const Vector3& a = mesh.corner(face, 0);
    return 0.5 * (mesh.corner(face, 1) - a).cross(mesh.corner(face, 2) - a).norm();
  };
  const TriangleMesh& finest = levels_->level(levels_->finest()).mesh;
  const double small = geometry::surface_area(finest) / double(finest.triangles.size());
  for (int level = 0; level < levels_->finest(); ++level) {
    const TriangleMesh& mesh = levels_->level(level).mesh;
    std::vector<Fate> fates(mesh.triangles.size());
    for (std::size_t face = 0; face < fates.size(); ++face) {
      const bool there = level == 0 || fates_.back()[face / 4] == Fate::Divided;
      fates[face] = !there ? Fate::Absent : area(mesh, face) > small ? Fate::Divided : Fate::Kept;
    }
    fates_.push_back(std::move(fates));
  }
}

LoopRenderer::Test LoopRenderer::inside(const Vector3& point, LoopWorkspace& space) const {
  LoopDescent descent(*this, point, space);
  descent.test_inside();
  return descent.report();
}

LoopRenderer::Answer LoopRenderer::render(const Vector3& point, LoopWorkspace& space) const {
  LoopDescent descent(*this, point, space);
  descent.test_inside();
  Answer answer{descent.report()};
  if (answer.test.inside) answer.scp = descent.find_scp();
  answer.checks = descent.checks();
  return answer;
}

std::size_t LoopRenderer::bytes() const {
  std::size_t sum = levels_->bytes();
  for (const std::vector<Fate>& fates : fates_) sum += fates.capacity() * sizeof(Fate);
  return sum;
}

}  // namespace icome::haptics
