#include "study/definition/templates.h"

#include <fmt/format.h>

#include <array>

#include "base/near_names.h"
#include "io/key_reader.h"
#include "study/study_texts.h"

namespace icome::study {
namespace {

struct StudyTemplate {
  std::string_view name;
  std::string_view text;
};

constexpr std::array kTemplates = {
    StudyTemplate{"blank", kBlankStudy},
    StudyTemplate{"head-tracking", kHeadTrackingStudy},
    StudyTemplate{"menu", kMenuSelectionStudy},
};

/// The text with the first value of `name = "..."` replaced.
std::string renamed(std::string_view text, const std::string& name) {
  constexpr std::string_view kBefore = "\nname = \"";
  const std::size_t begin = text.find(kBefore) + kBefore.size();
  const std::size_t end = text.find('"', begin);
  return std::string(text.substr(0, begin)).append(name).append(text.substr(end));
}

}  // namespace

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const StudyTemplate& study : kTemplates) names.emplace_back(study.name);
  return names;
}

base::Result<std::string> study_template(std::string_view template_name, const std::string& name) {
  for (const StudyTemplate& study : kTemplates)
    if (study.name == template_name)
      return io::is_id(name) ? renamed(study.text, name) : std::string(study.text);
  return base::fail(fmt::format("there is no template '{}'{}", template_name,
                                base::suggestion(template_name, template_names())));
}

std::vector<TemplateScene> template_scenes(std::string_view template_name) {
  if (template_name == "blank") return {{"scenes/pointing-room.wrl", kPointingRoom}};
  if (template_name == "menu")
    return {{"scenes/menu-room.wrl", kMenuRoom}, {"scenes/colour-menu.toml", kColourMenu}};
  if (template_name != "head-tracking") return {};
  return {{"scenes/practice-room.wrl", kPracticeRoom},
          {"scenes/room-1.wrl", kRoom1},
          {"scenes/room-2.wrl", kRoom2},
          {"scenes/room-3.wrl", kRoom3},
          {"scenes/room-4.wrl", kRoom4}};
}

}  // namespace icome::study
