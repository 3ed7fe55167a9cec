#pragma once
#include <string>
#include <string_view>

namespace icome::devices {

/// Words that tell people which rule of udev permits them to use a device; `file`: a short name for it.
std::string udev_rule_advice(std::string_view file, std::string_view rule);

}  // namespace icome::devices
