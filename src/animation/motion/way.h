#pragma once
#include <limits>
#include <span>
#include <vector>

#include "base/vector.h"

namespace icome::animation {

using base::Vector2;

/// A line of straight pieces by the length along it (`s`, px), and how a bead slides on it.
class Way {
 public:
  /// Places that repeat the one before count once. Of none at all: the way is_empty().
  Way(std::span<const Vector2> places, bool closed);

  bool is_empty() const { return places_.empty(); }
  double length() const { return along_.back(); }
  bool is_closed() const { return closed_; }

  Vector2 at(double s) const;
  /// Direction of the piece at `s`, of length 1; (1, 0) of a single place.
  Vector2 direction(double s) const;

  /// The place of all that is nearest to `place`. Among those as near within `tie` px, the one that runs most
  /// along `heading`, to and fro alike, where a heading is given.
  double nearest(const Vector2& place, const Vector2& heading = Vector2::Zero(), double tie = 0) const;

  /// A bead at `s` slides towards `hand` as long as each step brings it nearer: it comes to the next place
  /// that is the nearest one near by, and never jumps to a piece that lies close but is far along the way.
  double slid(double s, const Vector2& hand) const;
  /// As slid(), within one frame: where little pulls along the way (the hand is at the centre of a bend) the
  /// bead goes by little, kPull times the pull, and more at corners. Round a sharp corner it follows a hand
  /// that is past it: to a place twice as near, kRound times as far along the way as the hand is from it.
  double slid_in_a_frame(double s, const Vector2& hand) const;
  static constexpr double kPull = 4;
  static constexpr double kRound = 2.5;

  /// The angle of the way, rad, counter-clockwise as seen with y down, the mean over kCorner px (an eighth of
  /// a short way's length) about `s`, so that it turns evenly at corners. It counts full turns: from one end
  /// to the other it has no jump; of a closed way it changes by full turns where the way begins.
  double angle(double s) const;
  static constexpr double kCorner = 40;

  /// `s` of a closed way within [0, length()), of an open one no further than its ends.
  double within(double s) const;
  /// The way from one place to another, the shorter one round where it is closed; below 0: backwards.
  double between(double from, double to) const;

 private:
  std::size_t pieces() const { return along_.size() - 1; }
  std::size_t piece_at(double s) const;
  Vector2 corner(std::size_t number) const { return places_[number % places_.size()]; }
  double slide(double s, const Vector2& hand, bool limited) const;
  double nearest_within(double s, double far, const Vector2& place) const;
  double turned_until(double s) const;  // the integral of the angle from 0 to s

  bool closed_;
  std::vector<Vector2> places_;
  std::vector<double> along_ = {0};     // of each corner, and of the first one again where closed
  std::vector<Vector2> directions_;     // of each piece
  std::vector<double> angles_;          // of each piece, full turns counted
  std::vector<double> integral_ = {0};  // of the angle, at each corner
  double turn_ = 0;                     // of a closed way, once round
};

}  // namespace icome::animation
