#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cutout/tracker/frame_size.h"
#include "cutout/tracker/pose/pose_search.h"
#include "cutout/tracker/tracker.h"

namespace icome::cutout {
namespace {

constexpr double kLongestMemory = 3;      // s that a place is remembered, to settle what is doubtful
constexpr double kLongestGlide = 0.05;    // s that a hidden triangle is still reported, where it would be
constexpr double kStillMoved = 1.5;       // pixels that it may have moved since
constexpr double kTrackedSupport = 0.12;  // share of the outline by which a triangle is followed
constexpr double kTrackedAgainst = 0.25;
constexpr double kTrackedBeyond = 0.4;   // blue beyond that no other triangle explains
constexpr double kMovedSupport = 0.22;   // share by which it is believed where it was not foreseen
constexpr double kForeseenPlace = 3;     // pixels
constexpr double kMuchNearer = 0.5;      // of the way from where it was foreseen
constexpr double kForeseenTurn = 0.05;   // rad
constexpr double kSharedOutline = 0.6;   // of what supports a triangle, that another one's edges explain too
constexpr double kClearlyBetter = 0.75;  // of the better score, below which the other one is let go
constexpr double kOnOutline = 1.5;       // pixels from an edge
constexpr double kSureSupport = 0.3;     // share by which a new triangle of three edges is believed at once
constexpr double kSureRms = 0.35;        // pixels
constexpr double kLeastWindow = 6;       // pixels about a prediction
constexpr double kWidestWindow = 20;
constexpr double kLongestStep = 0.5;   // s between frames over which motion is foreseen
constexpr double kRestless = 3;        // deviations from what noise explains, from which a triangle moves
constexpr double kColourPause = 0.5;   // s between looks at the colours
constexpr int kColourRows = 20;        // of places in a frame, and columns
constexpr int kLeastTablePlaces = 40;  // of these that must be red
constexpr int kColourMemory = 8;       // looks over which colours are averaged
constexpr int kPatience = 3;           // frames between full searches while nothing new is found

/// The state of a triangle over time.
struct TriangleTrack {
  bool followed = false;               // its pose is known, perhaps from a moment ago
  bool sure = false;                   // seen in two frames, or very well in one
  Placed placed;                       // as reported
  Vector2 velocity = Vector2::Zero();  // mm/s
  double spin = 0;                     // rad/s
  double seen = 0;                     // s, when the edges last showed it
  double confidence = 0;
  double score = 0;  // of the last look: what speaks for it, less what speaks against it
};

class PoseTracker : public Tracker {
 public:
  PoseTracker(KnownTriangles known, TableView view, bool tracks)
      : rectifier_(std::move(view)),
        shapes_(known.triangles.begin(), known.triangles.end()),
        search_(shapes_, rectifier_),
        fit_(rectifier_, colours_),
        claims_(rectifier_.view().frame_width(), rectifier_.view().frame_height()),
        tracks_(shapes_.size()),
        lost_(shapes_.size()),
        follows_(tracks) {
    if (const auto& shown = rectifier_.view().colours())
      shown_colours_.adapt(shown->table_bgr.data(), shown->triangle_bgr.data());
    colours_ = shown_colours_;
  }

  base::Result<std::vector<Sighting>> see(const FrameView& frame, double time) override;
  void forget() override {
    std::fill(tracks_.begin(), tracks_.end(), TriangleTrack{});
    std::fill(lost_.begin(), lost_.end(), LastSeen{});
    last_time_.reset();
    colours_ = shown_colours_;
    fit_.set_spread(0.0);
    colour_looks_ = 0;
    colours_seen_ = -1e9;
  }

 private:
  void follow(double time);
  void follow_one(std::size_t triangle, double time);
  void part_doubles(double time);
  void part(std::size_t one, std::size_t other);
  double share_on(std::size_t one, std::size_t other) const;
  void search_missing(const FrameView& frame, double time);
  void adapt_colours(const FrameView& frame, double time);
  Placed foreseen(const TriangleTrack& track, double time) const;
  void update(TriangleTrack& track, const OutlineFitted& fitted, double time);
  bool is_where_another_is(std::size_t triangle, const Placed& placed) const;
  std::vector<Neighbour> neighbours_of(std::size_t triangle) const;

