#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace icome::files {

/// Faces that are made here from what a node says, in the form of an IndexedFaceSet.
struct MadeFaces {
  std::vector<float> positions = {};
  std::vector<int> polygons = {};
  std::vector<float> texture_coordinates = {};
  std::vector<int> texture_polygons = {};
};

/// Puts faces together. Corners at the same place are one vertex, and what is no face then is left out.
class FaceMaker {
 public:
  struct Corner {
    int vertex = 0;
    int texture = 0;
  };

  int vertex(const std::array<double, 3>& position);
  int texture(double s, double t);
  void face(std::span<const Corner> corners);
  MadeFaces take() { return std::move(faces_); }

 private:
  using Bits = std::array<std::uint32_t, 3>;
  struct Hash {
    std::size_t operator()(const Bits& bits) const;
  };

  MadeFaces faces_ = {};
  std::unordered_map<Bits, int, Hash> vertices_ = {};
  std::vector<Corner> kept_ = {};
};

/// The parts of a Cylinder, or of a Cone (`top_radius` 0), that are there; its axis is y.
struct RoundParts {
  double radius = 1.0;
  double top_radius = 1.0;
  double height = 2.0;
  bool side = true;
  bool top = true;
  bool bottom = true;
};
MadeFaces make_round(const RoundParts& parts);
/// Between faces of make_round() that stand for one curved surface, at least.
inline constexpr float kRoundCrease = 0.3F;

}  // namespace icome::files
