#include "files/gltf_animations.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "files/gltf_value.h"
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

/// The moments of all parts, finely; none where these do not have one cycle.
std::optional<KeyFrames> common_moments(const Motion& motion) {
  KeyFrames common;
  for (const KeyFrames* frames : {&motion.rotation, &motion.scale, &motion.translation}) {
    if (frames->times.empty()) continue;
    const bool other = frames->cycle != common.cycle || frames->loops != common.loops;
    if (!common.times.empty() && other) return std::nullopt;
    common.cycle = frames->cycle;
    common.loops = frames->loops;
    common.times.insert(common.times.end(), frames->times.begin(), frames->times.end());
  }
  std::sort(common.times.begin(), common.times.end());
  std::erase_if(common.times, [&](double time) { return time > common.cycle; });
  common.times.erase(std::unique(common.times.begin(), common.times.end()), common.times.end());
  common.times = cut_finer(common.times, kPiecesOfBend);
  return common;
}

/// The way of a node without a centre that says the same.
Vector3 way_of(const PlaceParts& parts) { return world::affine(parts).translation(); }

/// The same without a centre and axes of a stretch, which nodes have not. None where that cannot be.
std::optional<Motion> as_node(const Motion& motion) {
  Motion node = motion;
  if (!always_even(motion) && !motion.rest.stretch_axes.isApprox(base::Quaternion::Identity(), 1e-12))
    return std::nullopt;
  if (moves_about_centre(motion)) {
    auto common = common_moments(motion);
    if (!common) return std::nullopt;
    for (const double time : common->times) {
      const Vector3 way = way_of(world::parts_at(motion, time));
      common->values.insert(common->values.end(), way.begin(), way.end());
    }
    node.translation = std::move(*common);
  } else if (!motion.rest.centre.isZero(0.0)) {
    // It shifts all places alike.
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
  return node;
}

/// glTF wants each later than the one before.
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
  const auto motion = moved ? as_node(*moved) : std::nullopt;
  lost_ += motion ? 0 : 1;
  if (!motion) return false;
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
  if (lost_ > 0)
    remarks.push_back({{},
                       0,
                       fmt::format("{} left out: glTF knows no such stretching.",
                                   lost_ == 1 ? "1 motion is" : fmt::format("{} motions are", lost_))});
  return remarks;
}

}  // namespace icome::files
