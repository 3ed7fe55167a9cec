#include "geometry/sweep/extrusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh_repair.h"
#include "geometry/mesh/polygon_triangulation.h"
#include "geometry/sweep/section_weld.h"
#include "geometry/sweep/sweep_advance.h"
#include "geometry/sweep/triangle_crossing.h"

namespace icome::geometry {
namespace {

using base::Result;
using Triangle = TriangleMesh::Triangle;
using Quad = std::array<std::uint32_t, 4>;

/// A triangle lower than this share of the tolerance has no area.
constexpr double kLeastHeight = 0x1p-6;
/// A last section this near to the first, as shares of the latest motion and of the profile, ends on it:
/// angles are typed with few digits.
constexpr double kMeetingShare = 0x1p-10;
constexpr double kMeetingShareOfProfile = 0x1p-6;
/// The other diagonal of a quad is taken where 1 less the cosine of its fold is less than this share of that
/// of the first.
constexpr double kMuchBetter = 0.5;
constexpr double kBetter = 1.0;

/// The most tests of an edge against a triangle in a sweep's search for crossings with itself, and the
/// number added for each triangle: a bound for profiles with thousands of long corners side by side.
constexpr std::uint64_t kTests = std::uint64_t{1} << 27U;
constexpr std::uint64_t kTestsOfATriangle = 200;
/// The direction in the profile in which cuts lead; few edges are drawn across it.
constexpr double kSlant = 0.618;
/// A quad is plane when its fold's cosine is this near to 1.
constexpr double kPlaneFold = 0x1p-40;
/// The longest further move of a profile that is scaled to nothing, in tolerances: it goes on shrinking where
/// a step is repeated more often than can be seen.
constexpr double kNothingMoves = 0x1p10;

/// The diagonal along which a quad is cut: from its second corner, or from its first. Unless it is a must,
/// the other is taken where it folds the quad less.
struct Cut {
  bool from_second = false;
  bool is_must = false;
};

/// Does the outline go back from this corner to the one before it?
bool folds_at(const std::vector<std::uint32_t>& outline, std::size_t corner) {
  const std::size_t count = outline.size();
  const std::uint32_t before = outline[(corner + count - 1) % count];
  return before == outline[(corner + 1) % count] && before != outline[corner];
}

/// Two triangles instead of a quad, and the cosine of the angle between their normals.
struct Halves {
  Triangle first = {};
  Triangle second = {};
  double fold = 0.0;
};

/// The triangles of an outline, without ones that have no area where edges go straight on.
std::vector<Triangle> cap_triangles(const std::vector<Vector3>& outline) {
  TriangleMesh cap;
  cap.positions = outline;
  triangulate_polygon(outline, cap.triangles);
  TriangleMesh repaired = cap;
  repair(repaired);
  // If repair removed more than that, it has seen cracks in details near to its own limits.
  const bool is_whole =
      repaired.positions.size() == outline.size() && repaired.triangles.size() == cap.triangles.size();
  return is_whole ? repaired.triangles : cap.triangles;
}

std::string step_name(std::span<const SweepStep> steps, std::size_t step, int repeat) {
  if (steps[step].repeat == 1) return fmt::format("step {}", step + 1);
  return fmt::format("step {} (repeat {} of {})", step + 1, repeat, steps[step].repeat);
}

/// The texture coordinates for a metre along x and y on an outline, approximately (least squares).
Eigen::Matrix2d places_per_metre(const std::vector<Vector2>& points, const std::vector<Vector2>& places) {
  Vector2 middle = Vector2::Zero(), middle_place = Vector2::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    middle += points[i] / double(points.size());
    middle_place += places[i] / double(points.size());
  }
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero(), common = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    spread += (points[i] - middle) * (points[i] - middle).transpose();
    common += (places[i] - middle_place) * (points[i] - middle).transpose();
  }
  return common * spread.inverse();
}

/// Makes the mesh, section by section. Triangles are wound for a sweep that advances forward, and turned at
/// the end when it went backward.
class Extruder {
 public:
  Extruder(const Profile& profile, std::span<const SweepStep> steps, ExtrusionEnds ends)
      : steps_(steps),
        ends_(ends),
        open_(profile.open),
        places_(profile.places),
        rules_(ends == ExtrusionEnds::Capped, ends == ExtrusionEnds::Joined) {
    Bounds box;
    for (const Vector2& point : profile.points) {
      first_.points.emplace_back(point.x(), point.y(), 0.0);
      box.extend(first_.points.back());
    }
    profile_size_ = box.sizes().norm();
    way_.resize(profile.points.size(), 0.0);
    if (!places_.empty()) find_ways_out(profile.points);
  }

