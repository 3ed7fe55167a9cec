#include "geometry/sweep/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "geometry/mesh/polygon_triangulation.h"

namespace icome::geometry {
namespace {

constexpr double kFullTurn = 6.283185307179586;

double cross_of(const Vector2& u, const Vector2& v) { return u.x() * v.y() - u.y() * v.x(); }

double distance_to_edge(const Vector2& point, const Vector2& a, const Vector2& b) {
  const Vector2 along = b - a;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - (a + t * along)).norm();
}

/// A profile without repeated corners, with the numbers that the corners had.
struct ThinnedProfile {
  std::vector<Vector2> points = {};
  std::vector<std::size_t> numbers = {};
};

ThinnedProfile without_repeats(const Profile& profile, double tolerance) {
  ThinnedProfile thinned;
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const Vector2& point = profile.points[i];
    if (!thinned.points.empty() && (point - thinned.points.back()).norm() <= tolerance) continue;
    thinned.points.push_back(point);
    thinned.numbers.push_back(i + 1);
  }
  while (!profile.open && thinned.points.size() > 1 &&
         (thinned.points.back() - thinned.points.front()).norm() <= tolerance) {
    thinned.points.pop_back();
    thinned.numbers.pop_back();
  }
  return thinned;
}

/// Searches for edges of a profile that come nearer to one another than the tolerance, except where one
/// continues the other.
class EdgeCrossings {
 public:
  EdgeCrossings(const std::vector<Vector2>& points, bool open, double tolerance)
      : points_(points), open_(open), edges_(points.size() - (open ? 1 : 0)), tolerance_(tolerance) {}

  /// Two edges, each named by its first corner.
  std::optional<std::pair<std::size_t, std::size_t>> find() const {
    std::vector<std::size_t> order(edges_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(low(a).x(), a) < std::pair(low(b).x(), b);
    });
    for (std::size_t i = 0; i < edges_; ++i)
      for (std::size_t j = i + 1; j < edges_ && low(order[j]).x() <= high(order[i]).x() + tolerance_; ++j)
        if (touch(order[i], order[j])) return std::minmax(order[i], order[j]);
    return std::nullopt;
  }

 private:
  const Vector2& start(std::size_t edge) const { return points_[edge]; }
  const Vector2& end(std::size_t edge) const { return points_[(edge + 1) % points_.size()]; }
  Vector2 low(std::size_t edge) const { return start(edge).cwiseMin(end(edge)); }
  Vector2 high(std::size_t edge) const { return start(edge).cwiseMax(end(edge)); }

  bool goes_on(std::size_t from, std::size_t to) const {
    return open_ ? from + 1 == to : (from + 1) % points_.size() == to;
  }

  bool touch(std::size_t first, std::size_t second) const {
    if (low(second).y() > high(first).y() + tolerance_ || low(first).y() > high(second).y() + tolerance_)
      return false;
    if (goes_on(first, second)) return folds(first, second);
    if (goes_on(second, first)) return folds(second, first);
    if (keeps_to_one_side(first, second) || keeps_to_one_side(second, first)) return false;
    return cross(first, second) || end_touches(first, second) || end_touches(second, first);
  }

  /// Does the other edge lie on one side of the line through the edge, clear of it? That settles most.
  bool keeps_to_one_side(std::size_t edge, std::size_t other) const {
    const Vector2 along = end(edge) - start(edge);
    const double room = tolerance_ * along.norm();
    const double a = cross_of(along, start(other) - start(edge));
    const double b = cross_of(along, end(other) - start(edge));
    return std::min(a, b) > room || std::max(a, b) < -room;
  }

  /// Does the second edge run back along the first, which ends where it starts?
  bool folds(std::size_t first, std::size_t second) const {
    return distance_to_edge(end(second), start(first), end(first)) <= tolerance_ ||
           distance_to_edge(start(first), start(second), end(second)) <= tolerance_;
  }

  bool end_touches(std::size_t edge, std::size_t other) const {
    return distance_to_edge(start(edge), start(other), end(other)) <= tolerance_ ||
           distance_to_edge(end(edge), start(other), end(other)) <= tolerance_;
  }

  bool divides(std::size_t edge, std::size_t other) const {
    const Vector2 along = end(edge) - start(edge);
    return (cross_of(along, start(other) - start(edge)) > 0.0) !=
           (cross_of(along, end(other) - start(edge)) > 0.0);
  }

  bool cross(std::size_t a, std::size_t b) const { return divides(a, b) && divides(b, a); }

  const std::vector<Vector2>& points_;
  bool open_;
  std::size_t edges_;
  double tolerance_;
};

base::Result<void> check_places(const Profile& profile) {
  if (profile.places.empty()) return {};
  if (profile.places.size() != profile.points.size())
    return base::fail(
        fmt::format("the profile has {} corners and {} places in a picture; give each corner one",
                    profile.points.size(), profile.places.size()));
  const auto is_usual = [](const Vector2& place) {
    return place.allFinite() && place.cwiseAbs().maxCoeff() <= kFarthestPictureRepeat;
  };
  if (!std::ranges::all_of(profile.places, is_usual))
    return base::fail(fmt::format("a picture is repeated up to {:g} times; give places within that",
                                  kFarthestPictureRepeat));
  return {};
}

