#pragma once
#include <optional>

#include "base/vector.h"

namespace icome::sketch {

/// A pressure for what feels none, by speed: a slow hand draws a wide line, a fast one a thin line, with no
/// sudden change. One for each stroke.
class MousePressure {
 public:
  /// The pressure (0 to 1) at a place (m, as far as the hand went) and time (s). Times that do not go on
  /// leave it as it is.
  double at(double time, const base::Vector2& place);

 private:
  struct Before {
    double time;
    base::Vector2 place;
  };
  std::optional<Before> before_;
  double pressure_ = 0.3;  // lines begin thin
};

}  // namespace icome::sketch
