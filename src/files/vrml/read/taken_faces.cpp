#include "files/vrml/read/taken_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/mesh/polygon_triangulation.h"
#include "io/single.h"

namespace icome::files {
namespace {

constexpr FindingKind kShortFaces = {"Faces with fewer than three corners are left out", "shapes"};
constexpr FindingKind kWrongFaces = {"Faces with vertices that are not there are left out", "shapes"};
constexpr FindingKind kLargeFaces = {"Faces with more than 20,000 corners are left out", "shapes"};
static_assert(geometry::kMaximumPolygonCorners == 20'000);

class FaceTaker {
 public:
  FaceTaker(const std::vector<float>& positions, const std::vector<std::int32_t>& list, bool ccw)
      : positions_(positions), list_(list), ccw_(ccw) {}

  TakenFaces take() {
    find_vertices();
    taken_.mesh.corners.reserve(list_.size());
    taken_.slots.reserve(list_.size());
    std::uint32_t number = 0;
    for (std::size_t begin = 0; begin < list_.size(); ++number) {
      std::size_t end = begin;
      while (end < list_.size() && list_[end] != -1) ++end;
      add(begin, end, number);
      begin = end + 1;
    }
    number_vertices();
    return std::move(taken_);
  }

  void tell(const std::string& name, Findings& findings) const {
    if (short_ > 0) findings.add(kShortFaces, name, short_);
    if (wrong_ > 0) findings.add(kWrongFaces, name, wrong_);
    if (large_ > 0) findings.add(kLargeFaces, name, large_);
  }

 private:
  void find_vertices() {
    is_there_.resize(positions_.size() / 3);
    for (std::size_t i = 0; i < is_there_.size(); ++i) {
      const float* const at = positions_.data() + 3 * i;
      is_there_[i] = std::isfinite(at[0]) && std::isfinite(at[1]) && std::isfinite(at[2]);
    }
  }

  void add(std::size_t begin, std::size_t end, std::uint32_t number) {
    if (end - begin > geometry::kMaximumPolygonCorners) {
      ++large_;
      return;
    }
    const auto is_there = [&](std::int32_t it) {
      return it >= 0 && std::size_t(it) < is_there_.size() && is_there_[std::size_t(it)];
    };
    if (!std::all_of(list_.data() + begin, list_.data() + end, is_there)) {
      ++wrong_;
      return;
    }
    std::vector<std::uint32_t>& slots = taken_.slots;
    const std::size_t first = slots.size();
    // Equal corners in a row count as one.
    while (end > begin + 1 && list_[end - 1] == list_[begin]) --end;
    for (std::size_t i = begin; i < end; ++i) {
      if (i == begin || list_[i] != list_[i - 1]) slots.push_back(std::uint32_t(i));
    }
    if (slots.size() - first < 3) {
      ++short_;
      slots.resize(first);
      return;
    }
    if (!ccw_) std::reverse(slots.begin() + std::ptrdiff_t(first), slots.end());
    taken_.mesh.begins.push_back(std::uint32_t(slots.size()));
    taken_.numbers.push_back(number);
  }

  /// Drops vertices that no face uses.
  void number_vertices() {
    constexpr std::uint32_t kUnused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> numbers(is_there_.size(), kUnused);
    for (const std::uint32_t slot : taken_.slots) {
      taken_.vertices.push_back(std::uint32_t(list_[slot]));
      numbers[taken_.vertices.back()] = 0;
    }
    std::vector<base::Vector3>& positions = taken_.mesh.positions;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (numbers[i] == kUnused) continue;
      numbers[i] = std::uint32_t(positions.size());
      const float* const at = positions_.data() + 3 * i;
      positions.emplace_back(io::from_single(at[0]), io::from_single(at[1]), io::from_single(at[2]));
    }
    for (const std::uint32_t vertex : taken_.vertices) taken_.mesh.corners.push_back(numbers[vertex]);
  }

  const std::vector<float>& positions_;
  const std::vector<std::int32_t>& list_;
  bool ccw_;
  std::vector<bool> is_there_;  // vertex by vertex: is it finite?
  TakenFaces taken_;
  std::size_t short_ = 0, wrong_ = 0, large_ = 0;
};

}  // namespace

TakenFaces take_faces(const std::vector<float>& positions, const std::vector<std::int32_t>& polygons,
                      bool ccw, const std::string& name, Findings& findings) {
  FaceTaker taker(positions, polygons, ccw);
  TakenFaces faces = taker.take();
  taker.tell(name, findings);
  return faces;
}

}  // namespace icome::files
