#include "geometry/csg/meshing/csg_tets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "geometry/csg/csg_part.h"

namespace icome::geometry {
namespace {

constexpr double kEdgeOfCell = 2.5;      // the longest edges where many flat surfaces pass
constexpr double kOffOfCell = 0.03;      // the distance of chords from the surface, in cells
constexpr double kEdgeInCrowd = 0.1;     // where more than kCrowd surfaces pass
constexpr double kChord = 0.4;           // the length of edges, of the radius of the bend
constexpr double kStraightChord = 0.2;   // where they may be long in the other direction
constexpr double kParallel = 1e-9;       // the difference from 1 of cosines of parallel directions
constexpr std::size_t kMostFlat = 8;     // planes that one tetrahedron is cut by, where it need not be small
constexpr std::size_t kCrowd = 12;       // more surfaces than this are better parted than cut along
constexpr double kFinest = 0x1p-18;      // of the whole: no edge is halved below
constexpr double kAround = 0.1;          // of a tetrahedron's size: so much around it counts as its own
constexpr double kDrawnFrom = 0.02;      // of a point's shortest edge: it is moved onto nearer surfaces
constexpr std::size_t kLooksATet = 64;   // on average, for each tetrahedron allowed
constexpr std::size_t kTellEach = 4096;  // tetrahedra between two calls of `go_on`
/// The first tetrahedra begin this part of the size below the box, so that neither faces along the axes nor
/// along their diagonals fall on their points.
const Vector3 kTetShift(0.0381966011, 0.0414213562, 0.0318309886);
constexpr double kTetRoom = 1.1;

constexpr std::array<std::array<int, 2>, 6> kTetEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

using SurfaceList = std::shared_ptr<const std::vector<CsgSurfaces::Index>>;

/// A tetrahedron in Maubach's order: the edge from corner 0 to corner `tag` is the next to be halved.
struct OpenTet {
  std::array<std::uint32_t, 4> corners;
  unsigned tag;
  SurfaceList surfaces;
};

class TetRefiner {
 public:
  TetRefiner(const CsgProgram& program, const CsgSurfaces& surfaces, double cell, std::size_t most,
             const ContourProgress& go_on)
      : program_(program),
        surfaces_(surfaces),
        cell_(cell),
        most_(most),
        go_on_(go_on),
        length_(largest_coordinate(program)) {}

  base::Result<CsgTets> refined() {
    begin();
    bool good = halve_large() && close_gaps();
    if (good) move_beside();
    if (too_many_) {
      return base::fail(fmt::format("its thin and bent parts take more than {} tetrahedra to mesh", most_));
    }
    if (!good) return base::fail("the meshing was interrupted");
    for (OpenTet& tet : tets_) {
      if (volume(tet.corners) < 0.0) std::swap(tet.corners[0], tet.corners[1]);
      result_.tets.push_back({tet.corners, *tet.surfaces});
    }
    return std::move(result_);
  }

