#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::study {

/// The templates that `icome study new` can begin with: "blank", "head-tracking", "menu".
std::vector<std::string> template_names();

/// The study file of a template, with `name` as the study's name if that is an id. Fails if there is no such
/// template.
base::Result<std::string> study_template(std::string_view template_name, const std::string& name);

/// A design that a template's trials take place in, or an element of one.
struct TemplateScene {
  std::string file;  // "scenes/room-1.wrl", beside the study file
  std::string_view text;
};

/// The scenes of a template; none if there is no such template.
std::vector<TemplateScene> template_scenes(std::string_view template_name);

}  // namespace icome::study
