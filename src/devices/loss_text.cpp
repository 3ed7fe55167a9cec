#include "devices/loss_text.h"

#include <fmt/format.h>

namespace icome::devices {

std::string loss_text(const std::string& name, const std::string& why) {
  if (why.empty())
    return fmt::format(
        "The device \"{}\" does not answer: see that it is plugged in and switched on. It is used again as "
        "soon as it answers.",
        name);
  return fmt::format("The device \"{}\" is lost: {}{} It is used again as soon as it answers.", name, why,
                     why.ends_with('.') ? "" : ".");
}

}  // namespace icome::devices
