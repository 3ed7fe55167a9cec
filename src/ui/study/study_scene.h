#pragma once
#include <QElapsedTimer>
#include <QWidget>

#include "study/run/trial_stage.h"
#include "ui/study/study_words.h"
#include "ui/tools/scene_tools.h"
#include "ui/window/scene_view.h"

class QLabel;

namespace icome::ui {

/// The scene that trials take place in, under a line that says what to do. Mouse, pen and keys drive the
/// hand, and only while a trial runs. The session outlives it.
class StudyScene final : public QWidget {
 public:
  StudyScene(session::Session& session, const StudyWords& words, QWidget* parent);
  ~StudyScene() override;

  /// Which trial it is: "Trial 3 of 15".
  void show_trial(const QString& which) const;
  /// What to do, as the stage is now.
  void show_stage(const study::TrialStage& stage);
  /// Is there a picture?
  bool is_drawn() { return !view_->window_of_scene().renderer().isEmpty(); }

  /// Once for each update of the session: before it, and after.
  void move_hand();
  void tick() { view_->tick(); }
  void take_keyboard() { view_->take_keyboard(); }

 private:
  void say(const QString& what, bool loud);
  void say_what_to_do(double hold_left);
  void put_mouse(const base::Vector3& place);

  session::Session& session_;
  StudyWords words_;
  SceneTools tools_;
  QWidget* bar_;
  QLabel* line_;
  QLabel* trial_;
  SceneView* view_;
  study::TrialStage::State state_ = study::TrialStage::State::Idle;
  QElapsedTimer started_;  // invalid: the start is not to be seen any more
};

}  // namespace icome::ui
