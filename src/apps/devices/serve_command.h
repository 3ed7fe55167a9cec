#pragma once
#include <string>

#include "apps/devices/devices_options.h"

namespace icome::apps {

/// The fault of the text of --vrpn; empty: it names a place.
std::string names_place(const std::string& text);

/// Runs `icome devices serve` until it is asked to end. Returns the program's exit code.
int run_serve(const DevicesOptions& options);

}  // namespace icome::apps
