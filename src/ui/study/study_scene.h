#pragma once
#include <QElapsedTimer>
#include <QWidget>

#include "study/run/trial_stage.h"
#include "ui/study/study_words.h"
#include "ui/tools/scene_tools.h"
#include "ui/window/scene_view.h"

class QLabel;

namespace icome::ui {

/// The scene of the trials, under a line that tells what to do. Mouse, pen and keys drive the hand, and only
/// while a trial runs. The session outlives it.
class StudyScene final : public QWidget {
 public:
  StudyScene(session::Session& session, const StudyWords& words, QWidget* parent);
  ~StudyScene() override;

  /// Shows which trial it is: "Trial 3 of 15".
  void show_trial(const QString& which) const;
  /// Shows what to do at this stage.
  void show_stage(const study::TrialStage& stage);
  /// Is there a picture?
  bool is_drawn() { return !view_->window_of_scene().renderer().isEmpty(); }

  /// To be called once for each update of the session: move_hand() before it, tick() after it.
  void move_hand();
  void tick() { view_->tick(); }
  void take_keyboard() { view_->take_keyboard(); }

 private:
  void say(const QString& what, bool loud);
  void say_what_to_do(const study::TrialStage& stage);
  void put_mouse(const base::Vector3& place);

  session::Session& session_;
  StudyWords words_;
  SceneTools tools_;
  QWidget* bar_;
  QLabel* line_;
  QLabel* trial_;
  SceneView* view_;
  study::TrialStage::State state_ = study::TrialStage::State::Idle;
  QElapsedTimer started_;  // since the start of the trial; invalid before the first
};

}  // namespace icome::ui