  Rectifier rectifier_;
  ColourClasses shown_colours_;  // of the view, from which it begins
  ColourClasses colours_;        // of the light of now
  std::vector<TriangleShape> shapes_;
  PoseSearch search_;
  OutlineFit fit_;
  Claims claims_;
  std::vector<TriangleTrack> tracks_;
  std::vector<Placed> foreseen_;                 // of all tracks, in the frame at hand
  std::vector<TriangleTrack> before_;            // all tracks, as they were before it
  std::vector<std::vector<Vector2>> supported_;  // pixels of each followed triangle in it
  std::vector<PoseFound> found_;
  SearchWish wish_;
  struct LastSeen {
    double time = -1e9;  // s
    Placed placed;
  };
  std::vector<LastSeen> lost_;  // of each triangle, when it was last seen for sure
  std::optional<double> last_time_;
  std::array<double, 3> table_bgr_{}, triangle_bgr_{};  // running means
  int colour_looks_ = 0;                                // that went into them
  double colours_seen_ = -1e9;                          // s, when they were last looked at
  bool follows_;
  int idle_searches_ = 0;  // full searches without a find, one after the other
  int skipped_ = 0;        // frames since the last full search
};

Placed PoseTracker::foreseen(const TriangleTrack& track, double time) const {
  const double ahead = std::clamp(time - track.seen, 0.0, kLongestStep);
  return {track.placed.centroid + ahead * track.velocity, track.placed.turn + ahead * track.spin};
}

std::vector<Neighbour> PoseTracker::neighbours_of(std::size_t triangle) const {
  std::vector<Neighbour> others;
  for (std::size_t other = 0; other < tracks_.size(); ++other) {
    if (other == triangle || !tracks_[other].followed) continue;
    if ((foreseen_[other].centroid - foreseen_[triangle].centroid).norm() <
        shapes_[other].reach + shapes_[triangle].reach + 10)
      others.push_back({&shapes_[other], foreseen_[other]});
  }
  return others;
}

/// Was another triangle foreseen there rather than this one? Nearly alike ones would change places.
bool PoseTracker::is_where_another_is(std::size_t triangle, const Placed& placed) const {
  const double pixel = rectifier_.mm_per_pixel(placed.centroid);
  const auto off = [&](std::size_t i) {
    return ((foreseen_[i].centroid - placed.centroid).norm() +
            shapes_[i].reach * std::abs(within_half_turn(foreseen_[i].turn - placed.turn))) /
           pixel;
  };
  const double own = off(triangle);
  if (own < kForeseenPlace) return false;
  for (std::size_t other = 0; other < tracks_.size(); ++other)
    if (other != triangle && tracks_[other].followed && off(other) < kMuchNearer * own) return true;
  return false;
}

void PoseTracker::update(TriangleTrack& track, const OutlineFitted& fitted, double time) {
  const double step = time - track.seen;
  Placed now = fitted.placed;
  if (track.followed && step > 1e-6 && step < kLongestStep) {
    // A triangle at rest is held by the mean of what was seen; one that moves is where it is seen.
    const base::Vector3 off(now.centroid.x() - track.placed.centroid.x(),
                            now.centroid.y() - track.placed.centroid.y(),
                            within_half_turn(now.turn - track.placed.turn));
    const double deviations = off.dot(fitted.information * off) / 3;  // squared, a mean of 1 at rest
    const double gain = deviations / (deviations + kRestless * kRestless);
    const double share = std::clamp(0.15 + gain, 0.0, 1.0);
    now.centroid = track.placed.centroid + share * off.head<2>();
    now.turn = track.placed.turn + share * off.z();
    const Vector2 velocity = (fitted.placed.centroid - track.placed.centroid) / step;
    const double spin = off.z() / step;
    const bool moves = gain > 0.5 && fitted.evidence.support() >= kMovedSupport;
    track.velocity = moves ? velocity : Vector2(0.5 * track.velocity);
    track.spin = moves ? spin : 0.5 * track.spin;
  } else {
    track.velocity.setZero();
    track.spin = 0;
  }
  track.placed = now;
  track.seen = time;
  track.followed = true;
  track.confidence = fitted.evidence.support();
  track.score = track.confidence * (1 - fitted.evidence.rms) - fitted.evidence.contradiction();
}

void PoseTracker::follow_one(std::size_t triangle, double time) {
  TriangleTrack& track = tracks_[triangle];
  const Placed guess = foreseen_[triangle];
  const double pixel = rectifier_.mm_per_pixel(guess.centroid);
  const double step = std::clamp(time - track.seen, 0.0, kLongestStep);
  const double moved =
      step * (track.velocity.norm() + std::abs(track.spin) * shapes_[triangle].reach) / pixel;
  const std::vector<Neighbour> neighbours = neighbours_of(triangle);
  const auto holds = [&](const OutlineFitted& fitted) {
    const OutlineEvidence& evidence = fitted.evidence;
    if (evidence.support() < kTrackedSupport || evidence.contradiction() > kTrackedAgainst ||
        evidence.contradiction() > evidence.support() || evidence.beyond() > kTrackedBeyond ||
        evidence.edges_with(2) < 2)
      return false;
    // Little that is seen can tell that a triangle is where it was foreseen, not that it has moved elsewhere.
    return evidence.support() >= kMovedSupport ||
           ((fitted.placed.centroid - guess.centroid).norm() < kForeseenPlace * pixel &&
            std::abs(within_half_turn(fitted.placed.turn - guess.turn)) < kForeseenTurn);
  };
  const double first = std::clamp(kLeastWindow + 0.3 * moved, kLeastWindow, kWidestWindow);
  OutlineFitted fitted = fit_.fit(shapes_[triangle], guess, first, {6 * pixel, 0.1}, neighbours);
  if (!holds(fitted) || fitted.evidence.contradiction() > 0.05) {
    const OutlineFitted wide =
        fit_.fit(shapes_[triangle], guess, kWidestWindow, {15 * pixel, 0.2}, neighbours);
    const auto score = [](const OutlineFitted& f) {
      return f.evidence.support() - f.evidence.contradiction();
    };
    if (holds(wide) && (!holds(fitted) || score(wide) > score(fitted)))
      fitted = wide;
    else if (holds(fitted))
      fitted = fit_.fit(shapes_[triangle], fitted.placed, 0, {6 * pixel, 0.1}, neighbours);
  }
  if (!holds(fitted) || is_where_another_is(triangle, fitted.placed)) return;
  update(track, fitted, time);
  track.sure = true;
  foreseen_[triangle] = fitted.placed;
  supported_[triangle].assign(fit_.supported_pixels().begin(), fit_.supported_pixels().end());
  for (const Vector2& place : supported_[triangle]) claims_.take(place);
}

void PoseTracker::follow(double time) {
  foreseen_.resize(tracks_.size());
  supported_.resize(tracks_.size());
  before_ = tracks_;
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (tracks_[i].followed) foreseen_[i] = foreseen(tracks_[i], time);
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    if (tracks_[i].followed) follow_one(i, time);
}

/// The share of what supports a triangle that lies on the outline of another one.
double PoseTracker::share_on(std::size_t one, std::size_t other) const {
  std::size_t shared = 0;
  for (const Vector2& pixel : supported_[one]) {
    const Vector2 place = rectifier_.to_table(pixel.x(), pixel.y());
    const double near = kOnOutline * rectifier_.mm_per_pixel(place);
    shared += std::abs(depth_within(shapes_[other], tracks_[other].placed, place)) < near;
  }
  return supported_[one].empty() ? 0.0 : double(shared) / double(supported_[one].size());
}

/// Lets the one of two triangles go that the edges of both speak for less. Where neither is clearly better
/// both are where they were foreseen, until the next frames tell.
void PoseTracker::part(std::size_t one, std::size_t other) {
  const bool less = tracks_[one].score < tracks_[other].score;
  const std::size_t better = less ? other : one, worse = less ? one : other;
  const bool is_clear = tracks_[worse].score < kClearlyBetter * tracks_[better].score;
  tracks_[worse] = before_[worse];
  if (!is_clear) tracks_[better] = before_[better];
}

void PoseTracker::part_doubles(double time) {
  for (std::size_t i = 0; i < tracks_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const TriangleTrack &a = tracks_[i], &b = tracks_[j];
      if (!a.followed || !b.followed || a.seen != time || b.seen != time) continue;
      if ((a.placed.centroid - b.placed.centroid).norm() > shapes_[i].reach + shapes_[j].reach) continue;
      const bool i_has_little = share_on(i, j) >= kSharedOutline,
                 j_has_little = share_on(j, i) >= kSharedOutline;
      if (i_has_little && j_has_little)
        part(i, j);
      else if (i_has_little || j_has_little)
        tracks_[i_has_little ? i : j] = before_[i_has_little ? i : j];
    }
}

void PoseTracker::search_missing(const FrameView& frame, double time) {
  wish_.wanted.assign(tracks_.size(), false);
  wish_.last.assign(tracks_.size(), std::nullopt);
  wish_.neighbours.clear();
  bool any = false, lost_now = false;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const bool seen = tracks_[i].followed && tracks_[i].seen == time;
    wish_.wanted[i] = !seen;
    if (lost_[i].time + kLongestMemory >= time) wish_.last[i] = lost_[i].placed;
    any |= !seen;
    lost_now |= tracks_[i].followed && !seen;
    if (seen) wish_.neighbours.push_back({&shapes_[i], tracks_[i].placed});
  }
  if (!any) return;
  // Triangles that have long been away are looked for now and then.
  if (follows_ && !lost_now && idle_searches_ >= kPatience && ++skipped_ < kPatience) return;
  skipped_ = 0;
  search_.find(frame, colours_, fit_, wish_, claims_, found_);
  idle_searches_ = found_.empty() ? idle_searches_ + 1 : 0;
  for (const PoseFound& pose : found_) {
    TriangleTrack& track = tracks_[pose.triangle];
    const bool was_sure =
        track.followed && track.sure &&
        (track.placed.centroid - pose.fitted.placed.centroid).norm() < 2 * shapes_[pose.triangle].reach;
    track = {};
    update(track, pose.fitted, time);
    const OutlineEvidence& evidence = pose.fitted.evidence;
    track.sure =
        !follows_ || was_sure ||
        (evidence.support() >= kSureSupport && evidence.edges_with(3) == 3 && evidence.rms < kSureRms);
  }
}

void PoseTracker::adapt_colours(const FrameView& frame, double time) {
  // Light changes slowly: a few hundred places, now and then. Limits are moved only when they matter.
  if (time - colours_seen_ < kColourPause) return;
  colours_seen_ = time;
  std::array<double, 3> table{}, triangle{};
  int table_count = 0, triangle_count = 0;
  const auto add = [](std::array<double, 3>& sum, const std::uint8_t* bgr) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += bgr[i];
  };
  for (int row = 0; row < kColourRows; ++row)
    for (int column = 0; column < kColourRows; ++column) {
      const int x = (2 * column + 1) * frame.width / (2 * kColourRows);
      const std::uint8_t* bgr = frame.row((2 * row + 1) * frame.height / (2 * kColourRows)) + 3 * x;
      if (colours_.of(bgr) != ColourClass::Red) continue;
      add(table, bgr);
      ++table_count;
    }
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    const TriangleTrack& track = tracks_[i];
    if (!track.sure || track.seen != time || track.confidence < 0.5) continue;
    const Vector2 pixel = rectifier_.view().to_pixel(track.placed.centroid);
    if (!(pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < frame.width && pixel.y() < frame.height)) continue;
    const std::uint8_t* bgr = frame.row(int(pixel.y())) + 3 * int(pixel.x());
    if (colours_.of(bgr) != ColourClass::Blue) continue;
    add(triangle, bgr);
    ++triangle_count;
  }
  if (table_count < kLeastTablePlaces || triangle_count == 0) return;
  const double share = 1.0 / std::min(++colour_looks_, kColourMemory);
  for (std::size_t i = 0; i < 3; ++i) {
    table_bgr_[i] += share * (table[i] / table_count - table_bgr_[i]);
    triangle_bgr_[i] += share * (triangle[i] / triangle_count - triangle_bgr_[i]);
  }
  colours_.adapt(table_bgr_.data(), triangle_bgr_.data());
}

