#pragma once
#include <limits>
#include <span>
#include <vector>

#include "geometry/tree/box_tree.h"
#include "haptics/shapes/element.h"

namespace icome::haptics {

/// The index that stands for no object.
constexpr std::uint32_t kNoObject = 0xffff'ffff;

/// Resting place of a tip that was moved by a sweep.
struct SweepHit {
  double t = 1.0;    // along the step, in [0, 1]
  bool met = false;  // did something hold it there?
  Element contact;   // the element that held it, facing the tip
};

class HapticScene;

/// The surroundings of the surface contact point: every element that a tip whose centre stays within `reach`
/// of the segment from `a` to `b` can meet. All in a frame with the world's axes and an origin near by: far
/// from the world's own, coordinates would have too few digits left. Gathered once, it answers all sweeps of
/// a tick, and of the next ticks while the SCP stays inside. Pieces of large shapes are only boxes at first
/// and become elements when a sweep comes near. Where there would be too many, meshes are kept whole, and
/// each sweep finds in their trees what is on its way. Takes its memory when constructed; everything else is
/// real-time safe.
class ContactRegion {
 public:
  static constexpr std::size_t kPieces = 4096;
  static constexpr std::size_t kElements = 8192;
  // As work() counts them: pieces gathered for an element tested, and for a piece of a whole mesh tested.
  static constexpr std::uint64_t kPiecesForAnElement = 4;
  static constexpr std::uint64_t kGatheredForTested = 3;

  ContactRegion();

  /// The frame, the tip and the time for which a region is gathered.
  struct Frame {
    Vector3 origin;      // m, origin of the region's frame in the world
    double tip = 0.0;    // m, the tip's radius
    double elapsed = 0;  // s after the moment of the scene's poses
  };
  /// Empties the region and sets what it will cover, with at most `limit` pieces. The caller keeps the scene
  /// alive.
  void start(const HapticScene& scene, const Frame& frame, const Vector3& a, const Vector3& b, double reach,
             std::size_t limit = kPieces);
  /// From start() on, takes shapes whole that can tell what a tip meets.
  void keep_whole() { keeps_whole_ = true; }
  bool keeps_whole() const { return keeps_whole_; }
  /// Notes that an object of this size (m, from its middle outwards) has pieces here.
  void hold(double size);
  /// Adds an element (in this frame); `bounds` encloses the surface that it stands for, which is nearer to
  /// the tip's centre than the tip's radius where it holds. False when there was no room.
  bool add(const Element& element, const Bounds& bounds);
  /// Adds a piece of an object that becomes elements later, by Shape::expand. False without room.
  bool defer(std::uint32_t object, std::uint32_t piece, const Bounds& bounds);
  /// Adds an object that Shape::sweep asks what a tip meets. False without room.
  bool defer_whole(std::uint32_t object);
  /// Forgets everything: covers nothing.
  void invalidate();

  /// Did more belong here than there is room for? Then sweeps may miss something: don't move.
  bool overflowed() const { return overflowed_; }
  std::size_t size() const { return size_; }

  /// Distance, m, that the tip may go from `position` in any direction without leaving; negative outside.
  double clearance(const Vector3& position) const;

  /// Share, in [0, 1], of a step from a position in the region that stays in it, or hardly less.
  double share_within(const Vector3& position, const Vector3& step) const;

  /// The first element that a tip moving from `start` by `step` comes to rest on, other than the
  /// surfaces of `ignored` and those of `ignored_object`. Both ends lie in the region.
  SweepHit sweep(const Vector3& start, const Vector3& step, std::span<const Element> ignored,
                 std::uint32_t ignored_object = kNoObject);

  /// Makes the elements now that a sweep from `start` by about `step` will look at.
  void make_ready(const Vector3& start, const Vector3& step);

  /// Fills `into` with the flat elements within `distance` of a position in the region, and all curved ones
  /// that may be, facing it, as far as they fit; returns their number, which may be larger.
  std::size_t around(const Vector3& position, double distance, std::span<Element> into);

  /// Elements that sweeps have tested so far, a quarter of the pieces that gathers have brought, and three
  /// quarters of the pieces of whole meshes that were tested: the cost of it all, as a number that replays
  /// repeat.
  std::uint64_t work() const { return looked_at_ + gathered_ / kPiecesForAnElement; }

  const Vector3& a() const { return a_; }
  const Vector3& b() const { return b_; }
  double reach() const { return reach_; }
  const Frame& frame() const { return frame_; }
  /// The tolerance of contact arithmetic here: it follows from the largest object that has pieces here,
  /// and from the digits that coordinates have.
  const Tolerance& tolerance() const { return tolerance_; }
  /// The size (m) of the smallest object that has pieces here; infinite without any.
  double smallest() const { return smallest_; }

 private:
  static constexpr std::uint32_t kWhole = 0xffff'ffff;  // stands for all pieces of an object
  static constexpr std::size_t kMade = 512;             // entries of made_
  static constexpr std::size_t kMadeElements = 2048;
  static constexpr std::size_t kMostOfPiece = 16;  // elements of a piece of a shape that is kept whole

  /// A box and the elements in it; none yet for a deferred piece.
  struct Piece {
    std::uint32_t object;
    std::uint32_t piece;
    std::uint32_t first;  // in elements_
    std::uint32_t count;
  };
  /// Where the elements of a piece of a whole object are, while `generation_` lasts.
  struct Made {
    std::uint64_t generation = 0;
    std::uint32_t object = kNoObject, piece = 0;
    std::uint32_t first = 0, count = 0;  // in made_elements_
  };

  bool take_box(const Bounds& bounds);
  std::span<const Element> elements_of(Piece& piece);
  std::span<const Element> elements_of_whole(std::uint32_t object, std::uint32_t piece);
  template <typename Ask>
  void sweep_whole(std::uint32_t object, const Vector3& start, const Vector3& step, double distance,
                   Ask&& ask);
  /// The query for all that a tip can meet while its centre stays within `reach` (m) of the segment.
  geometry::SegmentQuery relative_query(const Vector3& from, const Vector3& to, double reach) const;

  const HapticScene* scene_ = nullptr;
  Vector3 a_ = Vector3::Zero();
  Vector3 b_ = Vector3::Zero();
  Frame frame_ = {Vector3::Zero()};
  double reach_ = -1.0;  // m
  Tolerance tolerance_;
  double smallest_ = std::numeric_limits<double>::infinity();  // m
  bool overflowed_ = false;
  bool keeps_whole_ = false;
  std::size_t limit_ = kPieces;
  std::uint64_t looked_at_ = 0;
  std::uint64_t gathered_ = 0;
  std::size_t size_ = 0;  // pieces
  std::vector<Piece> pieces_;
  std::vector<geometry::FourBoxes> boxes_;  // of the pieces, relative to a_
  std::vector<Element> elements_;
  // What sweeps have made of whole objects: the same few pieces are asked again and again.
  std::uint64_t generation_ = 0;
  std::vector<Made> made_;  // by a hash of the piece
  std::vector<Element> made_elements_;
};

}  // namespace icome::haptics
