#include "ui/cutout/table/table_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "base/clock.h"
#include "cutout/calibration/frame_quality.h"
#include "cutout/source/frame_source.h"

namespace icome::ui {
namespace {

constexpr double kJudgeEvery = 1.0;  // s between looks at what is wrong with frames

/// Waits until a time on the steady clock, ns, or until it is to end.
void wait_until(std::int64_t time, const std::stop_token& end) {
  constexpr std::int64_t kNap = 20'000'000;  // ns
  for (std::int64_t left = time - base::steady_nanoseconds(); left > 0 && !end.stop_requested();
       left = time - base::steady_nanoseconds())
    std::this_thread::sleep_for(std::chrono::nanoseconds(std::min(left, kNap)));
}

}  // namespace

TableFollower::~TableFollower() { stop(); }

base::Result<void> TableFollower::start(const TableSettings& settings) {
  stop();
  if (settings.source.empty())
    return base::fail("Say where the frames come from: camera, a folder, a video.");
  if (settings.known.empty()) return base::fail("Choose the list of known triangles first.");
  auto known = cutout::read_known_triangles(settings.known);
  if (!known) return tl::unexpected(known.error());
  view_.reset();
  if (!settings.view.empty()) {
    auto view = cutout::read_table_view(settings.view);
    if (!view) return tl::unexpected(view.error());
    view_ = std::move(*view);
  } else if (settings.width <= 0 || settings.height <= 0) {
    return base::fail("The size of the table is needed, or the file of a calibration.");
  }
  known_ = std::move(*known);
  width_ = view_ ? view_->table_width() : settings.width;
  height_ = view_ ? view_->table_height() : settings.height;
  {
    const std::lock_guard hold(lock_);
    problem_.clear();
    complaints_.clear();
  }
  tracker_.reset();
  number_ = dropped_ = 0;
  next_judgement_ = 0;
  state_ = State::Opening;
  thread_ = std::jthread([this, settings](const std::stop_token& end) { run(end, settings); });
  return {};
}

void TableFollower::stop() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  state_ = State::Off;
}

std::string TableFollower::problem() const {
  const std::lock_guard hold(lock_);
  return problem_;
}

std::vector<std::string> TableFollower::complaints() const {
  const std::lock_guard hold(lock_);
  return complaints_;
}

void TableFollower::set_state(State state) {
  state_ = state;
  QMetaObject::invokeMethod(
      &here_, [this] { changed_(); }, Qt::QueuedConnection);
}

void TableFollower::end_with(const std::string& problem) {
  {
    const std::lock_guard hold(lock_);
    problem_ = problem;
  }
  set_state(State::Ended);
}

void TableFollower::complain(std::vector<std::string> complaints) {
  {
    const std::lock_guard hold(lock_);
    if (complaints == complaints_) return;
    complaints_ = std::move(complaints);
  }
  QMetaObject::invokeMethod(
      &here_, [this] { changed_(); }, Qt::QueuedConnection);
}

cutout::TableView TableFollower::view_for(const cutout::Frame& frame) const {
  return view_ ? *view_ : cutout::TableView::whole_frame(frame.width, frame.height, width_, height_);
}

void TableFollower::run(const std::stop_token& end, const TableSettings& settings) {
  const auto stop = [&end] { return end.stop_requested(); };
  auto source = cutout::open_source(settings.source, {.rate = settings.rate});
  if (stop()) return;
  if (!source) return end_with(source.error().message);
  set_state(State::Running);
  std::int64_t began = 0;  // ns, of a source that is played at its own pace
  while (!stop()) {
    auto frame = (*source)->next(stop);
    if (stop()) return;
    if (!frame) {
      const bool goes_on = !(*source)->is_live() && (*source)->damaged() > 0 && number_ > 0;
      if (!goes_on) return end_with(frame.error().message);
      complain({frame.error().message});
      continue;
    }
    if (!*frame) break;
    if (!(*source)->is_live()) {
      const auto due = std::int64_t(1e9 * (*frame)->time);
      if (began == 0) began = base::steady_nanoseconds() - due;
      wait_until(began + due, end);
    }
    dropped_ = (*source)->dropped();
    look_at(**frame, base::steady_nanoseconds());
    if (state_ == State::Ended) return;
  }
  end_with("The frames have come to their end.");
}

void TableFollower::look_at(const cutout::Frame& frame, std::int64_t arrived) {
  if (!tracker_) tracker_ = cutout::make_pose_tracker(known_, view_for(frame));
  auto seen = tracker_->see(frame.view(), frame.time);
  if (!seen) return end_with(seen.error().message);
  TableSight& sight = latest_.write_slot();
  sight.seen = std::move(*seen);
  sight.time = frame.time;
  sight.arrived = arrived;
  sight.number = ++number_;
  sight.dropped = dropped_;
  sight.table_width = width_;
  sight.table_height = height_;
  const bool sees_all = sight.seen.size() == known_.triangles.size();
  latest_.publish();
  if (!posted_.exchange(true))
    QMetaObject::invokeMethod(
        &here_, [this] { take_sight(); }, Qt::QueuedConnection);
  if (frame.time < next_judgement_) return;
  next_judgement_ = frame.time + kJudgeEvery;
  // A frame in which all is found is good enough.
  complain(sees_all ? std::vector<std::string>() : cutout::complaints_of(cutout::quality_of(frame.view())));
}

void TableFollower::take_sight() {
  posted_ = false;
  if (latest_.update()) sight_(latest_.read());
}

}  // namespace icome::ui