base::Result<std::vector<Sighting>> PoseTracker::see(const FrameView& frame, double time) {
  if (auto good = check_frame_size(frame, rectifier_.view()); !good) return tl::unexpected(good.error());
  if (!follows_ || (last_time_ && (time < *last_time_ || time > *last_time_ + 2))) forget();
  last_time_ = time;
  fit_.look_at(frame);
  claims_.clear();
  follow(time);
  part_doubles(time);
  search_missing(frame, time);
  if (follows_) adapt_colours(frame, time);
  std::vector<Sighting> seen;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    TriangleTrack& track = tracks_[i];
    if (!track.followed) continue;
    if (track.seen == time) {
      if (!track.sure) continue;
      lost_[i] = {time, track.placed};
      seen.push_back({i, pose_of(track.placed), track.confidence});
      continue;
    }
    if (!track.sure || time - track.seen > kLongestGlide) {
      track = {};
      continue;
    }
    // Something that moves may do anything while it is hidden.
    const Placed guess = foreseen(track, time);
    const double moved = (guess.centroid - track.placed.centroid).norm() +
                         std::abs(guess.turn - track.placed.turn) * shapes_[i].reach;
    if (moved < kStillMoved * rectifier_.mm_per_pixel(guess.centroid))
      seen.push_back({i, pose_of(guess), 0.0});
  }
  return seen;
}

}  // namespace

std::unique_ptr<Tracker> make_pose_tracker(KnownTriangles known, TableView view, bool tracks) {
  return std::make_unique<PoseTracker>(std::move(known), std::move(view), tracks);
}

}  // namespace icome::cutout
