#include "files/vrml/worker/face_fields.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace icome::files {
namespace {

/// Tests the bits: that is quicker for millions, with the same result.
bool all_finite(std::span<const float> numbers) {
  std::uint32_t found = 0;
  for (const float number : numbers) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &number, sizeof bits);
    found |= static_cast<std::uint32_t>((bits & 0x7f800000U) == 0x7f800000U);
  }
  return found == 0;
}

/// Calls `visit(begin, end)` with the range of indices of each face of a list.
template <typename Visit>
void for_each_face(std::span<const int> polygons, Visit visit) {
  for (std::size_t begin = 0; begin < polygons.size();) {
    std::size_t end = begin;
    while (end < polygons.size() && polygons[end] != -1) ++end;
    visit(begin, end);
    begin = end + 1;
  }
}

/// Repairs the faces of a list.
class FaceChecker {
 public:
  FaceChecker(const FaceFields& fields, CheckedFaces& checked) : fields_(fields), checked_(checked) {}

  void check() {
    checked_.fields = fields_;
    check_positions();
    check_polygons();
    FaceFields& to = checked_.fields;
    fit(to.texture_coordinates, 2, to.texture_polygons, true, "texture coordinates");
    fit(to.normals, 3, to.normal_polygons, to.normal_per_vertex, "normals");
    fit(to.colours, 3, to.colour_polygons, to.colour_per_vertex, "colours");
    if (is_clean_) return;
    keep_good(to.texture_coordinates, to.texture_polygons, checked_.new_texture_polygons, true);
    keep_good(to.normals, to.normal_polygons, checked_.new_normal_polygons, to.normal_per_vertex);
    keep_good(to.colours, to.colour_polygons, checked_.new_colour_polygons, to.colour_per_vertex);
    keep_indices(fields_.polygons, checked_.new_polygons);
    to.polygons = checked_.new_polygons;
    const std::size_t left_out = face_count_ - kept_count_;
    if (left_out > 0)
      checked_.remarks.push_back(std::to_string(left_out) + " of " + std::to_string(face_count_) +
                                 " faces are left out, since they have fewer than three corners, or corners "
                                 "that are not there");
  }

 private:
  void check_positions() {
    vertex_count_ = fields_.positions.size() / 3;
    if (all_finite(fields_.positions)) return;
    checked_.new_positions.assign(fields_.positions.begin(), fields_.positions.end());
    is_bad_.resize(vertex_count_);
    for (std::size_t v = 0; v < vertex_count_; ++v) {
      float* const corner = checked_.new_positions.data() + 3 * v;
      if (all_finite({corner, 3})) continue;
      is_bad_[v] = true;
      std::fill(corner, corner + 3, 0.0F);
    }
    checked_.fields.positions = checked_.new_positions;
    checked_.remarks.emplace_back("some of its coordinates are not finite numbers");
  }

  bool is_vertex(int index) const {
    return index >= 0 && static_cast<std::size_t>(index) < vertex_count_ &&
           (is_bad_.empty() || !is_bad_[static_cast<std::size_t>(index)]);
  }

  void check_polygons() {
    const std::span<const int> polygons = fields_.polygons;
    int largest = -1;
    for_each_face(polygons, [&](std::size_t begin, std::size_t end) {
      bool is_good = end - begin >= 3;
      for (std::size_t i = begin; i < end; ++i) {
        is_good = is_good && is_vertex(polygons[i]);
        largest = std::max(largest, polygons[i]);
      }
      ++face_count_;
      kept_count_ += is_good ? 1 : 0;
    });
    largest_index_ =
        std::min<std::size_t>(static_cast<std::size_t>(std::int64_t{largest} + 1), vertex_count_);
    is_clean_ = kept_count_ == face_count_ && !polygons.empty() && polygons.back() == -1;
  }

