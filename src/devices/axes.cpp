#include "devices/axes.h"

#include <fmt/format.h>

namespace icome::devices {

base::Result<base::Matrix3> rotation_from_axes(std::string_view axes) {
  base::Matrix3 rotation = base::Matrix3::Zero();
  int row = 0;
  for (std::string_view rest = axes; !rest.empty(); ++row) {
    if (row > 0 && rest.front() == ',') rest.remove_prefix(1);
    const bool against = rest.starts_with('-');
    if (against || rest.starts_with('+')) rest.remove_prefix(1);
    if (row == 3 || rest.empty() || rest.front() < 'x' || rest.front() > 'z') {
      row = 0;
      break;
    }
    rotation(row, rest.front() - 'x') = against ? -1.0 : 1.0;
    rest.remove_prefix(1);
  }
  const double volume = row == 3 ? rotation.determinant() : 0.0;
  if (volume > 0.5) return rotation;
  return base::fail(
      fmt::format("\"{}\" {}; give the device's axes that point right, up and to the user, such as y,z,x",
                  axes, volume < -0.5 ? "would mirror left and right" : "does not name three axes"));
}

std::string axes_text(const base::Matrix3& ours_from_device) {
  std::string text;
  for (int row = 0; row < 3; ++row) {
    int axis = 0;
    ours_from_device.row(row).cwiseAbs().maxCoeff(&axis);
    text +=
        fmt::format("{}{}{}", row > 0 ? "," : "", ours_from_device(row, axis) < 0.0 ? "-" : "", "xyz"[axis]);
  }
  return text;
}

}  // namespace icome::devices
