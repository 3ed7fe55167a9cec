#include "geometry/contour/contour_refine.h"

#include <algorithm>
#include <utility>

#include "base/random.h"
#include "geometry/contour/contour_search.h"
#include "geometry/contour/contour_vertices.h"

namespace icome::geometry {
namespace {

/// Quads with a larger fault, in cells, are worked on.
constexpr double kFault = 0.02;
constexpr int kRounds = 2;
/// The largest distance of a vertex, and of the samples for it, beside its cell, in cells.
constexpr double kBeyond = 0.5;
/// Moves by less than this part of a cell are not made.
constexpr double kStill = 1e-6;
/// A move must make the faults around a vertex less by this part, so that rounding moves nothing.
constexpr double kGain = 1e-3;
/// Vertices of triangles without area are moved by this part of a cell, more each time.
constexpr double kApart = 1e-4;
constexpr int kTriesApart = 12;

using VertexQuad = std::pair<std::uint32_t, std::uint32_t>;

class ContourRefiner {
 public:
  ContourRefiner(ContourDraft& draft, std::vector<QuadSplit>& splits)
      : draft_(&draft),
        splitter_(*draft.solid, draft.grid->cell, draft.positions),
        splits_(&splits),
        fresh_(splits.size(), true) {}

  bool split_all(const ContourProgress& go_on) {
    return contour_in_batches(splits_->size(), go_on, [&](std::size_t begin, std::size_t end) {
      for (std::size_t quad = begin; quad < end; ++quad) (*splits_)[quad] = split(quad);
    });
  }

  bool refine(const ContourProgress& go_on) {
    const std::vector<VertexQuad> around = quads_to_improve();
    const std::vector<std::size_t> first = first_of_each(around);
    fresh_.assign(fresh_.size(), false);
    std::vector<Vector3> proposals(first.size());
    const auto quads_of = [&](std::size_t i) {
      const std::size_t end = i + 1 < first.size() ? first[i + 1] : around.size();
      return std::span(around).subspan(first[i], end - first[i]);
    };
    const ContourProgress proposing = contour_share(go_on, 0.0, 0.5), moving = contour_share(go_on, 0.5, 0.5);
    const bool done = contour_in_batches(first.size(), proposing, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) proposals[i] = propose(quads_of(i));
    });
    if (!done) return false;
    // One after the other: whether a move is good depends on the neighbours' new places.
    for (std::size_t i = 0; i < first.size(); ++i) {
      if (i % 1024 == 0 && !moving(static_cast<double>(i) / static_cast<double>(first.size()))) return false;
      move_if_better(quads_of(i), proposals[i]);
    }
    return true;
  }

  /// Moves the vertices of triangles without area until there are none.
  bool keep_apart(const ContourProgress& go_on) {
    double apart = kApart * draft_->grid->cell;
    for (int attempt = 0; attempt < kTriesApart; ++attempt, apart *= 2) {
      const ContourProgress trying =
          contour_share(go_on, static_cast<double>(attempt) / kTriesApart, 1.0 / kTriesApart);
      std::vector<std::uint32_t> vertices;
      for (const QuadSplit& split : *splits_) {
        for (const auto& triangle : split.triangles) {
          if (splitter_.sliver(triangle)) vertices.insert(vertices.end(), triangle.begin(), triangle.end());
        }
      }
      if (vertices.empty()) return true;
      std::sort(vertices.begin(), vertices.end());
      vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
      for (const std::uint32_t vertex : vertices) {
        draft_->positions[vertex] += apart * base::Random(vertex + vertices.size()).direction();
      }
      if (!split_all(trying)) return false;
    }
    return true;
  }

 private:
  QuadSplit split(std::size_t quad) const {
    return splitter_.split((*draft_->quads)[quad], (*draft_->crossings)[quad].normal);
  }

