#pragma once
#include "base/random.h"
#include "interaction/elements/element_use.h"
#include "interaction/techniques/bench/person.h"

namespace icome::study {

/// The outcome of choosing from a menu once.
struct MenuRun {
  const interaction::Widget* chosen = nullptr;  // the first that was; null: the person gave up
  double seconds = 0.0;                         // from seeing the menu to the choice
  int movements = 0;                            // towards the item, with corrections
  double way = 0.0;                             // m, of the tip
  double most_force = 0.0;                      // N
};

/// A simulated person chooses a widget of an open element: reacts, moves by minimum jerk to where signal-
/// dependent noise lets the movement end, sees what is lit, and corrects until it is the widget; then presses
/// the button, which jolts, or pushes. All the while the hand trembles. The element is felt through the servo
/// by a simulated hand, which its forces move, and it is the element's own point() that chooses. The tip
/// begins 3 cm before the middle of the element, which lies at the origin. The same random numbers give the
/// same run. Precondition: the widget is on the element's own sheet, and is chosen by either click or push.
MenuRun choose_from_menu(const interaction::PersonModel& person, const interaction::Element& element,
                         const interaction::TextMeasure& measure, const interaction::Widget& widget,
                         base::Random& random);

}  // namespace icome::study
