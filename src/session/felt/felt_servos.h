#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "haptics/servo/servo.h"

namespace icome::session {

/// The servos that feel one world, which may come and go: what is published is felt by all that are there,
/// and by those that come later. Any thread but the servo's: a call may wait for another one to end. The
/// servos are the caller's, and stay until they are taken out.
class FeltServos {
 public:
  /// Adds a servo before the one at that place, and lets it feel what was published last.
  void add(haptics::Servo& servo, std::size_t place);
  /// Takes it out: nothing is published to it after this.
  void remove(const haptics::Servo& servo);

  void publish(const std::shared_ptr<const haptics::HapticScene>& scene);
  void publish_effects(const std::vector<haptics::PlacedEffect>& effects);
  /// Publishes the sheets of a menu, which are felt besides the world's effects.
  void publish_menu(const std::vector<haptics::PlacedEffect>& sheets);
  /// Servo::capped_effects() of the first one, without those of a menu.
  std::vector<haptics::CappedEffect> capped_effects() const;

 private:
  std::vector<haptics::PlacedEffect> all_effects() const;

  mutable std::mutex mutex_;  // of all that follows
  std::vector<haptics::Servo*> servos_;
  std::shared_ptr<const haptics::HapticScene> scene_;  // null: none yet
  std::vector<haptics::PlacedEffect> effects_;
  std::vector<haptics::PlacedEffect> menu_;
};

}  // namespace icome::session
