#pragma once
#include <span>
#include <string_view>

namespace icome::devices {

/// The profile (device_profiles.h) of devices that have this part in the name that they give themselves.
struct ModelProfile {
  std::string_view part;  // in lower case
  std::string_view profile;
};

/// The first entry that fits the name, upper or lower case alike; null without one.
const ModelProfile* find_model_profile(std::span<const ModelProfile> profiles, std::string_view model);

}  // namespace icome::devices
