#pragma once
#include <functional>
#include <optional>
#include <string>

#include "apps/speech/speech_options.h"
#include "apps/status_line.h"
#include "files/design.h"
#include "interaction/operations/operation_runner.h"
#include "speech/dialogue/dialogue.h"

namespace icome::apps {

/// A hand that a file or an option tells of, each row from its time on.
struct HandPath {
  struct Row {
    double time;  // s
    speech::Pointer pointer;
  };
  std::vector<Row> rows;  // in the order of their times

  /// Nothing before the first row.
  std::optional<speech::Pointer> at(double time) const;
};

/// The hand of "x,y,z" or "x,y,z,dx,dy,dz", at all times. Fails for other text.
base::Result<HandPath> hand_from_text(const std::string& text);
/// The hand of a CSV file t,x,y,z or t,x,y,z,dx,dy,dz. Fails with file and line.
base::Result<HandPath> hand_from_file(const std::filesystem::path& file);

/// A person without a window: what is selected, and a hand, if there is one.
class TextStage final : public speech::Stage {
 public:
  HandPath hand;
  /// Saves the design; null: there is no file to save to.
  std::function<base::Result<void>()> saving;

  std::optional<speech::Pointer> pointer(double time) const override { return hand.at(time); }
  std::vector<world::ObjectId> selection() const override { return selection_; }
  void select(const std::vector<world::ObjectId>& objects) override { selection_ = objects; }
  speech::StageAbilities abilities() const override { return {.saves = bool(saving)}; }
  base::Result<void> save() override { return saving(); }

 private:
  std::vector<world::ObjectId> selection_;
};

/// The built-in vocabulary with those that are added. Fails with file and line.
base::Result<speech::Vocabulary> vocabulary_of(const TalkOptions& talk);

/// A talk without a window about a design, with all that it refers to. Stays where it was made.
class Talk {
 public:
  /// Reads all that the options name. Fails with the first thing that cannot be read.
  static base::Result<std::unique_ptr<Talk>> open(const TalkOptions& options, StatusLine& status);
  Talk(const Talk&) = delete;
  Talk& operator=(const Talk&) = delete;

  TextStage& stage() { return stage_; }
  speech::Dialogue& dialogue() { return dialogue_; }
  const world::World& world() const { return runner_.world(); }

  /// A new talk about the design as it is, which this one does not follow.
  std::unique_ptr<Talk> beginning() const;

  /// Writes the design; a file that would lose something only with `force`. Tells what the format cannot
  /// hold.
  base::Result<void> save(const std::filesystem::path& out, bool force) const;

 private:
  Talk(const TalkOptions& options, const files::LoadedDesign& design, speech::Vocabulary vocabulary,
       speech::OwnWords own_words);

  TalkOptions options_;
  files::LoadedDesign file_;  // as it was read
  speech::Vocabulary vocabulary_;
  interaction::OperationRunner runner_;
  TextStage stage_;
  speech::OwnWords own_words_;
  speech::Dialogue dialogue_;
};

}  // namespace icome::apps
