#include "geometry/curve/curve_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/tree/hilbert.h"

namespace icome::geometry {
namespace {

constexpr float kInfinitelyFar = std::numeric_limits<float>::infinity();
constexpr double kFarthestQuery = 1e15;  // m: squares of single precision hold it
constexpr float kIndexRounding = 2e-6F;  // of all coordinates: more than single precision loses on the way

// Pieces leave their chords by some tenth of their length, so that the chord tells nearly all. More of them
// make the tree deeper and fill the cache for nothing.
constexpr double kBentPiece = 0.1;
constexpr int kLeastPiecesOfCurve = 2, kMostPiecesOfCurve = 16;

int pieces_of(const CubicBezier& curve) {
  const double bend = std::max(curve.second_derivative(0.0).norm(), curve.second_derivative(1.0).norm());
  double way = 0.0;
  for (std::size_t i = 0; i < 3; ++i) way += (curve.points[i + 1] - curve.points[i]).norm();
  if (!(way > 0.0)) return 1;
  return int(std::clamp(std::ceil(bend / (8.0 * kBentPiece * way)), double(kLeastPiecesOfCurve),
                        double(kMostPiecesOfCurve)));
}

double distance_to_chord(const Vector2& point, const Vector2& from, const Vector2& way) {
  const double square = way.squaredNorm();
  const double part = square > 0.0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0.0;
  return (from + part * way - point).norm();
}

/// The distance from the chord that no place of the piece passes: by its hull, or by how far it is from the
/// even run along the chord, whose greatest Bernstein polynomials sum up to 3/4.
double chord_reach(const CubicBezier& piece) {
  const auto& p = piece.points;
  const Vector2 way = p[3] - p[0];
  const double by_hull = std::max(distance_to_chord(p[1], p[0], way), distance_to_chord(p[2], p[0], way));
  const double by_run = 0.75 * std::max((p[1] - p[0] - way / 3.0).norm(), (p[2] - p[3] + way / 3.0).norm());
  return std::min(by_hull, by_run);
}

FourFloats least_of(const FourFloats& a, const FourFloats& b) { return a < b ? a : b; }
FourFloats most_of(const FourFloats& a, const FourFloats& b) { return a > b ? a : b; }

FloatBox index_box(const Bounds2& box) {
  return float_box({Vector3(box.min().x(), box.min().y(), 0.0), Vector3(box.max().x(), box.max().y(), 0.0)});
}

}  // namespace

/// One query.
class CurveIndex::Search {
 public:
  Search(const CurveIndex& index, const Vector2& point, double within)
      : index_(index),
        point_(point),
        x_(float(index.centred(point).x())),
        y_(float(index.centred(point).y())),
        slack_(kIndexRounding * (std::abs(x_) + std::abs(y_) + index.extent_)),
        least_(within * within),
        limit_(float(within) * 1.000001F + slack_) {}

  bool run(Nearest& found) {
    struct Open {
      std::uint32_t level, place;
      float distance;  // squared
    };
    std::array<Open, kMostLevels*(kWidth - 1) + 1> stack;
    unsigned depth = 0;
    stack[depth++] = {index_.levels_ - 1, 0, 0.0F};
    while (depth > 0) {
      const Open top = stack[--depth];
      if (!(top.distance < square(limit_))) continue;
      const FourFloats distances = distances_to(index_.nodes_[index_.start_[top.level] + top.place]);
      const unsigned first = depth;
      for (unsigned child = 0; child < kWidth; ++child) {
        const float distance = distances[child];
        if (!(distance < square(limit_))) continue;
        unsigned slot = depth++;  // insertion keeps the nearest on top
        for (; slot > first && stack[slot - 1].distance < distance; --slot) stack[slot] = stack[slot - 1];
        stack[slot] = {top.level - 1, top.place * kWidth + child, distance};
        prefetch(stack[slot].level, stack[slot].place);
      }
      if (top.level > 0) continue;
      while (depth > first) {
        const Open& chords = stack[--depth];
        if (chords.distance < square(limit_)) look_at(chords.place);
      }
    }
    solve_all();
    if (any_) found = found_;
    return any_;
  }

