#include "geometry/loop/loop_refine.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>

namespace icome::geometry {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// A position as OpenSubdiv accumulates it.
struct OsdPoint {
  Vector3 position = Vector3::Zero();
  void Clear() { position.setZero(); }                                                     // NOLINT
  void AddWithWeight(const OsdPoint& other, double w) { position += w * other.position; }  // NOLINT
};

std::unique_ptr<Far::TopologyRefiner> make_refiner(const TriangleMesh& mesh,
                                                   const std::vector<std::array<std::uint32_t, 2>>& creases,
                                                   const std::vector<std::uint32_t>& corners) {
  const std::vector<int> corner_counts(mesh.triangles.size(), 3);
  std::vector<int> indices, crease_vertices;
  for (const auto& triangle : mesh.triangles) indices.insert(indices.end(), triangle.begin(), triangle.end());
  for (const auto& crease : creases) {
    crease_vertices.insert(crease_vertices.end(), crease.begin(), crease.end());
  }
  const std::vector<int> corner_vertices(corners.begin(), corners.end());
  const std::vector<float> crease_weights(creases.size(), Sdc::Crease::SHARPNESS_INFINITE);
  const std::vector<float> corner_weights(corners.size(), Sdc::Crease::SHARPNESS_INFINITE);

  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = int(mesh.positions.size());
  descriptor.numFaces = int(mesh.triangles.size());
  descriptor.numVertsPerFace = corner_counts.data();
  descriptor.vertIndicesPerFace = indices.data();
  descriptor.numCreases = int(creases.size());
  descriptor.creaseVertexIndexPairs = crease_vertices.data();
  descriptor.creaseWeights = crease_weights.data();
  descriptor.numCorners = int(corners.size());
  descriptor.cornerVertexIndices = corner_vertices.data();
  descriptor.cornerWeights = corner_weights.data();

  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  return std::unique_ptr<Far::TopologyRefiner>(
      Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_LOOP, options)));
}

}  // namespace

base::Result<LoopRefinement> loop_refine(const TriangleMesh& mesh,
                                         const std::vector<std::array<std::uint32_t, 2>>& creases,
                                         const std::vector<std::uint32_t>& corners) {
  const auto refiner = make_refiner(mesh, creases, corners);
  if (!refiner) {
    return base::fail("the control mesh is not one that OpenSubdiv can refine: repair it first");
  }
  Far::TopologyRefiner::UniformOptions one_level(1);
  one_level.fullTopologyInLastLevel = true;
  refiner->RefineUniform(one_level);

  std::vector<OsdPoint> coarse(mesh.positions.size());
  for (std::size_t i = 0; i < coarse.size(); ++i) coarse[i].position = mesh.positions[i];
  const Far::TopologyLevel& fine_level = refiner->GetLevel(1);
  std::vector<OsdPoint> fine(std::size_t(fine_level.GetNumVertices()));
  const Far::PrimvarRefinerReal<double> interpolator(*refiner);
  interpolator.Interpolate(1, coarse, fine);

  const Far::TopologyLevel& level = refiner->GetLevel(0);
  LoopRefinement result;
  result.vertices.reserve(mesh.positions.size());
  for (int v = 0; v < level.GetNumVertices(); ++v) {
    result.vertices.push_back(fine[std::size_t(level.GetVertexChildVertex(v))].position);
  }
  result.edges.reserve(std::size_t(level.GetNumEdges()));
  for (int e = 0; e < level.GetNumEdges(); ++e) {
    result.edges.push_back(fine[std::size_t(level.GetEdgeChildVertex(e))].position);
  }
  result.edge_of_side.resize(mesh.triangles.size());
  for (int f = 0; f < level.GetNumFaces(); ++f) {
    const auto edges = level.GetFaceEdges(f);  // edge i runs from corner i to i + 1
    for (int i = 0; i < 3; ++i) result.edge_of_side[std::size_t(f)][i] = std::uint32_t(edges[i]);
  }
  return result;
}

}  // namespace icome::geometry
