#include "apps/menu/menu_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/design/design_work.h"
#include "apps/interrupt.h"
#include "apps/menu/menu_picture.h"
#include "apps/menu/menu_trial.h"
#include "charts/lettering.h"
#include "devices/device_profiles.h"
#include "interaction/elements/element_feel.h"
#include "interaction/elements/element_file.h"
#include "io/file_bytes.h"
#include "io/new_file.h"
#include "session/elements/element_picture.h"

namespace icome::apps {
namespace {

using interaction::Element;
using interaction::ElementUse;
using interaction::HandleKind;
using interaction::LaidWidget;
using interaction::Widget;
using interaction::WidgetKind;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kLongestHeadMotion = 1'000'000'000;  // bytes
constexpr double kTickSeconds = 0.001;                       // the longest between two ticks while trying

constexpr const char* kMenuNotes =
    "Examples:\n"
    "  icome menu colours.toml                     where each item lies\n"
    "  icome menu colours.toml --picture menu.png  faded, and near the pointer with an item lit\n"
    "  icome menu colours.toml --path tip.csv --choose push --json\n"
    "\n"
    "FILE.toml describes a haptic element: a menu, toolbar, dialog, ring, pie or daisy that lies in the\n"
    "scene (docs/elements.md). The path has a first line t,x,y,z (s, m, world frame), and perhaps a fifth\n"
    "column b, the button: 1 down, 0 up. Without it a click comes where the path ends. Each row is a\n"
    "tick of the servo, with more on the way where rows are over 1 ms apart; forces keep the limits of\n"
    "the device. What is held where the path ends is let go there. With --choose look it is the motion of\n"
    "a head instead, rows t x y z qx qy qz qw (s, m, a quaternion; the head looks along -z), and what is\n"
    "looked at when it ends is chosen.\n"
    "\n"
    "JSON: {file, kind, language, centre: [x,y,z], normal: [x,y,z], width, height, items: [{name, text,\n"
    "kind, centre, normal, width, height, enabled, submenu: null or [items, as they lie when it is\n"
    "open]}]} (m, world frame). A list, tabs and a page have items: [those in them]; what has a value:\n"
    "value; a number: less and more [x,y,z]; a slider: groove {least, most} (its ends); a colour:\n"
    "wheel {centre, inner, outer, corners: [full, white, black]}; rows that scroll: scroll {first, seen,\n"
    "count, less, more, bar}.\n"
    "With --path instead {chosen: [names, also of items that open a menu or page], choices: [{name, by,\n"
    "time_s, value, opens: null, \"menu\" or \"page\"}], seconds, near_s, pushes, max_force_n,\n"
    "max_force_step_n, tick_us: {median, p99, max} (null with look)}.";

const char* word_of(interaction::ElementKind kind) {
  switch (kind) {
    case interaction::ElementKind::Menu:
      return "menu";
    case interaction::ElementKind::Toolbar:
      return "toolbar";
    case interaction::ElementKind::Dialog:
      return "dialog";
    case interaction::ElementKind::Ring:
      return "ring";
    case interaction::ElementKind::Pie:
      return "pie";
    case interaction::ElementKind::Daisy:
      break;
  }
  return "daisy";
}

const char* word_of(interaction::WidgetKind kind) {
  switch (kind) {
    case interaction::WidgetKind::Item:
      return "item";
    case interaction::WidgetKind::Check:
      return "check";
    case interaction::WidgetKind::Radio:
      return "radio";
    case interaction::WidgetKind::Slider:
      return "slider";
    case interaction::WidgetKind::Label:
      return "label";
    case interaction::WidgetKind::Number:
      return "number";
    case interaction::WidgetKind::List:
      return "list";
    case interaction::WidgetKind::Row:
      return "row";
    case interaction::WidgetKind::Colour:
      return "colour";
    case interaction::WidgetKind::Tabs:
      return "tabs";
    case interaction::WidgetKind::Page:
      return "page";
    case interaction::WidgetKind::Separator:
      break;
  }
  return "separator";
}

const char* word_of(interaction::ChosenBy by) {
  switch (by) {
    case interaction::ChosenBy::Click:
      return "click";
    case interaction::ChosenBy::Push:
      return "push";
    case interaction::ChosenBy::Key:
      return "key";
    case interaction::ChosenBy::Wheel:
      return "wheel";
    case interaction::ChosenBy::Name:
      return "name";
    case interaction::ChosenBy::Look:
      break;
  }
  return "look";
}

Json place_json(const base::Vector3& vector) { return {vector.x(), vector.y(), vector.z()}; }

std::string menu_json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// An element with what is needed to lay it out.
struct PreparedElement {
  Element element;
  std::size_t language = 0;
};

Json value_json(const interaction::Value& value) { return Json::parse(interaction::json_from_value(value)); }

/// An element with some of its menus and pages open.
class OpenElement {
 public:
  OpenElement(const PreparedElement& prepared, std::vector<const Widget*> open, interaction::ShownParts shown)
      : prepared_(prepared),
        open_(std::move(open)),
        shown_(std::move(shown)),
        layout_(interaction::lay_out(prepared.element, prepared.language, charts::line_width, open_, shown_)),
        settings_(prepared.element) {}

