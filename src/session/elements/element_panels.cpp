#include "session/elements/element_panels.h"

#include <algorithm>

namespace icome::session {
namespace {

using base::Vector2;
using base::Vector3;
using interaction::ElementFrame;
using interaction::ElementUse;
using interaction::LaidSheet;
using interaction::LaidWidget;
using Panel = render::SceneOverlay::Panel;

constexpr double kSeenPushes = 3.0;  // depths of a push: as deep in an element the hand is seen

bool is_daisy(const ElementUse& use) {
  return !use.layout().sheets.empty() && use.layout().sheets.front().sphere.has_value();
}

ElementPart part_of(charts::Image picture, std::size_t sheet, std::optional<std::size_t> tile = {}) {
  return {std::make_shared<const charts::Image>(std::move(picture)), sheet, tile};
}

/// Places in the sheet's plane and before it, m of the element, as they are in the world.
Vector3 in_world(const ElementFrame& frame, const Vector3& place) {
  return frame.in_world(place.head<2>()) + frame.size * place.z() * frame.normal();
}

/// The pose of a part in the frame of the element's plane, and half its width and height.
struct PartPlace {
  base::Pose pose = base::Pose::Identity();
  Vector2 half = Vector2::Zero();
};

PartPlace place_of(const ElementUse& use, const ElementPart& part) {
  const LaidSheet& sheet = use.layout().sheets[part.sheet];
  PartPlace place;
  if (part.tile) {
    const LaidWidget& laid = use.layout().widgets[*part.tile];
    return {sheet.sphere->tile_at(laid.centre, use.front()), laid.half};
  }
  if (sheet.sphere) {
    place.pose.translation().z() = -sheet.sphere->radius;
    place.half = half_of_ball(use);
    return place;
  }
  place.pose.translation().head<2>() = sheet.centre;
  place.half = sheet.half;
  return place;
}

/// Parts that are turned away are fainter.
Panel panel_at(const ElementUse& use, const ElementPart& part, const PartPlace& place) {
  const ElementFrame& frame = use.frame();
  const Vector3 middle = place.pose.translation();
  Panel panel;
  panel.picture = part.picture;
  panel.at = in_world(frame, middle);
  const Vector3 right = middle + place.half.x() * place.pose.linear().col(0);
  const Vector3 top = middle + place.half.y() * place.pose.linear().col(1);
  panel.lying = {Vector3(in_world(frame, right) - *panel.at), Vector3(in_world(frame, top) - *panel.at)};
  panel.alpha = use.opacity() * std::clamp(0.6 + 0.8 * place.pose.linear()(2, 2), 0.2, 1.0);
  constexpr double kOpaque = 0.9;
  if (panel.alpha > kOpaque)
    panel.hides_beyond = kSeenPushes * use.element().choosing.push_depth * frame.size;
  return panel;
}

}  // namespace

std::vector<ElementPart> draw_parts(const ElementUse& use, ElementTheme theme, double resolution) {
  std::vector<ElementPart> parts;
  const bool daisy = is_daisy(use);
  if (daisy) {
    parts.push_back(part_of(draw_ball(use, theme, resolution), 0));
    for (std::size_t i = 0; i < use.layout().widgets.size(); ++i)
      if (const LaidWidget& laid = use.layout().widgets[i]; laid.sheet == 0)
        parts.push_back(part_of(draw_tile(use, laid, theme, resolution), 0, i));
  }
  for (std::size_t i = daisy ? 1 : 0; i < use.layout().sheets.size(); ++i)
    parts.push_back(part_of(draw_sheet(use, i, theme, resolution), i));
  return parts;
}

std::vector<Panel> placed_parts(const ElementUse& use, const std::vector<ElementPart>& parts) {
  struct Placed {
    std::size_t sheet;
    double depth;  // m, before the element's plane
    Panel panel;
  };
  std::vector<Placed> placed;
  for (const ElementPart& part : parts) {
    const PartPlace place = place_of(use, part);
    if (place.pose.linear()(2, 2) <= 0.0)
      continue;  // seen from behind, its text would be the other way round
    placed.push_back({part.sheet, place.pose.translation().z(), panel_at(use, part, place)});
  }
  std::ranges::stable_sort(placed, [](const Placed& one, const Placed& other) {
    return std::pair(one.sheet, one.depth) < std::pair(other.sheet, other.depth);
  });
  std::vector<Panel> panels;
  for (Placed& it : placed) panels.push_back(std::move(it.panel));
  return panels;
}

std::vector<Panel> panels_of(const ElementUse& use, ElementTheme theme, double resolution) {
  return placed_parts(use, draw_parts(use, theme, resolution));
}

}  // namespace icome::session
