#include "files/vrml/worker/made_faces.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace icome::files {
namespace {

constexpr int kRoundSides = 48;

}  // namespace

std::size_t FaceMaker::Hash::operator()(const Bits& bits) const {
  std::uint64_t hash = 0;
  for (const std::uint32_t part : bits) hash = (hash ^ part) * 0x9e3779b97f4a7c15ULL;
  return static_cast<std::size_t>(hash ^ (hash >> 32U));
}

int FaceMaker::vertex(const std::array<double, 3>& position) {
  Bits bits{};
  std::array<float, 3> rounded{};
  for (std::size_t i = 0; i < 3; ++i) {
    rounded[i] = static_cast<float>(position[i]) + 0.0F;  // drops the sign of -0
    bits[i] = std::bit_cast<std::uint32_t>(rounded[i]);
  }
  const auto [known, is_new] = vertices_.try_emplace(bits, static_cast<int>(faces_.positions.size() / 3));
  if (is_new) faces_.positions.insert(faces_.positions.end(), rounded.begin(), rounded.end());
  return known->second;
}

int FaceMaker::texture(double s, double t) {
  faces_.texture_coordinates.push_back(static_cast<float>(s));
  faces_.texture_coordinates.push_back(static_cast<float>(t));
  return static_cast<int>(faces_.texture_coordinates.size() / 2) - 1;
}

void FaceMaker::face(std::span<const Corner> corners) {
  kept_.clear();
  for (const Corner& corner : corners)
    if (kept_.empty() || kept_.back().vertex != corner.vertex) kept_.push_back(corner);
  while (kept_.size() > 1 && kept_.front().vertex == kept_.back().vertex) kept_.pop_back();
  if (kept_.size() < 3) return;
  for (const Corner& corner : kept_) {
    faces_.polygons.push_back(corner.vertex);
    faces_.texture_polygons.push_back(corner.texture);
  }
  faces_.polygons.push_back(-1);
  faces_.texture_polygons.push_back(-1);
}

/// Textures as ISO/IEC 14772-1 lays them on Cylinders and Cones: the seam is at the back, and from there a
/// picture goes round counter-clockwise, seen from above.
MadeFaces make_round(const RoundParts& parts) {
  FaceMaker maker;
  using Corner = FaceMaker::Corner;
  struct Ring {
    std::vector<int> vertices, around, within;  // around: texture of the side; within: of the cap
  };
  const auto ring = [&](double radius, double y, double v) {
    Ring made;
    for (int k = 0; k <= kRoundSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * (k % kRoundSides) / kRoundSides;
      const double x = -std::sin(angle);
      const double z = -std::cos(angle);
      made.vertices.push_back(maker.vertex({radius * x, y, radius * z}));
      made.around.push_back(maker.texture(double{1} * k / kRoundSides, v));
      made.within.push_back(maker.texture(0.5 + 0.5 * x, v > 0.5 ? 0.5 - 0.5 * z : 0.5 + 0.5 * z));
    }
    return made;
  };
  const Ring low = ring(parts.radius, -0.5 * parts.height, 0.0);
  const Ring high = ring(parts.top_radius, 0.5 * parts.height, 1.0);
  for (std::size_t k = 0; parts.side && k < kRoundSides; ++k)
    maker.face(std::array{
        Corner{low.vertices[k], low.around[k]}, Corner{low.vertices[k + 1], low.around[k + 1]},
        Corner{high.vertices[k + 1], high.around[k + 1]}, Corner{high.vertices[k], high.around[k]}});
  std::vector<Corner> cap;
  for (std::size_t k = 0; k < kRoundSides; ++k) cap.push_back({high.vertices[k], high.within[k]});
  if (parts.top) maker.face(cap);
  cap.clear();
  for (std::size_t k = kRoundSides; k > 0; --k) cap.push_back({low.vertices[k], low.within[k]});
  if (parts.bottom) maker.face(cap);
  return maker.take();
}

}  // namespace icome::files
