#pragma once
#include <QMenu>
#include <QSettings>
#include <filesystem>
#include <functional>
#include <optional>

#include "interaction/operations/operation.h"
#include "session/session.h"
#include "ui/forms/operation_preview.h"
#include "ui/window/note.h"

namespace icome::ui {

/// The haptic menu of the window: which one it is, opening it, and doing what is chosen from it. Its items do
/// operations on what is selected, or commands of the window by the names of their actions. Its values begin
/// as those of what is selected, and what is held in it is seen and felt before it is let go. Session,
/// settings and window outlive it.
class MenuActions {
 public:
  struct Hooks {
    std::function<bool()> begin;            // asked before the world is edited; false: do not
    std::function<void(const Note&)> tell;  // shows a note
    std::function<void(const interaction::Operation&)> ask;  // shows the form of an operation
  };
  MenuActions(session::Session& session, QSettings& settings, Hooks hooks, QWidget& window);
  MenuActions(const MenuActions&) = delete;
  MenuActions& operator=(const MenuActions&) = delete;

  /// Adds the entries to the menu of tools.
  void fill(QMenu& menu);
  /// Uses this menu instead of the one that was chosen before, as long as the program runs.
  void use(interaction::Element element) { own_ = std::move(element); }
  /// The menu that toggle() opens. Fails where its file cannot be read.
  base::Result<interaction::Element> element() const;
  /// Opens the menu there; the one that is open closes instead.
  void toggle(const session::MenuSpot& spot);
  /// Is the menu that toggle() opened one that lies over the scene where the pointer was?
  bool pops_up() const { return pops_up_; }
  /// Uses the menu of a file from now on; tells where that does not work.
  void choose(const std::filesystem::path& file);
  /// Enables the items of the open menu that can be done now. Call it where that may have changed.
  void refresh();

 private:
  std::optional<bool> is_possible(const interaction::Widget& widget) const;
  void tell_unknown_commands(const interaction::Element& element) const;
  void tell_boxes(const interaction::Element& element, const std::string& language) const;
  void take_ticks_over(std::vector<interaction::Widget>& widgets) const;
  void choose_file();
  void hear(const session::MenuChoice& choice);
  void perform(const session::MenuChoice& choice);
  void preview(const session::MenuChoice* choice);
  interaction::Value present(const interaction::Widget& widget) const;
  QAction* command_of(const interaction::Widget& widget) const;

  session::Session& session_;
  QSettings& settings_;
  Hooks hooks_;
  QWidget& window_;
  std::optional<interaction::Element> own_;
  bool pops_up_ = false;      // the open one
  OperationPreview preview_;  // of what is held in the menu
  bool is_slow_ = false;      // to preview what is held
};

}  // namespace icome::ui
