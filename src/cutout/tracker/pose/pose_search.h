#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "cutout/tracker/edges/claims.h"
#include "cutout/tracker/pose/outline_fit.h"
#include "cutout/tracker/pose/pose_hypotheses.h"

namespace icome::cutout {

/// A triangle that was found in a frame.
struct PoseFound {
  std::size_t triangle;
  OutlineFitted fitted;
};

/// Searches a whole frame for triangles, from nothing.
class PoseSearch {
 public:
  static constexpr std::size_t kMostFits = 1500;  ///< hypotheses that are fitted to a frame, the best ones

  /// `shapes` and `rectifier` outlive the search.
  PoseSearch(std::span<const TriangleShape> shapes, const Rectifier& rectifier);

  /// The triangles that are wanted, by edges that are not claimed yet, each at most once; their edges are
  /// claimed then. `neighbours` are triangles known to lie there. `fit` looks at the same frame.
  void find(const FrameView& frame, const ColourClasses& colours, OutlineFit& fit,
            const std::vector<bool>& wanted, std::span<const Neighbour> neighbours, Claims& claims,
            std::vector<PoseFound>& found);

 private:
  struct Candidate {
    PoseFound pose;
    double score;
    std::vector<Vector2> pixels;  // of supported places
  };
  void choose_hypotheses(const OutlineFit& fit);
  void fit_hypotheses(OutlineFit& fit, std::span<const Neighbour> neighbours);
  void accept(OutlineFit& fit, std::span<const Neighbour> neighbours, Claims& claims,
              std::vector<PoseFound>& found);

  std::span<const TriangleShape> shapes_;
  const Rectifier* rectifier_;
  PoseHypotheses makes_;
  Crossings crossings_;
  OrientedLines lines_;
  std::vector<EdgePoint> points_;
  std::vector<EdgeSegment> segments_;
  std::vector<PoseHypothesis> hypotheses_;
  std::vector<std::pair<double, std::size_t>> ranked_;  // hypotheses by what a glance says
  std::vector<Candidate> candidates_;
  std::size_t candidate_count_ = 0;  // those in use; the others keep their memory
};

/// Is what the frame says enough to believe in a triangle that was not seen before?
bool is_believable(const OutlineEvidence& evidence);

}  // namespace icome::cutout