 private:
  /// Makes six tetrahedra around the diagonal of a cube, or of a box that is as long as the solid along z.
  void begin() {
    const Bounds& box = program_.bounds();
    const auto way = straight_way(program_);
    along_z_ = way && std::abs(way->z()) > 1.0 - kParallel;
    const double across = along_z_ ? box.sizes().head<2>().maxCoeff() : box.sizes().maxCoeff();
    // No less along z than across, even for a plate: each halving across is one along z, too.
    Vector3 sides(across, across, std::max(across, box.sizes().z()));
    sides *= kTetRoom;
    finest_ = kFinest * sides.x();
    const Vector3 low = box.min() - sides.cwiseProduct(kTetShift);
    for (int i = 0; i < 8; ++i)
      result_.points.push_back(low + sides.cwiseProduct(Vector3(i & 1, i >> 1 & 1, i >> 2)));
    auto all = std::make_shared<std::vector<CsgSurfaces::Index>>(surfaces_.size());
    std::iota(all->begin(), all->end(), 0U);
    std::array<std::uint32_t, 3> axes{1, 2, 4};
    do {
      waiting_.push_back({{0, axes[0], axes[0] | axes[1], 7}, 3, all});
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  /// Is the work still within its limits? `others`: tetrahedra beside those that are done or wait.
  bool goes_on(std::size_t others = 0) {
    too_many_ = tets_.size() + waiting_.size() + others + passed_ / kMostFlat > most_ ||
                ++looks_ > kLooksATet * most_;
    return !too_many_ && (looks_ % kTellEach != 0 || go_on_(0.5));
  }

  bool halve_large() {
    while (!waiting_.empty()) {
      if (!goes_on()) return false;
      OpenTet tet = std::move(waiting_.back());
      waiting_.pop_back();
      if (!may_hold_surface(tet)) continue;
      if (size(tet) > wanted_size(tet)) {
        halve(tet, waiting_);
      } else {
        passed_ += tet.surfaces->size();
        tets_.push_back(std::move(tet));
      }
    }
    return true;
  }

  /// Halves tetrahedra until none has an edge that its neighbour halved.
  bool close_gaps() {
    for (bool any = true; any;) {
      any = false;
      std::vector<OpenTet> kept, halves;
      waiting_.swap(tets_);
      while (!waiting_.empty()) {
        if (!goes_on(kept.size())) return false;
        OpenTet tet = std::move(waiting_.back());
        waiting_.pop_back();
        if (!has_halved_edge(tet)) {
          kept.push_back(std::move(tet));
          continue;
        }
        any = true;
        halves.clear();
        halve(tet, halves);
        for (OpenTet& half : halves) {
          if (may_hold_surface(half)) waiting_.push_back(std::move(half));
        }
      }
      tets_ = std::move(kept);
    }
    return true;
  }

  const Vector3& at(std::uint32_t point) const { return result_.points[point]; }

  double volume(const std::array<std::uint32_t, 4>& c) const {
    return (at(c[1]) - at(c[0])).cross(at(c[2]) - at(c[0])).dot(at(c[3]) - at(c[0]));
  }

  /// The longest edge; only its part across z where surfaces are straight along z.
  double size(const OpenTet& tet) const {
    double longest = 0.0;
    for (const auto& edge : kTetEdges) {
      const Vector3 way = at(tet.corners[edge[1]]) - at(tet.corners[edge[0]]);
      longest = std::max(longest, along_z_ ? way.head<2>().norm() : way.norm());
    }
    return longest;
  }

  Bounds box_around(const OpenTet& tet) const {
    Bounds box;
    for (const std::uint32_t corner : tet.corners) box.extend(at(corner));
    const Vector3 margin = Vector3::Constant(kAround * box.sizes().maxCoeff());
    return {box.min() - margin, box.max() + margin};
  }

  bool may_hold_surface(OpenTet& tet) const {
    const Bounds box = box_around(tet);
    auto open = surfaces_.open(box, *tet.surfaces);
    if (open.empty()) return false;
    const PartContent found = content(program_, box, surfaces_.atoms(open), length_);
    if (open.size() < tet.surfaces->size())
      tet.surfaces = std::make_shared<const std::vector<CsgSurfaces::Index>>(std::move(open));
    return found.solid && found.free;
  }

  /// The length of edges by the bends; shorter where so many surfaces pass that cutting takes longer than
  /// halving. Surfaces that coincide count as one: halving does not part them.
  double wanted_size(const OpenTet& tet) const {
    double wanted = std::numeric_limits<double>::infinity();
    const Vector3 centre = box_around(tet).center();
    const std::vector<CsgSurfaces::Index> passing = surfaces_.unlike(*tet.surfaces);
    for (const CsgSurfaces::Index surface : passing) {
      if (surfaces_.is_plane(surface)) continue;
      const double bend = surfaces_.bend(surface, centre, cell_);
      wanted = std::min(wanted, std::sqrt(8.0 * bend * chord_height(cell_, bend)));
      if (along_z_) wanted = std::min(wanted, kStraightChord * bend);
    }
    if (passing.size() > kMostFlat) wanted = std::min(wanted, kEdgeOfCell * cell_);
    if (passing.size() > kCrowd) wanted = std::min(wanted, kEdgeInCrowd * cell_);
    return std::max(wanted, finest_);
  }

  bool has_halved_edge(const OpenTet& tet) const {
    return std::any_of(kTetEdges.begin(), kTetEdges.end(), [&](const auto& edge) {
      return middles_.contains(edge_key(tet.corners[edge[0]], tet.corners[edge[1]]));
    });
  }

  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [found, fresh] = middles_.try_emplace(edge_key(a, b), std::uint32_t(result_.points.size()));
    if (fresh) result_.points.push_back(0.5 * (at(a) + at(b)));
    return found->second;
  }

  void halve(const OpenTet& tet, std::vector<OpenTet>& into) {
    const std::uint32_t between = middle(tet.corners[0], tet.corners[tet.tag]);
    OpenTet one = tet, other = tet;
    one.corners[tet.tag] = between;
    for (unsigned i = 0; i < tet.tag; ++i) other.corners[i] = tet.corners[i + 1];
    other.corners[tet.tag] = between;
    one.tag = other.tag = tet.tag > 1 ? tet.tag - 1 : 3;
    into.push_back(std::move(one));
    into.push_back(std::move(other));
  }

  /// Moves points onto surfaces that pass close to them, as these would cut slivers off there.
  void move_beside() {
    struct Nearest {
      double reach = std::numeric_limits<double>::infinity();  // m
      Vector3 place;
    };
    result_.moved_to.assign(result_.points.size(), CsgSurfaces::kNone);
    std::vector<Nearest> nearest(result_.points.size());
    for (const OpenTet& tet : tets_) {
      for (const auto& edge : kTetEdges) {
        const std::uint32_t a = tet.corners[edge[0]], b = tet.corners[edge[1]];
        const double reach = kDrawnFrom * (at(b) - at(a)).norm();
        nearest[a].reach = std::min(nearest[a].reach, reach);
        nearest[b].reach = std::min(nearest[b].reach, reach);
      }
    }
    for (const OpenTet& tet : tets_) {
      for (const std::uint32_t corner : tet.corners) {
        for (const CsgSurfaces::Index index : *tet.surfaces) {
          const CsgAtom& atom = surfaces_.shape(index);
          const Vector3 place = atom.tree_from_atom * retract(atom, atom.atom_from_tree * at(corner)).point;
          const double distance = (place - at(corner)).norm();
          if (distance >= nearest[corner].reach) continue;
          nearest[corner] = {distance, place};
          result_.moved_to[corner] = index;
        }
      }
    }
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (result_.moved_to[i] != CsgSurfaces::kNone) result_.points[i] = nearest[i].place;
    }
  }

