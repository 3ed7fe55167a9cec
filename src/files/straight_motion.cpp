#include "files/straight_motion.h"

#include <cmath>
#include <utility>

namespace icome::files {
namespace {

using world::Interpolation;
using world::KeyFrames;
using world::Motion;

/// Writes each value but the first twice: at its time, the value before it comes first.
void cut_steps(KeyFrames& frames, std::size_t size) {
  KeyFrames cut = frames;
  cut.interpolation = Interpolation::Linear;
  cut.times.clear();
  cut.values.clear();
  const auto add = [&](double time, std::size_t key) {
    cut.times.push_back(time);
    const auto first = frames.values.begin() + std::ptrdiff_t(key * size);
    cut.values.insert(cut.values.end(), first, first + std::ptrdiff_t(size));
  };
  for (std::size_t key = 0; key < frames.times.size(); ++key) {
    if (key > 0) add(frames.times[key], key - 1);
    add(frames.times[key], key);
  }
  frames = std::move(cut);
}

/// `part` gives the numbers of the part at a moment of the cycle. At a jump, the first of the two key
/// frames has the part's value just before it.
template <typename Part>
void cut_spline(KeyFrames& frames, const Part& part) {
  KeyFrames cut = frames;
  cut.interpolation = Interpolation::Linear;
  cut.times = cut_finer(frames.times, kPiecesOfBend);
  cut.values.clear();
  for (std::size_t key = 0; key < cut.times.size(); ++key) {
    const double time = cut.times[key];
    const bool jumps = key + 1 < cut.times.size() && cut.times[key + 1] == time;
    const auto numbers = part(jumps ? std::nextafter(time, 0.0) : time);
    cut.values.insert(cut.values.end(), numbers.begin(), numbers.end());
  }
  frames = std::move(cut);
}

bool is_spline(const KeyFrames& frames) { return frames.interpolation == Interpolation::CubicSpline; }

/// A motion that goes through all key frames of `frames` once, whatever their cycle.
Motion once(KeyFrames Motion::*part, KeyFrames frames) {
  frames.loops = false;
  if (!frames.times.empty()) frames.cycle = frames.times.back() + 1.0;
  Motion motion;
  motion.*part = std::move(frames);
  return motion;
}

}  // namespace

std::vector<double> cut_finer(const std::vector<double>& times, std::size_t pieces) {
  std::vector<double> finer;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    finer.push_back(times[i]);
    for (std::size_t piece = 1; times[i] < times[i + 1] && piece < pieces; ++piece)
      finer.push_back(times[i] + (times[i + 1] - times[i]) * double(piece) / double(pieces));
  }
  if (!times.empty()) finer.push_back(times.back());
  return finer;
}

Motion straightened(const Motion& motion) {
  Motion straight = motion;
  if (motion.translation.interpolation == Interpolation::Step) cut_steps(straight.translation, 3);
  if (motion.rotation.interpolation == Interpolation::Step) cut_steps(straight.rotation, 4);
  if (motion.scale.interpolation == Interpolation::Step) cut_steps(straight.scale, 3);
  if (is_spline(motion.translation)) {
    const Motion all = once(&Motion::translation, motion.translation);
    cut_spline(straight.translation, [&](double time) { return parts_at(all, time).translation; });
  }
  if (is_spline(motion.rotation)) {
    const Motion all = once(&Motion::rotation, motion.rotation);
    cut_spline(straight.rotation,
               [&](double time) { return Eigen::Vector4d(parts_at(all, time).rotation.coeffs()); });
  }
  if (is_spline(motion.scale)) {
    const Motion all = once(&Motion::scale, motion.scale);
    cut_spline(straight.scale, [&](double time) { return parts_at(all, time).scale; });
  }
  return straight;
}

bool is_bent(const Motion& motion) {
  return is_spline(motion.translation) || is_spline(motion.rotation) || is_spline(motion.scale);
}

}  // namespace icome::files
