#include "geometry/csg/meshing/csg_cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/decompositions.h"
#include "geometry/csg/csg_part.h"
#include "geometry/csg/meshing/csg_settle.h"
#include "geometry/csg/meshing/csg_tets.h"
#include "geometry/mesh/face_merge.h"
#include "geometry/mesh/mesh_sheets.h"

namespace icome::geometry {
namespace {

using Corners4 = std::array<std::uint32_t, 4>;
using Triangle = TriangleMesh::Triangle;

constexpr std::uint32_t kNoPoint = ~std::uint32_t{0};
constexpr double kOnSurface = 1e-10;  // of the coordinates: a point so near a surface is on it
constexpr double kRootExact = 1e-4;   // of kOnSurface: the accuracy of a cut
constexpr double kHighEnough = 10.0;  // of kOnSurface: the least height of triangles made by merging
constexpr int kRootSteps = 80;
constexpr std::size_t kTetsATriangle = 4;  // more tetrahedra than this for each triangle allowed are too many
constexpr std::size_t kMostTets = 1'500'000;   // however many triangles are allowed: they take some seconds
constexpr std::size_t kMostPieces = 100'000;   // of one tetrahedron
constexpr std::size_t kMostCuts = 50'000'000;  // cuts of pieces by surfaces, all told
constexpr std::size_t kFewMeshTriangles =
    2'000;  // of all meshes in a tree: with more, sampling is tried first
constexpr std::size_t kMostMeshTriangles = 20'000;  // of all meshes in a tree that is cut at all
constexpr std::size_t kTellEachCut = 1 << 16;       // cuts between two calls of `go_on`
constexpr double kMakingTetsPart = 0.4;             // of the whole work
constexpr double kCuttingPart = 2.0 / 3.0;          // of the remaining work; the rest is merging
constexpr std::array<std::array<int, 2>, 6> kPieceEdges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
/// The faces of a tetrahedron of positive volume, facing out.
constexpr std::array<std::array<int, 3>, 4> kPieceFaces{{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};

/// A corner of pieces: a point of the tetrahedra, or one at which a surface cuts an edge.
struct CutPoint {
  Vector3 place;
  CsgSurfaces::Index surface = CsgSurfaces::kNone;        // on which it was put
  std::array<std::uint32_t, 2> ends{kNoPoint, kNoPoint};  // of the edge that was cut
  /// The corners of the smallest side of a tetrahedron that holds it, rising: its cuts depend only on these.
  Corners4 carrier{kNoPoint, kNoPoint, kNoPoint, kNoPoint};
};

/// A face of a piece; `solid` tells whether that piece is solid.
struct PieceFace {
  Triangle key;     // its points, rising
  Triangle facing;  // facing out of the piece
  bool solid;
};

bool operator<(const PieceFace& a, const PieceFace& b) { return a.key < b.key; }

class CsgCutter {
 public:
  using Surface = CsgSurfaces::Index;

  CsgCutter(const CsgProgram& program, const CsgSurfaces& surfaces, CsgTets tets)
      : program_(program),
        surfaces_(surfaces),
        tets_(std::move(tets.tets)),
        on_(kOnSurface * largest_coordinate(program)) {
    for (std::uint32_t i = 0; i < tets.points.size(); ++i) {
      CutPoint point{.place = tets.points[i], .carrier = {i, kNoPoint, kNoPoint, kNoPoint}};
      if (tets.moved_to[i] != CsgSurfaces::kNone) point.surface = surfaces_.like(tets.moved_to[i]);
      points_.push_back(point);
    }
    open_at_.resize(points_.size());
    for (CsgTets::Tet& tet : tets_) {
      tet.surfaces = surfaces_.unlike(std::move(tet.surfaces));
      for (const std::uint32_t corner : tet.corners)
        open_at_[corner].insert(open_at_[corner].end(), tet.surfaces.begin(), tet.surfaces.end());
    }
    for (auto& open : open_at_) make_set(open);
  }

  base::Result<TriangleMesh> mesh(double cell, std::size_t max_triangles, const ContourProgress& go_on) {
    const auto done = cut_all(max_triangles, contour_share(go_on, 0.0, kCuttingPart));
    if (!done) return tl::unexpected(done.error());
    return merged(cell, contour_share(go_on, kCuttingPart, 1.0 - kCuttingPart));
  }

 private:
  base::Result<void> cut_all(std::size_t max_triangles, const ContourProgress& go_on) {
    for (std::size_t i = 0; i < tets_.size(); ++i) {
      const auto done = cut(tets_[i], contour_share(go_on, double(i) / double(tets_.size()), 0.0));
      if (!done) return done;
      if (triangles_.size() > max_triangles)
        return base::fail(fmt::format("the mesh would have more than {} triangles", max_triangles));
    }
    pair_up(between_, nullptr);
    return {};
  }

  base::Result<TriangleMesh> merged(double cell, const ContourProgress& go_on) {
    TriangleMesh result;
    for (const CutPoint& point : points_) result.positions.push_back(point.place);
    result.triangles = std::move(triangles_);
    std::vector<Surface> faces;
    for (const Triangle& triangle : result.triangles) faces.push_back(surface_of(triangle));
    result = separate_sheets(result);
    settle_vertices(result, faces, surfaces_);
    const std::vector<bool> tips = settle_tips(result, faces, program_, surfaces_, cell);
    const ChordJudge judge(program_, surfaces_, cell);
    const auto fits = [&](Surface face, const auto& corners) { return judge.stands_for(face, corners); };
    return merge_faces(result, faces, tips, kHighEnough * on_, fits, go_on);
  }

  /// The point's side: -1 behind the surface, 1 in front of it, 0 on it. Cuts are flat: a point on an edge
  /// that was cut later is on the side of that edge.
  int side(std::uint32_t index, Surface surface) const {
    const CutPoint& point = points_[index];
    if (point.surface == surface) return 0;
    if (point.ends[0] != kNoPoint && surface < point.surface) {
      const int first = side(point.ends[0], surface);
      return first != 0 ? first : side(point.ends[1], surface);
    }
    const double distance = height(point.place, surface);
    return std::abs(distance) <= on_ ? 0 : distance < 0.0 ? -1 : 1;
  }

  /// The signed distance from a surface, m; exact where its transform is even.
  double height(const Vector3& place, Surface surface) const {
    const CsgAtom& atom = surfaces_.shape(surface);
    return signed_distance(atom, atom.atom_from_tree * place) * std::sqrt(3.0) / atom.most_stretch;
  }

  /// Does every tetrahedron around the edge that the surface may pass cut it?
  bool cuts_along(Surface surface, const Corners4& carrier) const {
    return std::all_of(carrier.begin(), carrier.end(), [&](std::uint32_t corner) {
      return corner == kNoPoint ||
             std::binary_search(open_at_[corner].begin(), open_at_[corner].end(), surface);
    });
  }

  Corners4 carrier_of(std::uint32_t a, std::uint32_t b) const {
    std::array<std::uint32_t, 8> both;
    std::merge(points_[a].carrier.begin(), points_[a].carrier.end(), points_[b].carrier.begin(),
               points_[b].carrier.end(), both.begin());
    const auto end = std::unique(both.begin(), both.end());
    Corners4 carrier{kNoPoint, kNoPoint, kNoPoint, kNoPoint};
    std::copy(both.begin(), std::min(end, both.begin() + 4), carrier.begin());
    return carrier;
  }

  /// The surface that the triangle was cut along: a plane if there is one, else the one nearest to its
  /// middle.
  Surface surface_of(const Triangle& triangle) const {
    Surface best = CsgSurfaces::kNone;
    double least = std::numeric_limits<double>::infinity();
    Vector3 middle = Vector3::Zero();
    for (const std::uint32_t corner : triangle) middle += points_[corner].place / 3.0;
    for (const Surface surface : open_at_[points_[triangle[0]].carrier[0]]) {
      const bool along = std::all_of(triangle.begin(), triangle.end(),
                                     [&](auto corner) { return side(corner, surface) == 0; });
      if (!along) continue;
      if (surfaces_.is_plane(surface)) return surface;
      const double distance = std::abs(height(middle, surface));
      if (distance >= least) continue;
      least = distance;
      best = surface;
    }
    return best;
  }

  /// The place at which the surface crosses the edge between two points on either side of it.
  Vector3 crossing(std::uint32_t a, std::uint32_t b, Surface surface) const {
    const Vector3 start = points_[a].place, step = points_[b].place - start;
    double low = 0.0, high = 1.0, at_low = height(start, surface), at_high = height(start + step, surface);
    if (!(at_low < 0.0 ? at_high > 0.0 : at_low > 0.0 && at_high < 0.0)) return start + 0.5 * step;
    double best = 0.5, least = std::numeric_limits<double>::infinity();
    for (int i = 0, kept = 0; i < kRootSteps && least > kRootExact * on_; ++i) {  // Illinois
      const double t = (low * at_high - high * at_low) / (at_high - at_low);
      const double here = height(start + t * step, surface);
      if (std::abs(here) < least) {
        least = std::abs(here);
        best = t;
      }
      if ((here < 0.0) == (at_low < 0.0)) {
        low = t;
        at_low = here;
        if (kept == 1) at_high *= 0.5;
        kept = 1;
      } else {
        high = t;
        at_high = here;
        if (kept == 2) at_low *= 0.5;
        kept = 2;
      }
    }
    return start + best * step;
  }

  std::uint32_t cut_point(std::uint32_t a, std::uint32_t b, Surface surface) {
    const auto [found, fresh] = cut_edges_.try_emplace(edge_key(a, b), std::uint32_t(points_.size()));
    if (fresh) {
      const std::array<std::uint32_t, 2> ends{std::min(a, b), std::max(a, b)};
      points_.push_back({crossing(ends[0], ends[1], surface), surface, ends, carrier_of(a, b)});
    }
    return found->second;
  }

  /// Divides every piece that the surface passes, edge by edge, in an order that its neighbours share.
  void cut_along(Surface surface, std::vector<Corners4>& pieces) {
    std::vector<Corners4> result;
    std::vector<std::array<std::uint32_t, 2>> crossed;
    for (const Corners4& piece : pieces) {
      crossed.clear();
      std::array<int, 4> sides;
      for (std::size_t i = 0; i < 4; ++i) sides[i] = side(piece[i], surface);
      for (const auto& edge : kPieceEdges) {
        const std::uint32_t a = piece[edge[0]], b = piece[edge[1]];
        if (sides[edge[0]] * sides[edge[1]] < 0 && cuts_along(surface, carrier_of(a, b)))
          crossed.push_back({std::min(a, b), std::max(a, b)});
      }
      std::sort(crossed.begin(), crossed.end());
      const std::size_t first = result.size();
      result.push_back(piece);
      for (const auto& edge : crossed) {
        const std::uint32_t point = cut_point(edge[0], edge[1], surface);
        for (std::size_t i = first, end = result.size(); i < end; ++i) {
          const auto a = std::find(result[i].begin(), result[i].end(), edge[0]) - result[i].begin();
          const auto b = std::find(result[i].begin(), result[i].end(), edge[1]) - result[i].begin();
          if (a == 4 || b == 4) continue;
          Corners4 other = result[i];
          other[std::size_t(a)] = point;
          result[i][std::size_t(b)] = point;
          result.push_back(other);
        }
      }
    }
    pieces = std::move(result);
  }

  base::Result<void> cut(const CsgTets::Tet& tet, const ContourProgress& go_on) {
    std::vector<Surface> passing;  // an edge of it, also those that are not open in it
    for (const std::uint32_t corner : tet.corners)
      passing.insert(passing.end(), open_at_[corner].begin(), open_at_[corner].end());
    make_set(passing);
    std::vector<Corners4> pieces{tet.corners};
    for (const Surface surface : passing) {
      cuts_ += pieces.size();
      if (cuts_ >= tell_at_) {
        tell_at_ = cuts_ + kTellEachCut;
        if (!go_on(0.0)) return base::fail("the meshing was interrupted");
      }
      cut_along(surface, pieces);
      if (pieces.size() > kMostPieces || cuts_ > kMostCuts)
        return base::fail("too many thin parts meet in one place to mesh it");
    }
    std::vector<PieceFace> faces;
    for (const Corners4& piece : pieces) {
      const bool solid = is_solid(tet, piece);
      for (const auto& face : kPieceFaces) {
        const Triangle facing{piece[face[0]], piece[face[1]], piece[face[2]]};
        Triangle key = facing;
        std::sort(key.begin(), key.end());
        faces.push_back({key, facing, solid});
      }
    }
    pair_up(faces, &between_);
    return {};
  }

  bool is_solid(const CsgTets::Tet& tet, const Corners4& piece) const {
    Bounds box;
    Vector3 centre = Vector3::Zero(), middle = Vector3::Zero();
    for (const std::uint32_t corner : tet.corners) {
      box.extend(points_[corner].place);
      centre += 0.25 * points_[corner].place;
    }
    for (const std::uint32_t corner : piece) middle += 0.25 * points_[corner].place;
    return program_.inside_where(box, [&](std::uint32_t atom) {
      const CsgAtom& shape = program_.atoms()[atom];
      if (shape.kind == CsgAtom::Kind::Mesh) return behind(shape, middle);
      const Surface first = surfaces_.like(surfaces_.of_atom(atom));
      if (std::binary_search(tet.surfaces.begin(), tet.surfaces.end(), first)) {
        for (const std::uint32_t corner : piece) {
          if (const int at = side(corner, first); at != 0)
            return (at < 0) != surfaces_.opposite(surfaces_.of_atom(atom));
        }
      }
      return behind(shape, centre);
    });
  }

  /// Takes faces between solid and free pieces as surface; those without counterpart go to `lone`, if given.
  void pair_up(std::vector<PieceFace>& faces, std::vector<PieceFace>* lone) {
    std::sort(faces.begin(), faces.end());
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (i + 1 < faces.size() && faces[i].key == faces[i + 1].key) {
        if (faces[i].solid != faces[i + 1].solid)
          triangles_.push_back(faces[i].solid ? faces[i].facing : faces[i + 1].facing);
        ++i;
      } else if (lone != nullptr) {
        lone->push_back(faces[i]);
      }
    }
  }

  const CsgProgram& program_;
  const CsgSurfaces& surfaces_;
  std::vector<CsgTets::Tet> tets_;
  double on_;  // m
  std::size_t cuts_ = 0, tell_at_ = 0;
  std::vector<CutPoint> points_;
  std::vector<std::vector<Surface>> open_at_;  // by point of the tetrahedra: those of all around it
  std::unordered_map<std::uint64_t, std::uint32_t> cut_edges_;
  std::vector<PieceFace> between_;  // tetrahedra
  std::vector<Triangle> triangles_;
};

}  // namespace

base::Result<TriangleMesh> cut_csg(const CsgTree& tree, double cell, std::size_t max_triangles,
                                   const ContourProgress& go_on) {
  // The straight direction is turned to z, along which tetrahedra may be long.
  base::Quaternion tree_from_z = base::Quaternion::Identity();
  if (const auto way = straight_way(CsgProgram(tree)))
    tree_from_z = base::rotation_between(Vector3::UnitZ(), *way);
  CsgTree turned = tree;
  turned.set_transform(turned.root(),
                       Affine3(tree_from_z.conjugate()) * turned.node(turned.root()).parent_from_node);
  const CsgProgram program(turned);
  const std::size_t most_tets = std::min(kMostTets, kTetsATriangle * max_triangles);
  const CsgSurfaces surfaces(program);
  auto tets = make_csg_tets(program, surfaces, cell, most_tets, contour_share(go_on, 0.0, kMakingTetsPart));
  if (!tets) return tl::unexpected(tets.error());
  auto mesh = CsgCutter(program, surfaces, std::move(*tets))
                  .mesh(cell, max_triangles, contour_share(go_on, kMakingTetsPart, 1.0 - kMakingTetsPart));
  if (mesh) {
    for (Vector3& position : mesh->positions) position = tree_from_z * position;
  }
  return mesh;
}

bool has_flat_faces(const CsgProgram& program) {
  std::size_t triangles = 0;
  bool any = false;
  for (const CsgAtom& atom : program.atoms()) {
    any = any || atom.kind == CsgAtom::Kind::Plane || atom.kind == CsgAtom::Kind::Mesh;
    if (atom.kind == CsgAtom::Kind::Mesh) triangles += atom.mesh->mesh.triangles.size();
  }
  return any && triangles <= kFewMeshTriangles;
}

bool csg_can_cut(const CsgProgram& program) {
  std::size_t triangles = 0;
  for (const CsgAtom& atom : program.atoms()) {
    if (atom.kind == CsgAtom::Kind::Custom) return false;
    if (atom.kind == CsgAtom::Kind::Mesh) triangles += atom.mesh->mesh.triangles.size();
  }
  return triangles <= kMostMeshTriangles;
}

bool is_thin(const CsgProgram& program, double thickness) {
  constexpr std::size_t kMostAtoms = 2000;
  constexpr int kPlaces = 24;
  base::Random random(1);
  const std::size_t stride = 1 + program.atoms().size() / kMostAtoms;
  for (std::uint32_t atom = 0; atom < program.atoms().size(); atom += std::uint32_t(stride)) {
    int thin = 0, places = 0;
    for (int i = 0; i < kPlaces; ++i) {
      const auto place = random_place(program, atom, random);
      if (!place) continue;
      ++places;
      for (const double depth : {0.25, 0.5, 0.75, 1.0}) {
        const Vector3 way = depth * thickness * place->normal;
        if (program.inside(place->point - way) && !program.inside(place->point + way)) continue;
        ++thin;
        break;
      }
    }
    if (places > 0 && 2 * thin >= places) return true;
  }
  return false;
}

}  // namespace icome::geometry