  const CsgProgram& program_;
  const CsgSurfaces& surfaces_;
  double cell_;
  std::size_t most_;
  const ContourProgress& go_on_;
  double length_;  // m, the largest coordinate
  bool along_z_ = false;
  double finest_ = 0.0;     // m
  std::size_t looks_ = 0;   // at tetrahedra
  std::size_t passed_ = 0;  // by surfaces: each tetrahedron counts once for each that may pass it
  bool too_many_ = false;
  std::vector<OpenTet> waiting_, tets_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
  CsgTets result_;
};

}  // namespace

std::optional<Vector3> straight_way(const CsgProgram& program) {
  std::optional<Vector3> way;
  for (const CsgAtom& atom : program.atoms()) {
    if (atom.kind == CsgAtom::Kind::Plane || atom.kind == CsgAtom::Kind::Mesh) continue;
    if (atom.kind != CsgAtom::Kind::Cylinder) return std::nullopt;
    const Vector3 axis = atom.tree_from_atom.linear().col(2).normalized();
    if (way && std::abs(way->dot(axis)) < 1.0 - kParallel) return std::nullopt;
    way = axis;
  }
  return way;
}

double chord_height(double cell, double bend) {
  return std::min(kOffOfCell * cell, 0.125 * kChord * kChord * bend);
}

base::Result<CsgTets> make_csg_tets(const CsgProgram& program, const CsgSurfaces& surfaces, double cell,
                                    std::size_t most, const ContourProgress& go_on) {
  return TetRefiner(program, surfaces, cell, most, go_on).refined();
}

}  // namespace icome::geometry
