#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "haptics/servo/effect_feed.h"
#include "interaction/elements/element_use.h"

namespace icome::session {

/// The sheets of an element in use, as effects for a servo. A sheet that closes is felt until it has faded.
class FeltSheets {
 public:
  /// The effects get ids from this one on.
  explicit FeltSheets(std::uint64_t first_id = 1) : next_id_(first_id) {}

  /// Follows what is open at that time (s, never falls); null: nothing is. True: effects() are others now.
  bool follow(const interaction::ElementUse* use, double time);
  const std::vector<haptics::PlacedEffect>& effects() const { return effects_; }
  /// Closes all sheets at the next follow(), whatever is in use then.
  void let_go();
  /// Makes the grounds anew at the next follow(): widgets are enabled that were not, or the other way round.
  void outdate() { outdated_ = true; }

 private:
  struct Sheet {
    const interaction::Widget* opener;  // null: the element's own
    haptics::PlacedEffect effect = {};
    bool goes = false;                 // whatever is open
    std::optional<double> until = {};  // s, when it will have faded; none: it is open
  };

  Sheet* open_sheet(const interaction::Widget* opener);
  void bring_up_to_date(const interaction::ElementUse& use);
  static void close(Sheet& sheet, double time);

  std::vector<Sheet> sheets_;
  std::vector<haptics::PlacedEffect> effects_;
  std::uint64_t next_id_;
  bool outdated_ = false;
  std::uint64_t revision_ = 0;  // of the layout that is felt
};

}  // namespace icome::session
