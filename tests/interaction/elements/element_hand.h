#pragma once
#include <algorithm>
#include <cmath>
#include <string>

#include "interaction/elements/element_samples.h"

namespace icome::interaction {

/// Moves a tip over an element in ticks of a millisecond.
class Hand {
 public:
  explicit Hand(ElementUse& use) : use_(use) {}

  /// The place that far in front of a widget, m.
  base::Vector3 at(std::string_view name, double front) const {
    const Widget* const widget = find_widget(use_.element().widgets, name);
    for (const LaidWidget& laid : use_.layout().widgets)
      if (laid.widget == widget) return use_.frame().in_world(laid.centre) + front * use_.frame().normal();
    return base::Vector3::Constant(std::nan(""));
  }

  /// The names that the way chooses, with blanks between.
  std::string move(const base::Vector3& to, double seconds, bool button = false) {
    const base::Vector3 from = tip_;
    const int ticks = std::max(1, int(seconds * 1000.0));
    std::string chosen;
    for (int i = 1; i <= ticks; ++i) {
      tip_ = from + (to - from) * (double(i) / ticks);
      time_ += 0.001;
      if (const auto choice = use_.point({time_, tip_, button}))
        chosen += (chosen.empty() ? "" : " ") + choice->widget->name;
    }
    return chosen;
  }
  /// Pushes a place of the plane, and comes back.
  std::string push_at(const Vector2& place) {
    std::string chosen = move(over(place, 0.01), 0.1);
    chosen += move(over(place, -0.006), 0.2);
    return chosen + move(over(place, 0.01), 0.1);
  }
  std::string click_at(const Vector2& place) {
    std::string chosen = move(over(place, 0.01), 0.1);
    chosen += move(tip_, 0.01, true);
    return chosen + move(tip_, 0.01);
  }
  base::Vector3 over(const Vector2& place, double front) const {
    return use_.frame().in_world(place) + front * use_.frame().normal();
  }
  std::string push(std::string_view name) {
    std::string chosen = move(at(name, 0.01), 0.1);
    chosen += move(at(name, -0.006), 0.2);
    const base::Vector3 back = tip_ + 0.016 * use_.frame().normal();
    return chosen + move(back, 0.1);
  }
  std::string click(std::string_view name) {
    std::string chosen = move(at(name, 0.01), 0.1);
    chosen += move(tip_, 0.01, true);
    return chosen + move(tip_, 0.01);
  }
  const base::Vector3& tip() const { return tip_; }

 private:
  ElementUse& use_;
  base::Vector3 tip_ = base::Vector3(5.0, 5.0, 5.0);
  double time_ = 0.0;
};

/// An element in use, with a hand.
struct UsedElement {
  explicit UsedElement(const std::string& toml)
      : element(element_of(toml)), use(element, 0, even_letters()), hand(use) {}
  const Widget& widget(std::string_view name) const { return *find_widget(element.widgets, name); }

  Element element;
  ElementUse use;
  Hand hand;
};

}  // namespace icome::interaction
