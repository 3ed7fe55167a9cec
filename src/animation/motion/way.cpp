#include "animation/motion/way.h"

#include <algorithm>
#include <cmath>

#include "animation/motion/cell_point.h"

namespace icome::animation {
namespace {

constexpr double kOnePlace = 1e-9;  // px, within which places are one

/// The bead on a way while it slides.
struct Bead {
  std::size_t piece;
  double ahead;  // px from the piece's beginning
};

}  // namespace

Way::Way(std::span<const Vector2> places, bool closed) : closed_(closed) {
  for (const Vector2& place : places)
    if (places_.empty() || (place - places_.back()).norm() > kOnePlace) places_.push_back(place);
  while (closed_ && places_.size() > 1 && (places_.back() - places_.front()).norm() <= kOnePlace)
    places_.pop_back();
  if (places_.size() < 2) closed_ = false;
  const std::size_t count = places_.empty() ? 0 : places_.size() - (closed_ ? 0 : 1);
  for (std::size_t k = 0; k < count; ++k) {
    const Vector2 piece = corner(k + 1) - corner(k);
    const double length = piece.norm();
    directions_.push_back(piece / length);
    const double angle = angle_of(piece);
    angles_.push_back(k == 0 ? angle : unwrapped(angle, angles_.back()));
    along_.push_back(along_.back() + length);
    integral_.push_back(integral_.back() + angles_.back() * length);
  }
  if (closed_) turn_ = unwrapped(angles_.front(), angles_.back()) - angles_.front();
}

double Way::within(double s) const {
  if (!closed_) return std::clamp(s, 0.0, length());
  const double rest = s - length() * std::floor(s / length());
  return rest < length() ? rest : 0;
}

double Way::between(double from, double to) const {
  return closed_ ? std::remainder(to - from, length()) : to - from;
}

std::size_t Way::piece_at(double s) const {
  const auto next = std::upper_bound(along_.begin() + 1, along_.end() - 1, s);
  return std::size_t(next - along_.begin()) - 1;
}

Vector2 Way::at(double s) const {
  if (pieces() == 0) return places_.front();
  s = within(s);
  const std::size_t piece = piece_at(s);
  return corner(piece) + (s - along_[piece]) * directions_[piece];
}

Vector2 Way::direction(double s) const {
  return pieces() == 0 ? Vector2(1, 0) : directions_[piece_at(within(s))];
}

double Way::nearest(const Vector2& place, const Vector2& heading, double tie) const {
  double least = std::numeric_limits<double>::infinity();
  const auto foot_on = [&](std::size_t k) {
    return std::clamp(directions_[k].dot(place - corner(k)), 0.0, along_[k + 1] - along_[k]);
  };
  const auto distance_to = [&](std::size_t k, double foot) {
    return (corner(k) + foot * directions_[k] - place).norm();
  };
  double found = 0;
  for (std::size_t k = 0; k < pieces(); ++k) {
    const double foot = foot_on(k), distance = distance_to(k, foot);
    if (distance < least) {
      least = distance;
      found = along_[k] + foot;
    }
  }
  if (heading.isZero() || tie <= 0) return within(found);
  double most = -1;
  for (std::size_t k = 0; k < pieces(); ++k) {
    const double foot = foot_on(k);
    const double agreement = std::abs(directions_[k].dot(heading));
    if (agreement <= most || distance_to(k, foot) > least + tie) continue;
    most = agreement;
    found = along_[k] + foot;
  }
  return within(found);
}

double Way::slid(double s, const Vector2& hand) const { return slide(s, hand, false); }

double Way::slid_in_a_frame(double s, const Vector2& hand) const {
  if (pieces() == 0) return 0;
  const double slides_to = slide(s, hand, true);
  const double left = (at(slides_to) - hand).norm();
  if (left < kOnePlace) return slides_to;
  const double near = nearest_within(s, kRound * (at(s) - hand).norm(), hand);
  return (at(near) - hand).norm() < left / 2 ? near : slides_to;
}

double Way::nearest_within(double s, double far, const Vector2& place) const {
  s = within(s);
  double least = (at(s) - place).norm(), found = s;
  const std::size_t first = piece_at(s);
  for (const bool forwards : {true, false}) {
    std::size_t piece = first;
    double travelled = 0, begin = s - along_[first];
    for (std::size_t k = 0; k < pieces() && travelled < far; ++k) {
      const double length = along_[piece + 1] - along_[piece];
      const double end =
          forwards ? std::min(length, begin + far - travelled) : std::max(0.0, begin - (far - travelled));
      const double foot = std::clamp(directions_[piece].dot(place - corner(piece)), std::min(begin, end),
                                     std::max(begin, end));
      const double distance = (corner(piece) + foot * directions_[piece] - place).norm();
      if (distance < least) {
        least = distance;
        found = along_[piece] + foot;
      }
      travelled += std::abs(end - begin);
      if (!closed_ && piece == (forwards ? pieces() - 1 : 0)) break;
      piece = (piece + (forwards ? 1 : pieces() - 1)) % pieces();
      begin = forwards ? 0 : along_[piece + 1] - along_[piece];
    }
  }
  return within(found);
}

double Way::slide(double s, const Vector2& hand, bool limited) const {
  if (pieces() == 0) return 0;
  s = within(s);
  Bead bead = {piece_at(s), 0};
  bead.ahead = s - along_[bead.piece];
  const auto length_of = [&](std::size_t k) { return along_[k + 1] - along_[k]; };
  const auto pull = [&] { return directions_[bead.piece].dot(hand - corner(bead.piece)) - bead.ahead; };
  const auto step_over = [&](bool forwards) {
    if (forwards) {
      if (!closed_ && bead.piece + 1 == pieces()) return false;
      bead = {(bead.piece + 1) % pieces(), 0};
    } else {
      if (!closed_ && bead.piece == 0) return false;
      bead.piece = (bead.piece + pieces() - 1) % pieces();
      bead.ahead = length_of(bead.piece);
    }
    return true;
  };
  // At a corner the piece before may pull more.
  double strength = pull();
  if (bead.ahead == 0) {
    const Bead here = bead;
    if (step_over(false)) {
      const double back = pull();
      if (back < 0 && -back > std::max(strength, 0.0)) {
        strength = back;
      } else {
        bead = here;
      }
    }
  }
  const bool forwards = strength > 0;
  const double sign = forwards ? 1 : -1;
  double travelled = 0;
  double allowed = limited ? kPull * std::abs(strength) : std::numeric_limits<double>::infinity();
  for (std::size_t crossed = 0; crossed <= pieces(); ++crossed) {
    const double wanted = sign * pull();
    if (wanted <= 0) break;
    const double room = forwards ? length_of(bead.piece) - bead.ahead : bead.ahead;
    const double step = std::min({wanted, room, allowed - travelled});
    bead.ahead += sign * step;
    travelled += step;
    if (step < room) break;
    const Vector2 came = directions_[bead.piece];
    const Bead here = bead;
    if (!step_over(forwards)) break;
    if (sign * pull() <= 0) {
      bead = here;
      break;
    }
    const double bend = std::clamp(1 - came.dot(directions_[bead.piece]), 0.0, 1.0);
    if (limited) allowed = std::max(allowed, travelled + bend * sign * pull());
  }
  return within(std::clamp(along_[bead.piece] + bead.ahead, 0.0, length()));
}

double Way::turned_until(double s) const {
  if (!closed_) {
    if (s <= 0) return s * angles_.front();
    if (s >= length()) return integral_.back() + (s - length()) * angles_.back();
    const std::size_t piece = piece_at(s);
    return integral_[piece] + (s - along_[piece]) * angles_[piece];
  }
  const double rounds = std::floor(s / length());
  const double rest = std::clamp(s - rounds * length(), 0.0, length());
  const std::size_t piece = piece_at(rest);
  return rounds * integral_.back() + turn_ * length() * rounds * (rounds - 1) / 2 + rounds * turn_ * rest +
         integral_[piece] + (rest - along_[piece]) * angles_[piece];
}

double Way::angle(double s) const {
  if (pieces() == 0) return 0;
  s = within(s);
  const double half = std::min(kCorner / 2, length() / 16);
  return (turned_until(s + half) - turned_until(s - half)) / (2 * half);
}

}  // namespace icome::animation