  bool ask_all(Nearest& found) {
    for (std::size_t i = 0; i < index_.curves_.size(); ++i)
      offer(i, nearest_on_curve(index_.curves_[i], point_));
    if (any_) found = found_;
    return any_;
  }

 private:
  /// A piece that may be the nearest.
  struct Candidate {
    float least;  // m, below its distance
    std::uint32_t place;
    float part;  // of its chord, at which that is nearest
  };
  static constexpr std::size_t kMostCandidates = 64;

  static float square(float number) { return number * number; }

  /// Data that is looked at soon comes into the cache meanwhile.
  void prefetch(std::uint32_t level, std::uint32_t place) const {
    if (level < index_.levels_) {
      __builtin_prefetch(&index_.nodes_[index_.start_[level] + place]);
    } else {
      const char* const chords = reinterpret_cast<const char*>(&index_.chords_[place]);
      __builtin_prefetch(chords);
      __builtin_prefetch(chords + sizeof(Chords) - 1);
    }
  }

  FourFloats distances_to(const Node& node) const {
    const FourFloats none = {};
    const FourFloats x = most_of(most_of(node.lo_x - x_, x_ - node.hi_x), none);
    const FourFloats y = most_of(most_of(node.lo_y - y_, y_ - node.hi_y), none);
    return x * x + y * y;
  }

  void look_at(std::uint32_t place) {
    const Chords& chords = index_.chords_[place];
    const FourFloats x = x_ - chords.from_x, y = y_ - chords.from_y;
    const FourFloats zero = {}, one = {1.0F, 1.0F, 1.0F, 1.0F};
    const FourFloats part =
        most_of(least_of((x * chords.way_x + y * chords.way_y) * chords.per_way, one), zero);
    const FourFloats off_x = x - part * chords.way_x, off_y = y - part * chords.way_y;
    const FourFloats distances = off_x * off_x + off_y * off_y;
    const FourFloats farthest = limit_ + chords.reach;
    for (unsigned mask = detail::mask_of(distances < farthest * farthest); mask != 0; mask &= mask - 1) {
      const auto lane = unsigned(__builtin_ctz(mask));
      const float distance = std::sqrt(distances[lane]), reach = chords.reach[lane];
      // To each place of the chord there is one of the piece within its reach.
      limit_ = std::min(limit_, distance * 1.000001F + reach + slack_);
      if (count_ == kMostCandidates) solve_all();
      candidates_[count_++] = {distance * 0.999999F - reach - slack_, place * kWidth + lane, part[lane]};
    }
  }

  /// The least bounds first, so that the others need no solving, mostly.
  void solve_all() {
    while (count_ > 0) {
      std::size_t next = 0, kept = 0;
      for (std::size_t i = 0; i < count_; ++i) {
        if (!(candidates_[i].least < limit_)) continue;
        candidates_[kept] = candidates_[i];
        if (candidates_[kept].least < candidates_[next].least) next = kept;
        ++kept;
      }
      count_ = kept;
      if (count_ == 0) return;
      const Candidate candidate = candidates_[next];
      candidates_[next] = candidates_[--count_];
      const Piece& piece = index_.pieces_[candidate.place];
      const double from = piece.from(), to = piece.to();
      offer(piece.curve, nearest_on_curve(index_.curves_[piece.curve], point_, from, to,
                                          from + double(candidate.part) * (to - from)));
    }
  }

  void offer(std::size_t curve, const NearestOnCurve& near) {
    if (!(near.distance_squared < least_)) return;
    least_ = near.distance_squared;
    found_ = {curve, near};
    any_ = true;
    limit_ = std::min(limit_, float(std::sqrt(least_)) * 1.000001F + slack_);
  }

