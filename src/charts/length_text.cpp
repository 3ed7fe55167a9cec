#include "charts/length_text.h"

#include <fmt/format.h>

#include <cmath>

namespace icome::charts {

double nice_length_below(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  // A hair of slack: 0.2 / 0.1 must not count as less than 2.
  const double ratio = length / power * (1.0 + 1e-12);
  return power * (ratio >= 5.0 ? 5.0 : ratio >= 2.0 ? 2.0 : 1.0);
}

std::string length_text(double metres) {
  struct Unit {
    double metres;
    const char* name;
  };
  constexpr Unit kUnits[] = {{1e3, "km"}, {1.0, "m"}, {1e-3, "mm"}, {1e-6, "\u00b5m"}, {1e-9, "nm"}};
  for (const Unit& unit : kUnits) {
    if (metres >= unit.metres * (1.0 - 1e-9))
      return fmt::format("{:.4g} {}", metres / unit.metres, unit.name);
  }
  return fmt::format("{:.3g} m", metres);
}

std::string grouped(std::size_t number) {
  const std::string digits = std::to_string(number);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

}  // namespace icome::charts
