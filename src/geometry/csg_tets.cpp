#include "geometry/csg_tets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "geometry/csg_part.h"

namespace icome::geometry {
namespace {

constexpr double kEdgeOfCell = 2.5;      // the longest edges where a grid's cells are as many
constexpr double kEdgeInCrowd = 0.1;     // where more than kCrowd surfaces pass
constexpr double kChord = 0.4;           // edges, of the radius of the bend
constexpr double kStraightChord = 0.2;   // where they may be long in the other direction
constexpr double kParallel = 1e-9;       // what cosines of parallel directions are off 1
constexpr double kTip = 0.1;             // of a cone's or tube's size: what is bent more counts as bent so
constexpr std::size_t kMostFlat = 8;     // planes that one tetrahedron is cut by, where it need not be small
constexpr std::size_t kCrowd = 12;       // more surfaces than this are better parted than cut along
constexpr double kFinest = 0x1p-18;      // of the whole: no edge is halved below
constexpr double kAround = 0.1;          // of a tetrahedron's size: so much around it counts as its own
constexpr double kDrawnFrom = 0.02;      // of a point's shortest edge: nearer surfaces draw it to them
constexpr std::size_t kLooksATet = 64;   // on average, for each tetrahedron allowed
constexpr std::size_t kTellEach = 4096;  // tetrahedra between two looks at `go_on`
/// The first tetrahedra begin this part of the size below the box: neither faces along the axes nor along
/// their diagonals shall fall on their points.
const Vector3 kTetShift(0.0381966011, 0.0414213562, 0.0318309886);
constexpr double kTetRoom = 1.1;

constexpr std::array<std::array<int, 2>, 6> kTetEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

using AtomList = std::shared_ptr<const std::vector<std::uint32_t>>;

/// In Maubach's order: the edge from corner 0 to corner `tag` is the next to be halved.
struct OpenTet {
  std::array<std::uint32_t, 4> corners;
  unsigned tag;
  AtomList atoms;
};

class TetRefiner {
 public:
  TetRefiner(const CsgProgram& program, double cell, std::size_t most, const ContourProgress& go_on)
      : program_(program), cell_(cell), most_(most), go_on_(go_on), length_(largest_coordinate(program)) {}

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
      result_.tets.push_back({tet.corners, *tet.atoms});
    }
    return std::move(result_);
  }

 private:
  /// Six around the diagonal of a cube, or of a box that is as long as the solid is along z.
  void begin() {
    const Bounds& box = program_.bounds();
    const auto way = straight_way(program_);
    along_z_ = way && std::abs(way->z()) > 1.0 - kParallel;
    const double across = along_z_ ? box.sizes().head<2>().maxCoeff() : box.sizes().maxCoeff();
    Vector3 sides(across, across, along_z_ ? box.sizes().z() : across);
    sides *= kTetRoom;
    finest_ = kFinest * sides.x();
    const Vector3 low = box.min() - sides.cwiseProduct(kTetShift);
    for (int i = 0; i < 8; ++i)
      result_.points.push_back(low + sides.cwiseProduct(Vector3(i & 1, i >> 1 & 1, i >> 2)));
    auto all = std::make_shared<std::vector<std::uint32_t>>(program_.atoms().size());
    std::iota(all->begin(), all->end(), 0U);
    std::array<std::uint32_t, 3> axes{1, 2, 4};
    do {
      waiting_.push_back({{0, axes[0], axes[0] | axes[1], 7}, 3, all});
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  bool goes_on() {
    too_many_ = tets_.size() + waiting_.size() + passed_ / kMostFlat > most_ || ++looks_ > kLooksATet * most_;
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
        passed_ += tet.atoms->size();
        tets_.push_back(std::move(tet));
      }
    }
    return true;
  }

