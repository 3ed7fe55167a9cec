#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "interaction/navigation.h"
#include "world/world.h"

namespace icome::speech {

using base::Vector3;
using world::ObjectId;

/// The hand that sentences point with, in the world's frame.
struct Pointer {
  base::Pose world_from_pointer = base::Pose::Identity();  // its tip (m); it points along -z
};

/// The words of an item of a menu, and whether it opens a menu of its own.
struct MenuWords {
  std::string words;
  std::string item;  // its name for choose_item()
  bool opens = false;
};

/// What a stage can do; what it cannot is refused when it is said.
struct StageAbilities {
  bool saves = false, closes = false, goes = false, has_menu = false;
  bool has_window = false;  // which asks before work is lost, and tells when it is saved
};

/// All that sentences refer to and act on beside the design itself: the person's view and hand, what is
/// selected, files and menus. One thread uses it.
class Stage {
 public:
  virtual ~Stage() = default;

  /// The view in whose frame left, right, in front and behind are.
  virtual interaction::View view() const { return {}; }
  /// The hand at a time (s, the clock of the sentences); none: there is no hand, or it was not there then.
  virtual std::optional<Pointer> pointer(double) const { return std::nullopt; }

  virtual std::vector<ObjectId> selection() const = 0;
  virtual void select(const std::vector<ObjectId>& objects) = 0;

  /// The hand moves the objects, or (true) turns them, from now until let_go(). False: the stage cannot, and
  /// the dialogue moves them by itself where the hand is when it is told to stop.
  virtual bool take(const std::vector<ObjectId>&, bool) { return false; }
  virtual void let_go() {}

  virtual StageAbilities abilities() const { return {}; }
  virtual base::Result<void> save() { return {}; }
  virtual base::Result<void> close_design() { return {}; }
  /// Goes to the place of an object: a viewpoint, or before a thing.
  virtual base::Result<void> go_to(ObjectId) { return {}; }

  /// The items of the menu that is open, and of those near the hand; none where none is open.
  virtual std::vector<MenuWords> menu_items() const { return {}; }
  /// The submenus that can be opened by name.
  virtual std::vector<MenuWords> submenus() const { return {}; }
  virtual base::Result<void> open_menu(const std::string&) { return {}; }
  virtual base::Result<void> choose_item(const std::string&) { return {}; }
  virtual bool close_menu() { return false; }
};

}  // namespace icome::speech
