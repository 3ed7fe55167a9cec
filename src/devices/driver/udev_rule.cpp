#include "devices/driver/udev_rule.h"

#include <fmt/format.h>

namespace icome::devices {

std::string udev_rule_advice(std::string_view file, std::string_view rule) {
  // The number comes before that of the rules by which systemd deals with the tag.
  return fmt::format(
      "put this udev rule into /etc/udev/rules.d/70-icome-{}.rules and plug the device in again: {}, "
      "TAG+=\"uaccess\"",
      file, rule);
}

}  // namespace icome::devices
