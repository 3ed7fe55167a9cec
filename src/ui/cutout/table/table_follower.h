#pragma once
#include <QObject>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/result.h"
#include "cutout/tracker/tracker.h"
#include "realtime/latest_value.h"

namespace icome::ui {

/// The table that is watched: where frames come from, what lies on it, and how the camera sees it.
struct TableSettings {
  std::string source;            // an address as cutout::open_source() takes it
  std::filesystem::path known;   // the list of triangles
  std::filesystem::path view;    // the result of a calibration; empty: the frame's corners are the table's
  double width = 0, height = 0;  // mm, of the table, without a view
  double rate = 0;               // frames/s; 0: as they come
};

/// Triangles seen in a frame.
struct TableSight {
  std::vector<cutout::Sighting> seen;
  double time = 0;                           // s, of the source
  std::int64_t arrived = 0;                  // ns on the steady clock: when the frame was there
  std::uint64_t number = 0;                  // frames so far
  std::uint64_t dropped = 0;                 // frames that came too fast
  double table_width = 0, table_height = 0;  // mm
};

/// Reads frames and finds triangles on a thread of its own, until the frames end or it is stopped.
class TableFollower {
 public:
  enum class State : std::uint8_t { Off, Opening, Running, Ended };

  TableFollower() = default;
  ~TableFollower();
  TableFollower(const TableFollower&) = delete;
  TableFollower& operator=(const TableFollower&) = delete;

  /// Begins. Fails, naming the file, where the list or the view cannot be read; a source that cannot be
  /// opened is told later by problem().
  base::Result<void> start(const TableSettings& settings);
  /// Ends, within a fraction of a second.
  void stop();

  State state() const { return state_; }
  /// Why it has ended, and what is wrong with the frames: sentences for people.
  std::string problem() const;
  std::vector<std::string> complaints() const;
  const cutout::KnownTriangles& known() const { return known_; }

  /// Is called on the thread that made this, as soon as a frame has been looked at. Frames that come before
  /// the last one was heard of are passed over.
  void on_sight(std::function<void(const TableSight&)> sight) { sight_ = std::move(sight); }
  /// Is called there when the state or what is wrong has changed.
  void on_state(std::function<void()> state) { changed_ = std::move(state); }

 private:
  void run(const std::stop_token& end, const TableSettings& settings);
  void look_at(const cutout::Frame& frame, std::int64_t arrived);
  void end_with(const std::string& problem);
  void set_state(State state);
  void complain(std::vector<std::string> complaints);
  void take_sight();
  cutout::TableView view_for(const cutout::Frame& frame) const;

  QObject here_;  // callbacks are called in its thread
  cutout::KnownTriangles known_;
  std::optional<cutout::TableView> view_;
  double width_ = 0, height_ = 0;  // mm
  std::atomic<State> state_ = State::Off;
  realtime::LatestValue<TableSight> latest_;
  std::atomic<bool> posted_ = false;
  mutable std::mutex lock_;  // for problem_ and complaints_
  std::string problem_;
  std::vector<std::string> complaints_;
  // Used by the thread only.
  std::unique_ptr<cutout::Tracker> tracker_;
  std::uint64_t number_ = 0, dropped_ = 0;
  double next_judgement_ = 0;  // s
  std::function<void(const TableSight&)> sight_ = [](const TableSight&) {};
  std::function<void()> changed_ = [] {};
  std::jthread thread_;
};

}  // namespace icome::ui
