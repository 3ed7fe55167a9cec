#pragma once
#include <string>

#include "apps/touch/touch_models.h"

namespace icome::apps {

/// Reads the MODEL of a file: a design, as every other command reads it, scaled as the options say. Each
/// object that has a shape is a body to touch, felt as what it is with its material's touch properties;
/// objects that cannot be touched, and repairs, are named among the model's sentences.
base::Result<TouchModel> load_design(const std::string& text, const TouchOptions& options);

}  // namespace icome::apps
