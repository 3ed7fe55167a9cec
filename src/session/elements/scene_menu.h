#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "interaction/elements/element_use.h"
#include "interaction/navigation.h"
#include "session/elements/element_panels.h"
#include "session/elements/felt_sheets.h"

namespace icome::session {

/// Something that was chosen from a menu in the scene, with its new setting.
struct MenuChoice {
  interaction::Widget widget;
  interaction::ChosenBy by = interaction::ChosenBy::Click;
  bool checked = false;                  // of Check and Radio
  double value = 0.0;                    // of Slider and Number
  interaction::OperationCall call = {};  // what it does, with its value
};

/// A hand at one moment, in the frame of the stage.
struct MenuTick {
  std::size_t hand = 0;
  interaction::ElementPointer at;
};

/// A haptic element that is open in a scene: what hands, mouse and keys do to it, what is felt of it, and its
/// picture. One thread (main) uses it; it knows no clock. Times are in seconds, and never fall.
class SceneMenu {
 public:
  /// The effects of its sheets have ids from this one on, which no object has.
  static constexpr std::uint64_t kFirstSheet = std::uint64_t(1) << 62;

  /// Opens the element in one of its languages; what was open is closed.
  void open(interaction::Element element, std::size_t language, interaction::TextMeasure measure,
            const interaction::ElementFrame& frame);
  void close();
  /// Is it open, and chosen from by looking? Hands neither use nor feel it then.
  bool is_looked_at() const { return use_ && use_->element().choosing.by_look; }
  /// The open element; null: none is.
  const interaction::ElementUse* use() const { return use_ ? &*use_ : nullptr; }

  // The following only while it is open.
  void place(const interaction::ElementFrame& frame) { use_->place(frame); }
  /// ElementUse::keep_within().
  void keep_within(const interaction::LaidBox& room) { use_->keep_within(room); }
  /// Takes the hands' ticks since the last call, in order, and lets time pass. The hand that is near uses the
  /// menu, as long as it stays near.
  std::vector<MenuChoice> take(std::span<const MenuTick> ticks, double now);
  /// The mouse points along that way: it counts as a pointer close to the plane. Nothing is chosen while its
  /// way meets no sheet; see met_by(). What it holds it keeps beside the sheets, too.
  std::optional<MenuChoice> point_by_mouse(const interaction::Ray& way, bool button, double now);
  /// The place where a way meets a sheet, stage frame; nothing: it meets none.
  std::optional<base::Vector3> met_by(const interaction::Ray& way) const;
  /// Does the mouse hold something, wherever it points?
  bool is_held_by_mouse() const { return presses_ && attended_ && use_->is_holding(); }
  /// As take(), for an element that is chosen from by looking: the eye looks along that way, and the first
  /// hand that presses its button holds it. A mouse that has pointed at the element stands for the eye until
  /// the eye looks elsewhere.
  std::vector<MenuChoice> look(const interaction::Ray& gaze, std::span<const MenuTick> ticks, double now);
  std::optional<MenuChoice> press(interaction::ElementKey key);
  /// ElementUse::type().
  bool type(char letter);
  /// ElementUse::turn_wheel().
  std::optional<MenuChoice> turn_wheel(double notches);
  std::optional<MenuChoice> choose(std::string_view name_or_text);
  /// Enables the widgets of the names in question, or not; others stay as they are.
  void enable(const std::function<std::optional<bool>(const interaction::Widget&)>& is_enabled);
  /// Sets values to what the world has, such as the colour of what is selected; null: it stays as it is.
  void show_values(const std::function<interaction::Value(const interaction::Widget&)>& value_of);
  /// The choice that letting go of a held Slider, Number or Colour would make; nothing: none is held.
  std::optional<MenuChoice> changing() const;
  /// The hand that uses it; none: none does.
  std::optional<std::size_t> hand() const { return hand_; }

  /// FeltSheets::follow(); also after close(), until all has faded.
  bool follow(double now) { return sheets_.follow(is_looked_at() ? nullptr : use(), now); }
  const std::vector<haptics::PlacedEffect>& effects() const { return sheets_.effects(); }
  /// Draws what has changed; true: panels() are others now.
  bool draw(ElementTheme theme);
  const std::vector<render::SceneOverlay::Panel>& panels() const { return panels_; }

 private:
  std::optional<base::Vector3> plane_met_by(const interaction::Ray& way) const;
  std::uint64_t looks(ElementTheme theme) const;
  std::optional<std::size_t> nearest_hand(std::span<const MenuTick> ticks) const;
  std::optional<MenuChoice> told(const std::optional<interaction::Choice>& choice) const;

  interaction::Element element_;
  std::optional<interaction::ElementUse> use_;  // refers to element_
  FeltSheets sheets_{kFirstSheet};
  std::vector<ElementPart> parts_;
  render::SceneOverlay::Panel mark_ = {.picture = {}, .in_window = {0.5, 0.5}};  // where the eye looks
  std::vector<render::SceneOverlay::Panel> panels_;
  std::uint64_t drawn_ = 0;  // looks() of the pictures
  std::optional<std::size_t> hand_ = {};
  double heard_ = 0.0;          // s, of the newest tick
  bool attended_ = false;       // by mouse or keys
  bool presses_ = false;        // the button of the mouse, or of the hand that looks, is down
  interaction::Ray gaze_ = {};  // of the last look
};

}  // namespace icome::session
