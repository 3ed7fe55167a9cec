#pragma once
#include <QString>

#include "base/result.h"

namespace icome::ui {

/// The quantity that a number stands for, and so the units that people see and may type. Values are SI.
enum class Quantity : std::uint8_t {
  Length,     // shown in mm
  Angle,      // shown in degrees
  Stiffness,  // N/m
  Damping,    // N s/m
  Force,      // N
  Share,      // of 1, shown in percent
  Degrees,    // an angle that is kept in degrees, so that quarter turns stay exact
  Pixels,     // px
  Whole,      // a whole number
  Plain,
};

/// Reads what a person typed: "3", "3 cm", "0.2m", "1,5 in", "0.5 rad". Without a unit the shown unit is
/// meant. Fails with a hint on valid text for anything else, and for numbers beyond 1e9 (SI).
base::Result<double> read_quantity(const QString& text, Quantity quantity);

/// The number in the shown unit, without the unit: to six figures and at most `most_decimals` decimals.
QString number_text(double value, Quantity quantity, int most_decimals = 9);

/// The shown unit: "mm"; empty for plain numbers.
QString unit_of(Quantity quantity);

/// The change by one step of the arrow keys: one shown unit; 10 N/m, 0.1 N and 0.01 of a plain number.
double step_of(Quantity quantity);

}  // namespace icome::ui
