#include "session/speech/conversation.h"

#include <utility>

#include "interaction/operations/operation_runner.h"
#include "session/speech/spoken_stage.h"
#include "speech/hearing/likely_meant.h"
#include "speech/words/own_words.h"

namespace icome::session {
namespace {

using base::Result;
using speech::Dialogue;

constexpr int kTalkButton = 1;
constexpr const char* kBusy = "something else in the window must be finished first";

/// The world of a session, each sentence an action of its history.
class SpokenTarget final : public interaction::OperationTarget {
 public:
  SpokenTarget(Session& session, const ConversationHooks& hooks) : session_(session), hooks_(hooks) {}

  const world::World& world() const override { return session_.world(); }
  world::IdSource& ids() override { return session_.ids(); }
  Result<void> act(const world::Edit& edit, const std::string& title) override {
    if (!hooks_.begin()) return base::fail(kBusy);
    return session_.history().perform(edit, title);
  }
  Result<void> undo() override { return hooks_.begin() ? session_.history().undo() : base::fail(kBusy); }
  Result<void> redo() override { return hooks_.begin() ? session_.history().redo() : base::fail(kBusy); }
  bool can_undo() const override { return session_.history().can_undo(); }
  bool can_redo() const override { return session_.history().can_redo(); }

 private:
  Session& session_;
  const ConversationHooks& hooks_;
};

/// Words of one's own, and why they are not kept.
std::pair<speech::OwnWords, std::string> usual_words() {
  std::pair<speech::OwnWords, std::string> made;
  if (auto words = speech::OwnWords::open(speech::OwnWords::usual_file()))
    made.first = std::move(*words);
  else
    made.second = words.error().message;
  return made;
}

}  // namespace

struct Conversation::Parts {
  Parts(Session& the_session, ConversationHooks the_hooks)
      : session(the_session),
        hooks(std::move(the_hooks)),
        target(session, hooks),
        stage(session, hooks),
        words(usual_words()) {}

  /// Nothing was spoken of yet.
  void begin() {
    is_another = false;
    dialogue = std::make_unique<Dialogue>(*speech::built_in_vocabulary(), target, stage, words.first);
    candidates.clear();
    is_new = true;
  }

  Dialogue& talk() {
    if (!dialogue || is_another) begin();
    return *dialogue;
  }

  void answer(Spoken spoken) {
    candidates = spoken.answer.candidates;
    // As any operation does, it leaves selected what it made or changed.
    if (!spoken.answer.operations.empty() && !spoken.answer.objects.empty())
      session.select(spoken.answer.objects);
    is_new = true;
    // Nobody is talked over who holds the key.
    if (ways.speaks && !is_held && !spoken.answer.reply.empty()) speak(spoken.answer.reply);
    listener(spoken);
  }

  void speak(const std::string& reply) {
    if (!speaker) speaker = std::make_unique<speech::Speaker>(hooks.loudspeaker);
    speaker->say(reply);
    follow_speaker();
  }

  /// Hears nothing while it speaks; a question of its own is answered without the wake word.
  void follow_speaker() {
    if (!speaker) return;
    const bool is_about = speaker->is_about();
    if (is_about && ways.wake_word && talk().asks()) ways.wake_word->stay_awake(speech::clock_of_ears());
    if (ear) ear->mute(is_about && !is_held);
  }

  /// The word that begins what is meant now; null: all is meant.
  speech::WakeWord* wake_word() {
    return ways.wake_word && ways.attention == speech::Attention::Always ? &*ways.wake_word : nullptr;
  }

  /// Is the button to talk with down at this hand? It counts where the hand is there, and is not its clutch.
  bool is_button_down(std::size_t hand) const {
    const PointerView& pointer = session.hands().pointer(hand);
    if (pointer.status == devices::DeviceStatus::Lost || (pointer.buttons >> kTalkButton & 1U) == 0)
      return false;
    const auto mapping = session.hands().use(hand).mapping;
    return !mapping || mapping->clutch_button != kTalkButton;
  }

  /// Does any hand talk? A technique travels with that button.
  bool is_button_down() const {
    const SessionHands& hands = session.hands();
    if (session.techniques().current()) return false;
    for (std::size_t i = 0; i < hands.pointers(); ++i)
      if (hands.mouse() != i && is_button_down(i)) return true;
    return false;
  }

  void follow_keys() {
    const bool held = is_key_held || (ways.attention == speech::Attention::WhileHeld && is_button_down());
    if (std::exchange(is_held, held) == held) return;
    ear->hold(held);
    if (held && speaker) speaker->stop();
  }

