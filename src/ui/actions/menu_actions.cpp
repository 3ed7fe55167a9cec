#include "ui/actions/menu_actions.h"

#include <fmt/format.h>

#include <QElapsedTimer>
#include <QFileDialog>
#include <QLocale>
#include <utility>

#include "base/near_names.h"
#include "interaction/elements/element_file.h"
#include "interaction/elements/present_value.h"
#include "session/elements/element_picture.h"
#include "ui/actions/actions.h"
#include "ui/actions/desktop_menu.h"
#include "ui/actions/recent_files.h"
#include "ui/forms/operation_arguments.h"

namespace icome::ui {
namespace {

using interaction::Element;
using interaction::Widget;
using interaction::WidgetKind;

constexpr const char* kMenuFileKey = "menu/file";  // empty: the window's own
constexpr const char* kMenuTopic = "menu";
constexpr int kSlowPreview = 50;  // ms, beyond which previews would make the hand that drags stutter

}  // namespace

MenuActions::MenuActions(session::Session& session, QSettings& settings, Hooks hooks, QWidget& window)
    : session_(session),
      settings_(settings),
      hooks_(std::move(hooks)),
      window_(window),
      preview_(session, [](OperationPreview::End) {}) {
  session_.menu().on_changing([this](const session::MenuChoice* choice) { preview(choice); });
  session_.menu().on_choice([this](const session::MenuChoice& choice) { hear(choice); });
  session_.menu().on_trouble([this](const std::string& what) {
    hooks_.tell({.weight = Note::Weight::Passing, .text = what, .topic = kMenuTopic});
  });
  session_.on_selection([this] { refresh(); });
}

void MenuActions::fill(QMenu& menu) {
  QAction* open = add_action(menu, "tool.menu", "Haptic &Menu\tSpace", {}, [this] { toggle({}); });
  open->setStatusTip(
      "Opens the menu that lies in the scene, for hands, mouse and keys; Space or Esc closes it");
  add_action(menu, "tool.menu_file", "Haptic Menu &From File\u2026", {}, [this] { choose_file(); });
  add_action(menu, "tool.menu_usual", "&Usual Haptic Menu", {}, [this] {
    own_.reset();
    settings_.remove(kMenuFileKey);
    session_.menu().close();
  });
}

void MenuActions::choose_file() {
  auto* dialog = new QFileDialog(&window_, "Haptic Menu From File");
  dialog->setObjectName("menu_file");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilter("Haptic menus (*.toml)");
  QObject::connect(dialog, &QFileDialog::fileSelected, dialog,
                   [this](const QString& file) { choose(path_of(file)); });
  dialog->open();
}

void MenuActions::choose(const std::filesystem::path& file) {
  auto read = interaction::read_element_file(file);
  if (!read)
    return hooks_.tell({.weight = Note::Weight::Error, .text = read.error().message, .topic = kMenuTopic});
  own_.reset();
  settings_.setValue(kMenuFileKey, QString::fromStdString(file.string()));
  session_.menu().close();
  toggle({});
}

base::Result<Element> MenuActions::element() const {
  if (own_) return *own_;
  const std::filesystem::path file = path_of(settings_.value(kMenuFileKey).toString());
  if (!file.empty()) return interaction::read_element_file(file);
  return interaction::read_element(kDesktopMenu, "the usual haptic menu");
}

QAction* MenuActions::command_of(const Widget& widget) const {
  return widget.command.empty() ? nullptr
                                : window_.findChild<QAction*>(QString::fromStdString(widget.command));
}

/// Items without anything to do are as their file says. A menu must be open.
std::optional<bool> MenuActions::is_possible(const Widget& widget) const {
  if (!widget.command.empty()) {
    const QAction* const command = command_of(widget);
    return command != nullptr && command->isEnabled();
  }
  const interaction::OperationCall call = session_.menu().use()->settings().call_of(widget);
  if (call.operation.empty()) return std::nullopt;
  const auto operation = interaction::find_operation(call.operation);
  // Shapes that were bent by hand have no sizes, and a ball has no width.
  const bool has_size = call.operation != "reshape" || widget.value_as.empty() ||
                        session_.selection().empty() || !present(widget).is_null();
  if (!operation || !has_size) return false;
  return asks_for_values(**operation, call.arguments) ||
         completed_fields(**operation, call.arguments, session_.selection()).has_value();
}

/// Items are ticked as the commands are that they do.
void MenuActions::take_ticks_over(std::vector<Widget>& widgets) const {
  for (Widget& widget : widgets) {
    if (const QAction* const command = command_of(widget); command && command->isCheckable())
      widget.checked = command->isChecked();
    take_ticks_over(widget.widgets);
  }
}

/// Says which items would do a command that the window has not got.
void MenuActions::tell_unknown_commands(const Element& element) const {
  std::vector<std::string> names;
  for (const QAction* const action : window_.findChildren<QAction*>())
    if (!action->objectName().isEmpty()) names.push_back(action->objectName().toStdString());
  std::vector<std::string> unknown;
  const auto look = [&](const auto& self, const std::vector<Widget>& widgets) -> void {
    for (const Widget& widget : widgets) {
      if (!widget.command.empty() && command_of(widget) == nullptr)
        unknown.push_back(fmt::format("item '{}': the window has no command '{}'{}", widget.name,
                                      widget.command, base::suggestion(widget.command, names)));
      self(self, widget.widgets);
    }
  };
  look(look, element.widgets);
  if (unknown.empty()) return;
  hooks_.tell({.weight = Note::Weight::Warning,
               .text = "The menu has items that do nothing.",
               .topic = kMenuTopic,
               .details = std::move(unknown)});
}

/// Says which letters are not seen.
void MenuActions::tell_boxes(const Element& element, const std::string& language) const {
  const std::string boxes =
      session::letters_without_font(element, interaction::language_of(element, language));
  if (boxes.empty()) return;
  hooks_.tell({.weight = Note::Weight::Warning,
               .text = fmt::format("Boxes in the menu stand for {}: no font here has these letters.", boxes),
               .topic = kMenuTopic});
}

void MenuActions::toggle(const session::MenuSpot& spot) {
  if (session_.menu().use() != nullptr) return session_.menu().close();
  auto made = element();
  if (made) {
    pops_up_ = made->place == interaction::ElementPlace::Pointer;
    take_ticks_over(made->widgets);
    tell_unknown_commands(*made);
    const std::string language = QLocale::system().name().section('_', 0, 0).toStdString();
    tell_boxes(*made, language);
    if (const auto opened = session_.menu().open(std::move(*made), language, spot); !opened)
      made = tl::unexpected(opened.error());
  }
  if (!made)
    return hooks_.tell({.weight = Note::Weight::Error, .text = made.error().message, .topic = kMenuTopic});
  refresh();
}

void MenuActions::refresh() {
  session_.menu().enable([this](const Widget& widget) { return is_possible(widget); });
  session_.menu().show_values([this](const Widget& widget) { return present(widget); });
}

/// The value that the first selected object has of what the widget changes; null: none.
interaction::Value MenuActions::present(const Widget& widget) const {
  if (widget.operation.empty() || widget.value_as.empty() || session_.selection().empty()) return {};
  return interaction::present_value(session_.world(), session_.selection().front(), widget.operation,
                                    widget.value_as);
}

/// Tries out what letting go would do; null: nothing is held any more.
void MenuActions::preview(const session::MenuChoice* choice) {
  if (choice == nullptr || choice->call.operation.empty()) {
    preview_.take_back();
    is_slow_ = false;
    return;
  }
  const auto operation = interaction::find_operation(choice->call.operation);
  if (!operation || is_slow_) return;
  const auto fields = completed_fields(**operation, choice->call.arguments, session_.selection());
  if (!fields || (!preview_.shown() && !hooks_.begin())) return;
  QElapsedTimer time;
  time.start();
  // A value that is refused is told when it is chosen.
  if (!preview_.show(**operation, *fields)) preview_.take_back();
  is_slow_ = time.elapsed() > kSlowPreview;
}

void MenuActions::hear(const session::MenuChoice& choice) {
  const interaction::ElementUse* const use = session_.menu().use();
  const bool is_answered = use != nullptr && use->element().kind == interaction::ElementKind::Dialog;
  if ((pops_up_ || is_answered) && choice.widget.widgets.empty() && choice.widget.kind == WidgetKind::Item)
    session_.menu().close();
  perform(choice);
  refresh();
}

void MenuActions::perform(const session::MenuChoice& choice) {
  if (QAction* const command = command_of(choice.widget)) return command->trigger();
  if (choice.call.operation.empty()) return;
  const auto operation = interaction::find_operation(choice.call.operation);
  if (!operation) return;
  const auto fields = completed_fields(**operation, choice.call.arguments, session_.selection());
  if (!fields) return hooks_.ask(**operation);
  if (!preview_.shown() && !hooks_.begin()) return;
  const auto done = preview_.shown() ? preview_.show(**operation, *fields)
                                     : perform_operation(session_, **operation, *fields);
  done ? preview_.keep() : preview_.take_back();
  if (!done)
    return hooks_.tell({.weight = Note::Weight::Error, .text = done.error().message, .topic = "edit"});
  if (!done->empty()) hooks_.tell({.text = *done, .topic = "edit"});
}

}  // namespace icome::ui
