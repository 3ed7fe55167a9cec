#pragma once
#include <string>

#include "apps/serving/serving_options.h"
#include "base/result.h"

namespace icome::apps {

/// A link to the design that the options name; makes the design where there is none and the role is "own".
base::Result<std::string> invitation_link(const ServingOptions& options);

/// Runs `icome invite`: prints a link, and nothing else on standard output. Returns the exit code.
int run_invite(const ServingOptions& options);

/// Runs `icome revoke`. Returns the exit code.
int run_revoke(const ServingOptions& options);

}  // namespace icome::apps