  Result<TriangleMesh> run() {
    if (auto sound = check_size(); !sound) return tl::unexpected(sound.error());
    if (auto sound = measure(); !sound) return tl::unexpected(sound.error());
    for (const Vector3& point : first_.points) {
      first_.vertices.push_back(static_cast<std::uint32_t>(mesh_.positions.size()));
      mesh_.positions.push_back(point);
    }
    latest_ = first_;
    SweepWalk walk(steps_);
    while (walk.next())
      if (auto sound = add_section(walk); !sound) return tl::unexpected(sound.error());
    if (auto sound = finish(); !sound) return tl::unexpected(sound.error());
    return std::move(mesh_);
  }
  /// The texture coordinates of every triangle that run() has made, if the profile has places; else none.
  std::vector<std::array<Vector2, 3>>& coordinates() { return coordinates_; }

 private:
  /// Finds for each edge of the outline the texture coordinates for a metre straight out.
  void find_ways_out(const std::vector<Vector2>& points) {
    const Eigen::Matrix2d per_metre = places_per_metre(points, places_);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vector2 along = (points[(i + 1) % points.size()] - points[i]).normalized();
      ways_out_.emplace_back(per_metre * Vector2(along.y(), -along.x()));
    }
  }

  Result<void> check_size() const {
    std::uint64_t sections = 1;
    for (const SweepStep& step : steps_) sections += static_cast<std::uint64_t>(step.repeat);
    const std::uint64_t most = kMaximumExtrusionTriangles / (2 * first_.points.size()) - 1;
    if (sections <= most) return {};
    return base::fail(fmt::format(
        "{} repeats of a profile with {} corners make more than {} triangles; repeat {} times at most",
        sections - 1, first_.points.size(), kMaximumExtrusionTriangles, most - 1));
  }

  /// Sets the tolerance by the largest coordinates of the sweep; fails where these are too large.
  Result<void> measure() {
    double largest = 0.0;
    for (const Vector3& point : first_.points) largest = std::max(largest, point.cwiseAbs().maxCoeff());
    const double extent = largest;
    for (const SweepStep& step : steps_) largest = std::max(largest, step.centre.cwiseAbs().maxCoeff());
    SweepWalk walk(steps_);
    while (walk.next()) {
      const double reach = (walk.place().translation().cwiseAbs() +
                            walk.place().linear().cwiseAbs() * Vector3(extent, extent, 0.0))
                               .maxCoeff();
      if (!(reach <= kLargestExtrusion))
        return base::fail(fmt::format("{} leads further than {:g} m away; scale or move by less",
                                      step_name(steps_, walk.step(), walk.repeat()), kLargestExtrusion));
      largest = std::max(largest, reach);
    }
    tolerance_ = kSweepTolerance * largest;
    return {};
  }

  Result<void> add_section(const SweepWalk& walk) {
    step_ = walk.step();
    repeat_ = walk.repeat();
    SweepSection section;
    section.place = walk.place();
    for (const Vector3& point : first_.points) section.points.push_back(section.place * point);
    const double way = longest_way_to(section);
    if (walk.at_end() && !mesh_.triangles.empty()) {
      const int corner =
          meeting_corner(first_.points, section.points, open_,
                         std::min(kMeetingShare * way, kMeetingShareOfProfile * profile_size_));
      if (corner >= 0) return join_at(section, static_cast<std::size_t>(corner));
    }
    if (shape_ != SectionShape::Whole) {
      if (way <= kNothingMoves * tolerance_) return {};
      return fail_here("moves a profile that is scaled to nothing; leave it out or scale less");
    }
    const SectionShape shape = weld_section(section, latest_, open_, tolerance_, mesh_.positions);
    if (section.vertices == latest_.vertices) return {};
    if (shape == SectionShape::Ragged)
      return fail_here(
          "flattens the profile to a line on which its corners do not meet in pairs; "
          "scale it to a point, or leave it some thickness");
    if (auto sound = add_band(section); !sound) return sound;
    shape_ = shape;
    latest_ = std::move(section);
    way_ = way_to_;
    return {};
  }

  double longest_way_to(const SweepSection& section) const {
    double longest = 0.0;
    for (std::size_t i = 0; i < section.points.size(); ++i)
      longest = std::max(longest, (section.points[i] - latest_.points[i]).norm());
    return longest;
  }

  /// Joins the last section, which lies on the first, to it: corner 0 meets the first one's corner `corner`.
  Result<void> join_at(SweepSection& section, std::size_t corner) {
    if (ends_ != ExtrusionEnds::Joined)
      return fail_here("ends where the profile starts; join the ends, or go less far");
    const std::size_t count = first_.points.size();
    for (std::size_t i = 0; i < count; ++i) section.vertices.push_back(first_.vertices[(i + corner) % count]);
    is_joined_ = true;
    return add_band(section);
  }

  Result<void> add_band(const SweepSection& to) {
    const std::size_t before = mesh_.triangles.size();
    better_fold_ = open_ ? kBetter : kMuchBetter;
    way_to_ = way_;
    for (std::size_t i = 0; i < to.points.size(); ++i)
      way_to_[i] += (to.points[i] - latest_.points[i]).norm();
    if (!add_quads(to))
      return fail_here(
          "makes the sheet cross itself; move the axis out of the profile or turn less at a time");
    if (auto sound = check_flatness(before); !sound) return sound;
    if (!open_)
      if (auto sound = check_advance(to, before); !sound) return sound;
    if (!has_folds_) return {};
    tests_left_ += kTestsOfATriangle * (mesh_.triangles.size() - before);
    if (find_crossing(mesh_, before, tolerance_, !open_, tests_left_) == TriangleCrossing::None) return {};
    // Strong twists succeed more often where each quad is cut by itself.
    mesh_.triangles.resize(before);
    if (!places_.empty()) coordinates_.resize(before);
    better_fold_ = kBetter;
    add_quads(to);
    if (auto sound = check_flatness(before); !sound) return sound;
    const TriangleCrossing crossing = find_crossing(mesh_, before, tolerance_, !open_, tests_left_);
    if (crossing == TriangleCrossing::None) return {};
    if (crossing == TriangleCrossing::NotSought)
      return fail_here(
          "twists a profile too intricate to be kept from crossing itself; give it fewer corners");
    return fail_here("twists or squeezes the profile so far that its triangles meet; do it in smaller parts");
  }

  /// Adds the quads up to the section; false where the sheet crosses itself.
  bool add_quads(const SweepSection& to) {
    has_folds_ = false;
    const std::size_t count = to.vertices.size();
    for (std::size_t i = 0; i + (open_ ? 1 : 0) < count; ++i) {
      const std::size_t j = (i + 1) % count;
      const Quad quad = {latest_.vertices[i], latest_.vertices[j], to.vertices[j], to.vertices[i]};
      const std::size_t before = mesh_.triangles.size();
      if (!add_quad(quad, cut_between(to.vertices, i, j))) return false;
      if (!places_.empty()) place_quad(quad, i, j, before);
    }
    return true;
  }

  /// Gives the triangles that were made of a quad their places in the picture. Corners that came together are
  /// placed half-way.
  void place_quad(const Quad& quad, std::size_t i, std::size_t j, std::size_t before) {
    const Vector2& out = ways_out_[i];
    const std::array<Vector2, 4> places = {places_[i] + way_[i] * out, places_[j] + way_[j] * out,
                                           places_[j] + way_to_[j] * out, places_[i] + way_to_[i] * out};
    for (std::size_t t = before; t < mesh_.triangles.size(); ++t) {
      std::array<Vector2, 3>& corners = coordinates_.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        Vector2 sum = Vector2::Zero();
        int count = 0;
        for (std::size_t q = 0; q < quad.size(); ++q) {
          if (quad[q] != mesh_.triangles[t][k]) continue;
          sum += places[q];
          ++count;
        }
        corners[k] = sum / count;
      }
    }
  }

  /// At a fold of an outline, both quads are cut towards the fold: two cuts from the other side would end in
  /// the same vertex. Elsewhere all cuts lead the same way through the profile, so that the two sides of a
  /// thin wall that is twisted bulge alike.
  Cut cut_between(const std::vector<std::uint32_t>& to, std::size_t i, std::size_t j) const {
    if (!open_ && (folds_at(to, j) || folds_at(latest_.vertices, i))) return {false, true};
    if (!open_ && (folds_at(to, i) || folds_at(latest_.vertices, j))) return {true, true};
    const Vector3 way = first_.points[j] - first_.points[i];
    return {way.x() + kSlant * way.y() < 0.0, false};
  }

  Result<void> check_flatness(std::size_t before) const {
    for (std::size_t t = before; t < mesh_.triangles.size(); ++t)
      if (is_flat(mesh_.triangles[t]))
        return fail_here("moves an edge of the profile along itself; move it aside or scale evenly");
    return {};
  }

  Result<void> check_advance(const SweepSection& to, std::size_t before) {
    const SweepAdvance advance = advance_between(latest_, to, tolerance_);
    if (advance == SweepAdvance::Level) return check_level(before);
    if (advance == SweepAdvance::Crossing)
      return fail_here(
          "meets the section before it inside the profile, so that the surface would run through "
          "itself; move the axis out of the profile, turn less at a time or move further");
    if (rules_.take(advance)) return {};
    return fail_here("turns back into what the steps before it have made; go on in their direction");
  }

  /// Checks a step within the plane: the old outline must be all inside the new one, or all outside.
  Result<void> check_level(std::size_t before) {
    const Vector3 normal = latest_.normal();
    bool shrinks = false;
    bool grows = false;
    for (std::size_t t = before; t < mesh_.triangles.size(); ++t)
      (normal_of(mesh_.triangles[t]).dot(normal) > 0.0 ? shrinks : grows) = true;
    if (shrinks == grows)
      return fail_here(
          "moves the profile within its own plane across its own edges; move it out of the plane");
    if (rules_.take_level(shrinks)) return {};
    return fail_here(
        "scales the profile within its own plane back over what is there; move it out of the plane");
  }

  Result<void> finish() {
    is_past_steps_ = true;
    const bool joins = ends_ == ExtrusionEnds::Joined;
    if (joins && shape_ != SectionShape::Whole)
      return base::fail(
          "a sweep that ends in a point or a line cannot be joined to its start; cap it instead");
    if (joins && !is_joined_)
      if (auto sound = add_band(first_); !sound) return sound;
    if (mesh_.triangles.empty()) return base::fail("the steps move nothing; give one that does");
    if (open_) {
      turn_closed_sheet(joins);
      drop_unused_vertices(mesh_);
      return {};
    }
    if (!rules_.has_volume())
      return base::fail("the steps never leave the plane of the profile; move it out or turn it");
    if (!rules_.may_end())
      return base::fail(
          "the last step scales the profile within its own plane, back over what is there; leave "
          "it out or move on");
    if (ends_ == ExtrusionEnds::Capped) add_caps();
    if (rules_.starts_backward()) turn_all();
    drop_unused_vertices(mesh_);  // corners within an edge on the axis have no triangle
    return {};
  }

  void add_caps() {
    for (const Triangle& t : cap_triangles(first_.points)) {
      add_cap_triangle(first_, {t[0], t[2], t[1]});
      if (shape_ == SectionShape::Whole) add_cap_triangle(latest_, t);
    }
  }

  /// `corners` are numbers of the outline's corners.
  void add_cap_triangle(const SweepSection& section, const Triangle& corners) {
    const std::size_t before = mesh_.triangles.size();
    add_triangle({section.vertices[corners[0]], section.vertices[corners[1]], section.vertices[corners[2]]});
    if (places_.empty() || mesh_.triangles.size() == before) return;
    coordinates_.push_back({places_[corners[0]], places_[corners[1]], places_[corners[2]]});
  }

  /// Turns a sheet whose rims lie on the axis of a ring to face out: such a sheet has an outside.
  void turn_closed_sheet(bool joins) {
    const bool is_closed = joins && first_.vertices.front() == latest_.vertices.front() &&
                           first_.vertices.back() == latest_.vertices.back();
    if (is_closed && signed_volume(mesh_) < 0.0) turn_all();
  }

  void turn_all() {
    for (Triangle& triangle : mesh_.triangles) std::swap(triangle[1], triangle[2]);
    for (auto& corners : coordinates_) std::swap(corners[1], corners[2]);
  }

  /// Adds a quad; with equal corners, a triangle or nothing. False: an open profile's quad crosses itself.
  bool add_quad(const Quad& quad, Cut cut) {
    std::vector<std::uint32_t>& corners = quad_corners_;
    corners.clear();
    for (const std::uint32_t corner : quad)
      if (corners.empty() || corner != corners.back()) corners.push_back(corner);
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
    if (corners.size() == 3) add_triangle({corners[0], corners[1], corners[2]});
    if (corners.size() < 4) return true;
    const Halves halves = halves_of(quad, cut);
    add_triangle(halves.first);
    add_triangle(halves.second);
    has_folds_ = has_folds_ || halves.fold < 1.0 - kPlaneFold;
    return !open_ || halves.fold >= 0.0;
  }

  void add_triangle(const Triangle& t) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh_.triangles.push_back(t);
  }

  Halves halves_of(const Quad& q, Cut cut) const {
    Halves taken = {{q[0], q[1], q[2]}, {q[0], q[2], q[3]}};
    Halves other = {{q[0], q[1], q[3]}, {q[1], q[2], q[3]}};
    if (cut.from_second) std::swap(taken, other);
    for (Halves* halves : {&taken, &other})
      halves->fold = normal_of(halves->first).normalized().dot(normal_of(halves->second).normalized());
    const bool is_worse = 1.0 - other.fold >= better_fold_ * (1.0 - taken.fold) - kPlaneFold;
    return is_worse || cut.is_must ? taken : other;
  }

  Vector3 normal_of(const Triangle& t) const {
    const Vector3& a = mesh_.positions[t[0]];
    return (mesh_.positions[t[1]] - a).cross(mesh_.positions[t[2]] - a);
  }

  bool is_flat(const Triangle& t) const {
    double longest = 0.0;
    for (int i = 0; i < 3; ++i)
      longest = std::max(longest, (mesh_.positions[t[(i + 1) % 3]] - mesh_.positions[t[i]]).norm());
    return !(normal_of(t).norm() > kLeastHeight * tolerance_ * longest);
  }

  tl::unexpected<base::Error> fail_here(std::string_view why) const {
    const std::string where =
        is_past_steps_ ? "joining the last section to the first" : step_name(steps_, step_, repeat_);
    return base::fail(fmt::format("{} {}", where, why));
  }

  std::span<const SweepStep> steps_;
  ExtrusionEnds ends_;
  bool open_;
  std::vector<Vector2> places_;         // in the picture, of the outline's corners; none: there is no picture
  std::vector<Vector2> ways_out_ = {};  // of the edges from them, per metre
  std::vector<std::array<Vector2, 3>> coordinates_ = {};
  std::vector<double> way_ = {};     // m, the length that each corner has moved to the latest section
  std::vector<double> way_to_ = {};  // and to the next
  AdvanceRules rules_;
  double profile_size_ = 0.0;
  double tolerance_ = 0.0;
  TriangleMesh mesh_ = {};
  SweepSection first_ = {};
  SweepSection latest_ = {};                  // the last that made triangles
  SectionShape shape_ = SectionShape::Whole;  // of the latest
  bool is_joined_ = false;
  std::size_t step_ = 0;  // the current step of the sweep, for errors
  int repeat_ = 0;
  bool is_past_steps_ = false;
  double better_fold_ = kBetter;
  std::uint64_t tests_left_ = kTests;
  bool has_folds_ = false;  // of the band being made: are some of its quads not plane?
  std::vector<std::uint32_t> quad_corners_ = {};
};

}  // namespace

Result<TriangleMesh> extrude(const Profile& profile, std::span<const SweepStep> steps, ExtrusionEnds ends) {
  if (auto sound = check_steps(steps); !sound) return tl::unexpected(sound.error());
  const Result<Profile> checked = checked_profile(profile);
  if (!checked) return tl::unexpected(checked.error());
  return Extruder(*checked, steps, ends).run();
}

Result<TexturedExtrusion> extrude_textured(const Profile& profile, std::span<const SweepStep> steps,
                                           ExtrusionEnds ends) {
  if (auto sound = check_steps(steps); !sound) return tl::unexpected(sound.error());
  const Result<Profile> checked = checked_profile(profile);
  if (!checked) return tl::unexpected(checked.error());
  Extruder extruder(*checked, steps, ends);
  auto mesh = extruder.run();
  if (!mesh) return tl::unexpected(mesh.error());
  return TexturedExtrusion{std::move(*mesh), std::move(extruder.coordinates())};
}

}  // namespace icome::geometry