  /// Those of the widgets that show, and in each those of the menu or page that it opens, as they lie then.
  Json items(const std::vector<Widget>& widgets) const {
    Json items = Json::array();
    for (const Widget& widget : widgets) {
      const bool holds = widget.kind == WidgetKind::List || widget.kind == WidgetKind::Tabs;
      const LaidWidget* const laid = layout_.widget(widget);
      if (!holds && (laid == nullptr || !widget.can_be_chosen())) continue;
      Json item = holds ? item_at(widget, frame_of(widget)) : item_at(widget, {laid->centre, laid->half});
      if (holds) item["items"] = this->items(widget.widgets);
      add_parts(widget, item);
      items.push_back(std::move(item));
    }
    return items;
  }

  /// The rows that show; null: all do.
  Json scroll(const Widget* of) const {
    const interaction::LaidColumn* const column = layout_.column(of);
    if (column == nullptr) return nullptr;
    return {{"first", column->first},
            {"seen", column->seen},
            {"count", column->count},
            {"less", handle(HandleKind::Less, of)},
            {"more", handle(HandleKind::More, of)},
            {"bar", handle(HandleKind::Bar, of)}};
  }

 private:
  interaction::ElementFrame frame() const { return {prepared_.element.centre, prepared_.element.turn}; }
  Json place(const base::Vector2& at) const { return place_json(frame().in_world(at)); }
  Json handle(HandleKind kind, const Widget* of) const { return place(layout_.handle(kind, of)->box.centre); }

  interaction::LaidBox frame_of(const Widget& widget) const {
    const auto found = std::ranges::find(layout_.frames, &widget, &interaction::LaidFrame::of);
    return found == layout_.frames.end() ? interaction::LaidBox() : found->box;
  }

  /// The place of a widget in the world, z out of its front: in the plane, or on the sphere at rest.
  base::Pose pose_of(const Widget& widget, const interaction::LaidBox& box) const {
    const LaidWidget* const laid = layout_.widget(widget);
    const auto sphere = laid != nullptr ? layout_.sheets[laid->sheet].sphere : std::nullopt;
    return sphere ? frame().world_from_element() * sphere->tile_at(box.centre, {0.0, 0.0})
                  : interaction::world_from_sheet(frame(), interaction::LaidSheet{nullptr, box.centre});
  }

  Json item_at(const Widget& widget, const interaction::LaidBox& box) const {
    const std::size_t language = prepared_.language;
    const base::Pose lying = pose_of(widget, box);
    Json item{{"name", widget.name},
              {"text", language < widget.text.size() ? widget.text[language] : widget.name},
              {"kind", word_of(widget.kind)},
              {"centre", place_json(lying.translation())},
              {"normal", place_json(lying.linear().col(2))},
              {"width", 2.0 * box.half.x()},
              {"height", 2.0 * box.half.y()},
              {"enabled", widget.enabled},
              {"submenu", nullptr}};
    return item;
  }

