#include "apps/track/track_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "apps/interrupt.h"
#include "apps/status_line.h"
#include "apps/stopwatch.h"
#include "apps/terminal.h"
#include "apps/track/found_picture.h"
#include "apps/track/track_work.h"
#include "apps/track/truth_file.h"
#include "cutout/calibration/frame_quality.h"
#include "cutout/output/tuio.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegreesOfRadian = 57.29577951308232;
constexpr int kTuioPort = 3333;
constexpr std::size_t kMostTimes = 1'000'000;

/// The list of triangles, read again when the file has changed.
class KnownFile {
 public:
  explicit KnownFile(std::filesystem::path path) : path_(std::move(path)) { changed(); }

  base::Result<cutout::KnownTriangles> read() const { return cutout::read_known_triangles(path_); }
  /// Is the file another one than at the last call?
  bool changed() {
    std::error_code error;
    const auto time = std::filesystem::last_write_time(path_, error);
    if (error || time == time_) return false;
    time_ = time;
    return true;
  }

 private:
  std::filesystem::path path_;
  std::filesystem::file_time_type time_;
};

/// Counts and times of a whole run.
struct TrackTotals {
  std::size_t frames = 0;
  std::vector<double> times;      // ms
  std::vector<std::size_t> seen;  // frames in which each known triangle was found
};

Json json_of_frame(const cutout::Frame& frame, double ms, const cutout::KnownTriangles& known,
                   const std::vector<cutout::Sighting>& sightings) {
  Json entry = {{"t", frame.time}, {"ms", ms}, {"triangles", Json::array()}};
  for (const cutout::Sighting& sighting : sightings)
    entry["triangles"].push_back({{"id", known.triangles[sighting.triangle].id},
                                  {"x_mm", sighting.pose.centroid.x()},
                                  {"y_mm", sighting.pose.centroid.y()},
                                  {"angle_rad", sighting.pose.angle},
                                  {"confidence", sighting.confidence}});
  return entry;
}

Json json_of_truth(const TruthJudge& judge) {
  return {{"recall", judge.recall()},
          {"found", judge.found()},
          {"wanted", judge.wanted()},
          {"position_rms_mm", judge.position_rms()},
          {"worst_position_mm", judge.worst_position()},
          {"angle_rms_deg", judge.angle_rms() * kDegreesOfRadian},
          {"ghosts", judge.ghosts()},
          {"swaps", judge.swaps()}};
}

/// One run over the frames of a source.
class TrackRun {
 public:
  TrackRun(const TrackOptions& options, cutout::KnownTriangles known)
      : options_(options), known_file_(options.known), known_(std::move(known)) {}

  int run() {
    if (const auto ready = prepare(); !ready) return track_failed(ready.error());
    if (options_.json) print("{\"frames\": [");
    int exit_code = 0;
    while (may_go_on()) {
      auto next = source_->next([] { return interrupted(); });
      if (!next) {
        status_.clear();
        tell(next.error().message);
        if (source_->damaged() > 0) {
          ++number_;
          continue;
        }
        exit_code = kFailed;
        break;
      }
      if (!*next) break;
      if (const auto looked = look_at(std::move(**next)); !looked) {
        status_.clear();
        tell(looked.error().message);
        exit_code = kFailed;
        break;
      }
    }
    status_.clear();
    return finish(exit_code);
  }

 private:
  base::Result<void> prepare() {
    for (const std::string& warning : cutout::warnings_of(known_)) tell(warning);
    if (!options_.truth.empty()) {
      auto truth = read_truth(options_.truth);
      if (!truth) return tl::unexpected(truth.error());
      auto judge = TruthJudge::create(std::move(*truth), known_);
      if (!judge) return tl::unexpected(judge.error());
      judge_.emplace(std::move(*judge));
    }
    if (!options_.tuio.empty()) {
      const auto place = io::parse_host_port(options_.tuio, {"localhost", kTuioPort});
      if (!place) return base::fail("--tuio " + place.error().message);
      auto sender = cutout::UdpSender::create(*place);
      if (!sender) return tl::unexpected(sender.error());
      sender_.emplace(std::move(*sender));
    }
    TrackOptions with_rate = options_;
    if (judge_ && options_.rate == 0) with_rate.rate = judge_->rate();
    auto source = open_for(with_rate);
    if (!source) return tl::unexpected(source.error());
    source_ = std::move(*source);
    totals_.seen.resize(known_.triangles.size());
    return {};
  }

