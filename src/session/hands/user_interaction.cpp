#include "session/hands/user_interaction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace icome::session {
namespace {

using base::Pose;
using base::Quaternion;
using base::Vector3;
using devices::DeviceStatus;
using interaction::NavigationMode;
using interaction::View;

constexpr std::uint32_t kModeButton = 1U << 0;
constexpr std::uint32_t kHomeButton = 1U << 1;
constexpr double kLongestStep = 0.1;   // s: after a hang nobody should fly through a wall
constexpr double kPatience = 0.25;     // s, for which a device that says nothing new is believed
constexpr double kRecall = 0.1;        // s, in which most of a way back is done
constexpr double kFarthestHand = 2.0;  // of the view's distance: what is further off is hardly in sight
constexpr double kFarthestHead = 2.0;  // m
constexpr double kComeBack = 0.5;      // s, in which the eye goes to a head that was lost

/// The turn about the vertical that brings x to the picture's right: level also for views from straight
/// above.
Pose heading_of(const View& view) {
  const auto axes = view.world_from_eye.linear();
  Vector3 right(axes(0, 0), 0.0, axes(2, 0));
  // A view that lies on its side has its right above or below: the level right is then down or up in the
  // picture.
  if (right.norm() < 1e-6) right = (axes(1, 0) > 0.0 ? -1.0 : 1.0) * Vector3(axes(0, 1), 0.0, axes(2, 1));
  const double angle = std::atan2(-right.z(), right.x());
  return Pose(Eigen::AngleAxisd(angle, Vector3::UnitY()));
}

bool is_rigid(const Pose& pose) {
  return pose.matrix().allFinite() && pose.linear().isUnitary(1e-6) && pose.linear().determinant() > 0.0;
}

/// The pose a part of the way to another one.
Pose between(const Pose& from, const Pose& to, double part) {
  Pose result = Pose::Identity();
  result.linear() = Quaternion(from.linear()).slerp(part, Quaternion(to.linear())).toRotationMatrix();
  result.translation() = (1.0 - part) * from.translation() + part * to.translation();
  return result;
}

}  // namespace

UserInteraction::UserInteraction(std::unique_ptr<devices::NavigationDevice> navigation,
                                 std::unique_ptr<devices::HeadDevice> head)
    : navigation_(std::move(navigation)), head_(std::move(head)) {
  head_motion_.set_rest(Pose::Identity());
  place();
}

void UserInteraction::set_view(const View& view) {
  flight_.reset();
  view_ = interaction::usable(view);
  place();
}

void UserInteraction::fly_to(const View& view, double seconds) {
  flight_.emplace(view_, view, seconds);
  flown_for_ = 0.0;
}

void UserInteraction::carry(const Pose& by) {
  if (!is_rigid(by)) return;
  flight_.reset();
  View view = view_;
  view.world_from_eye = by * view.world_from_eye;
  view_ = interaction::usable(view);
  const Pose there = by * stage_from_device_;
  const Pose heading = heading_of(view_);
  const Vector3 offset = there.translation() - interaction::looked_at(view_);
  hand_offset_ = heading.linear().transpose() * offset / view_.distance;
  const Pose upright = heading * Eigen::AngleAxisd(hand_turn_, Vector3::UnitY());
  hand_tilt_ = Quaternion(upright.linear().transpose() * there.linear()).normalized();
  carried_ = true;
  place();
}

/// Brings workspaces that were tilted back upright.
void UserInteraction::right_hands(double dt) {
  if (std::exchange(carried_, false)) return;
  constexpr double kUpright = 1e-4;  // rad: cannot be seen
  const double left = hand_tilt_.angularDistance(Quaternion::Identity());
  if (left == 0.0) return;
  hand_tilt_ = left < kUpright ? Quaternion::Identity()
                               : hand_tilt_.slerp(1.0 - std::exp(-dt / kRecall), Quaternion::Identity());
}

UserInteraction::News UserInteraction::update(double dt) {
  const double step = std::isfinite(dt) ? std::clamp(dt, 0.0, kLongestStep) : 0.0;
  time_ += step;
  News news;
  read_navigation(step, news);
  read_head(step, news);
  steer(step);
  if (flight_) {
    flown_for_ += step;
    view_ = flight_->at(flown_for_);
    if (flight_->over(flown_for_)) flight_.reset();
  }
  move_hands(step);
  right_hands(step);
  place();
  return news;
}

void UserInteraction::note(const std::string& name, Presence& presence, DeviceStatus status, double dt,
                           News& news) {
  const bool there = status != DeviceStatus::Lost;
  if (there && presence.asked && !presence.there)
    news.devices.push_back({false, name + " is there and can be used."});
  if (!there && presence.there) {
    news.devices.push_back({true, name + " is gone. Plug it in again, or see whether its driver runs: it "
                                         "will go on by itself."});
  }
  presence.asked = true;
  presence.there = there;
  presence.silent = status == DeviceStatus::Ok ? 0.0 : presence.silent + dt;
}

void UserInteraction::read_navigation(double dt, News& news) {
  if (!navigation_) return;
  const bool was_there = navigation_presence_.there;
  devices::NavigationState state = steering_;
  const DeviceStatus status = navigation_->read(state);
  note(navigation_->name(), navigation_presence_, status, dt, news);
  if (!state.push.allFinite() || !state.turn.allFinite()) state.push = state.turn = Vector3::Zero();
  // A device that is lost or silent counts as not held.
  if (status == DeviceStatus::Lost || navigation_presence_.silent > kPatience)
    state.push = state.turn = Vector3::Zero();
  // A button that is down as the device is plugged in has not been pressed.
  const std::uint32_t pressed = was_there ? state.buttons & ~steering_.buttons : 0U;
  const bool other_mode = status == DeviceStatus::Ok && (pressed & kModeButton) != 0;
  news.home = status == DeviceStatus::Ok && (pressed & kHomeButton) != 0;
  steering_ = state;
  if (other_mode) mode_ = mode_ == NavigationMode::Camera ? NavigationMode::Hand : NavigationMode::Camera;
  if (news.home) recall_hands();
}