  void add_parts(const Widget& widget, Json& item) const {
    const bool is_one_of_several = widget.kind == WidgetKind::Row || widget.kind == WidgetKind::Page;
    if (const interaction::Value value = settings_.value_of(widget); !value.is_null() && !is_one_of_several)
      item["value"] = value_json(value);
    if (widget.opens_menu()) {
      std::vector<const Widget*> deeper = open_;
      deeper.push_back(&widget);
      const OpenElement opened(prepared_, std::move(deeper), shown_);
      item["submenu"] = opened.items(widget.widgets);
      if (Json scroll = opened.scroll(&widget); !scroll.is_null()) item["scroll"] = std::move(scroll);
    } else if (widget.kind == WidgetKind::Page) {
      interaction::ShownParts shown = shown_;
      shown.pages[settings_.of(widget).parent] = &widget;
      item["items"] = OpenElement(prepared_, open_, std::move(shown)).items(widget.widgets);
    } else if (widget.kind == WidgetKind::List) {
      item["scroll"] = scroll(&widget);
    } else if (widget.kind == WidgetKind::Slider) {
      const LaidWidget& laid = *layout_.widget(widget);
      const auto groove = interaction::groove_of(laid, prepared_.element.text_height);
      item["groove"] = {{"least", place({groove.left, laid.centre.y()})},
                        {"most", place({groove.right, laid.centre.y()})}};
    } else if (widget.kind == WidgetKind::Number) {
      item["less"] = handle(HandleKind::Less, &widget);
      item["more"] = handle(HandleKind::More, &widget);
    } else if (widget.kind == WidgetKind::Colour) {
      const auto wheel = interaction::wheel_of(*layout_.widget(widget), prepared_.element.text_height);
      item["wheel"] = {{"centre", place(wheel.centre)}, {"inner", wheel.inner}, {"outer", wheel.outer}};
      for (const base::Vector2& corner : wheel.corners()) item["wheel"]["corners"].push_back(place(corner));
    }
  }

