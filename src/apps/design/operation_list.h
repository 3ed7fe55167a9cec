#pragma once
#include <span>
#include <string>

#include "base/result.h"
#include "interaction/operations/operation.h"

namespace icome::apps {

/// Operations with their parameters, or only the one of that name, for people or as JSON, where they are
/// called `what`: "operation". Fails where there is none of that name.
base::Result<std::string> operation_list(std::span<const interaction::Operation* const> operations,
                                         const std::string& what, const std::string& only, bool json);

}  // namespace icome::apps
