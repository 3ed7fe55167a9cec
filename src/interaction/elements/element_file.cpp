#include "interaction/elements/element_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

#include "base/near_names.h"
#include "interaction/elements/colour_wheel.h"
#include "interaction/operations/looks/colour_names.h"
#include "interaction/operations/operation.h"
#include "interaction/operations/toml_value.h"
#include "io/file_bytes.h"

namespace icome::interaction {
namespace {

using io::KeyReader;
using io::Problems;
using io::TomlNode;
using io::Words;

constexpr int kFewestRows = 3, kMostRows = 100;     // that are seen at once
constexpr int kUsualRows = 6;                       // of a list
constexpr double kFarthestCentre = 1000.0;          // m
constexpr std::uint64_t kLongestFile = 10'000'000;  // bytes

const Words<ElementKind> kKinds = {{"menu", ElementKind::Menu},     {"toolbar", ElementKind::Toolbar},
                                   {"dialog", ElementKind::Dialog}, {"ring", ElementKind::Ring},
                                   {"pie", ElementKind::Pie},       {"daisy", ElementKind::Daisy}};
const Words<WidgetKind> kWidgetKinds = {
    {"item", WidgetKind::Item},    {"button", WidgetKind::Item},         {"check", WidgetKind::Check},
    {"toggle", WidgetKind::Check}, {"radio", WidgetKind::Radio},         {"slider", WidgetKind::Slider},
    {"label", WidgetKind::Label},  {"separator", WidgetKind::Separator}, {"number", WidgetKind::Number},
    {"list", WidgetKind::List},    {"colour", WidgetKind::Colour},       {"tabs", WidgetKind::Tabs}};
const Words<ElementPlace> kPlaces = {{"world", ElementPlace::World},
                                     {"head", ElementPlace::Head},
                                     {"hand", ElementPlace::Hand},
                                     {"pointer", ElementPlace::Pointer}};

bool has_control_characters(const std::string& text) {
  return std::ranges::any_of(text, [](unsigned char c) { return c < ' ' || c == 0x7f; });
}

class ElementReader {
 public:
  base::Result<Element> read(std::string_view text, const std::string& source) {
    const auto file = io::parse_toml(text, source);
    if (!file) return tl::unexpected(file.error());
    const std::vector<std::string> given = languages(*file);
    Element element;
    element.languages = given;
    KeyReader keys(*file, "the element", element.languages, problems_);
    keys.strings("languages");
    read_head(keys, element);
    read_groups(keys, element);
    const WidgetFeel feel = read_feel(keys, WidgetFeel());
    element.widgets = read_widgets(keys, "item", element.languages, feel, 1);
    check_places(element);
    check_only_one(element.widgets, keys.place());
    if (element.kind != ElementKind::Dialog) check_no_answers(element.widgets, keys.place());
    check_daisy(element, keys.place());
    if (element.widgets.empty() && problems_.none())
      problems_.add(keys.place(), "the element has no widgets; write [[item]] with name = \"...\"");
    keys.finish();
    if (!problems_.none()) return base::fail(problems_.text(source));
    return element;
  }

 private:
  /// The languages of the file; one without a name where it says none.
  std::vector<std::string> languages(const TomlNode& file) {
    const auto found = std::ranges::find(file.members, "languages", &io::TomlMember::key);
    std::vector<std::string> names;
    if (found != file.members.end())
      for (const TomlNode& node : found->value.elements) {
        const bool again = std::ranges::find(names, node.text) != names.end();
        if (!io::is_id(node.text) || again)
          problems_.add(node.place, "the element: languages must be different short names, such as \"en\".");
        if (!again) names.push_back(node.text);
      }
    if (found != file.members.end() && found->value.kind == TomlNode::Kind::Array && names.empty())
      problems_.add(found->value.place,
                    "the element: languages is empty; write short names, such as \"en\".");
    return names.empty() ? std::vector<std::string>{"en"} : names;
  }