void UserInteraction::read_head(double dt, News& news) {
  if (!head_) return;
  Pose user_from_head = Pose::Identity();
  const DeviceStatus status = head_->read(user_from_head);
  const bool was_lost = head_presence_.asked && !head_presence_.there;
  const std::size_t told = news.devices.size();
  note(head_->name(), head_presence_, status, dt, news);
  if (status == DeviceStatus::Lost && news.devices.size() > told)
    if (const std::string why = head_->why_lost(); !why.empty())
      news.devices.back().text = fmt::format("{} is gone. {}", head_->name(), why);
  const double part = 1.0 - std::exp(-dt / kRecall);
  if (status == DeviceStatus::Ok && is_rigid(user_from_head)) {
    auto at = user_from_head.translation();
    at = at.cwiseMax(-kFarthestHead).cwiseMin(kFarthestHead).eval();
    head_is_back_for_ = was_lost ? kComeBack : std::max(0.0, head_is_back_for_ - dt);
    const Pose moved = head_motion_.moved(user_from_head, time_);
    const bool transferred = head_is_transferred_ && !fish_tank_;
    const Pose now = transferred ? moved : head_motion_.steady_from_rest();
    rest_from_head_ = head_is_back_for_ > 0.0 ? between(rest_from_head_, now, part) : now;
  } else if (status == DeviceStatus::Lost) {
    head_motion_.forget_samples();
    rest_from_head_ = between(rest_from_head_, Pose::Identity(), part);
  }
}

void UserInteraction::set_fish_tank(const std::optional<interaction::FishTank>& screen) {
  if (screen == fish_tank_) return;
  if (!fish_tank_) field_before_ = view_.field;
  fish_tank_ = screen;
  view_ = interaction::with_field(view_, fish_tank_ ? interaction::field_of(*fish_tank_) : field_before_);
  place();
}

void UserInteraction::set_eye_distance(double metres) {
  eye_distance_ = metres;
  place();
}

void UserInteraction::set_head_transfer(const std::optional<interaction::HeadTransfer>& transfer) {
  head_is_transferred_ = transfer.has_value();
  if (transfer) head_motion_.set_transfer(*transfer);
}

void UserInteraction::recentre_head() { head_motion_.recentre(); }

void UserInteraction::steer(double dt) {
  if (steering_.push.isZero(0.0) && steering_.turn.isZero(0.0)) return;
  if (mode_ == NavigationMode::Hand) return;
  flight_.reset();
  view_ = interaction::flown(view_, steering_, dt);
}

void UserInteraction::move_hands(double dt) {
  const bool moved = !steering_.push.isZero(0.0) || !steering_.turn.isZero(0.0);
  if (mode_ == NavigationMode::Hand && moved) {
    recalled_ = false;
    const auto axes = [](const Vector3& it) { return Vector3(it.cwiseMax(-1.0).cwiseMin(1.0)); };
    // In the view's heading: also after the workspace was turned, right is right.
    hand_offset_ += dt * axes(steering_.push);
    hand_offset_ = hand_offset_.cwiseMax(-kFarthestHand).cwiseMin(kFarthestHand).eval();
    hand_turn_ = std::remainder(hand_turn_ + 0.5 * std::numbers::pi * dt * axes(steering_.turn).y(),
                                2.0 * std::numbers::pi);
  }
  if (!recalled_) return;
  constexpr double kThere = 1e-4;  // of the view's distance, rad: cannot be seen
  const double left = std::exp(-dt / kRecall);
  hand_offset_ *= left;
  hand_turn_ *= left;
  if (hand_offset_.norm() + std::abs(hand_turn_) > kThere) return;
  hand_offset_.setZero();
  hand_turn_ = 0.0;
  recalled_ = false;
}

void UserInteraction::place() {
  if (fish_tank_ && view_.field != interaction::field_of(*fish_tank_))
    view_ = interaction::with_field(view_, interaction::field_of(*fish_tank_));
  const Pose heading = heading_of(view_);
  stage_from_device_ = heading * Eigen::AngleAxisd(hand_turn_, Vector3::UnitY()) * hand_tilt_;
  stage_from_device_.translation() =
      interaction::looked_at(view_) + view_.distance * (heading.linear() * hand_offset_);
  place_eyes();
}

/// Places the eyes by where the head is: before the screen, or, where the screen goes along with the head, in
/// the head.
void UserInteraction::place_eyes() {
  const double scale = view_.distance / (fish_tank_ ? fish_tank_->distance : kScreenDistance);
  Pose eye_from_head = head_ && follows_head_ ? rest_from_head_ : Pose::Identity();
  eye_from_head.translation() *= scale;
  View screen = view_;
  if (!fish_tank_) {
    screen.world_from_eye = view_.world_from_eye * eye_from_head;
    screen = interaction::usable(screen);
    eye_from_head = Pose::Identity();
  }
  for (std::size_t i = 0; i < drawn_.size(); ++i) {
    const double aside = i == std::size_t(interaction::Eye::Left)    ? -0.5
                         : i == std::size_t(interaction::Eye::Right) ? 0.5
                                                                     : 0.0;
    const Vector3 eye = eye_from_head * Vector3(aside * eye_distance_ * scale, 0.0, 0.0);
    drawn_[i] = eye.isZero(0.0) ? screen : interaction::seen_from(screen, eye);
  }
}

}  // namespace icome::session
