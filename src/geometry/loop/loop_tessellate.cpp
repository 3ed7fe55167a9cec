#include <fmt/format.h>

#include <unordered_map>

#include "geometry/loop/loop_contact.h"

namespace icome::geometry {
namespace {

constexpr std::size_t kMostTessellated = 20'000'000;

/// Makes the triangles piece by piece; vertices that pieces share are made once.
class Tessellation {
 public:
  /// `steps` along each edge of a piece.
  Tessellation(const LoopPatches& patches, std::uint32_t steps)
      : patches_(patches), cursor_(patches), steps_(steps) {}

  void add(std::uint32_t piece) {
    corners_ = patches_.corner_ids(piece);
    std::vector<std::uint32_t> vertex((steps_ + 1) * (steps_ + 2) / 2);
    for (std::uint32_t j = 0; j <= steps_; ++j) {
      for (std::uint32_t i = 0; i + j <= steps_; ++i) vertex[at(i, j)] = vertex_at(piece, i, j);
    }
    for (std::uint32_t j = 0; j < steps_; ++j) {
      for (std::uint32_t i = 0; i + j < steps_; ++i) {
        mesh_.triangles.push_back({vertex[at(i, j)], vertex[at(i + 1, j)], vertex[at(i, j + 1)]});
        if (i + j + 1 == steps_) continue;
        mesh_.triangles.push_back({vertex[at(i + 1, j)], vertex[at(i + 1, j + 1)], vertex[at(i, j + 1)]});
      }
    }
  }

  /// The triangle of the control mesh itself.
  void add_whole(std::uint32_t slot) {
    TriangleMesh::Triangle triangle;
    for (std::uint32_t k = 0; k < 3; ++k) {
      corners_ = patches_.corner_ids(4 * slot + k);
      triangle[k] = shared(key(corners_[0], corners_[0], 0), 4 * slot + k, 0.0, 0.0);
    }
    mesh_.triangles.push_back(triangle);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  std::size_t at(std::uint32_t i, std::uint32_t j) const { return j * (2 * steps_ + 3 - j) / 2 + i; }

  struct Key {
    std::uint64_t ends;
    std::uint32_t step;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const {
      return std::size_t((k.ends ^ (std::uint64_t(k.step) << 29)) * 0x9e3779b97f4a7c15ULL >> 13);
    }
  };
  /// Step `step` of the edge from corner id `from` to `to`, the same from both sides.
  Key key(std::uint32_t from, std::uint32_t to, std::uint32_t step) const {
    if (step == 0) return {std::uint64_t(from) << 32 | from, 0};
    if (step == steps_) return {std::uint64_t(to) << 32 | to, 0};
    return from < to ? Key{std::uint64_t(from) << 32 | to, step}
                     : Key{std::uint64_t(to) << 32 | from, steps_ - step};
  }

  std::uint32_t vertex_at(std::uint32_t piece, std::uint32_t i, std::uint32_t j) {
    const double u = double(i) / steps_, v = double(j) / steps_;
    if (j == 0) return shared(key(corners_[0], corners_[1], i), piece, u, v);
    if (i == 0) return shared(key(corners_[0], corners_[2], j), piece, u, v);
    if (i + j == steps_) return shared(key(corners_[1], corners_[2], j), piece, u, v);
    return make(piece, u, v);
  }
  std::uint32_t shared(const Key& where, std::uint32_t piece, double u, double v) {
    const auto [found, is_new] = shared_.try_emplace(where, std::uint32_t(mesh_.positions.size()));
    if (is_new) make(piece, u, v);
    return found->second;
  }
  std::uint32_t make(std::uint32_t piece, double u, double v) {
    mesh_.positions.push_back(loop_point(cursor_, patches_, piece, u, v).point);
    return std::uint32_t(mesh_.positions.size() - 1);
  }

  const LoopPatches& patches_;
  LoopCursor cursor_;
  std::uint32_t steps_;
  std::array<std::uint32_t, 3> corners_;
  std::unordered_map<Key, std::uint32_t, Hash> shared_;
  TriangleMesh mesh_;
};

}  // namespace

base::Result<TriangleMesh> loop_tessellate(const LoopPatches& patches, int level) {
  if (level < 0) return base::fail("a surface cannot be tessellated at a negative level: ask for 0 or more");
  if (level > 12 || (std::size_t(patches.triangles()) << (2 * level)) > kMostTessellated) {
    return base::fail(fmt::format("level {} of {} control triangles is more than {} triangles: ask for less",
                                  level, patches.triangles(), kMostTessellated));
  }
  Tessellation tessellation(patches, level == 0 ? 1 : 1u << (level - 1));
  for (std::uint32_t triangle = 0; triangle < patches.triangles(); ++triangle) {
    const std::uint32_t slot = patches.slot(triangle);
    if (level == 0) {
      tessellation.add_whole(slot);
      continue;
    }
    for (std::uint32_t part = 0; part < 4; ++part) tessellation.add(4 * slot + part);
  }
  return tessellation.take();
}

}  // namespace icome::geometry
