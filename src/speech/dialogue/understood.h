#pragma once
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "speech/dialogue/draft.h"
#include "speech/dialogue/placing.h"
#include "speech/words/own_words.h"

namespace icome::speech {

/// The meaning of a sentence in its situation, before anything is done.
struct Understood {
  interaction::Value::Fields intent = {};  // {"op": ...}, for people and scripts: objects by name
  std::string reply = {};                  // a sentence for when it is done
  std::vector<ObjectId> objects = {};      // spoken of: made, changed or meant
  std::vector<ObjectId> created = {};
  std::string question = {};  // not empty: to be answered with yes before it is done
  /// Done before the edits of the draft, which are not made where it fails; none: nothing.
  std::function<base::Result<void>()> deed = nullptr;
};

/// Objects that the hand has taken by voice.
struct Held {
  std::vector<ObjectId> objects = {};
  bool turns = false;
  bool by_stage = false;  // it moves them; else they are moved when the hand lets go
  base::Pose world_from_pointer = base::Pose::Identity();  // when they were taken
};

/// A sentence as one reading of the grammar takes it, and all that an act needs to understand it.
struct Reading {
  const Command& command;
  const Phrase& phrase;  // of the command
  Situation situation;
  References& references;
  Draft& draft;
  Stage& stage;
  interaction::OperationTarget& target;
  OwnWords& own_words;
  Held& held;
  const std::set<std::string>& fixed_words;  // that mean something by themselves, whatever the design

  const world::World& world() const { return situation.world; }
  /// The objects of the sentence, or those that it is for where it names none.
  base::Result<std::vector<ObjectId>> objects();
  /// Why words cannot be a name or a word of one's own: they mean something already. Empty where they can.
  std::string why_no_name(const std::string& words) const;
  /// The part of the sentence by that rule. Fails where the vocabulary's form of the command has none.
  base::Result<const Phrase*> needed(std::string_view rule) const;
  /// The words of a part of the sentence.
  std::string words_of(const Phrase& part) const;
};

/// Understands a reading: by its act, or as an operation with parameters of the sentence.
base::Result<Understood> understand(Reading& reading);

/// "'seat'", "'seat' and 'leg'", "5 things".
std::string called_all(const world::World& world, const std::vector<ObjectId>& objects);
/// Their names, for JSON.
interaction::Value names_value(const world::World& world, const std::vector<ObjectId>& objects);
/// The text with a large first letter and a full stop.
std::string as_sentence(std::string text);

// The acts, in one source file for each group.
base::Result<Understood> act_create(Reading& reading);
base::Result<Understood> act_copy(Reading& reading);
base::Result<Understood> act_delete(Reading& reading);
base::Result<Understood> act_cut(Reading& reading);
base::Result<Understood> act_name(Reading& reading);
base::Result<Understood> act_scale(Reading& reading);
base::Result<Understood> act_move(Reading& reading);
base::Result<Understood> act_turn(Reading& reading);
base::Result<Understood> act_grab(Reading& reading);
base::Result<Understood> act_stop(Reading& reading);
base::Result<Understood> act_select(Reading& reading);
base::Result<Understood> act_deselect(Reading& reading);
base::Result<Understood> act_word(Reading& reading);
base::Result<Understood> act_forget(Reading& reading);
base::Result<Understood> act_words(Reading& reading);
base::Result<Understood> act_undo(Reading& reading);
base::Result<Understood> act_redo(Reading& reading);
base::Result<Understood> act_save(Reading& reading);
base::Result<Understood> act_view(Reading& reading);
base::Result<Understood> act_menu(Reading& reading);
base::Result<Understood> act_item(Reading& reading);
base::Result<Understood> act_close(Reading& reading);
base::Result<Understood> act_tell(Reading& reading);

}  // namespace icome::speech
