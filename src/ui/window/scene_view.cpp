#include "ui/window/scene_view.h"

#include <QApplication>
#include <QLabel>
#include <QPushButton>
#include <QScreen>
#include <QStackedLayout>
#include <QVBoxLayout>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr int kReasonWidth = 90 * kGrid;

}  // namespace

SceneView::SceneView(session::Session& session, SceneTools& tools, QWidget* parent)
    : QWidget(parent),
      session_(session),
      tools_(tools),
      scene_(new SceneWindow(tools, session.view().display())),
      container_(createWindowContainer(scene_, this)),
      stack_(new QStackedLayout(this)) {
  setObjectName("scene");
  container_->setObjectName("scene.container");
  container_->setAccessibleName("Scene");
  container_->setFocusPolicy(Qt::StrongFocus);
  container_->setMinimumSize(160, 120);
  stack_->addWidget(container_);
  make_reason();
}

void SceneView::make_reason() {
  auto* page = new QWidget(this);
  auto* rows = new QVBoxLayout(page);
  rows->setSpacing(4 * kGrid);
  sign_ = new QLabel(page);
  sign_->setObjectName("scene.sign");
  draw_sign();
  reason_ = new QLabel(page);
  reason_->setObjectName("scene.reason");
  reason_->setTextFormat(Qt::PlainText);
  reason_->setWordWrap(true);
  reason_->setAlignment(Qt::AlignCenter);
  reason_->setFixedWidth(kReasonWidth);
  reason_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  again_ = new QPushButton("Try Again", page);
  again_->setObjectName("scene.retry");
  connect(again_, &QPushButton::clicked, this, [this] {
    stack_->setCurrentWidget(container_);
    scene_->retry();
  });
  rows->addStretch();
  rows->addWidget(sign_, 0, Qt::AlignHCenter);
  rows->addWidget(reason_, 0, Qt::AlignHCenter);
  rows->addWidget(again_, 0, Qt::AlignHCenter);
  rows->addStretch();
  stack_->addWidget(page);
}

void SceneView::tick() {
  show_cursor();
  tell_screen();
  const auto why = scene_->trouble();
  if (!why) return;
  reason_->setText(QString::fromStdString(*why) + "\n\nEverything else works meanwhile: nothing is lost.");
  reason_->setFixedHeight(reason_->heightForWidth(kReasonWidth));
  stack_->setCurrentIndex(1);
}

/// Tells the session how large the picture of an eye is on the display, for the view through a window.
void SceneView::tell_screen() {
  const QScreen* const screen = scene_->screen();
  if (!screen || screen->size().isEmpty()) return;
  constexpr double kMillimetre = 0.001;
  base::Vector2 display(kMillimetre * screen->physicalSize().width(),
                        kMillimetre * screen->physicalSize().height());
  display = session_.view().display_size().value_or(display);
  const QSizeF picture = eye_size(scene_->size(), tools_.stereo());
  session_.view().set_screen({display.x() * picture.width() / screen->size().width(),
                              display.y() * picture.height() / screen->size().height()});
}

void SceneView::show_cursor() {
  Qt::CursorShape shape = Qt::ArrowCursor;
  if (tools_.tool() == Tool::Touch) {
    shape = Qt::BlankCursor;  // the hand is shown in its place
  } else if (tools_.dragging() || tools_.turning()) {
    shape = Qt::ClosedHandCursor;
  } else if (tools_.tool() == Tool::View) {
    shape = Qt::OpenHandCursor;
  }
  if (scene_->cursor().shape() != shape) scene_->setCursor(shape);
}

bool SceneView::eventFilter(QObject* of, QEvent* event) {
  const bool key = event->type() == QEvent::KeyPress || event->type() == QEvent::KeyRelease ||
                   event->type() == QEvent::ShortcutOverride;
  if (!key || of != window() || !has_keyboard()) return QWidget::eventFilter(of, event);
  // The window manager gives the keyboard to the whole window if the scene had it before.
  QCoreApplication::sendEvent(scene_, event);
  return event->isAccepted();
}

void SceneView::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  window()->installEventFilter(this);
}

/// Draws the warning sign in the theme's colours, as sharp as the screen.
void SceneView::draw_sign() { sign_->setPixmap(icon(Icon::Warning).pixmap(12 * kGrid, 12 * kGrid)); }

void SceneView::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && sign_) draw_sign();
}

void SceneView::take_keyboard() {
  if (again_->isVisible()) return again_->setFocus(Qt::OtherFocusReason);
  container_->setFocus(Qt::OtherFocusReason);
  scene_->requestActivate();
}

bool SceneView::has_keyboard() const {
  const QWidget* const focus = QApplication::focusWidget();
  return QGuiApplication::focusWindow() == scene_ ||
         (window()->isActiveWindow() && (!focus || focus == container_));
}

}  // namespace icome::ui
