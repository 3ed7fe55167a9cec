#pragma once
#include <string>
#include <unordered_map>
#include <vector>

#include "interaction/elements/colour_wheel.h"
#include "interaction/elements/element.h"

namespace icome::interaction {

/// An operation of `icome edit`, with arguments; without an operation nothing is to be done.
struct OperationCall {
  std::string operation = {};
  Value::Fields arguments = {};
};

/// The settings that people have made in an element: ticks, values, colours, rows and pages. Refers to the
/// element, which keeps what its file says.
class ElementSettings {
 public:
  struct Setting {
    bool checked = false;            // of Check and Radio
    double value = 0.0;              // of Slider and Number
    Hsv colour = {};                 // of Colour
    const Widget* chosen = nullptr;  // of List: a row; of Tabs: the page that shows; null: none
    const Widget* parent = nullptr;  // null: the element
  };

  explicit ElementSettings(const Element& element);

  // The widget is one of the element's.
  const Setting& of(const Widget& widget) const { return all_.find(&widget)->second; }
  Setting& of(const Widget& widget) { return all_.find(&widget)->second; }
  /// Can it be chosen, and is it enabled with the list and pages that it is in?
  bool is_usable(const Widget& widget) const;
  /// Sets what the argument of its operation is in the world, such as the size of what is selected; see
  /// call_of(). A value of another kind changes nothing. True: it is another one now.
  bool set(const Widget& widget, const Value& value);
  /// Sets what choosing it sets: ticks it, or makes it the one of its group, list or tabs.
  void choose(const Widget& widget);
  /// The value that it, or the List of a Row, tells: true or false, a number, "#rrggbb" or a name; null:
  /// none.
  Value value_of(const Widget& widget) const;
  /// The call that choosing it makes: its operation, or that of its List, with its value where that is an
  /// argument.
  OperationCall call_of(const Widget& widget) const;

 private:
  void add(const std::vector<Widget>& widgets, const Widget* parent);

  std::unordered_map<const Widget*, Setting> all_;
};

/// A value within the range of a Slider or Number; of a Slider also at one of its steps.
double within(const Widget& widget, double value);

/// A value without what adding 0.1 again and again leaves in its last digits.
double rounded_value(double value);

}  // namespace icome::interaction