  const CurveIndex& index_;
  Vector2 point_;
  float x_, y_;
  float slack_;   // m, what single precision may be wrong by
  double least_;  // m^2, of what was found
  float limit_;   // m, not below the distance of the nearest: farther pieces are of no interest
  std::array<Candidate, kMostCandidates> candidates_;
  std::size_t count_ = 0;
  Nearest found_;
  bool any_ = false;
};

void CurveIndex::add_pieces(std::vector<Piece>& pieces, std::vector<FloatBox>& boxes) const {
  for (std::size_t i = 0; i < curves_.size(); ++i) {
    const int count = pieces_of(curves_[i]);
    for (int k = 0; k < count; ++k) {
      const Piece piece = {std::uint32_t(i), std::uint16_t(k), std::uint16_t(count)};
      const Bounds2 box = curves_[i].part(piece.from(), piece.to()).hull_bounds();
      pieces.push_back(piece);
      boxes.push_back(index_box(Bounds2(centred(box.min()), centred(box.max()))));
    }
  }
}

void CurveIndex::set_chord(std::size_t place) {
  const Piece& piece = pieces_[place];
  const CubicBezier part = curves_[piece.curve].part(piece.from(), piece.to());
  const Vector2 from = centred(part.points[0]), way = part.points[3] - part.points[0];
  const double square = way.squaredNorm();
  Chords& chords = chords_[place / kWidth];
  const std::size_t lane = place % kWidth;
  chords.from_x[lane] = float(from.x());
  chords.from_y[lane] = float(from.y());
  chords.way_x[lane] = float(way.x());
  chords.way_y[lane] = float(way.y());
  const auto per_way = float(1.0 / square);
  chords.per_way[lane] = std::isfinite(per_way) ? per_way : 0.0F;
  chords.reach[lane] = detail::above(chord_reach(part) + (std::isfinite(per_way) ? 0.0 : std::sqrt(square)));
}

void CurveIndex::build_tree(std::vector<FloatBox> boxes) {
  while (true) {
    start_[levels_++] = std::uint32_t(nodes_.size());
    std::vector<FloatBox> outer;
    for (std::size_t i = 0; i < boxes.size(); i += kWidth) {
      Node node;
      FloatBox around = FloatBox::empty();
      for (std::size_t lane = 0; lane < kWidth; ++lane) {
        const FloatBox box = i + lane < boxes.size() ? boxes[i + lane] : FloatBox::empty();
        around.extend(box);
        node.lo_x[lane] = box.lo[0];
        node.lo_y[lane] = box.lo[1];
        node.hi_x[lane] = box.hi[0];
        node.hi_y[lane] = box.hi[1];
      }
      nodes_.push_back(node);
      outer.push_back(around);
    }
    if (outer.size() == 1) return;
    boxes = std::move(outer);
  }
}

CurveIndex::CurveIndex(std::span<const CubicBezier> curves) : curves_(curves.begin(), curves.end()) {
  if (curves_.empty()) return;
  Bounds2 all;
  for (const CubicBezier& curve : curves_) all.extend(curve.hull_bounds());
  middle_ = all.center();
  extent_ = detail::above(all.sizes().maxCoeff());
  std::vector<Piece> pieces;
  std::vector<FloatBox> boxes;
  add_pieces(pieces, boxes);
  std::vector<Eigen::Vector3f> middles;
  for (const FloatBox& box : boxes)
    middles.emplace_back(0.5F * (box.lo[0] + box.hi[0]), 0.5F * (box.lo[1] + box.hi[1]), 0.0F);
  Chords nothing{};
  nothing.from_x += kInfinitelyFar;
  chords_.assign((pieces.size() + kWidth - 1) / kWidth, nothing);
  std::vector<FloatBox> groups(chords_.size(), FloatBox::empty());
  for (const std::uint32_t which : hilbert_order(middles)) {
    groups[pieces_.size() / kWidth].extend(boxes[which]);
    pieces_.push_back(pieces[which]);
    set_chord(pieces_.size() - 1);
  }
  build_tree(std::move(groups));
}

bool CurveIndex::nearest(const Vector2& point, double within, Nearest& found) const {
  if (curves_.empty()) return false;
  Search search(*this, point, within);
  const bool is_far = !(centred(point).cwiseAbs().maxCoeff() + double(extent_) < kFarthestQuery);
  return is_far ? search.ask_all(found) : search.run(found);
}

}  // namespace icome::geometry
