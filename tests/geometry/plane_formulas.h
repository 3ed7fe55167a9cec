#pragma once
// Random formulas of planes, and what they say a second time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/random.h"
#include "base/vector.h"

namespace icome::geometry {

struct PlaneFormula {
  std::string text;
  std::function<double(const base::Vector3&)> value;  // steepness 1 at most
};

/// Numbers that the text says to the last digit.
inline double short_number(base::Random& random, double most) {
  return std::round(1e4 * random.uniform(-most, most)) / 1e4;
}

/// The signed distance from a plane that passes within `far` of the origin.
inline PlaneFormula plane_formula(base::Random& random, double far) {
  const base::Vector3 normal = random.direction();
  const double offset = short_number(random, far);
  return {fmt::format("({}*x + {}*y + {}*z + {})", normal.x(), normal.y(), normal.z(), offset),
          [=](const base::Vector3& p) { return normal.dot(p) + offset; }};
}

/// Planes joined by min, max and abs at random, `depth` deep.
inline PlaneFormula random_plane_formula(base::Random& random, int depth, double far) {
  if (depth == 0) return plane_formula(random, far);
  const PlaneFormula a = random_plane_formula(random, depth - 1, far);
  switch (random.index(4)) {
    case 0: {
      const double width = std::abs(short_number(random, far));
      return {fmt::format("(abs({}) - {})", a.text, width),
              [=](const base::Vector3& p) { return std::abs(a.value(p)) - width; }};
    }
    case 1: {
      const PlaneFormula b = random_plane_formula(random, depth - 1, far);
      const double width = std::abs(short_number(random, far));
      return {fmt::format("(0.5*abs({}) + 0.5*abs({}) - {})", a.text, b.text, width),
              [=](const base::Vector3& p) {
                return 0.5 * std::abs(a.value(p)) + 0.5 * std::abs(b.value(p)) - width;
              }};
    }
    default: {
      const bool least = random.index(2) == 0;
      const PlaneFormula b = random_plane_formula(random, depth - 1, far);
      return {fmt::format("{}({}, {})", least ? "min" : "max", a.text, b.text), [=](const base::Vector3& p) {
                return least ? std::min(a.value(p), b.value(p)) : std::max(a.value(p), b.value(p));
              }};
    }
  }
}

}  // namespace icome::geometry
