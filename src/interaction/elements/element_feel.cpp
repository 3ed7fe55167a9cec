#include "interaction/elements/element_feel.h"

#include <algorithm>

namespace icome::interaction {
namespace {

constexpr double kGrooveShare = 0.5;   // of the pull of a well, towards the middle of a ring of hues
constexpr double kLeastPush = 0.0003;  // m, below a floor that is nearly as deep as a push

/// The feel of a target that is pushed.
haptics::PanelTarget target_at(const Element& element, const LaidBox& box, const LaidSheet& sheet,
                               const WidgetFeel& feel) {
  haptics::PanelTarget target;
  target.centre = box.centre - sheet.centre;
  target.half = box.half;
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

/// Without a well: a hand goes along it.
WidgetFeel free_along(WidgetFeel feel) {
  feel.well = 0.0;
  return feel;
}

/// A well that draws the hand to what is set now.
void add_well(const Vector2& centre, const Vector2& half, double strength,
              std::vector<haptics::PanelTarget>& targets) {
  haptics::PanelTarget well;
  well.centre = centre;
  well.half = half;
  well.well = strength;
  if (strength > 0.0) targets.push_back(well);
}

/// The ring is a groove whose middle draws the hand, the triangle a recess, and the present hue a well.
void add_wheel(const Element& element, const LaidWidget& laid, const LaidSheet& sheet, double hue,
               std::vector<haptics::PanelTarget>& targets) {
  const WidgetFeel& feel = laid.widget->feel;
  const ColourWheel wheel = wheel_of(laid, element.text_height);
  haptics::PanelTarget ring = target_at(element, {wheel.centre, Vector2::Constant(wheel.outer)}, sheet, feel);
  ring.shape = haptics::PanelTarget::Shape::Ring;
  ring.inner = wheel.inner;
  ring.well *= kGrooveShare;
  targets.push_back(ring);
  haptics::PanelTarget triangle =
      target_at(element, {wheel.centre, Vector2::Constant(wheel.corner)}, sheet, free_along(feel));
  triangle.shape = haptics::PanelTarget::Shape::Triangle;
  targets.push_back(triangle);
  add_well(wheel.place_of_hue(hue) - sheet.centre, Vector2::Constant(0.5 * (wheel.outer - wheel.inner)),
           feel.well, targets);
}

/// A recess to go along, and a well at the value.
void add_slider(const Element& element, const LaidWidget& laid, const LaidSheet& sheet, double value,
                std::vector<haptics::PanelTarget>& targets) {
  const Widget& slider = *laid.widget;
  targets.push_back(target_at(element, {laid.centre, laid.half}, sheet, free_along(slider.feel)));
  const Vector2 place(groove_of(laid, element.text_height).place_of(slider, value), laid.centre.y());
  add_well(place - sheet.centre, Vector2::Constant(laid.half.y()), slider.feel.well, targets);
}

void add_targets(const Element& element, const ElementLayout& layout, const LaidWidget& laid,
                 const ElementSettings& settings, std::vector<haptics::PanelTarget>& targets) {
  const Widget& widget = *laid.widget;
  const LaidSheet& sheet = layout.sheets[laid.sheet];
  LaidBox box{laid.centre, laid.half};
  if (!widget.enabled) {  // plain ground
    haptics::PanelTarget plain;
    plain.centre = box.centre - sheet.centre;
    plain.half = box.half;
    targets.push_back(plain);
  } else if (widget.kind == WidgetKind::Colour) {
    add_wheel(element, laid, sheet, settings.of(widget).colour.hue, targets);
  } else if (widget.kind == WidgetKind::Slider) {
    add_slider(element, laid, sheet, settings.of(widget).value, targets);
  } else if (widget.kind == WidgetKind::Number) {
    targets.push_back(target_at(element, field_of(layout, widget), sheet, free_along(widget.feel)));
  } else {
    targets.push_back(target_at(element, box, sheet, widget.feel));
  }
}

/// Wells at the arrows and a recess along the groove, as the slider of McGee (thesis 4.4).
haptics::PanelTarget target_of(const Element& element, const LaidHandle& handle, const LaidSheet& sheet) {
  const WidgetFeel feel = handle.of != nullptr ? handle.of->feel : WidgetFeel();
  return target_at(element, handle.box, sheet, handle.kind == HandleKind::Bar ? free_along(feel) : feel);
}

bool is_felt(const LaidHandle& handle) {
  return handle.of == nullptr || handle.of->kind == WidgetKind::Item || handle.of->enabled;
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

std::vector<FeltSheet> feel_of(const Element& element, const ElementLayout& layout, const ElementFrame& frame,
                               const ElementSettings& settings) {
  std::vector<FeltSheet> felt;
  for (const LaidSheet& sheet : layout.sheets) {
    felt.push_back({world_from_sheet(frame, sheet), panel_of(element, sheet)});
    felt.back().panel.size = frame.size;
  }
  for (const LaidWidget& laid : layout.widgets)
    if (laid.widget->can_be_chosen())
      add_targets(element, layout, laid, settings, felt[laid.sheet].panel.targets);
  for (const LaidHandle& handle : layout.handles)
    if (is_felt(handle))
      felt[handle.sheet].panel.targets.push_back(target_of(element, handle, layout.sheets[handle.sheet]));
  return felt;
}

}  // namespace icome::interaction