  /// Until no tetrahedron has an edge that its neighbour halved.
  bool close_gaps() {
    for (bool any = true; any;) {
      any = false;
      std::vector<OpenTet> kept;
      for (OpenTet& tet : tets_) {
        if (!goes_on()) return false;
        if (!has_halved_edge(tet)) {
          kept.push_back(std::move(tet));
          continue;
        }
        any = true;
        std::vector<OpenTet> halves;
        halve(tet, halves);
        for (OpenTet& half : halves) {
          if (may_hold_surface(half)) kept.push_back(std::move(half));
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

  /// The longest edge as far as it matters where surfaces bend.
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
    auto open = open_atoms(program_, box, *tet.atoms);
    if (open.empty()) return false;
    const PartContent found = content(program_, box, open, length_);
    if (open.size() < tet.atoms->size())
      tet.atoms = std::make_shared<const std::vector<std::uint32_t>>(std::move(open));
    return found.solid && found.free;
  }

  /// Is it passed by so many surfaces that cutting it takes longer than halving it? Those that lie in one
  /// another count as one: halving does not part them.
  bool is_crowded(const std::vector<std::uint32_t>& passing) const {
    const auto& atoms = program_.atoms();
    std::vector<std::uint32_t> unlike;
    for (const std::uint32_t index : passing) {
      const bool known = std::any_of(unlike.begin(), unlike.end(), [&](std::uint32_t other) {
        return likeness(atoms[other], atoms[index], length_) != AtomLikeness::None;
      });
      if (!known) unlike.push_back(index);
      if (unlike.size() > kCrowd) return true;
    }
    return false;
  }

  double wanted_size(const OpenTet& tet) const {
    double wanted = std::numeric_limits<double>::infinity();
    const Vector3 centre = box_around(tet).center();
    const double chord = along_z_ ? kStraightChord : kChord;
    for (const std::uint32_t index : *tet.atoms) {
      const CsgAtom& atom = program_.atoms()[index];
      if (atom.kind == CsgAtom::Kind::Plane) continue;
      const double bend = tightest_bend(atom, retract(atom, atom.atom_from_tree * centre).point);
      const double least = kTip * (atom.kind == CsgAtom::Kind::Torus ? atom.b : atom.a);
      const double in_tree = std::sqrt(3.0) / atom.most_stretch;  // least stretch, where it is even
      wanted = std::min({wanted, kEdgeOfCell * cell_, chord * in_tree * std::max(bend, least)});
    }
    if (tet.atoms->size() > kMostFlat) wanted = std::min(wanted, kEdgeOfCell * cell_);
    if (is_crowded(*tet.atoms)) wanted = std::min(wanted, kEdgeInCrowd * cell_);
    return std::max(wanted, finest_);
  }

  static std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
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

  /// Surfaces that pass close to a point would cut slivers off there.
  void move_beside() {
    struct Nearest {
      double reach = std::numeric_limits<double>::infinity();  // m
      Vector3 place;
    };
    result_.moved_to.assign(result_.points.size(), CsgTets::kNoAtom);
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
        for (const std::uint32_t index : *tet.atoms) {
          const CsgAtom& atom = program_.atoms()[index];
          const Vector3 place = atom.tree_from_atom * retract(atom, atom.atom_from_tree * at(corner)).point;
          const double distance = (place - at(corner)).norm();
          if (distance >= nearest[corner].reach) continue;
          nearest[corner] = {distance, place};
          result_.moved_to[corner] = index;
        }
      }
    }
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (result_.moved_to[i] != CsgTets::kNoAtom) result_.points[i] = nearest[i].place;
    }
  }

  const CsgProgram& program_;
  double cell_;
  std::size_t most_;
  const ContourProgress& go_on_;
  double length_;  // m, the largest coordinate
  bool along_z_ = false;
  double finest_ = 0.0;     // m
  std::size_t looks_ = 0;   // at tetrahedra
  std::size_t passed_ = 0;  // by surfaces, each tetrahedron as often as surfaces may pass it
  bool too_many_ = false;
  std::vector<OpenTet> waiting_, tets_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
  CsgTets result_;
};

}  // namespace

std::optional<Vector3> straight_way(const CsgProgram& program) {
  std::optional<Vector3> way;
  for (const CsgAtom& atom : program.atoms()) {
    if (atom.kind == CsgAtom::Kind::Plane) continue;
    if (atom.kind != CsgAtom::Kind::Cylinder) return std::nullopt;
    const Vector3 axis = atom.tree_from_atom.linear().col(2).normalized();
    if (way && std::abs(way->dot(axis)) < 1.0 - kParallel) return std::nullopt;
    way = axis;
  }
  return way;
}

base::Result<CsgTets> make_csg_tets(const CsgProgram& program, double cell, std::size_t most,
                                    const ContourProgress& go_on) {
  return TetRefiner(program, cell, most, go_on).refined();
}

}  // namespace icome::geometry
