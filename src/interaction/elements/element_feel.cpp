#include "interaction/elements/element_feel.h"

#include <algorithm>

namespace icome::interaction {
namespace {

constexpr double kLeastPush = 0.0003;  // m, below a floor that is nearly as deep as a push

haptics::PanelTarget target_of(const Element& element, const LaidWidget& laid, const LaidSheet& sheet) {
  const Widget& widget = *laid.widget;
  const WidgetFeel& feel = widget.feel;
  haptics::PanelTarget target;
  target.centre = laid.centre - sheet.centre;
  target.half = laid.half;
  if (!widget.enabled) return target;  // plain ground
  target.well = feel.well;
  target.recess = feel.recess;
  target.ridge = feel.ridge;
  target.rings = feel.rings;
  target.ring_spacing = feel.ring_spacing;
  target.friction = feel.friction;
  target.detent = element.choosing.by_push ? element.choosing.detent : 0.0;
  // A push counts from the plane, which lies above the floor of a recess.
  target.push_depth = std::max(element.choosing.push_depth - feel.recess, kLeastPush);
  return target;
}

haptics::PanelSettings panel_of(const Element& element, const LaidSheet& sheet) {
  haptics::PanelSettings panel = ground_of(element);
  panel.half = sheet.half;
  if (element.ground.border != 0.0) {
    haptics::PanelTarget border;
    border.half = sheet.half;
    border.ridge = element.ground.border;
    panel.targets.push_back(border);
  }
  return panel;
}

}  // namespace

base::Pose world_from_sheet(const ElementFrame& frame, const LaidSheet& sheet) {
  base::Pose pose = frame.world_from_element();
  pose.translation() = frame.in_world(sheet.centre);
  return pose;
}

haptics::PanelSettings ground_of(const Element& element) {
  haptics::PanelSettings panel;
  panel.stiffness = element.ground.stiffness;
  panel.most_force = element.ground.most_force;
  panel.friction = element.ground.friction;
  panel.sides = element.ground.both_sides ? haptics::TouchableSides::Both : haptics::TouchableSides::Front;
  return panel;
}

std::vector<FeltSheet> feel_of(const Element& element, const ElementLayout& layout,
                               const ElementFrame& frame) {
  std::vector<FeltSheet> felt;
  for (const LaidSheet& sheet : layout.sheets) {
    felt.push_back({world_from_sheet(frame, sheet), panel_of(element, sheet)});
    felt.back().panel.size = frame.size;
  }
  for (const LaidWidget& laid : layout.widgets)
    if (laid.widget->can_be_chosen())
      felt[laid.sheet].panel.targets.push_back(target_of(element, laid, layout.sheets[laid.sheet]));
  return felt;
}

}  // namespace icome::interaction
