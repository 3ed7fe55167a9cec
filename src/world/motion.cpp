#include "world/motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "world/edit/edit.h"

namespace icome::world {
namespace {

using base::Quaternion;

constexpr double kLeastScale = 1e-6;   // of key frames
constexpr double kLeastTurn = 1e-100;  // length: below, squares of its numbers are lost
constexpr double kUnit = 1e-6;         // tolerance off 1 for the length of a turn

template <int Size>
using Numbers = Eigen::Matrix<double, Size, 1>;

/// Part of the three values that a spline has at each key.
enum class KeyPart : std::uint8_t { Arriving, Value, Leaving };

template <int Size>
Numbers<Size> numbers_at(const KeyFrames& frames, std::size_t key, KeyPart part = KeyPart::Value) {
  const bool spline = frames.interpolation == Interpolation::CubicSpline;
  const std::size_t row = spline ? 3 * key + std::size_t(part) : key;
  return Eigen::Map<const Numbers<Size>>(frames.values.data() + row * Size);
}

/// The moment within the cycle. Its end is not the beginning of the next (VRML 2.0, 6.50).
double within_cycle(const KeyFrames& frames, double time) {
  if (!(time > 0.0)) return 0.0;
  if (!frames.loops) return std::min(time, frames.cycle);
  const double part = std::fmod(time, frames.cycle);
  return part == 0.0 ? frames.cycle : part;
}

/// The key frames around a moment.
struct Around {
  std::size_t before = 0, after = 0;  // equal where there is nothing between
  double share = 0.0;                 // of the way between them
  double seconds = 0.0;               // from one to the other
};

Around around(const std::vector<double>& times, double time) {
  const auto next = std::upper_bound(times.begin(), times.end(), time);
  if (next == times.begin()) return {};
  const auto before = std::size_t(next - times.begin()) - 1;
  if (next == times.end()) return {before, before};
  const double seconds = *next - times[before];
  return {before, before + 1, (time - times[before]) / seconds, seconds};
}

/// The value on a cubic spline by glTF 2.0, appendix C.5.
template <int Size>
Numbers<Size> on_spline(const KeyFrames& frames, const Around& it) {
  if (it.before == it.after) return numbers_at<Size>(frames, it.before);
  const double t = it.share, t2 = t * t, t3 = t2 * t;
  return (2.0 * t3 - 3.0 * t2 + 1.0) * numbers_at<Size>(frames, it.before) +
         it.seconds * (t3 - 2.0 * t2 + t) * numbers_at<Size>(frames, it.before, KeyPart::Leaving) +
         (3.0 * t2 - 2.0 * t3) * numbers_at<Size>(frames, it.after) +
         it.seconds * (t3 - t2) * numbers_at<Size>(frames, it.after, KeyPart::Arriving);
}

Vector3 vector_at(const KeyFrames& frames, const Vector3& at_rest, double time) {
  if (frames.times.empty()) return at_rest;
  const Around it = around(frames.times, within_cycle(frames, time));
  if (frames.interpolation == Interpolation::CubicSpline) return on_spline<3>(frames, it);
  const Vector3 before = numbers_at<3>(frames, it.before);
  if (frames.interpolation == Interpolation::Step || it.before == it.after) return before;
  return (1.0 - it.share) * before + it.share * numbers_at<3>(frames, it.after);
}

Quaternion turn_at(const KeyFrames& frames, const Quaternion& at_rest, double time) {
  if (frames.times.empty()) return at_rest;
  const Around it = around(frames.times, within_cycle(frames, time));
  const Quaternion before = Quaternion(numbers_at<4>(frames, it.before)).normalized();
  if (frames.interpolation == Interpolation::Step || it.before == it.after) return before;
  if (frames.interpolation == Interpolation::Linear)
    return before.slerp(it.share, Quaternion(numbers_at<4>(frames, it.after)).normalized());
  const Numbers<4> turn = on_spline<4>(frames, it);
  const double length = turn.norm();
  return length > 0.0 && std::isfinite(length) ? Quaternion(Numbers<4>(turn / length)) : before;
}

bool is_turn(const Numbers<4>& numbers) {
  const double length = numbers.norm();
  return std::isfinite(length) && length > kLeastTurn;
}

/// Turns at rest are used unchanged: another length than 1 would stretch.
bool is_unit_turn(const Quaternion& turn) { return std::abs(turn.norm() - 1.0) < kUnit; }

base::Result<void> check_frames(const KeyFrames& frames, std::size_t size, const char* what) {
  const auto bad = [what](const char* why) { return base::fail(fmt::format("The {} {}.", what, why)); };
  const std::vector<double>& times = frames.times;
  if (frames.interpolation > Interpolation::CubicSpline) return bad("go on in a way that is not known");
  const std::size_t rows = frames.interpolation == Interpolation::CubicSpline ? 3 : 1;
  if (frames.values.size() / size / rows != times.size() || frames.values.size() % (size * rows) != 0)
    return bad("have not as many values as times");
  const auto finite = [](double it) { return std::isfinite(it); };
  if (!std::ranges::all_of(times, finite) || !std::ranges::all_of(frames.values, finite))
    return bad("have numbers that are not finite");
  if (!std::ranges::is_sorted(times) || (!times.empty() && times.front() < 0.0))
    return bad("go back in time");
  if (!(frames.cycle > 0.0) || !std::isfinite(frames.cycle)) return bad("have a cycle that takes no time");
  return {};
}

bool all_turns(const KeyFrames& rotation) {
  for (std::size_t key = 0; key < rotation.times.size(); ++key)
    if (!is_turn(numbers_at<4>(rotation, key))) return false;
  return true;
}

/// A transform that turns, stretches evenly and moves.
struct Similarity {
  Quaternion turn = Quaternion::Identity();
  double scale = 1.0;
  Vector3 way = Vector3::Zero();
};

std::optional<Similarity> similarity(const Affine3& frame) {
  constexpr double kNearlyIdentity = 1e-9;
  const base::Matrix3 linear = frame.linear();
  const double scale = std::cbrt(linear.determinant());
  if (!(scale > 0.0) || !std::isfinite(scale)) return std::nullopt;
  const base::Matrix3 turn = linear / scale;
  if (!(turn.transpose() * turn).isIdentity(kNearlyIdentity)) return std::nullopt;
  return Similarity{Quaternion(turn).normalized(), scale, frame.translation()};
}

/// Replaces each row of numbers by change(row, is_slope).
template <int Size, typename Change>
void change_values(KeyFrames& frames, Change&& change) {
  const bool spline = frames.interpolation == Interpolation::CubicSpline;
  for (std::size_t row = 0; row * Size < frames.values.size(); ++row) {
    Eigen::Map<Numbers<Size>> numbers(frames.values.data() + row * Size);
    numbers = change(Numbers<Size>(numbers), spline && row % 3 != std::size_t(KeyPart::Value));
  }
}

}  // namespace

bool PlaceParts::operator==(const PlaceParts& other) const {
  return translation == other.translation && rotation.coeffs() == other.rotation.coeffs() &&
         scale == other.scale && centre == other.centre &&
         stretch_axes.coeffs() == other.stretch_axes.coeffs();
}

Affine3 affine(const PlaceParts& parts) {
  base::Matrix3 linear = parts.rotation.toRotationMatrix();
  const Vector3& scale = parts.scale;
  if (scale.x() == scale.y() && scale.y() == scale.z()) {
    linear *= scale.x();  // about any axes
  } else {
    const base::Matrix3 axes = parts.stretch_axes.toRotationMatrix();
    linear = linear * axes * scale.asDiagonal() * axes.transpose();
  }
  Affine3 frame = Affine3::Identity();
  frame.linear() = linear;
  frame.translation() = parts.translation;
  if (!parts.centre.isZero(0.0)) frame.translation() += parts.centre - linear * parts.centre;
  return frame;
}

base::Result<void> check_motion(const Motion& motion) {
  const PlaceParts& rest = motion.rest;
  if (!is_unit_turn(rest.rotation) || !is_unit_turn(rest.stretch_axes) ||
      rest.scale.cwiseAbs().minCoeff() == 0.0 || !can_be_placed(affine(rest)))
    return base::fail("A motion must begin at a finite place that does not flatten the object.");
  for (const auto& checked : {check_frames(motion.translation, 3, "key frames of a way"),
                              check_frames(motion.rotation, 4, "key frames of a turn"),
                              check_frames(motion.scale, 3, "key frames of a size")}) {
    if (!checked) return checked;
  }
  if (!all_turns(motion.rotation)) return base::fail("The key frames of a turn have one that is none.");
  return {};
}

PlaceParts parts_at(const Motion& motion, double time) {
  PlaceParts parts = motion.rest;
  parts.translation = vector_at(motion.translation, parts.translation, time);
  parts.rotation = turn_at(motion.rotation, parts.rotation, time);
  if (motion.scale.times.empty()) return parts;
  // A scale that is smaller than the limit at rest may stay as small.
  const double least = std::min(kLeastScale, motion.rest.scale.cwiseAbs().minCoeff());
  parts.scale = vector_at(motion.scale, parts.scale, time).unaryExpr([least](double scale) {
    return std::copysign(std::max(std::abs(scale), least), scale);
  });
  return parts;
}

Affine3 place_at(const Motion& motion, const Affine3& at_rest, double time) {
  const Affine3 rest = affine(motion.rest);
  Affine3 place = affine(parts_at(motion, time));
  if (rest.matrix() != at_rest.matrix()) place = at_rest * rest.inverse() * place;
  return can_be_placed(place) ? place : at_rest;
}

std::optional<Motion> moved_along(const Motion& motion, const Affine3& at_rest) {
  const Affine3 rest = affine(motion.rest);
  if (rest.matrix() == at_rest.matrix()) return motion;
  const auto by = similarity(at_rest * rest.inverse());
  if (!by) return std::nullopt;
  const auto carried = [&](const Vector3& way) -> Vector3 { return by->scale * (by->turn * way); };
  const Vector3 from_centre = by->way + carried(motion.rest.centre) - motion.rest.centre;
  Motion moved = motion;
  moved.rest.translation = from_centre + carried(motion.rest.translation);
  moved.rest.rotation = by->turn * motion.rest.rotation;
  moved.rest.scale *= by->scale;
  change_values<3>(moved.translation, [&](const Numbers<3>& way, bool is_slope) -> Numbers<3> {
    return is_slope ? carried(way) : Vector3(from_centre + carried(way));
  });
  // Products of quaternions are linear in each of them: slopes turn along.
  change_values<4>(moved.rotation, [&](const Numbers<4>& turn, bool) -> Numbers<4> {
    return (by->turn * Quaternion(turn)).coeffs();
  });
  change_values<3>(moved.scale,
                   [&](const Numbers<3>& scale, bool) -> Numbers<3> { return by->scale * scale; });
  return moved;
}

double duration(const Motion& motion) {
  double longest = 0.0;
  for (const KeyFrames* frames : {&motion.translation, &motion.rotation, &motion.scale})
    if (!frames->times.empty()) longest = std::max(longest, frames->cycle);
  return longest;
}

bool loops(const Motion& motion) {
  const auto goes_on = [](const KeyFrames& it) { return !it.times.empty() && it.loops; };
  return goes_on(motion.translation) || goes_on(motion.rotation) || goes_on(motion.scale);
}

std::size_t key_count(const Motion& motion) {
  return motion.translation.times.size() + motion.rotation.times.size() + motion.scale.times.size();
}

std::size_t bytes_of(const Motion& motion) {
  std::size_t numbers = 0;
  for (const KeyFrames* frames : {&motion.translation, &motion.rotation, &motion.scale})
    numbers += frames->times.size() + frames->values.size();
  return sizeof(Motion) + numbers * sizeof(double);
}

std::vector<ObjectId> moving_objects(const World& world) {
  std::vector<ObjectId> ids;
  for (const auto& [id, object] : world.objects())
    if (object.motion) ids.push_back(id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

ObjectCourse::ObjectCourse(const World& world, ObjectId id) {
  for (const PhysicalObject* object = world.find(id); object; object = world.find(object->parent)) {
    const bool joins = !links_.empty() && !links_.back().motion && !object->motion;
    if (joins)
      links_.back().at_rest = object->parent_from_object * links_.back().at_rest;
    else
      links_.push_back({object->parent_from_object, object->motion});
  }
  std::reverse(links_.begin(), links_.end());
}

bool ObjectCourse::moves() const {
  return std::ranges::any_of(links_, [](const Link& it) { return it.motion != nullptr; });
}

Affine3 ObjectCourse::world_from_object(double time) const {
  Affine3 place = Affine3::Identity();
  for (const Link& it : links_)
    place = place * (it.motion ? place_at(*it.motion, it.at_rest, time) : it.at_rest);
  return place;
}

PosedWorld::PosedWorld(const World& at_rest, double time) : world_(at_rest) {
  for (const ObjectId id : moving_objects(world_)) {
    const PhysicalObject& object = *world_.find(id);
    movers_.push_back({id, object.parent_from_object, object.motion});
  }
  go_to(time);
}

Changes PosedWorld::go_to(double time) {
  Changes changes;
  for (const Mover& it : movers_) {
    const Affine3 place = place_at(*it.motion, it.at_rest, time);
    if (place.matrix() == world_.find(it.id)->parent_from_object.matrix()) continue;
    if (apply(world_, PlaceObject{it.id, place})) changes.objects.push_back(it.id);
  }
  return changes;
}

}  // namespace icome::world
