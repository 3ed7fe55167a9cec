#include "session/hands/technique_hand.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "interaction/techniques/similarity.h"
#include "session/hands/target_maker.h"
#include "session/hands/user_interaction.h"
#include "session/session.h"

namespace icome::session {
namespace {

using base::Affine3;
using base::Pose;
using base::Vector3;
using interaction::carried_by;

constexpr std::uint32_t kSelect = 1U << 0;
constexpr std::uint32_t kTravel = 1U << 1;
constexpr std::uint32_t kAway = 1U << 2;
constexpr std::uint32_t kNearer = 1U << 3;

std::string held_name(const world::World& world, interaction::TargetId id) {
  const world::PhysicalObject* object = world.find(world::ObjectId{id});
  return object && !object->name.empty() ? "Move " + object->name : "Move object";
}

bool uses_miniature(const interaction::Technique& technique) {
  return technique.selecting == interaction::Selecting::Miniature ||
         technique.holding == interaction::Holding::Miniature ||
         technique.travelling == interaction::Travelling::Miniature;
}

}  // namespace

/// The input of a hand as the technique maps it: while the world has shrunk for a held object, its way from
/// the eye is longer.
interaction::HandInput TechniqueHand::hand_of(const TechniqueMoment& moment, std::size_t which) {
  const TechniqueMoment::Hand& hand = moment.hands[which];
  stale_[which] = hand.there ? stale_[which] & hand.buttons : ~0U;
  const std::uint32_t down = hand.buttons & ~stale_[which];
  interaction::HandInput input;
  if (!hand.there) return input;
  const interaction::TechniqueState& state = technique_.state();
  Pose stage_from_hand = hand.stage_from_hand;
  const Vector3 eye = moment.stage_from_eye.translation();
  stage_from_hand.translation() = eye + state.room_growth * (stage_from_hand.translation() - eye);
  input.tracked = true;
  input.room_from_hand = carried_by(state.world_from_room.inverse(), stage_from_hand);
  input.grab = (down & kSelect) != 0;
  input.travel = (down & kTravel) != 0;
  input.reel = double((down & kAway) != 0) - double((down & kNearer) != 0);
  return input;
}

interaction::TechniqueInput TechniqueHand::input_of(const TechniqueMoment& moment) {
  interaction::TechniqueInput input;
  input.time = moment.time;
  input.room_from_head = carried_by(technique_.state().world_from_room.inverse(), moment.stage_from_eye);
  for (std::size_t i = 0; i < input.hands.size(); ++i) input.hands[i] = hand_of(moment, i);
  return input;
}

void TechniqueHand::place_room(const TechniqueMoment& moment) {
  if (!technique_.resting() || (recording_ && recording_->so_far)) return;
  const double scale = moment.distance / UserInteraction::kScreenDistance;
  technique_.place_room(Affine3(moment.stage_from_workspace) * Eigen::Scaling(scale));
}

/// The motion of the room besides its growth about the eyes, which is not seen.
Pose TechniqueHand::carried(const Affine3& room_before) const {
  const Affine3& room = stage_from_room();
  const Affine3 moved = room * room_before.inverse();
  const Vector3 eyes = room * Vector3(input_.room_from_head.translation());
  Pose by;
  by.matrix() = (interaction::scaled_about(eyes, 1.0 / interaction::scale_of(moved)) * moved).matrix();
  by.linear() = base::Quaternion(by.linear()).normalized().toRotationMatrix();
  return by;
}

/// False while something that the hands may meet is still being made. Buttons that are down then have
/// to be pressed anew.
bool TechniqueHand::get_ready(const world::World& world) {
  if (!maker_->is_at_work()) {
    for (auto& [shape, made] : maker_->take()) technique_.keep(shape, std::move(made));
    auto slow = technique_.slow_shapes(world);
    is_getting_ready_ = !slow.empty();
    if (is_getting_ready_) maker_->make(std::move(slow));
  }
  if (!is_getting_ready_) return true;
  technique_.let_go();
  outcome_ = {};
  stale_ = {~0U, ~0U};
  return false;
}

std::optional<Pose> TechniqueHand::update(Session& session, const TechniqueMoment& moment,
                                          const Revisions& revisions, std::string& refused) {
  if (revision_ && *revision_ != revisions.now()) {
    technique_.let_go();
    if (recording_) recording_->is_over = true;
  }
  if (!get_ready(session.world())) return std::nullopt;
  place_room(moment);
  input_ = input_of(moment);
  keep(input_);
  const Affine3 room_before = stage_from_room();
  const interaction::WorldTechnique::Step step = technique_.step(session.world(), input_);
  outcome_ = step.outcome;
  refused = step.refused;
  revision_ = revisions.now();
  if (outcome_.picked) {
    std::vector<world::ObjectId> selected;
    if (outcome_.selected != 0) selected.push_back(world::ObjectId{outcome_.selected});
    session.select(std::move(selected));
  }
  if (step.edit) perform(session, step, refused);
  revision_ = revisions.now();
  if (room_before.matrix() == stage_from_room().matrix()) return std::nullopt;
  constexpr double kRounding = 1e-12;
  const Pose by = carried(room_before);
  if ((by.matrix() - Pose::Identity().matrix()).cwiseAbs().maxCoeff() < kRounding) return std::nullopt;
  return by;
}

void TechniqueHand::perform(Session& session, const interaction::WorldTechnique::Step& step,
                            std::string& refused) {
  const auto done =
      step.is_first ? session.history().perform(*step.edit, held_name(session.world(), outcome_.moved->id))
                    : session.history().extend(*step.edit);
  if (done) return;
  refused = done.error().message;
  technique_.let_go();
}

std::optional<Affine3> TechniqueHand::copy_from_stage(const Session& session) {
  if (!revision_ || !uses_miniature(technique()) || !technique_.slow_shapes(session.world()).empty())
    return std::nullopt;
  const interaction::SelectingSettings sizes = interaction::sizes_now(technique(), technique_.state());
  return interaction::copy_from_world(sizes.miniature, technique_.scene(session.world()).bounds(), input_,
                                      stage_from_room());
}

void TechniqueHand::record(const world::World& world) {
  technique_.begin_anew();
  stale_ = {~0U, ~0U};
  recording_ = Recording{.beginning = world};
}

void TechniqueHand::keep(const interaction::TechniqueInput& input) {
  constexpr std::size_t kMostSteps = 60 * 60 * 60;  // an hour of updates
  if (!recording_ || recording_->is_over) return;
  if (!recording_->so_far) recording_->so_far = {technique(), stage_from_room(), {}};
  recording_->so_far->stream.push_back(input);
  recording_->is_over = recording_->so_far->stream.size() == kMostSteps;
}

std::optional<TechniqueHand::Recorded> TechniqueHand::stop_recording() {
  if (!recording_) return std::nullopt;
  Recording ended = *std::exchange(recording_, std::nullopt);
  return Recorded{std::move(ended.beginning),
                  ended.so_far.value_or(interaction::TechniqueRecording{technique(), stage_from_room(), {}}),
                  !ended.is_over};
}

interaction::Technique desk_technique(interaction::Selecting selecting, interaction::Holding holding,
                                      interaction::Travelling travelling, double reach, double distance) {
  interaction::Technique technique;
  technique.selecting = selecting;
  technique.holding = holding;
  technique.travelling = travelling;
  interaction::SelectingSettings& sizes = technique.selecting_settings;
  sizes.miniature.size = 0.1;
  sizes.miniature.before = 0.5;
  sizes.miniature.below = 0.05;
  sizes.miniature.keeps_in_sight = true;
  sizes.hand_radius = 0.01;
  interaction::GoGoSettings& arm = sizes.go_go;
  arm.chest_below_eyes = 0.0;
  // In the room's metres. With the slope at the rim as at the end of a stretched arm in the paper.
  const double share = UserInteraction::kScreenDistance / distance;
  const double rim = std::isfinite(share * reach) ? std::clamp(share * reach, 1e-4, 1.0) : 0.1;
  const double slope = interaction::go_go_slope({}, interaction::GoGoSettings{}.arm);
  arm.arm = UserInteraction::kScreenDistance + rim;
  arm.near_share = UserInteraction::kScreenDistance / arm.arm;
  arm.gain = 0.5 * (slope - 1.0) / rim;
  return technique;
}

}  // namespace icome::session
