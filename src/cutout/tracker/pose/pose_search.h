#pragma once
#include <cstddef>
#include <optional>
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

/// The triangles that a search is for.
struct SearchWish {
  std::vector<bool> wanted;  ///< for each known triangle
  std::vector<std::optional<Placed>>
      last;                           ///< where it was seen a moment ago, which settles what is doubtful
  std::vector<Neighbour> neighbours;  ///< triangles that are known to lie in the frame
};

/// Searches a whole frame for triangles, from nothing.
class PoseSearch {
 public:
  static constexpr std::size_t kMostFits = 500;  ///< hypotheses that are fitted to a frame, the best ones

  /// `shapes` and `rectifier` outlive the search.
  PoseSearch(std::span<const TriangleShape> shapes, const Rectifier& rectifier);

  /// The triangles that are wanted, by edges that are not claimed yet, each at most once; their edges are
  /// claimed then. `neighbours` are triangles known to lie there. `fit` looks at the same frame.
  void find(const FrameView& frame, const ColourClasses& colours, OutlineFit& fit, const SearchWish& wish,
            Claims& claims, std::vector<PoseFound>& found);

 private:
  struct Candidate {
    PoseFound pose;
    double score;
    std::vector<Vector2> pixels;  // of supported places
    bool whole;                   // each of its edges is supported somewhere
  };
  void choose_hypotheses(const OutlineFit& fit);
  void fit_hypotheses(OutlineFit& fit, std::span<const Neighbour> neighbours);
  std::optional<double> other_spread(double taken);
  void accept(OutlineFit& fit, const SearchWish& wish, Claims& claims, std::vector<PoseFound>& found);
  bool take(const Candidate& candidate, Claims& claims);
  bool is_doubtful(const Candidate& candidate, const SearchWish& wish) const;

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
  std::vector<double> spreads_;      // that triangles of the frame at hand tell, pixels
  std::size_t candidate_count_ = 0;  // those in use; the others keep their memory
  std::vector<bool> taken_;          // triangles that were accepted
};

/// Is what the frame says enough to believe in a triangle that was not seen before?
bool is_believable(const OutlineEvidence& evidence);

}  // namespace icome::cutout