  bool may_go_on() const {
    if (interrupted()) return false;
    if (options_.frames > 0 && totals_.frames >= options_.frames) return false;
    return options_.seconds <= 0 || since_.seconds() < options_.seconds;
  }

  base::Result<void> begin_with(const cutout::Frame& frame) {
    const auto view = view_for(options_, frame);
    if (!view) return tl::unexpected(view.error());
    if (view->frame_width() != frame.width || view->frame_height() != frame.height)
      return base::fail(
          fmt::format("{}: the frames are {} x {} pixels large, and the view was made for {} x {}; "
                      "calibrate anew, or ask for that --size",
                      options_.source, frame.width, frame.height, view->frame_width(), view->frame_height()));
    view_.emplace(*view);
    tell_of_small_triangles();
    bundles_.emplace(view_->table_width(), view_->table_height(), "icome");
    make_tracker();
    return {};
  }

  /// Triangles that are too small in the frame are not found, however clear they are.
  void tell_of_small_triangles() const {
    constexpr double kLeastPixels = 20;
    const base::Vector2 middle(0.5 * view_->table_width(), 0.5 * view_->table_height());
    for (const cutout::KnownTriangle& triangle : known_.triangles) {
      const base::Vector2 end = middle + base::Vector2(0, triangle.height);
      const double pixels = (view_->to_pixel(end) - view_->to_pixel(middle)).norm();
      if (pixels < kLeastPixels)
        tell(fmt::format(
            "{}: it is {:.0f} pixels high in this view, and below {:.0f} it may not be found; bring "
            "the camera nearer, or ask for a larger --size",
            triangle.id, pixels, kLeastPixels));
    }
  }

  void make_tracker() {
    tracker_ = options_.pipeline == "thesis" ? cutout::make_thesis_tracker(known_, *view_)
                                             : cutout::make_pose_tracker(known_, *view_, !options_.cold);
  }

  void take_new_list() {
    constexpr double kPause = 0.5;  // s between two looks
    if (since_.seconds() < next_list_) return;
    next_list_ = since_.seconds() + kPause;
    if (!known_file_.changed() || judge_) return;
    auto known = known_file_.read();
    if (!known) return tell(known.error().message + "\nThe list of before stays in use.");
    known_ = std::move(*known);
    for (const std::string& warning : cutout::warnings_of(known_)) tell(warning);
    totals_.seen.assign(known_.triangles.size(), 0);
    make_tracker();
    tell(fmt::format("the list was read again: {} triangles", known_.triangles.size()));
  }

  base::Result<void> look_at(cutout::Frame frame) {
    if (!tracker_) {
      if (const auto begun = begin_with(frame); !begun) return begun;
    }
    complaints_.look_at(frame);
    take_new_list();
    const Stopwatch watch;
    auto sightings = tracker_->see(frame.view(), frame.time);
    const double ms = 1000.0 * watch.seconds();
    if (!sightings) return base::fail(fmt::format("{}: {}", options_.source, sightings.error().message));
    if (totals_.times.size() < kMostTimes) totals_.times.push_back(ms);
    ++totals_.frames;
    for (const cutout::Sighting& sighting : *sightings) ++totals_.seen[sighting.triangle];
    if (judge_) judge_->judge(number_, *sightings);
    ++number_;
    if (sender_)
      for (const std::string& bundle : bundles_->of(*sightings, frame.time)) sender_->send(bundle);
    if (options_.json)
      print((totals_.frames > 1 ? ",\n" : "\n") + json_of_frame(frame, ms, known_, *sightings).dump());
    show_progress(*sightings);
    last_frame_ = std::move(frame);
    last_ = std::move(*sightings);
    return {};
  }

  void show_progress(const std::vector<cutout::Sighting>& sightings) {
    constexpr double kPause = 0.2;
    if (since_.seconds() < next_status_) return;
    next_status_ = since_.seconds() + kPause;
    const auto all = source_->count();
    const std::string of_all = all ? fmt::format(" of {}", *all) : std::string();
    const std::string dropped =
        source_->dropped() > 0 ? fmt::format(", {} dropped", source_->dropped()) : std::string();
    status_.say(fmt::format("Frame {}{}{}: {} of {} triangles, {:.1f} ms", totals_.frames, of_all, dropped,
                            sightings.size(), known_.triangles.size(), totals_.times.back()));
  }

