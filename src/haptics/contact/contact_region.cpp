#include "haptics/contact/contact_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "haptics/contact/haptic_scene.h"
#include "haptics/shapes/smooth_element.h"

namespace icome::haptics {

using geometry::FourBoxes;

namespace {

constexpr double kLongStep = 0.5;        // of the region's reach
constexpr double kFirstShare = 1.0 / 8;  // of a long step, asked first
constexpr double kShareKept = 0.999;     // of a way out of a region: so much of it is surely within

/// The pieces of smooth surfaces that a sweep has tested: a piece that has several boxes in the region
/// is tested once.
class AskedPieces {
 public:
  bool knows(const Element& element) {
    for (std::size_t i = 0; i < std::min(count_, kMost); ++i) {
      if (known_[i].object == element.object && known_[i].piece == element.feature) return true;
    }
    known_[count_++ % kMost] = {element.object, element.feature};
    return false;
  }

 private:
  static constexpr std::size_t kMost = 16;
  struct Asked {
    std::uint32_t object, piece;
  };
  std::array<Asked, kMost> known_;
  std::size_t count_ = 0;
};

/// The t at which a line from `offset` by t * `step` leaves a ball around the origin, or a cylinder when
/// both are at right angles to its axis; nothing if it misses it.
std::optional<double> exit_from(const Vector3& offset, const Vector3& step, double radius) {
  const double a = step.squaredNorm();
  const double b = offset.dot(step);
  const double discriminant = b * b - a * (offset.squaredNorm() - radius * radius);
  if (a <= 0.0 || discriminant < 0.0) return std::nullopt;
  return (std::sqrt(discriminant) - b) / a;
}

}  // namespace

ContactRegion::ContactRegion() : pieces_(kPieces), boxes_(kPieces / FourBoxes::kCount), made_(kMade) {
  elements_.reserve(kElements);
  made_elements_.reserve(kMadeElements);
}

void ContactRegion::start(const HapticScene& scene, const Frame& frame, const Vector3& a, const Vector3& b,
                          double reach, std::size_t limit) {
  limit_ = std::min(limit, kPieces);
  scene_ = &scene;
  frame_ = frame;
  a_ = a;
  b_ = b;
  reach_ = reach;
  tolerance_ = Tolerance::for_coordinates(std::max(a.cwiseAbs().maxCoeff(), b.cwiseAbs().maxCoeff()));
  smallest_ = std::numeric_limits<double>::infinity();
  overflowed_ = false;
  keeps_whole_ = false;
  size_ = 0;
  elements_.clear();
  made_elements_.clear();
  ++generation_;
}

void ContactRegion::hold(double size) {
  tolerance_.gap = std::max(tolerance_.gap, Tolerance::for_size(size).gap);
  if (size > 0.0) smallest_ = std::min(smallest_, size);
}

void ContactRegion::invalidate() {
  reach_ = -1.0;
  overflowed_ = false;
  size_ = 0;
}

bool ContactRegion::take_box(const Bounds& bounds) {
  overflowed_ = overflowed_ || size_ == limit_ || elements_.size() == kElements;
  if (overflowed_) return false;
  ++gathered_;
  FourBoxes& boxes = boxes_[size_ / FourBoxes::kCount];
  if (size_ % FourBoxes::kCount == 0) boxes = FourBoxes();
  boxes.set(size_ % FourBoxes::kCount, geometry::float_box(Bounds(bounds.min() - a_, bounds.max() - a_)));
  return true;
}

bool ContactRegion::add(const Element& element, const Bounds& bounds) {
  if (!take_box(bounds)) return false;
  pieces_[size_++] = {element.object, element.feature, std::uint32_t(elements_.size()), 1};
  elements_.push_back(element);
  return true;
}

bool ContactRegion::defer(std::uint32_t object, std::uint32_t piece, const Bounds& bounds) {
  if (!take_box(bounds)) return false;
  pieces_[size_++] = {object, piece, 0, 0};
  return true;
}

bool ContactRegion::defer_whole(std::uint32_t object) {
  const Vector3 far = Vector3::Constant(std::numeric_limits<double>::infinity());
  return defer(object, kWhole, {-far, far});
}

std::span<const Element> ContactRegion::elements_of(Piece& piece) {
  if (piece.count == 0) {
    PieceElements made(elements_);
    scene_->expand(piece.object, piece.piece, frame_, made);
    overflowed_ = overflowed_ || !made.complete();
    piece.first = std::uint32_t(made.all().data() - elements_.data());
    piece.count = std::uint32_t(made.all().size());
  }
  return {elements_.data() + piece.first, piece.count};
}

/// The elements of a piece of an object that is kept whole: valid until the next call.
std::span<const Element> ContactRegion::elements_of_whole(std::uint32_t object, std::uint32_t piece) {
  Made& made = made_[std::uint32_t(piece * 2654435761u) % kMade];
  if (made.generation != generation_ || made.object != object || made.piece != piece) {
    if (made_elements_.size() + kMostOfPiece > kMadeElements) {
      made_elements_.clear();
      ++generation_;
    }
    PieceElements elements(made_elements_);
    scene_->expand(object, piece, frame_, elements);
    made = {generation_, object, piece, std::uint32_t(elements.all().data() - made_elements_.data()),
            std::uint32_t(elements.all().size())};
  }
  return {made_elements_.data() + made.first, made.count};
}

/// Calls `ask(elements)` for the pieces of an object kept whole that come within `distance` (m) of a way,
/// until the share of it that still counts, which `ask` returns.
template <typename Ask>
void ContactRegion::sweep_whole(std::uint32_t object, const Vector3& start, const Vector3& step,
                                double distance, Ask&& ask) {
  class Visitor final : public PieceVisitor {
   public:
    Visitor(ContactRegion& region, std::uint32_t object, Ask& ask)
        : region_(region), object_(object), ask_(ask) {}
    double visit(std::uint32_t piece) override { return ask_(region_.elements_of_whole(object_, piece)); }

   private:
    ContactRegion& region_;
    std::uint32_t object_;
    Ask& ask_;
  };
  Visitor visitor(*this, object, ask);
  gathered_ += kGatheredForTested * scene_->sweep(object, start, step, distance, frame_, visitor);
}

geometry::SegmentQuery ContactRegion::relative_query(const Vector3& from, const Vector3& to,
                                                     double reach) const {
  return {from - a_, to - a_, reach + frame_.tip, frame_.tip > 0.0};
}

double ContactRegion::clearance(const Vector3& position) const {
  const Vector3 along = b_ - a_;
  const double squared = along.squaredNorm();
  const double t = squared > 0.0 ? std::clamp((position - a_).dot(along) / squared, 0.0, 1.0) : 0.0;
  return reach_ - (a_ + t * along - position).norm();
}

// The region is the union of two balls and of the cylinder between them, and convex: the way out of it is the
// farthest of the ways out of those.
double ContactRegion::share_within(const Vector3& position, const Vector3& step) const {
  double share = 0.0;
  for (const Vector3& centre : {a_, b_}) {
    const std::optional<double> out = exit_from(position - centre, step, reach_);
    if (out) share = std::max(share, *out);
  }
  const Vector3 along = b_ - a_;
  const double squared = along.squaredNorm();
  if (squared > 0.0) {
    const auto beside = [&](const Vector3& v) { return Vector3(v - along * (along.dot(v) / squared)); };
    const std::optional<double> out = exit_from(beside(position - a_), beside(step), reach_);
    const double at = out ? along.dot(position - a_ + *out * step) : -1.0;
    if (at >= 0.0 && at <= squared) share = std::max(share, *out);
  }
  share *= kShareKept;
  return share >= 1.0 ? 1.0 : clearance(position + share * step) >= 0.0 ? share : 0.0;
}

std::size_t ContactRegion::around(const Vector3& position, double distance, std::span<Element> into) {
  const geometry::SegmentQuery here = relative_query(position, position, distance);
  const Tolerance near = Tolerance::reaching(distance);
  std::size_t count = 0;
  const auto look = [&](std::span<const Element> elements) {
    looked_at_ += elements.size();
    for (const Element& element : elements) {
      if (element.flat() &&
          (std::abs(height(element, position)) > distance || !covers(element, position, near)))
        continue;
      if (count < into.size()) into[count] = facing(element, position);
      ++count;
    }
    return 1.0;
  };
  for (std::size_t block = 0; block * FourBoxes::kCount < size_; ++block) {
    for (unsigned mask = boxes_[block].near_mask(here); mask != 0; mask &= mask - 1) {
      Piece& piece = pieces_[block * FourBoxes::kCount + unsigned(__builtin_ctz(mask))];
      if (piece.piece == kWhole) {
        sweep_whole(piece.object, position, Vector3::Zero(), distance + frame_.tip, look);
      } else {
        look(elements_of(piece));
      }
    }
  }
  return count;
}

void ContactRegion::make_ready(const Vector3& start, const Vector3& step) {
  const geometry::SegmentQuery path = relative_query(start, start + step, step.norm());
  for (std::size_t block = 0; block * FourBoxes::kCount < size_; ++block) {
    for (unsigned mask = boxes_[block].near_mask(path); mask != 0; mask &= mask - 1) {
      Piece& piece = pieces_[block * FourBoxes::kCount + unsigned(__builtin_ctz(mask))];
      if (piece.piece != kWhole) elements_of(piece);
    }
  }
}

SweepHit ContactRegion::sweep(const Vector3& start, const Vector3& step, std::span<const Element> ignored,
                              std::uint32_t ignored_object) {
  const auto is_ignored = [&](const Element& element) {
    return std::any_of(ignored.begin(), ignored.end(),
                       [&](const Element& contact) { return same_surface(contact, element); });
  };
  SweepHit first;
  AskedPieces asked_pieces;
  const auto ask = [&](const Element& element) {
    if (element.smooth()) {
      if (is_ignored(element) || asked_pieces.knows(element)) return;
      Element found = element;
      const auto t = smooth_sweep(found, start, step, tolerance_);
      if (!t || (first.met && *t >= first.t)) return;
      first = {*t, true, found};
    } else {
      const auto t = haptics::sweep(element, start, step, tolerance_);
      if (!t || (first.met && *t >= first.t) || is_ignored(element)) return;
      first = {*t, true, facing(element, start)};
    }
  };
  const auto ask_all = [&](std::span<const Element> elements) {
    looked_at_ += elements.size();
    for (const Element& element : elements) ask(element);
    return first.t;
  };
  // A long step is often stopped soon: pieces near its beginning are tested first, and then the rest up
  // to the place where it was stopped.
  const double margin = tolerance_.touching() + edge_dip(frame_.tip);
  double share = step.norm() > kLongStep * reach_ ? kFirstShare : 1.0;
  std::optional<geometry::SegmentQuery> asked;
  while (true) {
    const geometry::SegmentQuery path = relative_query(start, start + share * step, margin);
    for (std::size_t block = 0; block * FourBoxes::kCount < size_; ++block) {
      unsigned mask = boxes_[block].near_mask(path);
      if (asked && mask != 0) mask &= ~boxes_[block].near_mask(*asked);
      for (; mask != 0; mask &= mask - 1) {
        Piece& piece = pieces_[block * FourBoxes::kCount + unsigned(__builtin_ctz(mask))];
        if (piece.object == ignored_object) continue;
        if (piece.piece == kWhole) {
          sweep_whole(piece.object, start, step, frame_.tip + margin, ask_all);
        } else {
          ask_all(elements_of(piece));
        }
      }
    }
    if (share >= first.t) break;
    share = first.t;
    asked = path;
  }
  return first;
}

}  // namespace icome::haptics
