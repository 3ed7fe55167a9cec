#include "ui/study/study_scene.h"

#include <QCursor>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <cmath>
#include <utility>

#include "ui/look/theme.h"

namespace icome::ui {

using State = study::TrialStage::State;

namespace {

constexpr int kFlash = 700;  // ms; time for which the start is shown

}  // namespace

StudyScene::StudyScene(session::Session& session, const StudyWords& words, QWidget* parent)
    : QWidget(parent),
      session_(session),
      words_(words),
      tools_(session, {}),
      bar_(new QWidget(this)),
      line_(new QLabel(bar_)),
      trial_(new QLabel(bar_)),
      view_(new SceneView(session, tools_, this)) {
  auto* mouse =
      new QLabel(session.hands().is_mouse_driven() ? words_(StudyWord::MouseKeys) : QString(), bar_);
  mouse->setTextFormat(Qt::PlainText);
  mouse->setForegroundRole(QPalette::PlaceholderText);
  line_->setObjectName("study.line");
  line_->setTextFormat(Qt::PlainText);
  line_->setAlignment(Qt::AlignCenter);
  QFont font = line_->font();
  font.setPointSizeF(1.2 * font.pointSizeF());
  font.setWeight(QFont::DemiBold);
  line_->setFont(font);
  trial_->setObjectName("study.trial");
  trial_->setForegroundRole(QPalette::PlaceholderText);
  auto* along = new QHBoxLayout(bar_);
  along->setContentsMargins(6 * kGrid, 2 * kGrid, 6 * kGrid, 2 * kGrid);
  along->addWidget(mouse, 1);
  along->addWidget(line_, 2);
  along->addWidget(trial_, 1, Qt::AlignRight);
  bar_->setAutoFillBackground(true);
  bar_->setFixedHeight(QFontMetrics(font).height() + 6 * kGrid);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  rows->addWidget(bar_);
  rows->addWidget(view_, 1);
  tools_.stay_with(Tool::Touch);
}

StudyScene::~StudyScene() {
  // The scene's window hands events to the tools, which are destroyed before child widgets would be.
  delete view_;
}

void StudyScene::show_trial(const QString& which) const { trial_->setText(which); }

void StudyScene::say(const QString& what, bool loud) {
  if (line_->text() != what) line_->setText(what);
  const auto ground = loud ? QPalette::Highlight : QPalette::Window;
  if (bar_->backgroundRole() == ground) return;
  bar_->setBackgroundRole(ground);
  line_->setForegroundRole(loud ? QPalette::HighlightedText : QPalette::WindowText);
}

void StudyScene::say_what_to_do(const study::TrialStage& stage) {
  if (state_ == State::Loading || stage.awaits_ear()) return say(words_(StudyWord::Loading), false);
  if (state_ == State::Seeking) return say(words_(StudyWord::BringPointer), false);
  if (state_ == State::Holding)
    return say(words_(StudyWord::HoldStill).arg(int(std::ceil(stage.hold_left()))), false);
  const bool flashes = state_ == State::Running && started_.elapsed() < kFlash;
  say(flashes ? words_(StudyWord::Start) : QString(), flashes);
}

void StudyScene::show_stage(const study::TrialStage& stage) {
  const bool is_new = stage.state() != std::exchange(state_, stage.state());
  if (is_new && state_ == State::Running) started_.start();
  if (is_new && session_.hands().is_mouse_driven()) {
    // So the mouse has room on all sides when the trial starts, and begins where the hand does.
    if (state_ == State::Seeking || state_ == State::Holding) put_mouse(stage.start());
    tools_.touch_tool().go_freely(state_ == State::Running ? std::optional(stage.start()) : std::nullopt);
  }
  say_what_to_do(stage);
}

/// Moves the mouse to where `place` is seen; without effect where the display does not allow it.
void StudyScene::put_mouse(const base::Vector3& place) {
  SceneWindow& window = view_->window_of_scene();
  const QSizeF scene(std::max(1, window.width()), std::max(1, window.height()));
  const QSizeF size = eye_size(scene, tools_.stereo());
  const base::Vector3 seen = session_.view().now().world_from_eye.inverse() * place;
  const Eigen::Vector2d half = interaction::half_picture(session_.view().now(), tools_.aspect());
  if (seen.z() >= 0.0) return;  // behind the eye
  const Eigen::Vector2d at = (seen.head<2>() / -seen.z()).cwiseQuotient(half);
  const QPointF pixel(0.5 * (1.0 + at.x()) * size.width(), 0.5 * (1.0 - at.y()) * size.height());
  if (!QRectF(QPointF(), size).contains(pixel)) return;
  QCursor::setPos(window.mapToGlobal(in_scene(pixel, scene, tools_.stereo()).toPoint()));
}

void StudyScene::move_hand() {
  session_.view().set_aspect(tools_.aspect());
  if (state_ == State::Running) return tools_.tick();
  tools_.touch_tool().take_press();  // a click from before the start does not count
  session_.hands().hold_buttons(0);
}

}  // namespace icome::ui
