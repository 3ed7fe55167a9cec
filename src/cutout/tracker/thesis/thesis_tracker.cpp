#include <algorithm>
#include <utility>
#include <vector>

#include "cutout/tracker/edges/rectifier.h"
#include "cutout/tracker/frame_size.h"
#include "cutout/tracker/thesis/hough_lines.h"
#include "cutout/tracker/thesis/isosceles_triples.h"
#include "cutout/tracker/thesis/red_blue_marks.h"
#include "cutout/tracker/tracker.h"

namespace icome::cutout {
namespace {

constexpr std::size_t kMostMarks = 30'000;
constexpr std::size_t kMostLines = 100;  // 161,700 triples
constexpr int kLeastLineVotes = 18;      // marks of a dark spot

class ThesisTracker : public Tracker {
 public:
  ThesisTracker(KnownTriangles known, TableView view)
      : known_(std::move(known)), rectifier_(std::move(view)) {}

  base::Result<std::vector<Sighting>> see(const FrameView& frame, double) override {
    if (auto good = check_frame_size(frame, rectifier_.view()); !good) return tl::unexpected(good.error());
    const base::Vector2 middle = rectifier_.to_table(frame.width / 2.0, frame.height / 2.0);
    const double pixel = rectifier_.mm_per_pixel(middle);
    red_blue_marks(frame, rectifier_, kMostMarks, marks_);
    hough_.find(marks_, pixel, kLeastLineVotes, kMostLines, lines_);
    std::vector<KnownTriple> triples = isosceles_triples(lines_, known_, pixel);
    std::stable_sort(triples.begin(), triples.end(),
                     [](const KnownTriple& a, const KnownTriple& b) { return worth(a) > worth(b); });
    // A triangle lies on the table once, and a line is an edge of one triangle.
    std::vector<bool> seen_before(known_.triangles.size(), false), used(lines_.size(), false);
    std::vector<Sighting> seen;
    for (const KnownTriple& triple : triples) {
      const auto [a, b, c] = triple.lines;
      if (seen_before[triple.triangle] || used[a] || used[b] || used[c]) continue;
      seen_before[triple.triangle] = used[a] = used[b] = used[c] = true;
      seen.push_back({triple.triangle, triple.pose, 1 - triple.mismatch / 2});
    }
    std::sort(seen.begin(), seen.end(),
              [](const Sighting& x, const Sighting& y) { return x.triangle < y.triangle; });
    return seen;
  }

 private:
  static double worth(const KnownTriple& triple) { return triple.votes * (1 - triple.mismatch / 2.5); }

  KnownTriangles known_;
  Rectifier rectifier_;
  HoughLines hough_;
  std::vector<base::Vector2> marks_;
  std::vector<HoughLine> lines_;
};

}  // namespace

std::unique_ptr<Tracker> make_thesis_tracker(KnownTriangles known, TableView view) {
  return std::make_unique<ThesisTracker>(std::move(known), std::move(view));
}

}  // namespace icome::cutout
