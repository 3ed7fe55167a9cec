#include "interaction/elements/element_feel.h"

namespace icome::interaction {
namespace {

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
  return target;
}

haptics::PanelSettings ground_of(const Element& element, const LaidSheet& sheet) {
  haptics::PanelSettings panel;
  panel.half = sheet.half;
  panel.stiffness = element.ground.stiffness;
  panel.most_force = element.ground.most_force;
  panel.push_depth = element.choosing.push_depth;
  panel.friction = element.ground.friction;
  panel.sides = element.ground.both_sides ? haptics::TouchableSides::Both : haptics::TouchableSides::Front;
  if (element.ground.border != 0.0) {
    haptics::PanelTarget border;
    border.half = sheet.half;
    border.ridge = element.ground.border;
    panel.targets.push_back(border);
  }
  return panel;
}

}  // namespace

std::vector<FeltSheet> feel_of(const Element& element, const ElementLayout& layout,
                               const ElementFrame& frame) {
  std::vector<FeltSheet> felt;
  for (const LaidSheet& sheet : layout.sheets) {
    FeltSheet one{frame.world_from_element(), ground_of(element, sheet)};
    one.world_from_sheet.translation() = frame.in_world(sheet.centre);
    felt.push_back(std::move(one));
  }
  for (const LaidWidget& laid : layout.widgets)
    if (laid.widget->can_be_chosen())
      felt[laid.sheet].panel.targets.push_back(target_of(element, laid, layout.sheets[laid.sheet]));
  return felt;
}

}  // namespace icome::interaction
