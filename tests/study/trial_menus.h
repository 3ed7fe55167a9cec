#pragma once
#include <memory>
#include <string>

#include "study/definition/trial_goal.h"

namespace icome::study {

inline interaction::Widget item_named(const std::string& name) {
  interaction::Widget item;
  item.name = name;
  item.text = {name};
  return item;
}

/// A menu of a red and a blue item.
inline interaction::Element two_items() {
  interaction::Element element;
  element.widgets = {item_named("red"), item_named("blue")};
  return element;
}

inline StageElement on_stage(interaction::Element element) {
  return {"menu", std::make_shared<const interaction::Element>(std::move(element))};
}

/// The middle of a widget that is to be seen, m, stage frame.
inline base::Vector3 middle_of(const interaction::ElementUse& use, const std::string& name) {
  for (const interaction::LaidWidget& laid : use.layout().widgets)
    if (laid.widget->name == name) return use.frame().in_world(laid.centre);
  throw std::runtime_error("no widget " + name + " is to be seen");
}

}  // namespace icome::study
