#include "speech/dialogue/amounts.h"

#include <fmt/format.h>

#include <cmath>

#include "base/parse_number.h"

namespace icome::speech {

double length_of(const Phrase& phrase) {
  const Phrase* const number = phrase.part("number");
  const Phrase* const unit = phrase.part("unit") ? phrase.part("unit") : phrase.part("units");
  const double metres = unit ? base::parse_number<double>(unit->tag()).value_or(0.0) : 0.0;
  double count = number ? number_of(*number) : 0.0;
  if (phrase.has("one")) count = 1.0;
  if (phrase.has("half")) count += 0.5;
  return count * metres;
}

double angle_of(const Phrase& phrase) {
  if (const Phrase* number = phrase.part("number")) return number_of(*number);
  return base::parse_number<double>(phrase.tag()).value_or(0.0);
}

Vector3 direction_of(const Phrase& phrase, const ViewerAxes& axes) {
  if (phrase.has("left")) return -axes.right;
  if (phrase.has("right")) return axes.right;
  if (phrase.has("up")) return axes.up;
  if (phrase.has("down")) return -axes.up;
  return phrase.has("near") ? axes.towards : Vector3(-axes.towards);
}

std::string length_words(double metres) {
  constexpr double kCentimetre = 0.01, kMillimetre = 0.001;
  if (std::abs(metres) >= 1.0) return fmt::format("{:.3g} m", metres);
  if (std::abs(metres) >= kCentimetre) return fmt::format("{:.3g} cm", metres / kCentimetre);
  return fmt::format("{:.3g} mm", metres / kMillimetre);
}

}  // namespace icome::speech
