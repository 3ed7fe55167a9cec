#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "collab/protocol/message.h"
#include "interaction/navigation.h"
#include "render/scene/scene_renderer.h"

namespace icome::session {

/// Somebody else at work in the same design, as seen in the scene.
struct PersonMark {
  charts::Colour colour = {};
  std::shared_ptr<const charts::Image> sign = nullptr;  // with the name; null: none yet
  collab::Whereabouts where = {};
  bool is_eye_seen = true;  // not that of somebody whose view one follows
};

/// The marks of people: a ball at each pointer, a pyramid that looks where the person does, and names beside
/// them. Of one size on the screen, whatever the distance.
render::SceneOverlay people_marks(const std::vector<PersonMark>& people, const interaction::View& view);

/// 0xRRGGBB.
charts::Colour colour_of(std::uint32_t code);

}  // namespace icome::session
