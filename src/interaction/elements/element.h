#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "haptics/effects/panel.h"
#include "interaction/operations/value.h"
#include "io/key_reader.h"
#include "world/shape/fixture.h"

namespace icome::interaction {

/// The arrangement of an element's widgets.
enum class ElementKind : std::uint8_t {
  Menu,     // below each other
  Toolbar,  // beside each other, in rows
  Dialog,   // words, then buttons beside each other
  Ring,     // round a free middle (JDCAD, thesis 2.2.3)
  Pie,      // sectors of a disc (HoloSketch, thesis 5.7.2)
  Daisy     // on a sphere that the hand turns (JDCAD, thesis 2.2.3)
};

enum class WidgetKind : std::uint8_t {
  Item,   // does something, or opens what is in it
  Check,  // on or off
  Radio,  // one of a group
  Slider,
  Label,  // words
  Separator,
  Number,  // a field with a target to each side that makes it less or more
  List,    // rows that show in place, and scroll
  Row,     // of a List
  Colour,  // a ring of hues round a triangle of shades
  Tabs,    // pages, of which one shows
  Page     // of Tabs
};

/// The frame in which an element rests.
enum class ElementPlace : std::uint8_t {
  World,
  Head,    // the head at rest: its turn is compensated (thesis 5.7.2)
  Hand,    // the non-dominant hand (CHIMP, thesis 2.3.1)
  Pointer  // where the pointer is when it opens
};

/// The feel of a widget (thesis 4.4.2); absent where it is 0. See haptics::PanelTarget.
struct WidgetFeel {
  double well = 0.4;            // N
  double recess = 0.0006;       // m
  double ridge = 0.0;           // m
  double rings = 0.0;           // m
  double ring_spacing = 0.002;  // m
  double friction = 0.0;        // coefficient

  bool operator==(const WidgetFeel&) const = default;
};

/// One thing of an element that people choose, set or read.
struct Widget {
  std::string name;  // unique in its element
  WidgetKind kind = WidgetKind::Item;
  io::Translations text;  // in each language of the element
  std::string icon = {};  // a colour, "#rrggbb" or by name, shown as a square; empty: none
  bool enabled = true;
  bool checked = false;            // of Check and Radio
  std::string group = {};          // of Radio
  double least = 0.0, most = 1.0;  // of Slider and Number
  double step = 0.0, value = 0.0;  // of Slider and Number; step 0 of a Slider: any
  std::string operation = {};      // of `icome edit`; empty: the name is all that is told
  Value::Fields with = {};         // its arguments
  std::string command = {};        // of the window instead, such as "view.home"
  bool is_default = false;         // of a dialog: what Enter chooses
  bool is_cancel = false;          // of a dialog: what Escape chooses
  WidgetFeel feel = {};
  /// The menu that an Item opens beside it, rows of a List, pages of Tabs, and the widgets on a Page.
  std::vector<Widget> widgets = {};
  std::string unit = {};                      // of Number, behind its value
  world::Colour colour = {1.0F, 1.0F, 1.0F};  // of Colour
  std::string chosen = {};                    // name of a List's row or of the page that shows first
  std::uint32_t rows = 0;                     // of List and of an Item's menu: seen at once; 0: all
  std::string value_as = {};                  // argument of the operation that takes its value
  double value_times = 1.0;                   // of Slider and Number: by which that is multiplied

  bool can_be_chosen() const {
    return kind != WidgetKind::Label && kind != WidgetKind::Separator && kind != WidgetKind::List &&
           kind != WidgetKind::Tabs;
  }
  bool opens_menu() const { return kind == WidgetKind::Item && !widgets.empty(); }
};

/// The ways of choosing with the pointer (thesis 6.6.1).
struct ChoosingSettings {
  bool by_click = true;       // near is enough: the button chooses what is lit
  bool by_push = true;        // the ground is pushed in
  bool by_look = false;       // instead: what is looked at is chosen when the button is released (CHIMP)
  double near = 0.02;         // m, > 0, to the plane
  double margin = 0.005;      // m, by which the rectangle is larger than the element
  double push_depth = 0.003;  // m, > 0
  double recede = 0.04;       // m, > near: further from it, open menus close
  double detent = 0.4;        // N, 0 to 0.5
};

struct FadingSettings {
  double begins = 0.06;   // m, > opaque: where it begins to fade in
  double opaque = 0.015;  // m
  double least = 0.35;    // opacity of an element that is far away, 0 ... 1
  double seconds = 0.15;  // time constant
};

/// The ground of an element; see haptics::PanelSettings.
struct GroundSettings {
  double stiffness = 600.0;  // N/m
  double most_force = 3.0;   // N
  double friction = 0.0;     // coefficient
  double border = 0.0;       // m, height of a ridge round all of it (Miller's windows, thesis 4.4.1)
  bool both_sides = false;
};

/// A "haptic UI element" (thesis 5.7.2): a menu, toolbar or dialog that lies in the scene and is felt. It
/// turns about the vertical only. A description; see ElementLayout and ElementUse for one that is used.
struct Element {
  std::vector<std::string> languages = {""};
  ElementKind kind = ElementKind::Menu;
  io::Translations title = {""};
  ElementPlace place = ElementPlace::World;
  base::Vector3 centre = base::Vector3::Zero();  // m, in its frame
  double turn = 0.0;                             // rad, alpha of thesis 5.7.2
  double text_height = 0.004;                    // m, of a capital letter
  std::uint32_t columns = 0;                     // of a toolbar; 0: all in one row
  std::uint32_t rows = 0;                        // of a menu: seen at once, the others scroll; 0: all
  double width = 0.12;                           // m, at which words of a dialog are broken
  double radius = 0.0;                           // m, of a daisy's sphere, at least
  double cone = 0.454;                           // rad, half the angle of a daisy's cone
  ChoosingSettings choosing;
  FadingSettings fading;
  GroundSettings ground;
  std::vector<Widget> widgets;
};

}  // namespace icome::interaction