  void read_head(KeyReader& keys, Element& element) {
    element.kind = keys.word("kind", kKinds, ElementKind::Menu);
    element.title = keys.text("title", false);
    check_printed(keys, "title", element.title);
    element.text_height = keys.number("text_m", element.text_height, 0.0005, 1.0);
    element.columns = std::uint32_t(keys.whole("columns", 0, 0, 100));
    element.rows = std::uint32_t(keys.whole("rows", 0, kFewestRows, kMostRows));
    if (element.rows > 0 && element.kind != ElementKind::Menu)
      problems_.add(keys.place_of("rows"), "the element: only a menu has rows.");
    const auto refuse = [&](const char* key, const char* of, bool is_right) {
      if (!is_right && keys.has(key))
        problems_.add(keys.place_of(key), fmt::format("the element: {} is of a {}.", key, of));
    };
    refuse("columns", "toolbar", element.kind == ElementKind::Toolbar);
    refuse("radius_m", "daisy", element.kind == ElementKind::Daisy);
    refuse("cone_deg", "daisy", element.kind == ElementKind::Daisy);
    element.width = keys.number("width_m", element.width, 0.01, 10.0);
    element.radius = keys.number("radius_m", element.radius, 0.0, 10.0);
    element.cone = keys.number("cone_deg", 26.0, 1.0, 90.0) * std::numbers::pi / 180.0;
    element.place = keys.word("at", kPlaces, ElementPlace::World);
    if (const auto centre = keys.point("centre", kFarthestCentre)) element.centre = *centre;
    element.turn = keys.number("turn_deg", 0.0, -180.0, 180.0) * std::numbers::pi / 180.0;
  }

  void read_groups(KeyReader& keys, Element& element) {
    if (auto choosing = group(keys, "choosing", element)) read_choosing(*choosing, element.choosing);
    if (auto fading = group(keys, "fading", element)) read_fading(*fading, element.fading);
    if (auto ground = group(keys, "ground", element)) read_ground(*ground, element.ground);
  }

  std::optional<KeyReader> group(KeyReader& keys, const std::string& key, const Element& element) {
    const TomlNode* const table = keys.table(key);
    if (table == nullptr) return std::nullopt;
    return KeyReader(*table, key, element.languages, problems_);
  }

  void read_choosing(KeyReader& keys, ChoosingSettings& choosing) {
    enum class By : std::uint8_t { Click, Push, Both, Look };
    const By by = keys.word<By>(
        "by", {{"click", By::Click}, {"push", By::Push}, {"both", By::Both}, {"look", By::Look}}, By::Both);
    choosing.by_click = by == By::Click || by == By::Both;
    choosing.by_push = by == By::Push || by == By::Both;
    choosing.by_look = by == By::Look;
    choosing.near = keys.number("near_m", choosing.near, 0.001, 1.0);
    choosing.margin = keys.number("margin_m", choosing.margin, 0.0, 1.0);
    choosing.push_depth = keys.number("push_m", choosing.push_depth, 0.0005, 0.015);
    choosing.recede = keys.number("recede_m", std::max(choosing.recede, 2.0 * choosing.near), 0.001, 10.0);
    choosing.detent = keys.number("detent_n", choosing.detent, 0.0, 0.5);
    if (choosing.recede < choosing.near)
      problems_.add(keys.place_of("recede_m"), "choosing: recede_m must not be below near_m.");
    if (choosing.by_push && choosing.near <= choosing.push_depth)
      problems_.add(keys.place_of("near_m"),
                    "choosing: near_m must be above push_m, or a push comes out of reach.");
    keys.finish();
  }

  void read_fading(KeyReader& keys, FadingSettings& fading) {
    fading.begins = keys.number("begins_m", fading.begins, 0.001, 10.0);
    fading.opaque = keys.number("opaque_m", fading.opaque, 0.0, 10.0);
    fading.least = keys.number("least", fading.least, 0.0, 1.0);
    fading.seconds = keys.number("seconds", fading.seconds, 0.0, 10.0);
    if (fading.opaque >= fading.begins)
      problems_.add(keys.place_of(keys.has("opaque_m") ? "opaque_m" : "begins_m"),
                    fmt::format("fading: opaque_m, {:g}, must be below begins_m.", fading.opaque));
    keys.finish();
  }

  void read_ground(KeyReader& keys, GroundSettings& ground) {
    ground.stiffness = keys.number("stiffness_n_per_m", ground.stiffness, 50.0, 5000.0);
    ground.most_force = keys.number("most_n", ground.most_force, 0.5, 30.0);
    ground.friction = keys.number("friction", ground.friction, 0.0, 2.0);
    ground.border = keys.number("border_m", ground.border, -0.005, 0.005);
    ground.both_sides = keys.flag("both_sides", ground.both_sides);
    keys.finish();
  }

