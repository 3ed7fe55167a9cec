// polyhedron() of a .csg file: points and faces become a closed mesh, or are refused with the reason.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <utility>

#include "files/csg/csg_arguments.h"
#include "files/csg/csg_shapes.h"
#include "files/mesh/face_collector.h"
#include "geometry/mesh/mesh_repair.h"
#include "io/byte_watch.h"

namespace icome::files {
namespace {

using geometry::MeshReport;
using geometry::RepairReport;
using geometry::TriangleMesh;
using Index = CsgDocument::Index;
using Kind = CsgDocument::Kind;

/// A volume below this, in cubes of the mesh's size, is zero up to rounding.
constexpr double kNoVolume = 1e-14;

class PolyhedronReader {
 public:
  PolyhedronReader(const CsgDocument& document, Index statement, io::TimeBudget& time_budget)
      : document_(document),
        time_budget_(time_budget),
        statement_(document.statements()[statement]),
        arguments_(document, statement, {"points", "faces", "convexity", "triangles"}) {}

  base::Result<CsgPart> run() {
    const auto points = vector("points");
    const auto faces = vector(arguments_.find("faces") ? "faces" : "triangles");
    if (points) read_points(*points);
    if (points && faces) read_faces(*faces);
    if (arguments_.failed()) return tl::unexpected(arguments_.error());
    TriangleMesh mesh = collector_.take(&time_budget_);
    // Repairing a mesh takes long.
    if (!time_budget_.lasts_now()) return tl::unexpected(io::interruption());
    return solid(std::move(mesh));
  }

 private:
  std::optional<Index> vector(const char* name) {
    const auto found = arguments_.find(name);
    if (found && document_.value(*found).kind != Kind::Vector)
      arguments_.fail_kind(*found, fmt::format("a vector is expected for {} of polyhedron", name));
    return found;
  }
  void read_points(Index points);
  void read_faces(Index faces);
  void read_face(Index face);
  std::uint32_t corner(Index value);
  base::Result<CsgPart> solid(TriangleMesh mesh) const;
  tl::unexpected<base::Error> refuse(const std::string& reason) const {
    return tl::unexpected(document_.error_at(statement_.offset, "this polyhedron " + reason));
  }

  const CsgDocument& document_;
  io::TimeBudget& time_budget_;
  const CsgDocument::Statement& statement_;
  CsgArguments arguments_;
  FaceCollector collector_;
  std::vector<std::uint32_t> corners_;  // of the face being read
};

void PolyhedronReader::read_points(Index points) {
  const Index end = document_.value_end(points);
  for (Index i = points + 1; i < end && !arguments_.failed() && time_budget_.lasts();
       i = document_.value_end(i)) {
    const auto [x, y, z] = arguments_.numbers<3>(i, "a point");
    const geometry::Vector3 point(x, y, z);
    if (point.cwiseAbs().maxCoeff() > kLargestSize)
      arguments_.fail(i, fmt::format("this point is farther than {:.0g} mm from the origin", kLargestSize));
    collector_.add_position(point / kMillimetresPerMetre);
  }
}

std::uint32_t PolyhedronReader::corner(Index value) {
  const CsgDocument::Value& index = document_.value(value);
  const auto points = static_cast<double>(collector_.positions());
  if (index.kind != Kind::Number) {
    arguments_.fail_kind(value, "the number of a point is expected");
  } else if (index.number != std::floor(index.number) || index.number < 0.0 || index.number >= points) {
    arguments_.fail(value, fmt::format("face refers to point {}; the {} points are numbered from 0",
                                       index.number, points));
  }
  return arguments_.failed() ? 0 : static_cast<std::uint32_t>(index.number);
}

void PolyhedronReader::read_face(Index face) {
  if (document_.value(face).kind != Kind::Vector)
    return arguments_.fail_kind(face, "a face is expected, a vector of numbers of points");
  corners_.clear();
  // Backwards: OpenSCAD's faces run clockwise seen from outside. Every element takes one place: a vector
  // among them fails.
  for (Index i = document_.value_end(face) - 1; i > face && !arguments_.failed(); --i) {
    const std::uint32_t next = corner(i);
    if (corners_.empty() || corners_.back() != next) corners_.push_back(next);
  }
  if (corners_.size() > 1 && corners_.front() == corners_.back()) corners_.pop_back();
  if (!arguments_.failed() && !collector_.add_face(corners_))
    arguments_.fail(face, too_many_corners(corners_.size()));
}

void PolyhedronReader::read_faces(Index faces) {
  const Index end = document_.value_end(faces);
  for (Index i = faces + 1; i < end && !arguments_.failed() && time_budget_.lasts();
       i = document_.value_end(i))
    read_face(i);
}

/// Is the repair worth a note? Welding shared corners and dropping spare ones is not.
bool worth_telling(const RepairReport& report) {
  return report.turned_parts + report.rewound_faces + report.duplicate_faces + report.degenerate_faces +
             report.crack_vertices + report.flipped_edges >
         0;
}

base::Result<CsgPart> PolyhedronReader::solid(TriangleMesh mesh) const {
  const RepairReport report = geometry::repair(mesh);
  const MeshReport& surface = report.surface;
  if (mesh.triangles.empty()) return CsgPart{};
  if (surface.boundary_edges > 0)
    return refuse(fmt::format("is open: {} of its edges belong to one face only", surface.boundary_edges));
  if (surface.non_manifold_edges > 0)
    return refuse(fmt::format("is not manifold: {} of its edges belong to more than two faces",
                              surface.non_manifold_edges));
  if (!surface.orientable) return refuse("is one-sided, like a Klein bottle");
  const double size = geometry::bounds(mesh).sizes().maxCoeff();
  if (std::abs(geometry::signed_volume(mesh)) <= kNoVolume * size * size * size) return CsgPart{};
  CsgPart part;
  part.notes = collector_.notes();
  if (worth_telling(report)) {
    for (std::string& sentence : report.sentences()) part.notes.push_back(std::move(sentence));
  }
  part.shape = std::make_shared<const geometry::MeshSolid>(std::move(mesh));
  return part;
}

}  // namespace

base::Result<CsgPart> read_polyhedron(const CsgDocument& document, Index statement,
                                      io::TimeBudget& time_budget) {
  return PolyhedronReader(document, statement, time_budget).run();
}

}  // namespace icome::files
