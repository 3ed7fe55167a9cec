#pragma once
#include "interaction/operations/value.h"
#include "io/toml_tree.h"

namespace icome::interaction {

/// The value of a parameter as a TOML file says it.
Value value_from_toml(const io::TomlNode& node);

}  // namespace icome::interaction