  WidgetFeel read_feel(KeyReader& keys, WidgetFeel feel) {
    const TomlNode* const table = keys.table("feel");
    if (table == nullptr) return feel;
    const std::vector<std::string> none = {"en"};
    KeyReader inner(*table, "feel", none, problems_);
    feel.well = inner.number("well_n", feel.well, 0.0, 3.0);
    feel.recess = inner.number("recess_m", feel.recess, -0.003, 0.003);
    feel.ridge = inner.number("ridge_m", feel.ridge, -0.003, 0.003);
    feel.rings = inner.number("rings_m", feel.rings, 0.0, 0.001);
    feel.ring_spacing = inner.number("ring_spacing_m", feel.ring_spacing, 0.0005, 0.05);
    feel.friction = inner.number("friction", feel.friction, 0.0, 2.0);
    inner.finish();
    return feel;
  }

  std::vector<Widget> read_widgets(KeyReader& keys, const std::string& key,
                                   const std::vector<std::string>& languages, const WidgetFeel& feel,
                                   std::size_t depth) {
    std::vector<Widget> widgets;
    for (KeyReader& one : keys.tables(key, "item")) {
      if (depth > kDeepestMenu) {
        problems_.add(one.place(), fmt::format("menus lie in each other {} deep at most.", kDeepestMenu));
        break;
      }
      if (++count_ > kMostWidgets) {
        if (count_ == kMostWidgets + 1)
          problems_.add(one.place(), fmt::format("an element has {} items at most.", kMostWidgets));
        break;
      }
      widgets.push_back(read_widget(one, languages, feel, depth));
    }
    return widgets;
  }

  Widget read_widget(KeyReader& keys, const std::vector<std::string>& languages, const WidgetFeel& feel,
                     std::size_t depth) {
    Widget widget;
    widget.kind = keys.word("kind", kWidgetKinds, WidgetKind::Item);
    widget.name = keys.plain("name");
    widget.text = keys.text("text", false);
    check_printed(keys, "text", widget.text);
    if (widget.text.empty() && widget.kind != WidgetKind::List)
      widget.text.assign(languages.size(), widget.name);
    check_name(keys, widget);
    widget.icon = keys.plain("icon");
    check_colour(keys, "icon", widget.icon, widget);
    widget.enabled = keys.flag("enabled", true);
    widget.checked = keys.flag("checked", false);
    widget.group = keys.plain("group");
    widget.is_default = keys.flag("default", false);
    widget.is_cancel = keys.flag("cancel", false);
    widget.feel = read_feel(keys, feel);
    widget.widgets = read_widgets(keys, "item", languages, widget.feel, depth + 1);
    places_[widget.name] = keys.place();
    read_kind(keys, widget);
    check_kind(keys, widget);
    read_operation(keys, widget);
    keys.finish();
    return widget;
  }

  /// The keys that only some kinds have.
  void read_kind(KeyReader& keys, Widget& widget) {
    switch (widget.kind) {
      case WidgetKind::Slider:
      case WidgetKind::Number:
        read_range(keys, widget);
        break;
      case WidgetKind::Colour: {
        const std::string value = keys.plain("value");
        check_colour(keys, "value", value, widget);
        if (const auto colour = colour_from_text(value); colour) widget.colour = *colour;
        break;
      }
      case WidgetKind::List:
        read_rows(keys, widget, kUsualRows);
        make_all(keys, widget, WidgetKind::Row, "row");
        read_chosen(keys, widget);
        break;
      case WidgetKind::Tabs:
        make_all(keys, widget, WidgetKind::Page, "page");
        read_chosen(keys, widget);
        break;
      default:
        read_rows(keys, widget, 0);
    }
    const bool holds =
        widget.kind == WidgetKind::Item || widget.kind == WidgetKind::List || widget.kind == WidgetKind::Tabs;
    if (!widget.widgets.empty() && !holds)
      problems_.add(keys.place(),
                    fmt::format("item '{}': only an item of kind \"item\", \"list\" or \"tabs\" "
                                "has items in it.",
                                widget.name));
  }

  /// Line ends and the like cannot be drawn.
  void check_printed(KeyReader& keys, const std::string& key, const std::vector<std::string>& texts) {
    for (const std::string& text : texts)
      if (has_control_characters(text))
        return problems_.add(
            keys.place_of(key),
            fmt::format("{} has control characters, such as ends of lines; write words.", key));
  }

  /// Keys that mean nothing there.
  void check_kind(KeyReader& keys, const Widget& widget) {
    const auto refuse = [&](const char* key, const char* of) {
      if (keys.has(key))
        problems_.add(keys.place_of(key), fmt::format("item '{}': {} is of {}.", widget.name, key, of));
    };
    const bool is_radio = widget.kind == WidgetKind::Radio;
    if (!is_radio && widget.kind != WidgetKind::Check) refuse("checked", "a check or radio");
    if (!is_radio) refuse("group", "a radio");
    if (!widget.opens_menu()) return;
    refuse("operation", "an item that opens no menu");
    refuse("command", "an item that opens no menu");
  }

