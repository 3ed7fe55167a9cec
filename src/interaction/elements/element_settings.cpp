#include "interaction/elements/element_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "interaction/operations/looks/colour_names.h"

namespace icome::interaction {
namespace {

/// The widget whose operation a row does: its own, or that of its list.
const Widget& doer_of(const Widget& widget, const Widget* parent) {
  const bool is_lists = widget.kind == WidgetKind::Row && widget.operation.empty() && parent != nullptr;
  return is_lists ? *parent : widget;
}

}  // namespace

double within(const Widget& widget, double value) {
  if (widget.kind == WidgetKind::Slider && widget.step > 0.0)
    value = widget.least + widget.step * std::round((value - widget.least) / widget.step);
  return std::clamp(value, widget.least, widget.most);
}

double rounded_value(double value) { return std::stod(fmt::format("{:.12g}", value)); }

ElementSettings::ElementSettings(const Element& element) { add(element.widgets, nullptr); }

void ElementSettings::add(const std::vector<Widget>& widgets, const Widget* parent) {
  for (const Widget& widget : widgets) {
    Setting setting{widget.checked, widget.value, hsv_of(widget.colour), nullptr, parent};
    const auto named = std::ranges::find(widget.widgets, widget.chosen, &Widget::name);
    if (named != widget.widgets.end()) {
      setting.chosen = &*named;
    } else if (widget.kind == WidgetKind::Tabs && !widget.widgets.empty()) {
      setting.chosen = &widget.widgets.front();
    }
    all_.emplace(&widget, setting);
    add(widget.widgets, &widget);
  }
}

bool ElementSettings::is_usable(const Widget& widget) const {
  if (!widget.enabled || !widget.can_be_chosen()) return false;
  for (const Widget* above = of(widget).parent; above != nullptr; above = of(*above).parent)
    if (above->kind != WidgetKind::Item && !above->enabled) return false;
  return true;
}

void ElementSettings::choose(const Widget& widget) {
  Setting& setting = of(widget);
  if (widget.kind == WidgetKind::Check) setting.checked = !setting.checked;
  if (widget.kind == WidgetKind::Radio) {
    for (auto& [other, its] : all_)
      if (other->kind == WidgetKind::Radio && other->group == widget.group) its.checked = false;
    setting.checked = true;
  }
  const bool is_of_several = widget.kind == WidgetKind::Row || widget.kind == WidgetKind::Page;
  if (is_of_several && setting.parent != nullptr) of(*setting.parent).chosen = &widget;
}

bool ElementSettings::set(const Widget& widget, const Value& value) {
  Setting& setting = of(widget);
  const Value before = value_of(widget);
  switch (widget.kind) {
    case WidgetKind::Check:
      if (const bool* const flag = value.flag()) setting.checked = *flag;
      break;
    case WidgetKind::Slider:
    case WidgetKind::Number:
      if (const double* const number = value.number(); number && widget.value_times != 0.0)
        setting.value = rounded_value(*number / widget.value_times);
      break;
    case WidgetKind::Colour:
      // A colour that is told again keeps the hue that its grey was given.
      if (value.text() != nullptr && value != before)
        if (const auto colour = colour_from_text(*value.text()))
          setting.colour = hsv_of(*colour, setting.colour);
      break;
    case WidgetKind::List:
      if (value.text() != nullptr) {
        const auto row = std::ranges::find(widget.widgets, *value.text(), &Widget::name);
        setting.chosen = row != widget.widgets.end() ? &*row : nullptr;
      }
      break;
    default:
      break;
  }
  return value_of(widget) != before;
}

Value ElementSettings::value_of(const Widget& widget) const {
  const Setting& setting = of(widget);
  switch (widget.kind) {
    case WidgetKind::Check:
    case WidgetKind::Radio:
      return setting.checked;
    case WidgetKind::Slider:
    case WidgetKind::Number:
      return setting.value;
    case WidgetKind::Colour:
      return colour_text(rgb_of(setting.colour));
    case WidgetKind::List:
    case WidgetKind::Tabs:
      return setting.chosen != nullptr ? Value(setting.chosen->name) : Value();
    case WidgetKind::Row:
    case WidgetKind::Page:
      return setting.parent != nullptr ? value_of(*setting.parent) : Value();
    case WidgetKind::Item:
    case WidgetKind::Label:
    case WidgetKind::Separator:
      break;
  }
  return {};
}

OperationCall ElementSettings::call_of(const Widget& widget) const {
  const Widget& doer = doer_of(widget, of(widget).parent);
  OperationCall call{doer.operation, doer.with};
  if (doer.operation.empty() || doer.value_as.empty()) return call;
  // A row that is not the chosen one tells what it would be.
  Value value = widget.kind == WidgetKind::Row ? Value(widget.name) : value_of(doer);
  if (const double* const number = value.number()) value = rounded_value(*number * doer.value_times);
  call.arguments.emplace_back(doer.value_as, std::move(value));
  return call;
}

}  // namespace icome::interaction
