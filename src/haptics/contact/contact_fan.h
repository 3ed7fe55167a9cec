#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "haptics/shapes/element.h"

namespace icome::haptics {

/// A short way on from a place where elements meet.
struct FanWay {
  static constexpr std::size_t kNone = ~std::size_t(0);

  Vector3 end;     // m, where it leads
  double gain;     // rate at which it nears the tip: the cosine of its angle to the pull
  std::size_t on;  // the element that it runs along, or kNone
};

/// The flat elements around a place where a point tip's SCP rests, among them all that meet in a vertex. The
/// free space there lies on the front of all of them together, as far as each reaches: beside a saddle it is
/// more than the intersection of their half-spaces. In a cone of flat faces the steepest free way leads
/// straight to the tip, along a face, or along an edge: no other need be tested. A way counts as free when
/// its end can be reached from the SCP by straight pieces that pass through no element, all within the
/// neighbourhood. Real-time safe.
class ContactFan {
 public:
  static constexpr std::size_t kCapacity = 64;   // elements
  static constexpr double kLength = 1024.0;      // gaps, of a way
  static constexpr double kNeighbourhood = 2.0;  // lengths of a way: radius in which elements must be known

  /// Can a fan be made of the elements? Only of triangles, rectangles and planes, for a point tip.
  static bool knows(std::span<const Element> elements);

  /// `elements`: all in the neighbourhood of `position`, at most kCapacity, facing it; the caller
  /// keeps them. `pull` leads from there to the tip.
  ContactFan(std::span<const Element> elements, const Vector3& position, const Vector3& pull,
             const Tolerance& tolerance);

  /// The steepest free way, unless none brings the SCP nearer to the tip by more than what counts as
  /// touching. Friction holds ways that run along an element with a gain of at most `held`.
  std::optional<FanWay> steepest(double held);

 private:
  static constexpr std::size_t kMostWays = 1 + 9 * kCapacity;
  static constexpr std::size_t kMostStations = 8 * kCapacity;
  static constexpr std::size_t kMostExtremes = 12 * kCapacity;

  static constexpr int kMostLooks = 16'000;  // tests of an element, some 10 ns each: then there is no way

  enum class Passage : std::uint8_t { Free, AtAnEdge, Through };

  template <typename Visit>
  void for_each_edge(std::size_t element, double reach, Visit&& visit) const;
  void find_ways(const Vector3& pull);
  void consider(const Vector3& along, const Vector3& pull, std::size_t on, double risen);
  void find_stations();
  Passage passage(const Element& element, const Vector3& from, const Vector3& to) const;
  bool sees(const Vector3& from, const Vector3& to) const;
  bool buried(const Vector3& place) const;
  bool below_floor(const Vector3& place);
  bool is_floor(std::size_t element);
  void find_extremes(std::size_t element);
  bool leads_on(std::size_t element) const;
  bool reachable(const Vector3& place);
  void look_around(const Vector3& from);

  std::span<const Element> elements_;
  Vector3 position_;
  const Tolerance& tolerance_;
  double length_;  // m, of a way
  std::array<FanWay, kMostWays> ways_;
  std::size_t way_count_ = 0;
  // Places above edges and faces from which all the free space around the vertex can be seen. Those seen so
  // far come first.
  std::array<Vector3, kMostStations> stations_;
  std::size_t station_count_ = 0;
  std::size_t seen_count_ = 0;
  std::size_t looked_from_ = 0;  // number of those seen from which it has looked around
  bool has_stations_ = false;
  // The outermost places of the elements in the neighbourhood, once asked for; and which elements are floors,
  // as far as that has been asked.
  std::array<Vector3, kMostExtremes> extremes_;
  std::size_t extreme_count_ = 0;
  std::array<std::optional<bool>, kCapacity> floor_{};
  mutable int looks_ = kMostLooks;  // tests that are left
};

}  // namespace icome::haptics
