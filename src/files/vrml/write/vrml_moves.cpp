#include "files/vrml/write/vrml_moves.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "files/straight_motion.h"
#include "files/vrml/write/vrml_place.h"
#include "io/number_text.h"

namespace icome::files {
namespace {

using world::KeyFrames;
using world::Motion;

/// Rounded as the turns of all Transforms, with the angle last.
std::array<float, 4> vrml_turn(const base::Quaternion& turn) {
  const VrmlTurn it = vrml_place(base::Affine3(turn)).rotation;
  return {it.axis.x(), it.axis.y(), it.axis.z(), it.angle};
}

}  // namespace

const Motion* VrmlMoves::motion_of(const world::PhysicalObject& object) {
  if (!object.motion) return nullptr;
  auto moved = world::moved_along(*object.motion, object.parent_from_object);
  lost_ += moved ? 0 : 1;
  if (!moved) return nullptr;
  moved_ = std::move(*moved);
  return &moved_;
}

void VrmlMoves::write_rest(const Motion& motion, const std::string& def) {
  const world::PlaceParts& rest = motion.rest;
  if (!rest.centre.isZero(0.0)) text_.field("center", rest.centre);
  if (!rest.translation.isZero(0.0)) text_.field("translation", rest.translation);
  write_turn("rotation", rest.rotation);
  if (rest.scale != base::Vector3::Ones()) text_.field("scale", rest.scale);
  write_turn("scaleOrientation", rest.stretch_axes);
  moving_.push_back({def, straightened(motion)});
  bent_ += is_bent(motion) ? 1 : 0;
}

void VrmlMoves::write_turn(const char* field, const base::Quaternion& turn) {
  const std::array<float, 4> written = vrml_turn(turn);
  if (written[3] != 0.0F) text_.field(field, written);
}

void VrmlMoves::write() {
  for (const Moving& it : moving_) write(it);
}

void VrmlMoves::write(const Moving& it) {
  if (!it.motion.translation.times.empty()) write(it.def, "translation", it.motion.translation);
  if (!it.motion.rotation.times.empty()) write(it.def, "rotation", it.motion.rotation);
  if (!it.motion.scale.times.empty()) write(it.def, "scale", it.motion.scale);
}

void VrmlMoves::write(const std::string& def, const char* field, const KeyFrames& frames) {
  const std::string by = clock(frames);
  const bool turns = frames.values.size() == 4 * frames.times.size();
  const std::string name = names_.take_like(fmt::format("{}_{}", def, field));
  text_.open(fmt::format("DEF {} {}", name, turns ? "OrientationInterpolator" : "PositionInterpolator"));
  text_.open_list("key");
  for (const double time : frames.times) text_.row(std::array{io::to_single(time / frames.cycle)});
  text_.close_list();
  text_.open_list("keyValue");
  for (std::size_t key = 0; key < frames.times.size(); ++key) {
    const double* const value = frames.values.data() + key * (turns ? 4 : 3);
    if (turns)
      text_.row(vrml_turn(base::Quaternion(value).normalized()));
    else
      text_.row(base::Vector3(value));
  }
  text_.close_list();
  text_.close();
  text_.add(fmt::format("ROUTE {}.fraction_changed TO {}.set_fraction", by, name));
  text_.add(fmt::format("ROUTE {}.value_changed TO {}.set_{}", name, def, field));
}

const std::string& VrmlMoves::clock(const KeyFrames& frames) {
  const auto [found, is_new] = clocks_.try_emplace({frames.cycle, frames.loops});
  if (!is_new) return found->second;
  found->second = names_.take_like("clock");
  text_.open(fmt::format("DEF {} TimeSensor", found->second));
  text_.field("cycleInterval", frames.cycle);
  if (frames.loops) text_.field("loop", true);
  text_.close();
  return found->second;
}

std::vector<Remark> VrmlMoves::remarks() const {
  std::vector<Remark> remarks;
  const auto tell = [&](std::size_t count, const char* one, const char* several, const char* what) {
    if (count > 0)
      remarks.push_back({"", 0, fmt::format("{} {} {}", count, count == 1 ? one : several, what)});
  };
  tell(bent_, "motion is", "motions are", "written in straight pieces: VRML 2.0 knows no splines.");
  tell(lost_, "motion is", "motions are", "left out: what moves was stretched unevenly or mirrored since.");
  return remarks;
}

}  // namespace icome::files
