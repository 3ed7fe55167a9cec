#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "interaction/techniques/world_targets.h"
#include "speech/dialogue/stage.h"
#include "speech/dialogue/things.h"
#include "speech/grammar/grammar.h"

namespace icome::speech {

/// The viewer's frame: left, right, in front and behind are along the floor, whatever the tilt of the head.
struct ViewerAxes {
  explicit ViewerAxes(const interaction::View& view);
  Vector3 right, up, towards;  // unit, world frame; towards the viewer
  Vector3 eye;                 // m
};

/// The objects that were spoken of and made, the latest last. They may be gone by now.
struct Memory {
  std::vector<std::vector<ObjectId>> mentioned = {};
  std::vector<ObjectId> created = {};

  void mention(std::vector<ObjectId> objects);
};

/// A description that several objects fit.
struct Ambiguity {
  std::size_t begin = 0;                  // its first word, which tells it from others of the sentence
  std::vector<ObjectId> candidates = {};  // from left to right in the viewer's frame
  std::string noun = {};                  // as it was said: "green cone"
};

/// The objects that were chosen for descriptions, by their first word.
using Choices = std::map<std::size_t, std::vector<ObjectId>>;

/// Everything that a sentence's references are understood by. Refers to all of it.
struct Situation {
  const Vocabulary& vocabulary;
  const world::World& world;
  const Stage& stage;
  const Memory& memory;
  const std::vector<std::string>& words;              // of the sentence
  const std::function<double(std::size_t)>& time_of;  // s, of each word, for the hand at that moment
  const Choices& choices;
  interaction::WorldTargets& targets;  // of the design, for what the hand touches
};

/// Finds the objects that parts of a sentence mean (thesis 7.3, 7.4.2). One sentence.
class References {
 public:
  explicit References(const Situation& situation) : at_(situation), axes_(situation.stage.view()) {}

  /// The objects of a phrase of the rules objects, object, reference, pronoun, one or several, each once.
  /// Fails saying what there is not; where several fit, ambiguity() is set then, too.
  base::Result<std::vector<ObjectId>> objects(const Phrase& phrase);
  /// The single one; the first where a pronoun stands for several.
  base::Result<ObjectId> single(const Phrase& phrase);
  /// The objects that a command without any is for: the selection, what the hand touches, or what was spoken
  /// of. `word` is the word of the command.
  base::Result<std::vector<ObjectId>> unsaid(std::size_t word);
  /// The objects that look as a phrase of the rule many says; none where there are none.
  std::vector<ObjectId> alike(const Phrase& phrase);
  /// The things that lie as a phrase of the rule relation says. Fails as objects().
  base::Result<std::vector<ObjectId>> related(const Phrase& relation);
  /// The candidates that an answer to "Which one?" means. Fails where it is none of them.
  base::Result<std::vector<ObjectId>> answer(const Phrase& phrase, const std::vector<ObjectId>& candidates);

  /// The object that the hand touches, or points at, at the time of a word.
  std::optional<ObjectId> touched(std::size_t word);
  std::optional<ObjectId> pointed_at(std::size_t word);

  const std::optional<Ambiguity>& ambiguity() const { return ambiguity_; }
  const ViewerAxes& axes() const { return axes_; }

 private:
  using Found = base::Result<std::vector<ObjectId>>;

  Found object(const Phrase& phrase);
  Found pronoun(const Phrase& phrase);
  Found described(const Phrase& phrase, const Phrase* relation);
  Found named(const Phrase& phrase, const Phrase* relation);
  Found the_one(const Phrase& phrase, std::vector<ObjectId> fitting);
  Found several(const Phrase& phrase, std::vector<ObjectId> fitting);
  Found it() const;
  Found other_than_last() const;
  std::vector<ObjectId> selection() const;
  std::vector<ObjectId> last_mentioned() const;
  std::vector<ObjectId> last_created() const;

  std::vector<ObjectId> universe(const Phrase& phrase) const;
  base::Result<void> keep_related(std::vector<ObjectId>& objects, const Phrase& relation);
  void keep_looking_so(std::vector<ObjectId>& objects, const Phrase& looks) const;
  void keep_sized(std::vector<ObjectId>& objects, const std::string& size) const;
  bool is_called(ObjectId id, const std::string& noun) const;
  bool has_colour(ObjectId id, const std::string& colour) const;
  bool has_material(ObjectId id, const std::string& material) const;
  void keep_outermost(std::vector<ObjectId>& objects, const std::string& how, std::size_t count) const;
  void sort_from_left(std::vector<ObjectId>& objects) const;
  std::string noun_of(const Phrase& phrase) const;
  const interaction::TechniqueScene& targets() const { return at_.targets.of(at_.world); }

  Situation at_;
  ViewerAxes axes_;
  std::optional<Ambiguity> ambiguity_;
  std::optional<std::vector<ObjectId>> among_;  // the only objects to be meant
};

/// "Which one: the left or the right green cone?"
std::string question_of(const Ambiguity& ambiguity, const world::World& world, const ViewerAxes& axes);

/// The whole number or decimal that a phrase of the rule number says.
double number_of(const Phrase& phrase);

/// The side of one box on which another lies, as sentences say it: "left", "on", ... `axes` are the viewer's.
bool is_beside(const std::string& side, const Bounds& box, const Bounds& reference, const ViewerAxes& axes);

}  // namespace icome::speech
