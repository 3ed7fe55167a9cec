#pragma once
// Did the surface contact point (SCP) come by a way that a tip can go? By search on a lattice.
#include <array>
#include <cstdint>
#include <queue>
#include <unordered_map>

#include "haptics/csg_brute.h"

namespace icome::haptics {

/// Where the straight way from `a` to `b` is in the solid: how deep at least.
template <typename Solid>
double brute_depth_between(const Solid& solid, const Vector3& a, const Vector3& b, double finest) {
  const double length = (b - a).norm();
  double deepest = 0.0;
  for (double t = 0.0;;) {
    const double here = solid.bound(a + (length > 0.0 ? t / length : 0.0) * (b - a));
    deepest = std::max(deepest, -here);
    if (t >= length) return deepest;
    t = std::min(length, t + std::max(std::abs(here), finest));
  }
}

enum class Way { Straight, Around, None, Unknown };

/// A search for a way through the free space that is nearer to the tip than the SCP was, or little farther:
/// an SCP that is pulled there never moves away from the tip.
template <typename Solid>
class BruteWay {
 public:
  BruteWay(const Solid& solid, const Vector3& from, const Vector3& to, const Vector3& tip)
      : solid_(solid),
        from_(from),
        to_(to),
        tip_(tip),
        farthest_((from - tip).norm() + 0.25 * (to - from).norm()) {}

  Way search(double cell, std::size_t most) {
    cell_ = cell;
    come_.clear();
    std::priority_queue<Open> open;
    std::size_t looked_at = 0;
    for (int i = 0; i < 729; ++i)
      reach(open, {i / 81 - 4, i / 9 % 9 - 4, i % 9 - 4}, from_);  // out of a nook
    for (; !open.empty(); ++looked_at) {
      if (looked_at > most) return Way::Unknown;
      const Key key = open.top().key;
      open.pop();
      const Vector3 here = place(key);
      if ((here - to_).norm() < 4.0 * cell_ && free(here, to_)) return Way::Around;
      for (const Key& next : around(key)) reach(open, next, here);
    }
    return looked_at > 1 ? Way::None : Way::Unknown;  // a nook narrower than the lattice
  }

 private:
  using Key = std::array<int, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      return std::size_t(key[0]) * 73856093u ^ std::size_t(key[1]) * 19349663u ^
             std::size_t(key[2]) * 83492791u;
    }
  };
  struct Open {
    double cost;
    Key key;
    bool operator<(const Open& other) const { return cost > other.cost; }
  };

  Vector3 place(const Key& key) const { return from_ + cell_ * Vector3(key[0], key[1], key[2]); }

  static std::array<Key, 26> around(const Key& key) {
    std::array<Key, 26> result;
    int count = 0;
    for (int i = 0; i < 27; ++i) {
      if (i != 13)
        result[std::size_t(count++)] = {key[0] + i / 9 - 1, key[1] + i / 3 % 3 - 1, key[2] + i % 3 - 1};
    }
    return result;
  }

  bool free(const Vector3& a, const Vector3& b) const {
    return brute_depth_between(solid_, a, b, 0.02 * cell_) <= 1e-4 * cell_;
  }

  void reach(std::priority_queue<Open>& open, const Key& key, const Vector3& before) {
    if (come_.count(key) != 0) return;
    const Vector3 there = place(key);
    if ((there - tip_).norm() > farthest_ || solid_.inside(there) || !free(before, there)) return;
    come_[key] = true;
    open.push({(there - to_).norm(), key});
  }

  const Solid& solid_;
  Vector3 from_, to_, tip_;
  double farthest_;
  double cell_ = 0.0;
  std::unordered_map<Key, bool, Hash> come_;
};

/// How the SCP can have come from `from` to `to` while the tip was pulled to `tip`. What is thinner than 1e-4
/// of `size` may be passed unseen.
template <typename Solid>
Way brute_way(const Solid& whole, const Vector3& from, const Vector3& to, const Vector3& tip, double size) {
  const double length = (to - from).norm();
  const Solid nearby = whole.near(0.5 * (from + to), 0.5 * length + 1e-3 * size);
  if (brute_depth_between(nearby, from, to, 1e-4 * size) <= 1e-8 * size) return Way::Straight;
  const Solid solid = whole.near(tip, (from - tip).norm() + 0.05 * size);
  Way way = Way::None;
  const double finest = std::min(length / 200.0, 5e-4 * size);
  for (double cell = std::max(length / 12.0, 1e-4 * size); way != Way::Around && cell > finest; cell *= 0.4)
    way = BruteWay(solid, from, to, tip).search(cell, 100'000);
  return way;
}

}  // namespace icome::haptics