  void read_rows(KeyReader& keys, Widget& widget, int otherwise) {
    widget.rows = std::uint32_t(keys.whole("rows", otherwise, kFewestRows, kMostRows));
    if (keys.has("rows") && widget.kind != WidgetKind::List && widget.widgets.empty())
      problems_.add(
          keys.place_of("rows"),
          fmt::format("item '{}': rows are of a list, or of an item that opens a menu.", widget.name));
  }

  /// Makes all that is in a list rows, and all that is in tabs pages.
  void make_all(KeyReader& keys, Widget& widget, WidgetKind kind, const char* word) {
    if (widget.widgets.empty())
      problems_.add(keys.place(), fmt::format("item '{}': it has no {}s; write [[item.item]] below it.",
                                              widget.name, word));
    const TomlNode* const items = keys.value("item");
    for (std::size_t i = 0; i < widget.widgets.size(); ++i) {
      Widget& it = widget.widgets[i];
      const io::Place place = items->elements[i].place;
      if (it.kind != WidgetKind::Item || (kind == WidgetKind::Row && !it.widgets.empty()))
        problems_.add(place, fmt::format("item '{}': a {} is an item of no other kind{}.", it.name, word,
                                         kind == WidgetKind::Row ? " and opens no menu" : ""));
      if (kind == WidgetKind::Page && it.widgets.empty())
        problems_.add(place, fmt::format("item '{}': the page is empty.", it.name));
      it.kind = kind;
    }
  }

  /// The name of the row or page that is chosen at first.
  void read_chosen(KeyReader& keys, Widget& widget) {
    widget.chosen = keys.plain("value");
    std::vector<std::string> names;
    for (const Widget& it : widget.widgets) names.push_back(it.name);
    if (!widget.chosen.empty() && std::ranges::find(names, widget.chosen) == names.end())
      problems_.add(keys.place_of("value"),
                    fmt::format("item '{}': it has no '{}'{}", widget.name, widget.chosen,
                                base::suggestion(widget.chosen, names)));
  }

  void check_colour(KeyReader& keys, const std::string& key, const std::string& said, const Widget& widget) {
    if (said.empty()) return;
    if (const auto colour = colour_from_text(said); !colour)
      problems_.add(keys.place_of(key), fmt::format("item '{}': {}", widget.name, colour.error().message));
  }

  static bool is_high(const Widget& widget) {
    return widget.kind == WidgetKind::List || widget.kind == WidgetKind::Tabs ||
           widget.kind == WidgetKind::Colour;
  }

  /// Lists, tabs and pickers of colours lie in menus, dialogs and pages, and not among rows that scroll.
  void check_places(const Element& element) {
    const bool is_column = element.kind == ElementKind::Menu || element.kind == ElementKind::Dialog;
    check_places(element.widgets, element.rows > 0, is_column);
  }

  void check_places(const std::vector<Widget>& widgets, bool scrolls, bool is_column) {
    for (const Widget& widget : widgets) {
      if (is_high(widget) && (scrolls || !is_column))
        problems_.add(places_[widget.name],
                      fmt::format("item '{}': lists, tabs and pickers of colours lie {}.", widget.name,
                                  scrolls ? "in no menu with rows" : "in menus, dialogs and pages"));
      check_places(widget.widgets, widget.kind == WidgetKind::Item && widget.rows > 0, true);
    }
  }

  void check_name(KeyReader& keys, const Widget& widget) {
    const bool needs_none = widget.kind == WidgetKind::Label || widget.kind == WidgetKind::Separator;
    if (needs_none && widget.name.empty()) {
      if (widget.kind == WidgetKind::Label && widget.text.front().empty())
        keys.require("text", "text = \"...\"");
      return;
    }
    if (widget.name.empty()) {
      keys.require("name", "name = \"...\"");
      if (const TomlNode* const said = keys.value("name"); said && said->kind == TomlNode::Kind::String)
        problems_.add(keys.place_of("name"), "item: name is empty; write a word or more.");
    } else if (widget.name.find_first_not_of(' ') == std::string::npos) {
      problems_.add(keys.place_of("name"), "item: name is blank; write a word or more.");
    } else if (has_control_characters(widget.name)) {
      problems_.add(keys.place_of("name"), "item: name has control characters; write a word or more.");
    } else if (!names_.insert(widget.name).second) {
      problems_.add(keys.place_of("name"), fmt::format("item: there are two of the name '{}'.", widget.name));
    }
  }

