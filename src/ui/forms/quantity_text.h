#pragma once
#include <QString>

#include "base/result.h"

namespace icome::ui {

/// What a number means, and so which unit people see and may type. Values are SI.
enum class Quantity : std::uint8_t {
  Length,     // shown in mm
  Angle,      // shown in degrees
  Stiffness,  // N/m
  Damping,    // N s/m
  Force,      // N
  Share,      // of 1, shown in percent
  Degrees,    // an angle that is kept in degrees, so that quarter turns stay exact
  Whole,      // a whole number
  Plain,
};

/// What a person typed: "3", "3 cm", "0.2m", "1,5 in", "0.5 rad". Without a unit it is the one that is shown.
/// Fails, saying what is understood, for anything else and for numbers beyond all use.
base::Result<double> read_quantity(const QString& text, Quantity quantity);

/// The number in the shown unit, to six figures and no more decimals than that, without the unit.
QString number_text(double value, Quantity quantity, int most_decimals = 9);

/// The shown unit: "mm"; empty for plain numbers.
QString unit_of(Quantity quantity);

/// What one step of the arrow keys changes: one of the shown unit, or a hundredth for plain numbers.
double step_of(Quantity quantity);

}  // namespace icome::ui
