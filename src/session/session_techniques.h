#pragma once
#include <optional>

#include "base/result.h"
#include "session/hands/technique_hand.h"

namespace icome::session {

class Session;
struct SessionParts;

/// The technique that the first two pointers of a session work by (thesis chapter 2). Main's.
class SessionTechniques {
 public:
  SessionTechniques(const Session& session, SessionParts& parts) : session_(session), parts_(parts) {}
  SessionTechniques(const SessionTechniques&) = delete;
  SessionTechniques& operator=(const SessionTechniques&) = delete;

  /// Selects, holds and travels with the first two pointers by this technique (thesis chapter 2) from now on,
  /// as TechniqueHand says; without one, by touch. Fails, and changes nothing, for sizes that cannot be.
  base::Result<void> set(const std::optional<interaction::Technique>& technique);
  /// The technique that is used, with its target, held object and marks; null while it is by touch.
  const TechniqueHand* current() const;
  /// The map from the world to the technique's miniature, where it shows one, stage frame.
  std::optional<base::Affine3> miniature() const;
  /// Records the technique's inputs from now on; it begins anew. Fails without a technique.
  base::Result<void> record();
  /// Ends the recording and gives it; nothing unless it records.
  std::optional<TechniqueHand::Recorded> stop_recording();

 private:
  const Session& session_;
  SessionParts& parts_;
};

}  // namespace icome::session
