#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "base/result.h"
#include "interaction/elements/element_use.h"
#include "study/definition/study.h"

namespace icome::study {

/// The haptic element of a scene, at its place on the stage and ready to be laid out.
struct StageElement {
  std::string id;                                       // as SceneElement::id
  std::shared_ptr<const interaction::Element> element;  // never null
};

/// Reads the element of a scene; `folder` is that of the study file. Fails as
/// interaction::read_element_file() does, and for an element that does not lie in the world.
base::Result<StageElement> read_stage_element(const SceneElement& element,
                                              const std::filesystem::path& folder);

/// The languages of the study that the element has no texts in; none where it has only one.
std::vector<std::string> languages_lacking(const StageElement& element, const Study& study);

/// Is a place in the vicinity of an element in use: is its distance to the plane at most `distance`
/// (m; equation 5.2), and does its projection (5.6, corrected) lie in a rectangle that is larger by the
/// element's margin than one of its sheets?
bool is_in_vicinity(const interaction::ElementUse& use, const base::Vector3& place, double distance);

}  // namespace icome::study
