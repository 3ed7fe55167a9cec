#include "session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include "session/session_parts.h"

namespace icome::session {
namespace {

HapticRepresentationSettings felt_settings(const haptics::ServoSettings& servo) {
  HapticRepresentationSettings settings;
  settings.felt.tip_radius = servo.scp.tip_radius;
  settings.felt.interpolate_normals = servo.force_shading;
  settings.glide_seconds = haptics::EffectFeed::kGlideSeconds;
  settings.clock = session_seconds;
  settings.felt.with_time = true;
  return settings;
}

}  // namespace

SessionParts::SessionParts(SessionSettings given,
                           std::vector<std::unique_ptr<devices::PointerDevice>> devices)
    : settings(std::move(given)),
      user(std::move(settings.navigation), std::move(settings.head)),
      display(HapticLoop::kMostPointers),
      hands(std::move(devices), settings.servo, display),
      pointers_so_far(hands.pointers()),
      pointers(hands.pointers()),
      felt({haptics::HapticScene::compile({}), std::make_shared<const TouchedNames>()}),
      seen(std::make_shared<const render::RenderScene>()),
      addresses(settings.autosave_folder.empty() ? std::filesystem::path()
                                                 : settings.autosave_folder.parent_path() / "addresses") {
  user.set_head_transfer(settings.head_transfer);
  user.set_head_filter(settings.head_filter);
  stereo = settings.stereo;
  user.set_eye_distance(stereo.eye_distance);
  fish_tank = settings.fish_tank;
  renew_fish_tank();
  for (std::size_t i = 0; i < pointers.size(); ++i) pointers[i].number = i + 1;
}

SessionParts::~SessionParts() {
  finish_saving();
  for (const auto& follower : followers) follower->give_up();
  queue.close();
  hands.stop();
}

base::Result<std::unique_ptr<Session>> Session::create(SessionSettings settings) {
  auto devices = std::move(settings.pointers);
  if (devices.size() > HapticLoop::kMostPointers)
    return base::fail(fmt::format("A session has at most {} pointers.", HapticLoop::kMostPointers));
  const bool has_mouse = devices.empty();
  auto connections = std::move(settings.connections);
  if (connections.size() >= HapticLoop::kMostPointers)
    return base::fail(fmt::format("A session has at most {} devices.", HapticLoop::kMostPointers - 1));
  const bool realtime = settings.realtime_priority;
  auto parts = std::make_unique<SessionParts>(std::move(settings), std::move(devices));
  try {
    parts->start_followers();
  } catch (const std::system_error& error) {
    return base::fail(fmt::format(
        "The system gave no threads for a session ({}): close other programs and try again.", error.what()));
  }
  if (has_mouse) parts->take_in_mouse();
  if (const auto started = parts->hands.start(realtime); !started) return tl::unexpected(started.error());
  if (const std::string& notice = parts->hands.loop()->report().notice; !notice.empty())
    parts->tell(SessionEvent::Kind::Notice, notice);
  for (PointerConnection& it : connections) parts->take_in_device(std::move(it));
  parts->open_world({}, {});
  return std::unique_ptr<Session>(new Session(std::move(parts)));
}

void SessionParts::start_followers() {
  followers.push_back(std::make_unique<Follower>(
      queue, std::make_unique<HapticFollower>(felt_settings(settings.servo), hands.felt(), felt),
      "felt world"));
  // A tip with a radius feels changing shapes as they are at t = 0, and so they are seen.
  const bool shapes_change = !(settings.servo.scp.tip_radius > 0.0);
  auto eye = std::make_unique<RenderFollower>(display, seen, session_seconds, shapes_change);
  followers.push_back(std::make_unique<Follower>(queue, std::move(eye), "seen world"));
  if (!settings.autosave_folder.empty())
    journal =
        std::make_unique<AutosaveJournal>(queue.add_reader(), AutosaveSettings{settings.autosave_folder});
  for (auto& representation : settings.representations)
    followers.push_back(std::make_unique<Follower>(queue, std::move(representation), "representation"));
}

Session::Session(std::unique_ptr<SessionParts> parts)
    : parts_(std::move(parts)),
      files_(*parts_),
      history_(*parts_),
      view_(*parts_),
      stage_(*parts_),
      hands_(*parts_),
      sharing_(*parts_),
      techniques_(*this, *parts_),
      menu_(*parts_) {}
Session::~Session() = default;

void SessionParts::tell(SessionEvent::Kind kind, std::string text, std::vector<std::string> details) {
  events.push_back({kind, std::move(text), std::move(details)});
}

/// Takes in the news of other threads. Pointers first: the names of touched things are never older then.
void SessionParts::take_in() {
  queue.pump();
  take_files();
  take_shared();
  take_followers();
  hands.update();
  close_gone();
  if (felt.update()) capped = felt.read().capped;
  seen.update();
  tell_what_is_not_as_it_is();
  notice_devices();
}

/// Tells each sentence once for a design.
void SessionParts::tell_what_is_not_as_it_is() {
  std::vector<std::string> news;
  const auto take = [&](const std::vector<std::string>& sentences) {
    for (const std::string& it : sentences)
      if (told.insert(it).second) news.push_back(it);
  };
  if (const auto& scene = seen.read(); scene && scene != looked_at) {
    looked_at = scene;
    take(scene->remarks());
  }
  if (const auto& remarks = felt.read().remarks; remarks && remarks != listened_to) {
    listened_to = remarks;
    take(*remarks);
  }
  if (!news.empty())
    tell(SessionEvent::Kind::NotAsItIs, "Some of the design is not seen or felt as it is.", std::move(news));
}

void SessionParts::take_followers() {
  for (const auto& follower : followers)
    if (const auto news = follower->news()) tell(SessionEvent::Kind::Notice, *news);
}

void SessionParts::notice_devices() {
  for (std::size_t i = 0; i < hands.pointers(); ++i)
    if (hands.view(i).time != 0) notice_device(i);  // it has had a tick
}

/// Tells people that a device is lost or back, and what it says of itself.
void SessionParts::notice_device(std::size_t pointer) {
  using Told = devices::DeviceNews::Kind;
  const PointerView& view = hands.view(pointer);
  PointerParts& known = pointers[pointer];
  const std::string& name = hands.info(pointer).name;
  if (!known.news) known.news.emplace(name);
  const bool is_lost = view.status == devices::DeviceStatus::Lost;
  const std::string condition = hands.condition(pointer);
  std::vector<devices::DeviceNews::Item> all;
  // A device that was lost and came back in between is reported, too.
  if (view.losses > std::exchange(known.losses, view.losses) && !is_lost) all = known.news->look(true, {});
  for (auto& item : known.news->look(is_lost, condition)) all.push_back(std::move(item));
  for (auto& item : all) {
    const auto kind = item.kind == Told::Lost   ? SessionEvent::Kind::DeviceLost
                      : item.kind == Told::Back ? SessionEvent::Kind::DeviceBack
                                                : SessionEvent::Kind::Notice;
    events.push_back({.kind = kind, .text = std::move(item.text), .device = name});
  }
}

std::vector<SessionEvent> Session::update() {
  parts_->take_in();
  parts_->move_user();
  parts_->use_menu();
  if (parts_->grab_settings.takes_hold) parts_->shaping ? move_points() : move_held();
  parts_->renew_marks(*this);
  parts_->publish_wish();
  parts_->tell_menu_choices();
  return std::exchange(parts_->events, {});
}

void Session::move_held() {
  if (parts_->technique) {
    parts_->hold_by_technique(*this);
  } else {
    move_held_by_touch();
  }
}

void Session::move_held_by_touch() {
  for (std::size_t i = 0; i < parts_->hands.pointers(); ++i) {
    PointerParts& pointer = parts_->pointers[i];
    if (pointer.ungrabbed && (parts_->hands.view(i).buttons & 1U) != 0) continue;
    pointer.ungrabbed = parts_->is_at_menu(i) && !parts_->is_held(i);
    if (pointer.ungrabbed) continue;
    std::string refused;
    const bool held_part = pointer.part_grab.holds();
    auto feel = pointer.part_grab.update(*this, i, parts_->revisions, refused);
    const bool holds_part = pointer.part_grab.holds();
    // A press that has lost a part takes hold of nothing else.
    if (held_part && !holds_part) pointer.ungrabbed = true;
    if (!held_part && !holds_part) feel = pointer.grab.update(*this, i, parts_->revisions, refused);
    if (feel) parts_->hands.grip(i, *feel);
    if (!refused.empty()) parts_->tell(SessionEvent::Kind::Notice, refused);
  }
}

void Session::move_points() {
  parts_->shaping->follow(world(), selection());
  for (std::size_t i = 0; i < parts_->hands.pointers(); ++i) {
    if (parts_->is_mouse(i) && !parts_->hand_is_aimed) continue;  // it lies aside
    std::string refused;
    const auto feel =
        parts_->pointers[i].point_grab.update(*this, i, parts_->revisions, parts_->grab_settings, refused);
    if (feel) parts_->hands.grip(i, *feel);
    if (!refused.empty()) parts_->tell(SessionEvent::Kind::Notice, refused);
  }
}

bool SessionParts::is_settled() const {
  if (loader.part() || integrator.part() || saver.busy()) return false;
  if (journal && journal->followed() != queue.posted()) return false;
  return std::all_of(followers.begin(), followers.end(),
                     [this](const auto& it) { return it->followed() == queue.posted(); });
}

void Session::settle() {
  const auto wait = [](const auto& is_over) {
    while (!is_over()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  };
  wait([this] {
    parts_->take_in();
    return parts_->is_settled();
  });
  // One tick may have begun before the newest scene was there; the next one has it.
  const std::uint64_t ticks = parts_->hands.ticks();
  wait([this, ticks] { return parts_->hands.ticks() >= ticks + 2; });
  parts_->take_in();
  parts_->publish_wish();
}

}  // namespace icome::session
