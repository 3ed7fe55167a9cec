#include "files/vrml/worker/extrusion.h"

#include <algorithm>

#include "base/decompositions.h"

namespace icome::files {
namespace {

using base::Matrix3;
using base::Vector2;
using base::Vector3;

/// A direction, or zero where there is none.
Vector3 direction(const Vector3& v) { return v.isZero(0.0) ? v : v.stableNormalized(); }

/// Gives each zero direction that of the nearest before it with one, or else of the first with one. False:
/// none has one.
bool fill_gaps(std::vector<Vector3>& directions) {
  const auto has = [](const Vector3& v) { return !v.isZero(0.0); };
  const auto first = std::find_if(directions.begin(), directions.end(), has);
  if (first == directions.end()) return false;
  std::fill(directions.begin(), first, *first);
  for (auto it = first + 1; it != directions.end(); ++it)
    if (!has(*it)) *it = *(it - 1);
  return true;
}

/// Turns of the cross section's plane at each point of the spine: columns x, y and z.
std::vector<Matrix3> section_planes(const std::vector<Vector3>& spine, bool is_closed) {
  const std::size_t count = spine.size();
  std::vector<Vector3> along(count);
  std::vector<Vector3> across(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_end = i == 0 || i + 1 == count;
    const Vector3& before = spine[i > 0 ? i - 1 : is_closed ? count - 2 : 0];
    const Vector3& after = spine[i + 1 < count ? i + 1 : is_closed ? 1 : count - 1];
    along[i] = direction(after - before);
    const Vector3 forth = direction(after - spine[i]);
    const Vector3 back = direction(before - spine[i]);
    const Vector3 normal = forth.cross(back);
    // A straight line has no plane, only a normal left by rounding.
    if ((!is_end || is_closed) && normal.norm() > 1e-6)
      across[i] = direction(normal);
    else
      across[i].setZero();
  }
  if (!fill_gaps(along)) along.assign(count, Vector3::UnitY());
  std::vector<Matrix3> planes(count);
  if (!fill_gaps(across)) {
    const Eigen::Quaterniond turn = base::rotation_between(Vector3::UnitY(), along.front());
    std::fill(planes.begin(), planes.end(), turn.toRotationMatrix());
    return planes;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0 && across[i].dot(across[i - 1]) < 0.0) across[i] = -across[i];
    const Vector3 x = direction(along[i].cross(across[i]));
    planes[i] << x, along[i], direction(x.cross(along[i]));
  }
  return planes;
}

template <typename Value>
const Value& at_or_last(const std::vector<Value>& values, std::size_t i) {
  return values[std::min(i, values.size() - 1)];
}

/// Makes the faces of one extrusion.
class ExtrusionMaker {
 public:
  explicit ExtrusionMaker(const ExtrusionFields& fields)
      : fields_(fields), columns_(fields.cross_section.size()), rows_(fields.spine.size()) {}

  MadeFaces make() {
    const bool is_closed = rows_ > 2 && fields_.spine.front() == fields_.spine.back();
    const std::vector<Matrix3> planes = section_planes(fields_.spine, is_closed);
    for (std::size_t i = 0; i < rows_; ++i) add_section(i, planes[i]);
    for (std::size_t i = 0; i + 1 < rows_; ++i)
      for (std::size_t j = 0; j + 1 < columns_; ++j) add_side(i, j);
    if (!is_closed && fields_.begin_cap) add_cap(0, true);
    if (!is_closed && fields_.end_cap) add_cap(rows_ - 1, false);
    return maker_.take();
  }

 private:
  using Corner = FaceMaker::Corner;

  void add_section(std::size_t i, const Matrix3& plane) {
    const Vector2& scale = at_or_last(fields_.scales, i);
    const Matrix3 turn = plane * at_or_last(fields_.orientations, i);
    for (std::size_t j = 0; j < columns_; ++j) {
      const Vector2 flat = fields_.cross_section[j].cwiseProduct(scale);
      const Vector3 point = fields_.spine[i] + turn * Vector3(flat.x(), 0.0, flat.y());
      corners_.push_back({maker_.vertex({point.x(), point.y(), point.z()}),
                          maker_.texture(static_cast<double>(j) / static_cast<double>(columns_ - 1),
                                         static_cast<double>(i) / static_cast<double>(rows_ - 1))});
    }
  }

  /// Two triangles, since four corners need not lie in a plane.
  void add_side(std::size_t i, std::size_t j) {
    const Corner& a = corners_[i * columns_ + j];
    const Corner& b = corners_[i * columns_ + j + 1];
    const Corner& c = corners_[(i + 1) * columns_ + j + 1];
    const Corner& d = corners_[(i + 1) * columns_ + j];
    maker_.face(std::array{a, b, c});
    maker_.face(std::array{a, c, d});
  }

  void add_cap(std::size_t i, bool is_begin) {
    Vector2 low = fields_.cross_section.front();
    Vector2 high = low;
    for (const Vector2& point : fields_.cross_section) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    const double size = (high - low).maxCoeff() > 0.0 ? (high - low).maxCoeff() : 1.0;
    std::vector<Corner> cap;
    for (std::size_t j = 0; j < columns_; ++j) {
      const Vector2 place = (fields_.cross_section[j] - low) / size;
      cap.push_back({corners_[i * columns_ + j].vertex, maker_.texture(place.x(), place.y())});
    }
    if (is_begin) std::reverse(cap.begin(), cap.end());
    maker_.face(cap);
  }

  const ExtrusionFields& fields_;
  std::size_t columns_;
  std::size_t rows_;
  FaceMaker maker_ = {};
  std::vector<Corner> corners_ = {};  // row by row along the spine
};

}  // namespace

MadeFaces make_extrusion(const ExtrusionFields& fields) { return ExtrusionMaker(fields).make(); }

}  // namespace icome::files
