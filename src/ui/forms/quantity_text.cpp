#include "ui/forms/quantity_text.h"

#include <QRegularExpression>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace icome::ui {
namespace {

/// A unit that may be typed, and its size in the unit in which values are kept.
struct Typed {
  const char* name;
  double size;
};
constexpr double kDegree = std::numbers::pi / 180.0;
// The first of each is the shown unit.
constexpr Typed kLengths[] = {{"mm", 1e-3},     {"µm", 1e-6},   {"um", 1e-6},   {"cm", 1e-2},
                              {"dm", 1e-1},     {"m", 1.0},     {"km", 1e3},    {"in", 0.0254},
                              {"inch", 0.0254}, {"\"", 0.0254}, {"ft", 0.3048}, {"'", 0.3048}};
constexpr Typed kAngles[] = {{"°", kDegree}, {"deg", kDegree}, {"degrees", kDegree}, {"rad", 1.0}};
constexpr Typed kDegrees[] = {{"°", 1.0}, {"deg", 1.0}, {"degrees", 1.0}, {"rad", 1.0 / kDegree}};
constexpr Typed kStiffnesses[] = {{"N/m", 1.0}, {"N/mm", 1e3}, {"kN/m", 1e3}};
constexpr Typed kDampings[] = {{"N s/m", 1.0}, {"Ns/m", 1.0}, {"N·s/m", 1.0}};
constexpr Typed kForces[] = {{"N", 1.0}, {"mN", 1e-3}};
constexpr Typed kShares[] = {{"%", 1e-2}};
constexpr Typed kPlains[] = {{"", 1.0}};
constexpr Typed kPixels[] = {{"px", 1.0}};

std::span<const Typed> units_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::Length:
      return kLengths;
    case Quantity::Angle:
      return kAngles;
    case Quantity::Stiffness:
      return kStiffnesses;
    case Quantity::Damping:
      return kDampings;
    case Quantity::Force:
      return kForces;
    case Quantity::Share:
      return kShares;
    case Quantity::Degrees:
      return kDegrees;
    case Quantity::Pixels:
      return kPixels;
    case Quantity::Whole:
    case Quantity::Plain:
      break;
  }
  return kPlains;
}

std::string hint(Quantity quantity) {
  switch (quantity) {
    case Quantity::Length:
      return "Type a length such as 12.5, 3 cm or 0.2 m; a number alone is in mm.";
    case Quantity::Angle:
    case Quantity::Degrees:
      return "Type an angle such as 45 or 0.5 rad; a number alone is in degrees.";
    case Quantity::Stiffness:
      return "Type a stiffness such as 800 or 0.8 N/mm; a number alone is in N/m.";
    case Quantity::Damping:
      return "Type a damping such as 2.5; it is in N s/m.";
    case Quantity::Force:
      return "Type a force such as 0.5; it is in N.";
    case Quantity::Share:
      return "Type a share such as 40; it is in percent.";
    case Quantity::Pixels:
      return "Type a length such as 120; it is in px.";
    case Quantity::Whole:
      return "Type a whole number such as 3.";
    case Quantity::Plain:
      break;
  }
  return "Type a number such as 0.5.";
}

}  // namespace

base::Result<double> read_quantity(const QString& text, Quantity quantity) {
  static const QRegularExpression kNumber(R"(^([+\-−]?(?:\d+[.,]?\d*|[.,]\d+)(?:[eE][+\-]?\d+)?)\s*(.*)$)");
  const QRegularExpressionMatch match = kNumber.match(text.simplified());
  if (!match.hasMatch()) return base::fail(hint(quantity));
  bool good = false;
  const double number = match.captured(1).replace(',', '.').replace(QChar(0x2212), '-').toDouble(&good);
  const QString unit = match.captured(2);
  const std::span<const Typed> units = units_of(quantity);
  const auto found =
      unit.isEmpty() ? units.begin() : std::find_if(units.begin(), units.end(), [&](const Typed& it) {
        return unit.compare(QString::fromUtf8(it.name), Qt::CaseInsensitive) == 0;
      });
  if (!good || found == units.end()) return base::fail(hint(quantity));
  const double value = number * found->size;
  constexpr double kMost = 1e9;  // SI; nothing that anybody touches is larger
  if (!std::isfinite(value) || std::abs(value) > kMost)
    return base::fail("That is too large. " + hint(quantity));
  if (quantity == Quantity::Whole && value != std::round(value)) return base::fail(hint(quantity));
  return value;
}

QString number_text(double value, Quantity quantity, int most_decimals) {
  const double shown = value / units_of(quantity).front().size;
  if (!std::isfinite(shown)) return QString::number(shown);
  const double size = std::abs(shown);
  if (size < 1e-9) return "0";
  if (size >= 1e12) return QString::number(shown, 'g', 6);
  const int decimals = std::clamp(5 - int(std::floor(std::log10(size))), 0, most_decimals);
  QString text = QString::number(shown, 'f', decimals);
  if (text.contains('.')) {
    while (text.endsWith('0')) text.chop(1);
    if (text.endsWith('.')) text.chop(1);
  }
  return text == "-0" ? "0" : text;
}

QString unit_of(Quantity quantity) { return QString::fromUtf8(units_of(quantity).front().name); }

double step_of(Quantity quantity) {
  const double unit = units_of(quantity).front().size;
  switch (quantity) {
    case Quantity::Stiffness:
      return 10.0 * unit;
    case Quantity::Force:
      return 0.1;
    case Quantity::Plain:
      return 0.01;
    default:
      return unit;
  }
}

}  // namespace icome::ui
