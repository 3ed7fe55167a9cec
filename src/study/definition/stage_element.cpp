#include "study/definition/stage_element.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "interaction/elements/element_file.h"

namespace icome::study {

base::Result<StageElement> read_stage_element(const SceneElement& element,
                                              const std::filesystem::path& folder) {
  auto read = interaction::read_element_file(folder / element.file);
  if (!read) return tl::unexpected(read.error());
  if (read->place != interaction::ElementPlace::World)
    return base::fail(fmt::format("{}: an element of a study lies in its scene: write at = \"world\".",
                                  (folder / element.file).string()));
  if (read->choosing.by_look)
    return base::fail(fmt::format("{}: an element of a study is clicked or pushed: write by = \"both\".",
                                  (folder / element.file).string()));
  read->centre = element.centre.value_or(read->centre);
  read->turn = element.turn.value_or(read->turn);
  return StageElement{element.id, std::make_shared<const interaction::Element>(std::move(*read))};
}

std::vector<std::string> languages_lacking(const StageElement& element, const Study& study) {
  std::vector<std::string> lacking;
  const auto& has = element.element->languages;
  for (const std::string& language : study.languages)
    if (has.size() > 1 && std::ranges::find(has, language) == has.end()) lacking.push_back(language);
  return lacking;
}

bool is_in_vicinity(const interaction::ElementUse& use, const base::Vector3& place, double distance) {
  const interaction::ElementFrame& frame = use.frame();
  if (std::abs(frame.front_distance(place)) > distance) return false;
  const base::Vector2 on_plane = frame.projected(place);
  const base::Vector2 margin = base::Vector2::Constant(use.element().choosing.margin);
  return std::ranges::any_of(use.layout().sheets, [&](const interaction::LaidSheet& sheet) {
    return ((on_plane - sheet.centre).cwiseAbs().array() <= (sheet.half + margin).array()).all();
  });
}

}  // namespace icome::study
