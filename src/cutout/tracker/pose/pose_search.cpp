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

constexpr double kLooseness = 0.3;   // of a score, for each pixel that edges lie about the outline
constexpr double kMostLoose = 0.55;  // pixels, root of the mean square

double score_of(const OutlineEvidence& evidence) {
  return evidence.support() - 1.5 * evidence.contradiction() - 0.5 * evidence.beyond() -
         kLooseness * evidence.rms;
}

bool may_be(const OutlineEvidence& evidence) {
  return evidence.support() >= kLeastSupport && evidence.contradiction() <= kMostAgainst &&
         evidence.edges_with(3) >= 2 && evidence.rms <= kMostLoose;
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
    ranked_.emplace_back(score_of(glance), i);
  }
  std::sort(ranked_.begin(), ranked_.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  // Of those that are nearly one, the best stands for all.
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
  for (const auto& [score, index] : ranked_) {
    const PoseHypothesis& hypothesis = hypotheses_[index];
    const OutlineFitted fitted =
        fit.fit(shapes_[hypothesis.triangle], hypothesis.placed, kColdWindow, PosePrior{}, neighbours);
    if (!may_be(fitted.evidence) || fitted.evidence.beyond() > kMostBeyondAtFirst) continue;
    if (candidate_count_ == candidates_.size()) candidates_.emplace_back();
    Candidate& candidate = candidates_[candidate_count_++];
    candidate.pose = {hypothesis.triangle, fitted};
    candidate.score = score_of(fitted.evidence);
    candidate.pixels.assign(fit.supported_pixels().begin(), fit.supported_pixels().end());
  }
}

void PoseSearch::accept(OutlineFit& fit, std::span<const Neighbour> neighbours, Claims& claims,
                        std::vector<PoseFound>& found) {
  std::vector<const Candidate*> best;
  for (std::size_t i = 0; i < candidate_count_; ++i) best.push_back(&candidates_[i]);
  std::stable_sort(best.begin(), best.end(),
                   [](const Candidate* a, const Candidate* b) { return a->score > b->score; });
  std::vector<bool> taken(shapes_.size(), false);
  std::vector<const Candidate*> accepted;
  for (const Candidate* candidate : best) {
    if (taken[candidate->pose.triangle]) continue;
    std::size_t own = 0;
    for (const Vector2& pixel : candidate->pixels) own += !claims.taken(pixel.x(), pixel.y());
    const double share = double(own) / std::max(1, candidate->pose.fitted.evidence.places);
    if (share < kLeastSupport || double(own) < 0.6 * double(candidate->pixels.size())) continue;
    taken[candidate->pose.triangle] = true;
    for (const Vector2& pixel : candidate->pixels) claims.take(pixel);
    accepted.push_back(candidate);
  }
  // Blue beyond an edge must belong to another triangle: now all are known.
  std::vector<Neighbour> others;
  for (const Candidate* candidate : accepted) {
    PoseFound pose = candidate->pose;
    if (pose.fitted.evidence.blue_beyond > 0) {
      others.assign(neighbours.begin(), neighbours.end());
      for (const Candidate* other : accepted)
        if (other != candidate) others.push_back({&shapes_[other->pose.triangle], other->pose.fitted.placed});
      pose.fitted = fit.fit(shapes_[pose.triangle], pose.fitted.placed, 0, PosePrior{}, others);
    }
    if (is_believable(pose.fitted.evidence)) found.push_back(pose);
  }
}

void PoseSearch::find(const FrameView& frame, const ColourClasses& colours, OutlineFit& fit,
                      const std::vector<bool>& wanted, std::span<const Neighbour> neighbours, Claims& claims,
                      std::vector<PoseFound>& found) {
  found.clear();
  const Vector2 middle = rectifier_->to_table(frame.width / 2.0, frame.height / 2.0);
  const double step =
      std::max(1, (std::max(frame.width, frame.height) + Crossings::kFullSide - 1) / Crossings::kFullSide);
  const double pixel = step * rectifier_->mm_per_pixel(middle);
  crossings_.find(frame, colours, *rectifier_, claims, points_);
  lines_.find(points_, pixel, segments_);
  makes_.find(segments_, pixel, wanted, hypotheses_);
  choose_hypotheses(fit);
  fit_hypotheses(fit, neighbours);
  accept(fit, neighbours, claims, found);
}

}  // namespace icome::cutout
