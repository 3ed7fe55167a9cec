#include "files/gltf/gltf_motions.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <utility>

#include "files/gltf/gltf_accessor.h"
#include "files/gltf/gltf_model.h"
#include "files/gltf/gltf_node.h"
#include "files/gltf/gltf_value.h"
#include "io/number_text.h"

namespace icome::files {
namespace {

using world::Interpolation;
using world::KeyFrames;
using world::Motion;

constexpr FindingKind kUnplayable = {"Key frames that go back in time or are no numbers are left out",
                                     "animations"};
constexpr FindingKind kOtherClip = {"Animations of what another one moves are left out", "animations"};
constexpr FindingKind kMorphing = {"Animations of morph targets are left out", "animations"};
constexpr FindingKind kOtherTarget = {"Animations of other things than places of nodes are left out",
                                      "animations"};
constexpr FindingKind kOfMatrix = {"Animations of nodes that have a matrix are left out", "nodes"};

Interpolation interpolation_of(const std::string& name) {
  if (name == "STEP") return Interpolation::Step;
  return name == "CUBICSPLINE" ? Interpolation::CubicSpline : Interpolation::Linear;
}

KeyFrames Motion::*part_of(std::string_view path) {
  if (path == "translation") return &Motion::translation;
  if (path == "rotation") return &Motion::rotation;
  return path == "scale" ? &Motion::scale : nullptr;
}

/// All numbers; one in single precision becomes the short decimal that it stands for: 0.1.
std::vector<double> all_numbers(const GltfAccessor& from) {
  std::vector<double> numbers;
  numbers.reserve(from.size() * from.components());
  for (std::size_t element = 0; element < from.size(); ++element) {
    for (std::size_t i = 0; i < from.components(); ++i) {
      const double number = from.number(element, i);
      numbers.push_back(from.is_float() && std::isfinite(number) ? io::as_written(float(number)) : number);
    }
  }
  return numbers;
}

}  // namespace

GltfMotions::GltfMotions(const tinygltf::Model& model, io::MemoryBudget& memory, GoOn go_on)
    : model_(model), memory_(memory), go_on_(std::move(go_on)) {
  for (const tinygltf::Animation& animation : model.animations) read(animation);
}

void GltfMotions::read(const tinygltf::Animation& animation) {
  std::vector<Course> courses;
  double last = 0.0;
  for (const tinygltf::AnimationChannel& channel : animation.channels) {
    go_on_();
    Course course;
    if (!read(animation, channel, course)) continue;
    last = std::max(last, course.frames.times.back());
    courses.push_back(std::move(course));
  }
  for (const Course& it : courses) {
    const auto found = motions_.find(it.node);
    if (found == motions_.end() || (found->second.*it.part).times.empty()) continue;
    for (const Course& unused : courses) let_go(unused.frames);
    return findings_.add(kOtherClip, animation.name);
  }
  const tinygltf::Value& extras = icome_extras(animation.extras);
  const double cycle = number_in(extras, "cycle").value_or(last);
  const tinygltf::Value& loops = member(extras, "loops");
  for (Course& it : courses) {
    KeyFrames& frames = motions_[it.node].*it.part;
    if (!frames.times.empty()) {  // two channels of one place are invalid
      let_go(it.frames);
      continue;
    }
    frames = std::move(it.frames);
    constexpr double kStill = 1.0;  // s, where all key frames are at the moment 0
    frames.cycle = cycle > 0.0 && std::isfinite(cycle) ? cycle : kStill;
    frames.loops = !loops.IsBool() || loops.Get<bool>();
  }
}

bool GltfMotions::read(const tinygltf::Animation& animation, const tinygltf::AnimationChannel& channel,
                       Course& course) {
  course.part = part_of(channel.target_path);
  const bool of_node = channel.target_node >= 0 && std::size_t(channel.target_node) < model_.nodes.size();
  if (!course.part || !of_node) {
    findings_.add(channel.target_path == "weights" ? kMorphing : kOtherTarget, animation.name);
    return false;
  }
  course.node = std::size_t(channel.target_node);
  const tinygltf::Node& node = model_.nodes[course.node];
  if (!node.matrix.empty()) {
    findings_.add(kOfMatrix, node.name);
    return false;
  }
  const std::size_t size = course.part == &Motion::rotation ? 4 : 3;
  if (read_frames(animation, channel.sampler, size, course.frames)) return true;
  findings_.add(kUnplayable, animation.name);
  return false;
}

bool GltfMotions::read_frames(const tinygltf::Animation& animation, int sampler, std::size_t size,
                              KeyFrames& frames) {
  if (sampler < 0 || std::size_t(sampler) >= animation.samplers.size())
    throw GltfError("an animation refers to a sampler that is not there");
  const tinygltf::AnimationSampler& from = animation.samplers[std::size_t(sampler)];
  const GltfAccessor times(model_, from.input, 1, 1), values(model_, from.output, size, size);
  frames.interpolation = interpolation_of(from.interpolation);
  const std::size_t rows = frames.interpolation == Interpolation::CubicSpline ? 3 : 1;
  if (times.size() == 0 || values.size() % rows != 0 || values.size() / rows != times.size()) return false;
  if (!memory_.take((times.size() + size * values.size()) * sizeof(double)))
    throw GltfError(memory_.problem().message);
  frames.times = all_numbers(times);
  frames.values = all_numbers(values);
  Motion alone;
  alone.*(size == 4 ? &Motion::rotation : &Motion::translation) = frames;
  if (world::check_motion(alone)) return true;
  let_go(frames);
  return false;
}

void GltfMotions::let_go(const KeyFrames& frames) {
  memory_.give_back((frames.times.size() + frames.values.size()) * sizeof(double));
}

world::MotionPointer GltfMotions::of(std::size_t node) {
  const auto found = motions_.find(node);
  if (found == motions_.end()) return nullptr;
  Motion motion = std::move(found->second);
  motions_.erase(found);  // a node becomes one object
  for (const KeyFrames* frames : {&motion.translation, &motion.rotation, &motion.scale}) let_go(*frames);
  motion.rest = parts_of_place(model_.nodes[node]);
  if (!world::check_motion(motion)) return nullptr;  // its place is flat, as a remark tells
  return std::make_shared<const Motion>(std::move(motion));
}

}  // namespace icome::files
