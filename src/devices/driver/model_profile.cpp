#include "devices/driver/model_profile.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace icome::devices {

const ModelProfile* find_model_profile(std::span<const ModelProfile> profiles, std::string_view model) {
  std::string in_lower_case(model);
  std::transform(in_lower_case.begin(), in_lower_case.end(), in_lower_case.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const auto found = std::find_if(profiles.begin(), profiles.end(), [&](const ModelProfile& each) {
    return in_lower_case.find(each.part) != std::string::npos;
  });
  return found != profiles.end() ? &*found : nullptr;
}

}  // namespace icome::devices