  void understand(const speech::HeardUtterance& utterance) {
    auto [done, heard, is_addressed] = speech::understand_utterance(
        talk(), utterance.sentences, utterance.begin, utterance.end, {}, wake_word());
    if (is_addressed) answer({std::move(done), true, heard ? heard->score : 0.0, utterance.seconds});
  }

  /// Tells the ear what can be said now, where that may have changed; seldom, as it learns it anew each time.
  void follow() {
    constexpr double kSeldom = 0.5;  // s
    const double time = speech::clock_of_ears();
    if (!is_new || time < told_at + kSeldom) return;
    is_new = false;
    told_at = time;
    speech::HeardRules rules{Dialogue::kSentence, Dialogue::kUsualSentence};
    speech::Grammar grammar = talk().vocabulary().grammar;
    if (const speech::WakeWord* const word = wake_word()) {
      grammar = word->with_word(grammar, rules);
      rules = speech::WakeWord::kRules;
    }
    std::string text = grammar.jsgf(rules.sentence, "icome");
    if (text == told) return;
    told = std::move(text);
    ear->expect(std::move(grammar), std::string(rules.sentence), std::string(rules.usual));
  }

  Session& session;
  ConversationHooks hooks;
  SpokenTarget target;
  SpokenStage stage;
  std::pair<speech::OwnWords, std::string> words;
  std::unique_ptr<Dialogue> dialogue;  // null before the first sentence
  ConversationWays ways;
  std::unique_ptr<speech::Ear> ear;          // null: it does not listen
  std::unique_ptr<speech::Speaker> speaker;  // null: it has not spoken
  bool is_key_held = false;
  bool is_held = false;  // a key or a button
  std::function<void(const Spoken&)> listener = [](const Spoken&) {};
  std::vector<world::ObjectId> candidates;
  bool is_another = false;  // is there another design than the one that was spoken of?
  bool is_new = true;       // may something else be said than what the ear was told?
  bool had_menu = false;    // at the last tick
  std::string told;         // the grammar that the ear was told
  double told_at = -1e9;    // s
};

Conversation::Conversation(Session& session, ConversationHooks hooks)
    : parts_(std::make_shared<Parts>(session, std::move(hooks))) {
  // The session keeps its listeners as long as it lives, which is longer.
  session.on_change([parts = std::weak_ptr<Parts>(parts_)](const world::Changes* changes) {
    const auto there = parts.lock();
    if (!there) return;
    there->is_new = true;
    if (changes != nullptr) return;
    there->is_another = true;
    there->candidates.clear();
  });
}

Conversation::~Conversation() = default;

void Conversation::say(const std::string& sentence) {
  parts_->stage.keep_hand(speech::clock_of_ears());
  parts_->answer({.answer = parts_->talk().hear(sentence, {.now = speech::clock_of_ears()})});
}

void Conversation::listen(speech::OpenSource source) {
  parts_->ear.reset();
  parts_->told.clear();
  parts_->told_at = -1e9;
  parts_->is_new = true;
  parts_->is_held = false;
  if (!source) return;
  parts_->ear =
      std::make_unique<speech::Ear>(std::move(source), [] { return speech::make_sphinx_recogniser(); });
  parts_->ear->attend(parts_->ways.attention);
}

void Conversation::set_ways(ConversationWays ways) {
  parts_->ways = std::move(ways);
  parts_->is_new = true;
  if (parts_->ear) parts_->ear->attend(parts_->ways.attention);
  if (!parts_->ways.speaks && parts_->speaker) parts_->speaker->stop();
}

const ConversationWays& Conversation::ways() const { return parts_->ways; }

void Conversation::hold(bool is_held) { parts_->is_key_held = is_held; }

bool Conversation::listens() const { return parts_->ear != nullptr; }

speech::EarState Conversation::ear() const { return parts_->ear ? parts_->ear->state() : speech::EarState(); }

void Conversation::tick() {
  if (!parts_->ear) return;
  parts_->stage.keep_hand(speech::clock_of_ears());
  const bool has_menu = parts_->session.menu().use() != nullptr;
  if (std::exchange(parts_->had_menu, has_menu) != has_menu) parts_->is_new = true;
  parts_->follow_keys();
  parts_->follow_speaker();
  parts_->follow();
  for (const speech::HeardUtterance& utterance : parts_->ear->take()) parts_->understand(utterance);
}

void Conversation::on_answer(std::function<void(const Spoken&)> listener) {
  parts_->listener = std::move(listener);
}

const std::vector<world::ObjectId>& Conversation::candidates() const { return parts_->candidates; }

std::string Conversation::problem() const {
  if (!parts_->words.second.empty() || !parts_->speaker || !parts_->ways.speaks) return parts_->words.second;
  return parts_->speaker->problem();
}

}  // namespace icome::session