  int finish(int exit_code) {
    for (const std::string& note : source_->notes()) tell(note);
    if (sender_ && sender_->lost() > 0) tell(fmt::format("{} datagrams of TUIO were lost", sender_->lost()));
    if (!options_.picture.empty() && totals_.frames > 0) {
      const auto written = write_found(last_frame_, known_, *view_, last_, options_.picture);
      if (!written) {
        tell(written.error().message);
        exit_code = kFailed;
      }
    }
    if (totals_.frames == 0 && exit_code == 0) {
      if (!interrupted()) tell(fmt::format("{}: no frame could be read", options_.source));
      exit_code = interrupted() ? kTrackInterrupted : kFailed;
    }
    tell_of_nothing();
    const int printed = print_answer(options_.json ? json_end() : summary());
    return exit_code != 0 ? exit_code : printed;
  }

  /// Says so where no triangle was seen, and what may be the reason.
  void tell_of_nothing() const {
    constexpr double kLeastBlue = 0.001;  // of a frame
    if (totals_.frames == 0 || std::ranges::any_of(totals_.seen, [](std::size_t count) { return count > 0; }))
      return;
    const bool has_blue = cutout::quality_of(last_frame_.view()).blue >= kLeastBlue;
    tell(fmt::format("no triangle of {} was found: {}", options_.known.string(),
                     has_blue
                         ? "the blue ones on the table have other angles or heights, or --table or --view "
                           "are not this table's"
                         : "nothing blue lies on the table"));
  }

  std::string json_end() const {
    std::string text =
        fmt::format("\n], \"dropped\": {}, \"damaged\": {}", source_->dropped(), source_->damaged());
    if (judge_) text += ", \"truth\": " + json_of_truth(*judge_).dump();
    return text + "}\n";
  }

  std::string summary() const {
    if (totals_.frames == 0) return {};
    std::string text;
    if (totals_.frames == 1) {
      text += fmt::format("{:<16}{:>10}{:>10}{:>12}{:>12}\n", "triangle", "x, mm", "y, mm", "angle, deg",
                          "confidence");
      for (const cutout::Sighting& sighting : last_)
        text += fmt::format("{:<16}{:>10.2f}{:>10.2f}{:>12.2f}{:>12.2f}\n",
                            known_.triangles[sighting.triangle].id, sighting.pose.centroid.x(),
                            sighting.pose.centroid.y(), sighting.pose.angle * kDegreesOfRadian,
                            sighting.confidence);
    } else {
      text += fmt::format("{:<16}{:>12}\n", "triangle", "seen in, %");
      for (std::size_t i = 0; i < known_.triangles.size(); ++i)
        text += fmt::format("{:<16}{:>12.1f}\n", known_.triangles[i].id,
                            100.0 * double(totals_.seen[i]) / double(totals_.frames));
    }
    std::vector<double> times = totals_.times;
    std::ranges::sort(times);
    text += fmt::format(
        "{}, {} dropped, {} damaged; {:.2f} ms to find triangles in the middle frame, {:.2f} ms in "
        "the "
        "slowest of 100\n",
        how_many(totals_.frames, "frame"), source_->dropped(), source_->damaged(), times[times.size() / 2],
        times[std::min(times.size() - 1, times.size() * 99 / 100)]);
    if (judge_)
      text += fmt::format(
          "Truth: {:.2f} % found ({} of {}), off by {:.3f} mm and {:.3f} degrees (root mean square), "
          "{:.2f} mm at most; {} ghosts, {} swaps\n",
          100 * judge_->recall(), judge_->found(), judge_->wanted(), judge_->position_rms(),
          judge_->angle_rms() * kDegreesOfRadian, judge_->worst_position(), judge_->ghosts(),
          judge_->swaps());
    return text;
  }

  const TrackOptions& options_;
  KnownFile known_file_;
  cutout::KnownTriangles known_;
  std::optional<TruthJudge> judge_;
  std::optional<cutout::UdpSender> sender_;
  std::optional<cutout::TuioBundles> bundles_;
  std::unique_ptr<cutout::FrameSource> source_;
  std::optional<cutout::TableView> view_;
  std::unique_ptr<cutout::Tracker> tracker_;
  FrameComplaints complaints_;
  TrackTotals totals_;
  std::size_t number_ = 0;  // of the frame in the source, damaged ones counted
  cutout::Frame last_frame_;
  std::vector<cutout::Sighting> last_;
  Stopwatch since_;
  double next_list_ = 0, next_status_ = 0.5;  // s
  StatusLine status_;
};

}  // namespace

int run_tracking(const TrackOptions& options) {
  auto known = cutout::read_known_triangles(options.known);
  if (!known) return track_failed(known.error());
  return TrackRun(options, std::move(*known)).run();
}

}  // namespace icome::apps