  bool is_good_face(std::size_t begin, std::size_t end) const {
    return end - begin >= 3 && std::all_of(fields_.polygons.begin() + static_cast<std::ptrdiff_t>(begin),
                                           fields_.polygons.begin() + static_cast<std::ptrdiff_t>(end),
                                           [&](int index) { return is_vertex(index); });
  }

  /// Drops values, and their list of indices, unless they fit; cuts surplus off the list.
  void fit(std::span<const float>& values, std::size_t width, std::span<const int>& list, bool per_vertex,
           const char* what) {
    const std::size_t count = values.size() / width;
    const char* why = nullptr;
    if (!all_finite(values)) {
      why = "some are not finite numbers";
    } else if (per_vertex) {
      why = list.empty() ? (count < largest_index_ ? "there are not enough" : nullptr) : misfit(list, count);
      list = list.first(std::min(list.size(), fields_.polygons.size()));
      if (!list.empty() && list.size() != fields_.polygons.size()) is_clean_ = false;
    } else {
      if (list.empty() ? count < face_count_ : list.size() < face_count_) why = "there are not enough";
      list = list.first(std::min(list.size(), face_count_));
      if (std::any_of(list.begin(), list.end(), [&](int index) { return !is_below(index, count); }))
        why = "an index is wrong";
    }
    if (why && !values.empty())
      checked_.remarks.push_back(std::string("its ") + what + " are left out: " + why);
    if (!why && !values.empty()) return;
    values = {};
    list = {};
  }

  static bool is_below(int index, std::size_t count) {
    return index >= 0 && static_cast<std::size_t>(index) < count;
  }

  /// Reason why a list does not have the faces of the polygons; null: it has.
  const char* misfit(std::span<const int> list, std::size_t count) const {
    const std::span<const int> polygons = fields_.polygons;
    // The last -1 may be missing from either.
    const std::size_t needed =
        !polygons.empty() && polygons.back() == -1 ? polygons.size() - 1 : polygons.size();
    if (list.size() < needed) return "its list of indices is too short";
    for (std::size_t i = 0; i < needed; ++i) {
      if ((list[i] == -1) != (polygons[i] == -1)) return "its list of indices has other faces";
      if (list[i] != -1 && !is_below(list[i], count)) return "an index is wrong";
    }
    return nullptr;
  }

  /// The indices of the good faces, each ended by -1.
  void keep_indices(std::span<const int> list, std::vector<int>& kept) const {
    kept.reserve(list.size() + 1);
    for_each_face(fields_.polygons, [&](std::size_t begin, std::size_t end) {
      if (!is_good_face(begin, end)) return;
      kept.insert(kept.end(), list.begin() + static_cast<std::ptrdiff_t>(begin),
                  list.begin() + static_cast<std::ptrdiff_t>(end));
      kept.push_back(-1);
    });
  }

  void keep_good(std::span<const float> values, std::span<const int>& list, std::vector<int>& kept,
                 bool per_vertex) const {
    if (values.empty() || (per_vertex && list.empty())) return;
    if (per_vertex) {
      keep_indices(list, kept);
    } else {
      int face = 0;
      for_each_face(fields_.polygons, [&](std::size_t begin, std::size_t end) {
        if (is_good_face(begin, end))
          kept.push_back(list.empty() ? face : list[static_cast<std::size_t>(face)]);
        ++face;
      });
    }
    list = kept;
  }

  const FaceFields& fields_;
  CheckedFaces& checked_;
  std::size_t vertex_count_ = 0;
  std::vector<bool> is_bad_ = {};  // vertices that are not finite; empty: none
  std::size_t face_count_ = 0;
  std::size_t kept_count_ = 0;
  std::size_t largest_index_ = 0;  // of a vertex in use, plus one
  bool is_clean_ = false;
};

}  // namespace

void check_faces(const FaceFields& fields, CheckedFaces& checked) { FaceChecker(fields, checked).check(); }

}  // namespace icome::files
