#include "cutout/tracker/pose/pose_search.h"

#include <algorithm>
#include <cmath>

namespace icome::cutout {
namespace {

constexpr double kLeastGlance = 0.15;       // share of the outline that a glance must support
constexpr double kMostGlanceAgainst = 0.4;  // and may contradict
constexpr double kSamePlace = 5;            // pixels within which two hypotheses are one
constexpr double kSameTurn = 0.06;          // rad
constexpr std::size_t kMostOfTriangle = 6;  // hypotheses of one triangle that are fitted
constexpr double kColdWindow = 6;           // pixels from a hypothesis to its edges
constexpr double kLeastSupport = 0.22;      // share of the outline
constexpr double kMostAgainst = 0.1;
constexpr double kMostBeyond = 0.1;          // blue beyond that no other triangle explains
constexpr double kMostBeyondAtFirst = 0.35;  // before the others are known

constexpr double kMostLoose = 0.45;        // pixels that edges lie about the outline, root of the mean square
constexpr double kMostStepped = 0.7;       // likewise, of a triangle that is seen all around: colours kept at
                                           // half the size make steps of edges
constexpr double kLeastSpreadStep = 0.25;  // pixels, below which it stays as it is
constexpr double kMostSpread = 1.5;        // pixels
constexpr double kCertainSupport = 0.85;   // of a triangle that is seen all around
constexpr double kCertainRms = 0.3;        // pixels
constexpr double kAlikeAngle = 0.07;       // rad
constexpr double kAlikeReach = 0.1;        // share of it
constexpr double kNearlyAsGood = 0.75;     // of a score, from which another explanation casts doubt
constexpr double kSharedPlaces = 0.5;      // share of places by which two candidates explain the same edges
constexpr double kSeenShare = 0.12;        // of an edge that count as a sight of it
constexpr double kLeastOfTwo = 0.3;        // share of the outline, of two edges alone
constexpr int kSeenPlaces = 3;             // of an edge that count as a sight of it

/// Pixels of outline that speak for a candidate, less those against it.
double score_of(const OutlineEvidence& evidence, double circumference) {
  return circumference *
         (evidence.support() * (1 - evidence.rms) - 1.5 * evidence.contradiction() - 0.7 * evidence.beyond());
}

/// Is something seen of each edge?
bool is_whole(const OutlineEvidence& evidence) {
  for (std::size_t edge = 0; edge < 3; ++edge)
    if (evidence.supported_of[edge] < kSeenPlaces ||
        evidence.supported_of[edge] < kSeenShare * evidence.places_of[edge])
      return false;
  return true;
}

/// Are the shapes so near that both may fit the same edges?
bool is_alike(const TriangleShape& a, const TriangleShape& b) {
  return std::abs(a.corner_angles[1] - b.corner_angles[1]) < kAlikeAngle &&
         std::abs(a.reach - b.reach) < kAlikeReach * a.reach;
}

bool may_be(const OutlineEvidence& evidence) {
  const bool is_certain = evidence.support() >= kCertainSupport && is_whole(evidence);
  return evidence.support() >= kLeastSupport && evidence.contradiction() <= kMostAgainst &&
         evidence.edges_with(kSeenPlaces) >= 2 && evidence.rms <= (is_certain ? kMostStepped : kMostLoose);
}

}  // namespace

bool is_believable(const OutlineEvidence& evidence) {
  return may_be(evidence) && evidence.beyond() <= kMostBeyond;
}

PoseSearch::PoseSearch(std::span<const TriangleShape> shapes, const Rectifier& rectifier)
    : shapes_(shapes), rectifier_(&rectifier), makes_(shapes) {}

void PoseSearch::choose_hypotheses(const OutlineFit& fit) {
  ranked_.clear();
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    const PoseHypothesis& hypothesis = hypotheses_[i];
    if (!rectifier_->near_table(hypothesis.placed.centroid)) continue;
    const OutlineEvidence glance = fit.glance(shapes_[hypothesis.triangle], hypothesis.placed);
    if (glance.support() < kLeastGlance || glance.contradiction() > kMostGlanceAgainst ||
        glance.edges_with(1) < 2)
      continue;
    ranked_.emplace_back(glance.support() - 1.5 * glance.contradiction() - 0.5 * glance.beyond(), i);
  }
  std::sort(ranked_.begin(), ranked_.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  // Among hypotheses that are nearly one, the best stands for all.
  std::vector<std::vector<std::size_t>> of_triangle(shapes_.size());
  std::size_t kept = 0;
  for (const auto& [score, index] : ranked_) {
    const PoseHypothesis& hypothesis = hypotheses_[index];
    std::vector<std::size_t>& others = of_triangle[hypothesis.triangle];
    if (others.size() >= kMostOfTriangle) continue;
    const double near = kSamePlace * rectifier_->mm_per_pixel(hypothesis.placed.centroid);
    const bool known = std::any_of(others.begin(), others.end(), [&](std::size_t other) {
      const Placed& placed = hypotheses_[other].placed;
      return (placed.centroid - hypothesis.placed.centroid).norm() < near &&
             std::abs(within_half_turn(placed.turn - hypothesis.placed.turn)) < kSameTurn;
    });
    if (known) continue;
    others.push_back(index);
    ranked_[kept++] = {score, index};
    if (kept >= kMostFits) break;
  }
  ranked_.resize(kept);
}

void PoseSearch::fit_hypotheses(OutlineFit& fit, std::span<const Neighbour> neighbours) {
  candidate_count_ = 0;
  spreads_.clear();
  std::vector<Neighbour> certain;
  std::vector<bool> done(shapes_.size(), false);
  for (const auto& [score, index] : ranked_) {
    const PoseHypothesis& hypothesis = hypotheses_[index];
    // Nothing is seen of a triangle that lies on one that is seen all around.
    if (done[hypothesis.triangle]) continue;
    const bool within = std::any_of(certain.begin(), certain.end(), [&](const Neighbour& other) {
      return !is_alike(*other.shape, shapes_[hypothesis.triangle]) &&
             depth_within(*other.shape, other.placed, hypothesis.placed.centroid) > 0;
    });
    if (within) continue;
    const OutlineFitted fitted =
        fit.fit(shapes_[hypothesis.triangle], hypothesis.placed, kColdWindow, PosePrior{}, neighbours);
    if (fitted.inwards) spreads_.push_back(fit.spread() - *fitted.inwards);
    if (!may_be(fitted.evidence) || fitted.evidence.beyond() > kMostBeyondAtFirst) continue;
    if (candidate_count_ == candidates_.size()) candidates_.emplace_back();
    Candidate& candidate = candidates_[candidate_count_++];
    candidate.pose = {hypothesis.triangle, fitted};
    candidate.score = score_of(fitted.evidence, shapes_[hypothesis.triangle].circumference /
                                                    rectifier_->mm_per_pixel(fitted.placed.centroid));
    candidate.whole = is_whole(fitted.evidence);
    if (candidate.whole && fitted.evidence.support() >= kCertainSupport &&
        fitted.evidence.rms <= kCertainRms && fitted.evidence.contradicted == 0) {
      certain.push_back({&shapes_[hypothesis.triangle], fitted.placed});
      done[hypothesis.triangle] = true;
    }
    candidate.pixels.assign(fit.supported_pixels().begin(), fit.supported_pixels().end());
  }
}

/// The spread of outlines that this frame's triangles have in common, where it is another than was taken.
std::optional<double> PoseSearch::other_spread(double taken) {
  if (spreads_.empty()) return std::nullopt;
  // Among look-alikes the one with less of it is the right one.
  std::ranges::sort(spreads_, {}, [](double spread) { return std::abs(spread); });
  const double common = spreads_[(spreads_.size() - 1) / 2];
  if (std::abs(common - taken) < kLeastSpreadStep || std::abs(common) > kMostSpread) return std::nullopt;
  return common;
}

bool PoseSearch::take(const Candidate& candidate, Claims& claims) {
  if (taken_[candidate.pose.triangle]) return false;
  std::size_t own = 0;
  for (const Vector2& pixel : candidate.pixels) own += !claims.taken(pixel.x(), pixel.y());
  const double share = double(own) / std::max(1, candidate.pose.fitted.evidence.places);
  if (share < kLeastSupport || double(own) < 0.6 * double(candidate.pixels.size())) return false;
  taken_[candidate.pose.triangle] = true;
  for (const Vector2& pixel : candidate.pixels) claims.take(pixel);
  return true;
}

bool PoseSearch::is_doubtful(const Candidate& candidate, const SearchWish& wish) const {
  const auto was_near = [&](const PoseFound& pose) {
    const std::optional<Placed>& last = wish.last[pose.triangle];
    return last &&
           (last->centroid - pose.fitted.placed.centroid).norm() < 0.5 * shapes_[pose.triangle].reach &&
           std::abs(within_half_turn(last->turn - pose.fitted.placed.turn)) < 0.5;
  };
  const bool expected = was_near(candidate.pose);
  const Placed& placed = candidate.pose.fitted.placed;
  const double pixel = rectifier_->mm_per_pixel(placed.centroid);
  for (std::size_t i = 0; i < candidate_count_; ++i) {
    const Candidate& other = candidates_[i];
    if (&other == &candidate || taken_[other.pose.triangle] || other.score < kNearlyAsGood * candidate.score)
      continue;
    const Placed& there = other.pose.fitted.placed;
    const TriangleShape& shape = shapes_[other.pose.triangle];
    if ((there.centroid - placed.centroid).norm() > shape.reach + shapes_[candidate.pose.triangle].reach)
      continue;
    if (other.pose.triangle == candidate.pose.triangle &&
        (there.centroid - placed.centroid).norm() < 2 * pixel &&
        std::abs(within_half_turn(there.turn - placed.turn)) < 0.04)
      continue;
    if (expected && !was_near(other.pose)) continue;
    std::size_t shared = 0;
    for (const Vector2& at : candidate.pixels)
      shared += std::abs(depth_within(shape, there, rectifier_->to_table(at.x(), at.y()))) < 2 * pixel;
    if (double(shared) >= kSharedPlaces * double(candidate.pixels.size())) return true;
  }
  return false;
}

void PoseSearch::accept(OutlineFit& fit, const SearchWish& wish, Claims& claims,
                        std::vector<PoseFound>& found) {
  std::vector<const Candidate*> best;
  for (std::size_t i = 0; i < candidate_count_; ++i) best.push_back(&candidates_[i]);
  std::stable_sort(best.begin(), best.end(),
                   [](const Candidate* a, const Candidate* b) { return a->score > b->score; });
  taken_.assign(shapes_.size(), false);
  std::vector<const Candidate*> accepted;
  for (const Candidate* candidate : best)
    if (candidate->whole && take(*candidate, claims)) accepted.push_back(candidate);
  // Two edges alone may belong to several triangles, or to one in several ways: then nothing is known.
  for (const Candidate* candidate : best)
    if (!candidate->whole && candidate->pose.fitted.evidence.support() >= kLeastOfTwo &&
        !is_doubtful(*candidate, wish) && take(*candidate, claims))
      accepted.push_back(candidate);
  // Blue beyond an edge must belong to another triangle: now all are known.
  std::vector<Neighbour> others;
  for (const Candidate* candidate : accepted) {
    PoseFound pose = candidate->pose;
    if (pose.fitted.evidence.blue_beyond > 0) {
      others = wish.neighbours;
      for (const Candidate* other : accepted)
        if (other != candidate) others.push_back({&shapes_[other->pose.triangle], other->pose.fitted.placed});
      pose.fitted = fit.fit(shapes_[pose.triangle], pose.fitted.placed, 0, PosePrior{}, others);
    }
    if (is_believable(pose.fitted.evidence)) found.push_back(pose);
  }
}

void PoseSearch::find(const FrameView& frame, const ColourClasses& colours, OutlineFit& fit,
                      const SearchWish& wish, Claims& claims, std::vector<PoseFound>& found) {
  found.clear();
  const Vector2 middle = rectifier_->to_table(frame.width / 2.0, frame.height / 2.0);
  const double step =
      std::max(1, (std::max(frame.width, frame.height) + Crossings::kFullSide - 1) / Crossings::kFullSide);
  const double pixel = step * rectifier_->mm_per_pixel(middle);
  crossings_.find(frame, colours, *rectifier_, claims, points_);
  lines_.find(points_, pixel, segments_);
  makes_.find(segments_, pixel, wish.wanted, hypotheses_);
  choose_hypotheses(fit);
  fit_hypotheses(fit, wish.neighbours);
  if (const auto spread = other_spread(fit.spread())) {
    fit.set_spread(*spread);
    fit_hypotheses(fit, wish.neighbours);
  }
  accept(fit, wish, claims, found);
}

}  // namespace icome::cutout
