#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace icome::files {

/// Faces made from the fields of a node, in the form of an IndexedFaceSet.
struct MadeFaces {
  std::vector<float> positions = {};
  std::vector<int> polygons = {};
  std::vector<float> texture_coordinates = {};
  std::vector<int> texture_polygons = {};
};

/// Builds faces. Corners at the same place become one vertex; degenerate faces are left out.
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

/// The existing parts of a Cylinder, or of a Cone (`top_radius` 0); its axis is y.
struct RoundParts {
  double radius = 1.0;
  double top_radius = 1.0;
  double height = 2.0;
  bool side = true;
  bool top = true;
  bool bottom = true;
};
MadeFaces make_round(const RoundParts& parts);
/// Crease angle (rad) that smooths the faces of one curved surface from make_round().
inline constexpr float kRoundCrease = 0.3F;

}  // namespace icome::files