  /// The line of an item; one without a name has that of the element.
  const io::Place& place_of(const Widget& widget, const io::Place& otherwise) const {
    const auto found = places_.find(widget.name);
    return widget.name.empty() || found == places_.end() ? otherwise : found->second;
  }

  /// On a sphere lie things of one size, as many as can still be told apart.
  void check_daisy(const Element& element, const io::Place& place) {
    if (element.kind != ElementKind::Daisy) return;
    if (element.widgets.size() > kMostOnDaisy)
      problems_.add(place, fmt::format("the element: a daisy has {} items at most, not {}.", kMostOnDaisy,
                                       element.widgets.size()));
    for (const Widget& widget : element.widgets)
      if (widget.kind != WidgetKind::Item && widget.kind != WidgetKind::Check &&
          widget.kind != WidgetKind::Radio)
        problems_.add(place_of(widget, place),
                      fmt::format("the element: on a daisy lie items, checks and radios, not '{}'.",
                                  widget.name.empty() ? widget.text.front() : widget.name));
  }

  /// One default and one cancel in a menu, and one radio that is on in each group of it.
  void check_only_one(const std::vector<Widget>& widgets, const io::Place& place) {
    std::set<std::string> groups;
    int defaults = 0, cancels = 0;
    for (const Widget& widget : widgets) {
      if (widget.kind == WidgetKind::Radio && widget.checked && !groups.insert(widget.group).second)
        problems_.add(place_of(widget, place),
                      fmt::format("item '{}': another radio of its group is checked, too.", widget.name));
      if ((widget.is_default || widget.is_cancel) && !widget.enabled)
        problems_.add(
            place_of(widget, place),
            fmt::format("item '{}': what is disabled can be neither default nor cancel.", widget.name));
      if (widget.is_default && ++defaults > 1)
        problems_.add(place_of(widget, place), "the element: only one item can be the default.");
      if (widget.is_cancel && ++cancels > 1)
        problems_.add(place_of(widget, place), "the element: only one item can be the cancel.");
      check_only_one(widget.widgets, place);
    }
  }

  /// Enter and Escape answer the question of a dialog; elsewhere they choose what is lit, and close menus.
  void check_no_answers(const std::vector<Widget>& widgets, const io::Place& place) {
    for (const Widget& widget : widgets) {
      if (widget.is_default || widget.is_cancel)
        problems_.add(
            place_of(widget, place),
            fmt::format("item '{}': only an item of a dialog can be its default or cancel.", widget.name));
      check_no_answers(widget.widgets, place);
    }
  }

  void read_range(KeyReader& keys, Widget& widget) {
    const bool is_number = widget.kind == WidgetKind::Number;
    widget.least = keys.number("least", 0.0, -1e9, 1e9);
    widget.most = keys.number("most", std::max(is_number ? 100.0 : 1.0, widget.least + 1.0), -1e9, 1e9);
    if (widget.least >= widget.most) {
      problems_.add(keys.place_of("most"), fmt::format("item '{}': most must be above least.", widget.name));
      widget.most = widget.least + 1.0;
    }
    const double range = widget.most - widget.least;
    widget.step = keys.number("step", is_number ? std::min(1.0, range) : 0.0, is_number ? 1e-9 : 0.0, range);
    widget.value = keys.number("value", widget.least, widget.least, widget.most);
    if (is_number) widget.unit = keys.plain("unit");
    check_printed(keys, "unit", {widget.unit});
    widget.value_times = keys.number("value_times", 1.0, -1e9, 1e9);
    if (keys.has("value_times") && !keys.has("value_as"))
      problems_.add(keys.place_of("value_times"),
                    fmt::format("item '{}': value_times needs value_as.", widget.name));
  }

  /// Says what is wrong with a value; empty: nothing that can be known without a design.
  static std::string trouble_with(Parameter parameter, const Value& value) {
    using Kind = ParameterKind;
    if (parameter.kind == Kind::Object || parameter.kind == Kind::Objects || parameter.kind == Kind::Records)
      return {};
    parameter.only_for.clear();
    const std::vector<Parameter> parameters{std::move(parameter)};
    const Value::Fields fields{{parameters.front().name, value}};
    const auto checked = Arguments::check(parameters, fields, world::World());
    return checked ? std::string() : checked.error().message;
  }

