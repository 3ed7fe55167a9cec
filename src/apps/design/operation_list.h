#pragma once
#include <string>

#include "base/result.h"

namespace icome::apps {

/// Every operation with its parameters, or only the one of that name, for people or as JSON. Fails where
/// there is none of that name.
base::Result<std::string> operation_list(const std::string& only, bool json);

}  // namespace icome::apps
