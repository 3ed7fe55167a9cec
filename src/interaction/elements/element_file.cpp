#include "interaction/elements/element_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "base/near_names.h"
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

constexpr double kFarthestCentre = 1000.0;          // m
constexpr std::uint64_t kLongestFile = 10'000'000;  // bytes

const Words<ElementKind> kKinds = {{"menu", ElementKind::Menu},     {"toolbar", ElementKind::Toolbar},
                                   {"dialog", ElementKind::Dialog}, {"ring", ElementKind::Ring},
                                   {"pie", ElementKind::Pie},       {"daisy", ElementKind::Daisy}};
const Words<WidgetKind> kWidgetKinds = {{"item", WidgetKind::Item},   {"check", WidgetKind::Check},
                                        {"radio", WidgetKind::Radio}, {"slider", WidgetKind::Slider},
                                        {"label", WidgetKind::Label}, {"separator", WidgetKind::Separator}};
const Words<ElementPlace> kPlaces = {{"world", ElementPlace::World},
                                     {"head", ElementPlace::Head},
                                     {"hand", ElementPlace::Hand},
                                     {"pointer", ElementPlace::Pointer}};

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
    check_only_one(element.widgets, keys.place());
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
    return names.empty() ? std::vector<std::string>{"en"} : names;
  }

  void read_head(KeyReader& keys, Element& element) {
    element.kind = keys.word("kind", kKinds, ElementKind::Menu);
    element.title = keys.text("title", false);
    element.text_height = keys.number("text_m", element.text_height, 0.0005, 1.0);
    element.columns = std::uint32_t(keys.whole("columns", 0, 0, 100));
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
      problems_.add(keys.place_of("opaque_m"), "fading: opaque_m must be below begins_m.");
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
    if (widget.text.empty()) widget.text.assign(languages.size(), widget.name);
    check_name(keys, widget);
    widget.icon = keys.plain("icon");
    if (!widget.icon.empty())
      if (const auto colour = colour_from_text(widget.icon); !colour)
        problems_.add(keys.place_of("icon"),
                      fmt::format("item '{}': {}", widget.name, colour.error().message));
    widget.enabled = keys.flag("enabled", true);
    widget.checked = keys.flag("checked", false);
    widget.group = keys.plain("group");
    widget.is_default = keys.flag("default", false);
    widget.is_cancel = keys.flag("cancel", false);
    if (widget.kind == WidgetKind::Slider) read_slider(keys, widget);
    widget.feel = read_feel(keys, feel);
    read_operation(keys, widget);
    widget.widgets = read_widgets(keys, "item", languages, feel, depth + 1);
    if (!widget.widgets.empty() && widget.kind != WidgetKind::Item)
      problems_.add(keys.place(),
                    fmt::format("item '{}': only an item of kind \"item\" opens a menu.", widget.name));
    keys.finish();
    return widget;
  }

  void check_name(KeyReader& keys, const Widget& widget) {
    if (!widget.can_be_chosen() && widget.name.empty()) {
      if (widget.kind == WidgetKind::Label && widget.text.front().empty())
        keys.require("text", "text = \"...\"");
      return;
    }
    if (widget.name.empty()) {
      keys.require("name", "name = \"...\"");
      if (keys.has("name"))
        problems_.add(keys.place_of("name"), "item: name is empty; write a word or more.");
    } else if (std::ranges::any_of(widget.name, [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
      problems_.add(keys.place_of("name"), "item: name has control characters; write a word or more.");
    } else if (!names_.insert(widget.name).second) {
      problems_.add(keys.place_of("name"), fmt::format("item: there are two of the name '{}'.", widget.name));
    }
  }

  /// On a sphere lie things of one size, as many as can still be told apart.
  void check_daisy(const Element& element, const io::Place& place) {
    if (element.kind != ElementKind::Daisy) return;
    if (element.widgets.size() > kMostOnDaisy)
      problems_.add(place, fmt::format("the element: a daisy has {} items at most, not {}.", kMostOnDaisy,
                                       element.widgets.size()));
    for (const Widget& widget : element.widgets)
      if (!widget.can_be_chosen() || widget.kind == WidgetKind::Slider)
        problems_.add(place, fmt::format("the element: on a daisy lie items, checks and radios, not '{}'.",
                                         widget.name.empty() ? widget.text.front() : widget.name));
  }

  /// One default and one cancel in a menu, and one radio that is on in each group of it.
  void check_only_one(const std::vector<Widget>& widgets, const io::Place& place) {
    std::set<std::string> groups;
    int defaults = 0, cancels = 0;
    for (const Widget& widget : widgets) {
      defaults += widget.is_default ? 1 : 0;
      cancels += widget.is_cancel ? 1 : 0;
      if (widget.kind == WidgetKind::Radio && widget.checked && !groups.insert(widget.group).second)
        problems_.add(place,
                      fmt::format("item '{}': another radio of its group is checked, too.", widget.name));
      check_only_one(widget.widgets, place);
    }
    if (defaults > 1) problems_.add(place, "the element: only one item can be the default.");
    if (cancels > 1) problems_.add(place, "the element: only one item can be the cancel.");
  }

  void read_slider(KeyReader& keys, Widget& widget) {
    widget.least = keys.number("least", 0.0, -1e9, 1e9);
    widget.most = keys.number("most", 1.0, -1e9, 1e9);
    if (widget.least >= widget.most) {
      problems_.add(keys.place_of("most"), fmt::format("item '{}': most must be above least.", widget.name));
      widget.most = widget.least + 1.0;
    }
    widget.step = keys.number("step", 0.0, 0.0, widget.most - widget.least);
    widget.value = keys.number("value", widget.least, widget.least, widget.most);
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
    if (with != nullptr) widget.with = *value_from_toml(*with).fields();
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
    if (with == nullptr) return;
    std::vector<std::string> names;
    for (const Parameter& parameter : (*found)->parameters) names.push_back(parameter.name);
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

  Problems problems_;
  std::set<std::string> names_;
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
