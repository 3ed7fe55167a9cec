#pragma once
#include <functional>
#include <optional>
#include <string_view>

#include "base/result.h"
#include "session/elements/scene_menu.h"

namespace icome::session {

struct SessionParts;

/// The place at which a menu pops up (interaction::ElementPlace::Pointer): where a hand is, or along the way
/// that the mouse points; without either in the middle of the view.
struct MenuSpot {
  std::optional<std::size_t> hand = {};
  std::optional<interaction::Ray> way = {};
  double distance = 1.0;  // m, along that way
};

/// The menu that lies in the scene of a session, one at a time: hands, mouse and keys use it, and hands feel
/// it. Main's.
class SessionMenu {
 public:
  explicit SessionMenu(SessionParts& parts) : parts_(parts) {}
  SessionMenu(const SessionMenu&) = delete;
  SessionMenu& operator=(const SessionMenu&) = delete;

  /// Opens it, in that language or, where the element has not got it, in its first one; another menu closes.
  /// One that pops up faces the eye; as large as the hand that opens it moves or, without one, to be read.
  /// Fails without the font of its text, and for one that lies on a second hand where there is none.
  base::Result<void> open(interaction::Element element, std::string_view language, const MenuSpot& spot);
  void close();
  /// The open menu as it is; null: none is.
  const interaction::ElementUse* use() const;
  /// Calls `listener` on main, within Session::update(), with each thing that is chosen.
  void on_choice(std::function<void(const MenuChoice&)> listener);
  /// Calls `listener` likewise with the choice that would be made if a Slider, Number or Colour that is held
  /// were let go now, each time that it is another one; and with null when nothing is held any more, after
  /// what was chosen by letting go.
  void on_changing(std::function<void(const MenuChoice*)> listener);
  /// Calls `listener` likewise with what is wrong with a number that was typed.
  void on_trouble(std::function<void(const std::string&)> listener);
  void set_theme(ElementTheme theme);

  // All of the following are without effect while none is open.
  /// The mouse points along that way, stage frame, with its button down or not. True: it is on the menu.
  bool point(const interaction::Ray& way, bool button);
  /// Where that way meets the menu, m, stage frame.
  std::optional<base::Vector3> met_by(const interaction::Ray& way) const;
  void press(interaction::ElementKey key);
  /// Types into the number that is lit. False: none is, or the letter is of no number.
  bool type(char letter);
  /// Turns the wheel over the menu, > 0 away from the person. False: that way does not meet the menu.
  bool turn_wheel(const interaction::Ray& way, double notches);
  /// Chooses by a name or a text, as speech does. False: there is none of it that can be chosen.
  bool choose(std::string_view name_or_text);
  /// Enables widgets or not, as `is_enabled` says; nothing: it stays as it is.
  void enable(const std::function<std::optional<bool>(const interaction::Widget&)>& is_enabled);
  /// Sets values to what the world has, as `value_of` says; null: it stays as it is.
  void show_values(const std::function<interaction::Value(const interaction::Widget&)>& value_of);

 private:
  SessionParts& parts_;
};

}  // namespace icome::session