  const PreparedElement& prepared_;
  std::vector<const Widget*> open_;
  interaction::ShownParts shown_;
  interaction::ElementLayout layout_;
  interaction::ElementSettings settings_;
};

std::string layout_json(const PreparedElement& prepared, const ElementUse& use, const MenuOptions& options) {
  const OpenElement laid(prepared, {}, use.shown());
  const interaction::LaidSheet& sheet = use.layout().sheets.front();
  Json json{{"file", options.file.string()},
            {"kind", word_of(prepared.element.kind)},
            {"language", prepared.element.languages[prepared.language]},
            {"centre", place_json(use.frame().in_world(sheet.centre))},
            {"normal", place_json(use.frame().normal())},
            {"width", 2.0 * sheet.half.x()},
            {"height", 2.0 * sheet.half.y()},
            {"items", laid.items(prepared.element.widgets)}};
  if (Json scroll = laid.scroll(nullptr); !scroll.is_null()) json["scroll"] = std::move(scroll);
  return menu_json_text(json);
}

void append_rows(const Json& items, const std::string& indent, std::string& text) {
  for (const Json& item : items) {
    const auto name = indent + item["name"].get<std::string>();
    const auto& centre = item["centre"];
    text +=
        fmt::format("  {:<28}{:>8.1f}{:>8.1f}{:>8.1f}{:>9.1f} x {:.1f}{}\n", name,
                    1000.0 * centre[0].get<double>(), 1000.0 * centre[1].get<double>(),
                    1000.0 * centre[2].get<double>(), 1000.0 * item["width"].get<double>(),
                    1000.0 * item["height"].get<double>(), item["enabled"].get<bool>() ? "" : "  disabled");
    if (!item["submenu"].is_null()) append_rows(item["submenu"], indent + "  ", text);
    if (item.contains("items")) append_rows(item["items"], indent + "  ", text);
  }
}

std::string layout_text(const PreparedElement& prepared, const ElementUse& use, const MenuOptions& options) {
  std::string text =
      fmt::format("{}: a {}, turned by {:.4g} degrees; mm, world frame\n", options.file.string(),
                  word_of(prepared.element.kind), prepared.element.turn * 180.0 / std::numbers::pi);
  text += fmt::format("  {:<28}{:>8}{:>8}{:>8}{:>14}\n", "item", "x", "y", "z", "size");
  append_rows(OpenElement(prepared, {}, use.shown()).items(prepared.element.widgets), "", text);
  return text;
}

double share_of(const std::vector<double>& rising, double share) {
  return rising[std::size_t(share * double(rising.size() - 1))];
}

std::string trial_json(const MenuTrial& trial) {
  Json names = Json::array(), choices = Json::array();
  for (const MenuChoice& choice : trial.chosen) {
    names.push_back(choice.name);
    choices.push_back({{"name", choice.name},
                       {"by", word_of(choice.by)},
                       {"time_s", choice.time},
                       {"value", value_json(choice.value)},
                       {"opens", choice.opens.empty() ? Json() : Json(choice.opens)}});
  }
  Json ticks = nullptr;
  if (!trial.tick_us.empty())
    ticks = {{"median", share_of(trial.tick_us, 0.5)},
             {"p99", share_of(trial.tick_us, 0.99)},
             {"max", trial.tick_us.back()}};
  return menu_json_text({{"chosen", names},
                         {"choices", choices},
                         {"seconds", trial.seconds},
                         {"near_s", trial.near_seconds},
                         {"pushes", trial.pushes},
                         {"max_force_n", trial.max_force},
                         {"max_force_step_n", trial.max_force_step},
                         {"tick_us", ticks}});
}

std::string trial_text(const MenuTrial& trial) {
  std::string text =
      fmt::format("{:.4g} s, {:.4g} of them near the element, pushed in {} time{}\n", trial.seconds,
                  trial.near_seconds, trial.pushes, trial.pushes == 1 ? "" : "s");
  for (const MenuChoice& choice : trial.chosen) {
    const std::string value = choice.value.is_null() ? "" : ": " + interaction::json_from_value(choice.value);
    const std::string opens = choice.opens.empty() ? "" : ", opens its " + choice.opens;
    text += fmt::format("  {:.3f} s: {}{} (by {}{})\n", choice.time, choice.name, value, word_of(choice.by),
                        opens);
  }
  if (trial.chosen.empty()) text += "  nothing was chosen\n";
  if (trial.tick_us.empty()) return text;
  return text + fmt::format(
                    "force at most {:.3g} N, in steps of at most {:.3g} N; a tick {:.2g} us in the median, "
                    "{:.2g} at most\n",
                    trial.max_force, trial.max_force_step, share_of(trial.tick_us, 0.5),
                    trial.tick_us.back());
}

base::Result<PreparedElement> prepare(const MenuOptions& options) {
  auto element = interaction::read_element_file(options.file);
  if (!element) return tl::unexpected(element.error());
  PreparedElement prepared{std::move(*element), 0};
  const auto& languages = prepared.element.languages;
  if (!options.language.empty()) {
    const auto found = std::ranges::find(languages, options.language);
    if (found == languages.end())
      return base::fail(fmt::format("{} has no language \"{}\"; it has {}.", options.file.string(),
                                    options.language, fmt::join(languages, ", ")));
    prepared.language = std::size_t(found - languages.begin());
  }
  if (const std::string boxes = session::letters_without_font(prepared.element, prepared.language);
      !boxes.empty())
    tell(fmt::format("boxes stand for {}: no font here has these letters.", boxes));
  return prepared;
}

base::Result<std::string> answer_of_looking(ElementUse& use, const MenuOptions& options) {
  const auto text = io::read_bytes(*options.path, kLongestHeadMotion);
  if (!text) return tl::unexpected(text.error());
  const auto motion = devices::read_head_trace(*text, options.path->string());
  if (!motion) return tl::unexpected(motion.error());
  const MenuTrial trial = look_at_element(use, *motion);
  return options.json ? trial_json(trial) : trial_text(trial);
}

base::Result<std::string> answer_of_trial(ElementUse& use, const MenuOptions& options) {
  if (options.choose == "look") return answer_of_looking(use, options);
  const auto device = devices::find_device_profile(options.device);
  if (!device) return tl::unexpected(device.error());
  auto path = devices::PathPlayer::create(options.path->string(), *device);
  if (!path) return tl::unexpected(path.error());
  if (const auto filled = path->fill_in(kTickSeconds); !filled) return tl::unexpected(filled.error());
  const auto trial = try_element(use, *path);
  if (!trial) return base::fail("interrupted");
  if (!trial->capped.empty()) tell(fmt::format("on {}, {}.", device->name, trial->capped));
  return options.json ? trial_json(*trial) : trial_text(*trial);
}

base::Result<void> write_picture(const ElementUse& use, const MenuOptions& options, StatusLine& status) {
  if (const auto png = check_picture_name(*options.picture); !png) return tl::unexpected(png.error());
  auto out = io::NewFile::create(*options.picture);
  if (!out) return tl::unexpected(out.error());
  const auto image = draw_element(use, options, status);
  if (!image) return tl::unexpected(image.error());
  const auto png = charts::encode_png(*image);
  if (!png) return tl::unexpected(png.error());
  if (interrupted()) return base::fail("interrupted");
  out->write(std::string_view(reinterpret_cast<const char*>(png->data()), png->size()));
  return out->finish();
}

base::Result<std::string> answer_of(PreparedElement& prepared, const MenuOptions& options,
                                    StatusLine& status) {
  prepared.element.choosing.by_click = !options.path || options.choose == "click";
  prepared.element.choosing.by_push = !options.path || options.choose == "push";
  prepared.element.choosing.by_look = options.path && options.choose == "look";
  ElementUse use(prepared.element, prepared.language, charts::line_width);
  if (!options.show.empty() && !use.show(options.show))
    return base::fail(
        fmt::format("{} has no item \"{}\" that can be shown.", options.file.string(), options.show));
  if (options.picture)
    if (const auto written = write_picture(use, options, status); !written)
      return tl::unexpected(written.error());
  if (options.path) return answer_of_trial(use, options);
  return options.json ? layout_json(prepared, use, options) : layout_text(prepared, use, options);
}

}  // namespace

void add_menu(CLI::App& app, MenuOptions& options) {
  CLI::App& menu = *app.add_subcommand(
      "menu", "Show, draw and try a haptic menu, toolbar or dialog in the scene (thesis 5.7.2)");
  menu.footer(kMenuNotes);
  menu.add_option("FILE", options.file, "The element")->type_name("")->required();
  menu.add_option("--language", options.language, "Language of its texts (default: the first in the file)")
      ->type_name("NAME");
  auto* const path =
      menu.add_option("--path", options.path, "Try it: move the tip along these rows")->type_name("P.csv");
  menu.add_option("--choose", options.choose, "How the path chooses: click (default), push or look")
      ->check(CLI::IsMember({"click", "push", "look"}))
      ->type_name("HOW")
      ->needs(path);
  menu.add_option("--device", options.device, "Profile of the device of the path (default touch)")
      ->type_name("NAME")
      ->needs(path);
  auto* const picture =
      menu.add_option("--picture", options.picture, "Draw it, faded and opaque")->type_name("OUT.png");
  menu.add_option("--design", options.design, "Draw it over this design")->type_name("FILE")->needs(picture);
  menu.add_option("--theme", options.theme, "Its look: light (default), dark or contrast")
      ->check(CLI::IsMember({"light", "dark", "contrast"}))
      ->type_name("LOOK")
      ->needs(picture);
  menu.add_option("--show", options.show, "Bring this item into sight first: its page, its menu, its row")
      ->type_name("NAME");
  menu.add_flag("--json", options.json, "Print the answer as JSON (fields below)");
}

int run_menu(const MenuOptions& options) {
  catch_interrupts();
  StatusLine status;
  auto prepared = prepare(options);
  if (!prepared) return end_without_result(prepared.error(), status);
  const auto answer = answer_of(*prepared, options, status);
  status.clear();
  if (!answer) return end_without_result(answer.error(), status);
  return print_answer(*answer);
}

}  // namespace icome::apps
