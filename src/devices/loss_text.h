#pragma once
#include <string>

namespace icome::devices {

/// Sentences for people about a device that is lost, named `name`; `why` is its PointerDevice::condition().
std::string loss_text(const std::string& name, const std::string& why);

}  // namespace icome::devices