  /// The vertices of faulty quads that are new since the last round, each with all quads around it, in
  /// order.
  std::vector<VertexQuad> quads_to_improve() const {
    std::vector<bool> wanted(draft_->positions.size(), false);
    const auto& quads = *draft_->quads;
    for (std::size_t quad = 0; quad < quads.size(); ++quad) {
      if (!fresh_[quad] || (*splits_)[quad].fault <= kFault * draft_->grid->cell) continue;
      for (const std::uint32_t vertex : quads[quad]) wanted[vertex] = true;
    }
    std::vector<VertexQuad> around;
    for (std::size_t quad = 0; quad < quads.size(); ++quad) {
      for (const std::uint32_t vertex : quads[quad]) {
        if (wanted[vertex]) around.emplace_back(vertex, static_cast<std::uint32_t>(quad));
      }
    }
    std::sort(around.begin(), around.end());
    return around;
  }

  static std::vector<std::size_t> first_of_each(const std::vector<VertexQuad>& around) {
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < around.size(); ++i) {
      if (i == 0 || around[i].first != around[i - 1].first) first.push_back(i);
    }
    return first;
  }

  const ContourCell& cell_of(std::uint32_t vertex) const {
    const auto& cells = draft_->cells->cells;
    return *std::prev(std::upper_bound(
        cells.begin(), cells.end(), vertex,
        [](std::uint32_t wanted, const ContourCell& cell) { return wanted < cell.first_vertex; }));
  }

  /// A place for the vertex from the grid's samples and those at the triangles around.
  Vector3 propose(std::span<const VertexQuad> around) const {
    const std::uint32_t vertex = around.front().first;
    const ContourCell& cell = cell_of(vertex);
    SheetSampler sampler(*draft_->grid, *draft_->cells, *draft_->crossings, cell.key);
    auto sheets = sampler.samples(cell);
    SheetSamples& sheet = sheets[vertex - cell.first_vertex];
    if (is_lone_sheet(*draft_->grid, *draft_->cells, cell, sheet)) return draft_->positions[vertex];
    const auto own = sheet.all();
    std::vector<SurfacePoint> samples(own.begin(), own.end());

    const double size = draft_->grid->cell;
    Bounds space = vertex_space(*draft_->grid, cell);
    space.min().array() -= kBeyond * size;
    space.max().array() += kBeyond * size;
    for (const VertexQuad& quad : around) {
      for (const auto& triangle : (*splits_)[quad.second].triangles) {
        if (std::find(triangle.begin(), triangle.end(), vertex) == triangle.end()) continue;
        const auto found =
            search_along(*draft_->solid, splitter_.centre(triangle), splitter_.normal(triangle), size);
        if (found && space.contains(found->point)) samples.push_back(*found);
      }
    }
    return fit_vertex(*draft_->solid, size, space, samples);
  }

  void move_if_better(std::span<const VertexQuad> around, const Vector3& proposal) {
    Vector3& position = draft_->positions[around.front().first];
    if ((proposal - position).norm() <= kStill * draft_->grid->cell) return;
    double before = 0.0, after = 0.0;
    for (const VertexQuad& quad : around) before += (*splits_)[quad.second].fault;
    const Vector3 old = std::exchange(position, proposal);
    std::vector<QuadSplit> moved;
    moved.reserve(around.size());
    for (const VertexQuad& quad : around) {
      moved.push_back(split(quad.second));
      after += moved.back().fault;
    }
    if (!(after < before * (1 - kGain))) {
      position = old;
      return;
    }
    for (std::size_t i = 0; i < around.size(); ++i) {
      (*splits_)[around[i].second] = moved[i];
      fresh_[around[i].second] = true;
    }
  }

  ContourDraft* draft_;
  QuadSplitter splitter_;
  std::vector<QuadSplit>* splits_;
  std::vector<bool> fresh_;  // quads that are not as they were in the last round
};

}  // namespace

std::optional<std::vector<QuadSplit>> refine_and_split(ContourDraft& draft, const ContourProgress& go_on) {
  std::vector<QuadSplit> splits(draft.quads->size());
  ContourRefiner refiner(draft, splits);
  constexpr double kShare = 1.0 / (kRounds + 2);
  if (!refiner.split_all(contour_share(go_on, 0.0, kShare))) return std::nullopt;
  for (int round = 1; round <= kRounds; ++round) {
    if (!refiner.refine(contour_share(go_on, round * kShare, kShare))) return std::nullopt;
  }
  if (!refiner.keep_apart(contour_share(go_on, 1 - kShare, kShare))) return std::nullopt;
  return splits;
}

}  // namespace icome::geometry
