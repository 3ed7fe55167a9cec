#pragma once
#include <string>

#include "apps/touch_models.h"

namespace icome::apps {

// MODELs that are designs: worlds of objects, of which each that has a shape is a body to touch.

/// Does the MODEL name a file of a design (.wrl, .vrml, .gltf, .glb, .icome)?
bool names_design(const std::string& text);

/// Reads a design, turned and scaled as the options say. Every object is felt as what it is, with its
/// material's touch properties; what cannot be touched is told among the model's sentences.
base::Result<TouchModel> load_design(const std::string& text, const TouchOptions& options);

}  // namespace icome::apps