  /// The operation with its arguments; whether its objects are there is checked when it is done.
  void read_operation(KeyReader& keys, Widget& widget) {
    widget.operation = keys.plain("operation");
    widget.command = keys.plain("command");
    if (!widget.operation.empty() && !widget.command.empty())
      problems_.add(keys.place_of("command"),
                    fmt::format("item '{}': it does either an operation or a command.", widget.name));
    const TomlNode* const with = keys.table("with");
    widget.value_as = keys.plain("value_as");
    if (with != nullptr) widget.with = *value_from_toml(*with).fields();
    if (!widget.value_as.empty() && widget.operation.empty())
      problems_.add(keys.place_of("value_as"),
                    fmt::format("item '{}': value_as needs operation.", widget.name));
    if (widget.operation.empty()) {
      if (with != nullptr)
        problems_.add(with->place, fmt::format("item '{}': with needs operation.", widget.name));
      return;
    }
    const auto found = find_operation(widget.operation);
    if (!found) {
      problems_.add(keys.place_of("operation"),
                    fmt::format("item '{}': {}", widget.name, found.error().message));
      return;
    }
    std::vector<std::string> names;
    for (const Parameter& parameter : (*found)->parameters) names.push_back(parameter.name);
    if (!widget.value_as.empty()) check_value_as(keys, widget, **found, names);
    if (with == nullptr) return;
    for (const io::TomlMember& member : with->members) {
      const auto parameter = std::ranges::find((*found)->parameters, member.key, &Parameter::name);
      if (parameter == (*found)->parameters.end()) {
        problems_.add(member.place,
                      fmt::format("item '{}': {} takes no '{}'{}", widget.name, widget.operation, member.key,
                                  base::suggestion(member.key, names)));
      } else if (const std::string wrong = trouble_with(*parameter, *field(widget.with, member.key));
                 !wrong.empty()) {
        problems_.add(member.place, fmt::format("item '{}': {}", widget.name, wrong));
      }
    }
  }

  /// Values that a widget can have, among them those at its ends.
  static std::vector<Value> values_of(const Widget& widget) {
    switch (widget.kind) {
      case WidgetKind::Slider:
      case WidgetKind::Number: {
        const double second =
            widget.step > 0.0 ? widget.least + widget.step : 0.5 * (widget.least + widget.most);
        std::vector<Value> values;
        for (const double value : {widget.least, second, widget.most, widget.value})
          values.emplace_back(widget.value_times * value);
        return values;
      }
      case WidgetKind::Check:
        return {true, false};
      case WidgetKind::Colour:
        return {colour_text(widget.colour)};
      case WidgetKind::List: {
        std::vector<Value> names;
        for (const Widget& row : widget.widgets)
          if (row.operation.empty()) names.emplace_back(row.name);
        return names;
      }
      default:
        return {};
    }
  }

  /// The argument that takes the value must be there, take every one of them, and not be said in `with`.
  void check_value_as(KeyReader& keys, const Widget& widget, const Operation& operation,
                      const std::vector<std::string>& names) {
    const auto add = [&](const std::string& what) {
      problems_.add(keys.place_of("value_as"), fmt::format("item '{}': {}", widget.name, what));
    };
    const auto parameter = std::ranges::find(operation.parameters, widget.value_as, &Parameter::name);
    const std::vector<Value> values = values_of(widget);
    if (parameter == operation.parameters.end())
      return add(fmt::format("{} takes no '{}'{}", widget.operation, widget.value_as,
                             base::suggestion(widget.value_as, names)));
    if (values.empty())
      return add("it has no value for value_as; a check, slider, number, colour or list has.");
    if (field(widget.with, widget.value_as) != nullptr)
      return add(fmt::format("'{}' is said in with, too.", widget.value_as));
    for (const Value& value : values)
      if (const std::string wrong = trouble_with(*parameter, value); !wrong.empty())
        return add(fmt::format("its value does not fit: {}", wrong));
  }

  Problems problems_;
  std::set<std::string> names_;
  std::map<std::string, io::Place> places_;
  std::size_t count_ = 0;
};

}  // namespace

base::Result<Element> read_element(std::string_view text, const std::string& source) {
  return ElementReader().read(text, source);
}

base::Result<Element> read_element_file(const std::filesystem::path& path) {
  const auto text = io::read_bytes(path, kLongestFile);
  if (!text) return tl::unexpected(text.error());
  return read_element(*text, path.string());
}

}  // namespace icome::interaction
