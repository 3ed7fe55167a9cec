#include "files/gltf/gltf_animations.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "files/gltf/gltf_value.h"
#include "files/straight_motion.h"

namespace icome::files {
namespace {

using base::Vector3;
using tinygltf::Value;
using world::Interpolation;
using world::KeyFrames;
using world::Motion;
using world::PlaceParts;

bool is_even(const Vector3& scale) { return scale.x() == scale.y() && scale.y() == scale.z(); }

bool always_even(const Motion& motion) {
  if (!is_even(motion.rest.scale)) return false;
  for (std::size_t row = 0; 3 * row < motion.scale.values.size(); ++row)
    if (!is_even(Vector3(motion.scale.values.data() + 3 * row))) return false;
  return true;
}

bool moves_about_centre(const Motion& motion) {
  return !motion.rest.centre.isZero(0.0) && (!motion.rotation.times.empty() || !motion.scale.times.empty());
}

/// A moment to be written, and the moment whose place it gets: an earlier one before a jump.
struct Moment {
  double time = 0.0;
  double seen = 0.0;
  auto operator<=>(const Moment&) const = default;
};

/// The latest moment before `time` in a file's single precision.
double just_before(double time) { return double(std::nextafter(float(time), 0.0F)); }

/// The jumps: two key frames at one moment, as the file will have them, or a step of a Step course.
std::vector<Moment> jumps_in(const KeyFrames& frames) {
  std::vector<Moment> jumps;
  for (std::size_t key = 1; key < frames.times.size(); ++key) {
    const double time = frames.times[key], before = just_before(time);
    if (frames.times[key - 1] == time)
      jumps.push_back({time, before});
    else if (frames.interpolation == Interpolation::Step)
      jumps.push_back({before, before});
  }
  return jumps;
}

/// Do all parts that move have one cycle?
bool in_one_cycle(const Motion& motion) {
  const KeyFrames* first = nullptr;
  for (const KeyFrames* frames : {&motion.rotation, &motion.scale, &motion.translation}) {
    if (frames->times.empty()) continue;
    if (!first) first = frames;
    if (frames->cycle != first->cycle || frames->loops != first->loops) return false;
  }
  return true;
}

/// The moments of all parts, finely cut, up to the cycle's end, beyond which key frames may lie.
std::vector<Moment> common_moments(const Motion& motion, double cycle) {
  std::vector<double> times;
  std::vector<Moment> moments;
  for (const KeyFrames* frames : {&motion.rotation, &motion.scale, &motion.translation}) {
    times.insert(times.end(), frames->times.begin(), frames->times.end());
    const std::vector<Moment> jumps = jumps_in(*frames);
    moments.insert(moments.end(), jumps.begin(), jumps.end());
  }
  std::sort(times.begin(), times.end());
  if (std::erase_if(times, [&](double time) { return time > cycle; }) > 0) times.push_back(cycle);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::erase_if(moments, [&](const Moment& it) { return it.time > cycle; });
  for (const double time : cut_finer(times, kPiecesOfBend)) moments.push_back({time, time});
  std::sort(moments.begin(), moments.end());
  moments.erase(std::unique(moments.begin(), moments.end()), moments.end());
  return moments;
}

/// The translation of a node without a centre that has the same place.
Vector3 way_of(const PlaceParts& parts) { return world::affine(parts).translation(); }

/// The translation of a turn or growth about a centre, in one cycle, for a node without.
KeyFrames way_about_centre(const Motion& motion) {
  const KeyFrames& like = motion.rotation.times.empty() ? motion.scale : motion.rotation;
  KeyFrames way{.cycle = like.cycle, .loops = like.loops};
  for (const Moment& moment : common_moments(motion, like.cycle)) {
    const Vector3 place = way_of(world::parts_at(motion, moment.seen));
    way.times.push_back(moment.time);
    way.values.insert(way.values.end(), place.begin(), place.end());
  }
  return way;
}

/// Does single precision hold all its numbers, also moments that are moved apart?
bool fits_singles(const Motion& motion) {
  constexpr double kMost = 0.5 * double(std::numeric_limits<float>::max());
  const auto fits = [](double number) { return std::abs(number) <= kMost; };
  return std::ranges::all_of(
      std::array{&motion.translation, &motion.rotation, &motion.scale}, [&](const KeyFrames* it) {
        return std::ranges::all_of(it->times, fits) && std::ranges::all_of(it->values, fits);
      });
}

using NodeMotion = tl::expected<Motion, GltfAnimations::Loss>;

/// The motion without a centre and stretch axes, which nodes lack; or the loss.
NodeMotion as_node(const Motion& motion) {
  Motion node = motion;
  if (!always_even(motion) && !motion.rest.stretch_axes.isApprox(base::Quaternion::Identity(), 1e-12))
    return tl::unexpected(GltfAnimations::Loss::Stretch);
  if (moves_about_centre(motion)) {
    if (!in_one_cycle(motion)) return tl::unexpected(GltfAnimations::Loss::Cycles);
    node.translation = way_about_centre(motion);
  } else if (!motion.rest.centre.isZero(0.0)) {
    // The centre shifts all places alike.
    PlaceParts beside = motion.rest;
    beside.translation.setZero();
    const Vector3 shift = way_of(beside);
    const bool spline = motion.translation.interpolation == Interpolation::CubicSpline;
    for (std::size_t row = 0; 3 * row < node.translation.values.size(); ++row) {
      if (spline && row % 3 != 1) continue;
      Eigen::Map<Vector3>(node.translation.values.data() + 3 * row) += shift;
    }
  }
  node.rest.translation = way_of(motion.rest);
  node.rest.centre.setZero();
  node.rest.stretch_axes.setIdentity();
  if (!fits_singles(node)) return tl::unexpected(GltfAnimations::Loss::Size);
  return node;
}

/// The times in single precision, each later than the one before, as glTF requires.
std::vector<std::array<float, 1>> rising(const std::vector<double>& times) {
  std::vector<std::array<float, 1>> result;
  for (const double time : times) {
    auto rounded = float(time);
    if (!result.empty() && !(rounded > result.back()[0]))
      rounded = std::nextafter(result.back()[0], std::numeric_limits<float>::infinity());
    result.push_back({rounded});
  }
  return result;
}

template <std::size_t Size>
std::vector<std::array<float, Size>> float_rows(const std::vector<double>& values) {
  std::vector<std::array<float, Size>> rows(values.size() / Size);
  for (std::size_t i = 0; i < values.size(); ++i) rows[i / Size][i % Size] = float(values[i]);
  return rows;
}

const char* sampling_name(Interpolation interpolation) {
  constexpr std::array<const char*, 3> kNames = {"STEP", "LINEAR", "CUBICSPLINE"};
  return kNames.at(std::size_t(interpolation));
}

}  // namespace

bool GltfAnimations::add(const world::PhysicalObject& object, int index, tinygltf::Node& node) {
  if (!object.motion) return false;
  const auto moved = world::moved_along(*object.motion, object.parent_from_object);
  const NodeMotion motion = moved ? as_node(*moved) : tl::unexpected(Loss::Stretch);
  if (!motion) {
    ++lost_[std::size_t(motion.error())];
    return false;
  }
  bent_ += moves_about_centre(*moved) ? 1 : 0;
  const PlaceParts& rest = motion->rest;
  node.translation.assign(rest.translation.begin(), rest.translation.end());
  node.rotation.assign(rest.rotation.coeffs().begin(), rest.rotation.coeffs().end());
  node.scale.assign(rest.scale.begin(), rest.scale.end());
  add(motion->translation, index, "translation");
  add(motion->rotation, index, "rotation");
  add(motion->scale, index, "scale");
  return true;
}

void GltfAnimations::add(const KeyFrames& frames, int node, const char* path) {
  if (frames.times.empty()) return;
  const auto [found, is_new] =
      animations_.try_emplace({frames.cycle, frames.loops}, model_.animations.size());
  if (is_new) {
    Value::Object extras;
    extras["cycle"] = Value(frames.cycle);
    if (!frames.loops) extras["loops"] = Value(false);
    model_.animations.emplace_back();
    model_.animations.back().extras = extras_with(Value(std::move(extras)));
  }
  tinygltf::Animation& animation = model_.animations[found->second];
  tinygltf::AnimationSampler sampler;
  sampler.interpolation = sampling_name(frames.interpolation);
  sampler.input = buffer_.add_times(rising(frames.times));
  const bool turns = std::string_view(path) == "rotation";
  sampler.output = turns ? buffer_.add_values(float_rows<4>(frames.values))
                         : buffer_.add_values(float_rows<3>(frames.values));
  tinygltf::AnimationChannel channel;
  channel.sampler = int(animation.samplers.size());
  channel.target_node = node;
  channel.target_path = path;
  animation.samplers.push_back(std::move(sampler));
  animation.channels.push_back(std::move(channel));
}

std::vector<Remark> GltfAnimations::remarks() const {
  std::vector<Remark> remarks;
  if (bent_ > 0)
    remarks.push_back(
        {{},
         0,
         fmt::format("{} about a centre, which glTF does not know: the way is written in straight "
                     "pieces.",
                     bent_ == 1 ? "1 object turns" : fmt::format("{} objects turn", bent_))});
  constexpr std::array<const char*, 3> kWhy = {"glTF knows no such stretching",
                                               "glTF knows no turns about a centre in several cycles",
                                               "numbers of it are too large for single precision"};
  for (std::size_t i = 0; i < lost_.size(); ++i) {
    if (lost_[i] == 0) continue;
    const std::string motions = lost_[i] == 1 ? "1 motion is" : fmt::format("{} motions are", lost_[i]);
    remarks.push_back({{}, 0, fmt::format("{} left out: {}.", motions, kWhy.at(i))});
  }
  return remarks;
}

}  // namespace icome::files
