#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "interaction/elements/element.h"
#include "session/session.h"
#include "speech/dialogue/dialogue.h"
#include "speech/hearing/wake_word.h"
#include "speech/listening/ear.h"
#include "speech/speaking/speaker.h"

namespace icome::session {

/// A sentence, and what came of it.
struct Spoken {
  speech::Answer answer = {};
  bool by_voice = false;
  double score = 0.0;    // speech::Heard::score, by voice
  double seconds = 0.0;  // by voice: from the end of speech, as it was noticed, to its meaning
};

/// The parts of a window that a conversation uses. All are called on main.
struct ConversationHooks {
  /// Asked before the world is edited; false: do not.
  std::function<bool()> begin = [] { return true; };
  /// The way that the mouse points; nothing: it is not over the scene.
  std::function<std::optional<interaction::Ray>()> mouse = [] { return std::nullopt; };
  std::function<void()> save = nullptr;          // none: it cannot
  std::function<void()> close_design = nullptr;  // none: it cannot
  /// The haptic menu that open_menu opens; none: there is no menu.
  std::function<base::Result<interaction::Element>()> menu = nullptr;
  std::function<void()> open_menu = [] {};
  speech::OpenLoudspeaker loudspeaker = speech::open_loudspeaker;
};

/// The ways in which a conversation listens, and answers.
struct ConversationWays {
  speech::Attention attention = speech::Attention::Always;
  /// That begins what is meant, where it always listens; none: all that is said is meant.
  std::optional<speech::WakeWord> wake_word = {};
  bool speaks = false;  // the replies; it hears nothing meanwhile
};

/// Talks with a person about the design of a session (thesis 7.4, 8.2): typed sentences, and spoken ones
/// while it listens. Left, right, in front and behind are those of the view; the hand is that of a device
/// or, without one, where the mouse points. Main's; the session outlives it.
class Conversation {
 public:
  Conversation(Session& session, ConversationHooks hooks);
  ~Conversation();
  Conversation(const Conversation&) = delete;
  Conversation& operator=(const Conversation&) = delete;

  /// Understands a sentence and does it; the listener of on_answer() is told, too.
  void say(const std::string& sentence);
  /// Listens from now on to this source; without one, not any more.
  void listen(speech::OpenSource source);
  bool listens() const;
  void set_ways(ConversationWays ways);
  const ConversationWays& ways() const;
  /// Is a key held down by which one talks? A held one ends what is being spoken. The second button of a hand
  /// is such a key, too, but for the techniques, which travel with it.
  void hold(bool is_held);
  /// Does it listen only while a key is held down?
  bool listens_while_held() const { return listens() && ways().attention == speech::Attention::WhileHeld; }
  speech::EarState ear() const;
  /// While it listens: understands what was heard, and keeps where the hand is. Call it once for each update
  /// of the session.
  void tick();
  /// Calls `listener` on main with each sentence that was understood, or was not.
  void on_answer(std::function<void(const Spoken&)> listener);
  /// The objects of the question "Which one?" that is open, in the order of their numbers.
  const std::vector<world::ObjectId>& candidates() const;
  /// Why words of one's own are not kept, or replies not heard; empty: they are.
  std::string problem() const;

 private:
  struct Parts;
  std::shared_ptr<Parts> parts_;
};

}  // namespace icome::session