base::Result<void> check_numbers(const Profile& profile) {
  if (profile.points.size() > kMaximumPolygonCorners)
    return base::fail(fmt::format("the profile has {} corners; use {} at most", profile.points.size(),
                                  kMaximumPolygonCorners));
  for (std::size_t i = 0; i < profile.points.size(); ++i)
    if (!(profile.points[i].cwiseAbs().maxCoeff() <= kLargestProfile) || !profile.points[i].allFinite())
      return base::fail(
          fmt::format("corner {} of the profile is not a finite number of metres up to {:g}; "
                      "give another",
                      i + 1, kLargestProfile));
  return {};
}

double doubled_area(const std::vector<Vector2>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    sum += cross_of(points[i] - points[0], points[i + 1] - points[0]);
  return sum;
}

bool is_on_a_line(const std::vector<Vector2>& points, double tolerance) {
  std::vector<Vector3> lifted;
  lifted.reserve(points.size());
  for (const Vector2& point : points) lifted.emplace_back(point.x(), point.y(), 0.0);
  return common_line(lifted, tolerance).has_value();
}

base::Result<void> check_outline(const ThinnedProfile& thinned, bool open, double tolerance) {
  const std::size_t fewest = open ? 2 : 3;
  if (thinned.points.size() < fewest)
    return base::fail(fmt::format("the profile has {} different corners; {} needs at least {}",
                                  thinned.points.size(), open ? "an open one" : "a closed one", fewest));
  if (!open && is_on_a_line(thinned.points, tolerance))
    return base::fail("the profile has no area, since its corners lie on one line; move one off it");
  if (const auto edges = EdgeCrossings(thinned.points, open, tolerance).find())
    return base::fail(fmt::format(
        "the edges of the profile after corners {} and {} cross or touch; draw it so that they keep apart",
        thinned.numbers[edges->first], thinned.numbers[edges->second]));
  return {};
}

}  // namespace

base::Result<Profile> regular_polygon(int corners, double radius, const Vector2& centre) {
  if (corners < 3 || static_cast<std::size_t>(corners) > kMaximumPolygonCorners)
    return base::fail(
        fmt::format("a polygon has 3 to {} corners, and {} were asked for", kMaximumPolygonCorners, corners));
  if (!(radius >= kSmallestProfile && radius <= kLargestProfile))
    return base::fail(fmt::format("the radius of a polygon is {:g} to {:g} m; give such a one",
                                  kSmallestProfile, kLargestProfile));
  Profile profile;
  for (int i = 0; i < corners; ++i) {
    const double angle = kFullTurn * i / corners;
    profile.points.emplace_back(centre + radius * Vector2(std::cos(angle), std::sin(angle)));
  }
  if (const auto sound = check_numbers(profile); !sound) return tl::unexpected(sound.error());
  return profile;
}

base::Result<Profile> checked_profile(const Profile& profile) {
  if (const auto sound = check_numbers(profile); !sound) return tl::unexpected(sound.error());
  if (const auto sound = check_places(profile); !sound) return tl::unexpected(sound.error());
  Eigen::AlignedBox2d box;
  double largest = 0.0;
  for (const Vector2& point : profile.points) {
    box.extend(point);
    largest = std::max(largest, point.cwiseAbs().maxCoeff());
  }
  if (profile.points.size() > 1 && !(box.sizes().maxCoeff() >= kSmallestProfile))
    return base::fail(fmt::format("the profile is smaller than {:g} m; scale it up", kSmallestProfile));
  const double tolerance = kSweepTolerance * largest;
  ThinnedProfile thinned = without_repeats(profile, tolerance);
  if (const auto sound = check_outline(thinned, profile.open, tolerance); !sound)
    return tl::unexpected(sound.error());
  if (!profile.open && doubled_area(thinned.points) < 0.0) {
    std::ranges::reverse(thinned.points);
    std::ranges::reverse(thinned.numbers);
  }
  Profile checked{std::move(thinned.points), profile.open};
  for (const std::size_t number : thinned.numbers)
    if (!profile.places.empty()) checked.places.push_back(profile.places[number - 1]);
  return checked;
}

std::optional<Vector3> common_line(std::span<const Vector3> points, double tolerance) {
  const auto farther = [&](const Vector3& a, const Vector3& b) {
    return (a - points[0]).squaredNorm() < (b - points[0]).squaredNorm();
  };
  const Vector3 across = *std::max_element(points.begin(), points.end(), farther) - points[0];
  if (across.norm() <= tolerance) return Vector3::Zero();
  const Vector3 direction = across.normalized();
  for (const Vector3& point : points)
    if ((point - points[0]).cross(direction).norm() > tolerance) return std::nullopt;
  return direction;
}

}  // namespace icome::geometry
