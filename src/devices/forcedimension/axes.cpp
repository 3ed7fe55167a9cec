#include "devices/forcedimension/axes.h"

#include <fmt/format.h>

namespace icome::devices {

base::Result<base::Matrix3> rotation_from_axes(std::string_view axes) {
  base::Matrix3 rotation = base::Matrix3::Zero();
  int row = 0;
  double sign = 1.0;
  for (const char letter : axes) {
    if (letter == '+' || letter == '-') {
      sign = letter == '-' ? -1.0 : 1.0;
      continue;
    }
    if (letter < 'x' || letter > 'z' || row == 3) {
      row = 0;
      break;
    }
    rotation(row++, letter - 'x') = sign;
    sign = 1.0;
  }
  const double volume = row == 3 ? rotation.determinant() : 0.0;
  if (volume > 0.5) return rotation;
  return base::fail(fmt::format(
      "\"{}\" {}; give the device's axes that point right, up and to the user, such as yzx or y-xz", axes,
      volume < -0.5 ? "would mirror left and right" : "does not name three axes"));
}

}  // namespace icome::devices
