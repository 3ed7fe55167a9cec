#include "ui/window/scene_window.h"

#include <QCoreApplication>
#include <QExposeEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPlatformSurfaceEvent>
#include <QSurfaceFormat>
#include <QTabletEvent>
#include <QWheelEvent>
#include <cmath>
#include <utility>

namespace icome::ui {

SceneWindow::SceneWindow(SceneTools& tools, session::DisplayFeed& feed) : tools_(tools), feed_(feed) {
  setObjectName("scene.window");
  setSurfaceType(QSurface::OpenGLSurface);
  setFormat(scene_format());
}

SceneWindow::~SceneWindow() = default;

std::optional<std::string> SceneWindow::trouble() {
  if (display_) {
    if (auto why = display_->trouble()) {
      display_.reset();
      refused_ = true;
      trouble_ = std::move(why);
    }
  }
  return std::exchange(trouble_, std::nullopt);
}

void SceneWindow::retry() {
  refused_ = false;
  show_or_hide();
}

QString SceneWindow::renderer() {
  return display_ ? QString::fromStdString(display_->renderer()) : QString();
}

void SceneWindow::show_or_hide() {
  if (!isExposed()) {
    if (display_) display_->hide();
    return;
  }
  if (!display_ && !refused_) {
    auto made = DisplayThread::create(*this, feed_);
    if (made) {
      display_ = std::move(*made);
    } else {
      refused_ = true;
      trouble_ = made.error().message;
    }
  }
  const double ratio = devicePixelRatio();
  if (display_) display_->show(int(std::lround(width() * ratio)), int(std::lround(height() * ratio)));
}

bool SceneWindow::event(QEvent* event) {
  switch (event->type()) {
    case QEvent::PlatformSurface:
      // The thread must have let go of the surface before it goes.
      if (static_cast<QPlatformSurfaceEvent*>(event)->surfaceEventType() ==
          QPlatformSurfaceEvent::SurfaceAboutToBeDestroyed)
        display_.reset();
      break;
    case QEvent::Leave:
      tools_.leave();
      break;
    case QEvent::DragEnter:
    case QEvent::DragMove:
    case QEvent::Drop:
      return offered_(static_cast<QDropEvent&>(*event));
    case QEvent::ShortcutOverride: {
      const auto* const key = static_cast<QKeyEvent*>(event);
      event->setAccepted(tools_.takes_key(key->key(), key->modifiers()));
      return event->isAccepted();
    }
    case QEvent::DragLeave:
      tools_.leave();
      break;
    default:
      break;
  }
  return QWindow::event(event);
}

void SceneWindow::exposeEvent(QExposeEvent*) { show_or_hide(); }

void SceneWindow::resizeEvent(QResizeEvent*) {
  tools_.resize(size());
  if (display_) show_or_hide();
}

SceneInput SceneWindow::input(const QSinglePointEvent& event) {
  const SceneInput whole{.at = event.position(),
                         .size = QSizeF(std::max(1, width()), std::max(1, height())),
                         .button = event.button(),
                         .modifiers = event.modifiers()};
  const bool released = event.button() != Qt::NoButton && !event.buttons().testFlag(event.button());
  if (event.buttons() == Qt::NoButton && !released) pressed_in_.reset();
  const SceneInput input = in_eye(whole, tools_.stereo(), pressed_in_);
  pressed_in_ = event.buttons() == Qt::NoButton ? std::nullopt : std::optional(input.eye);
  return input;
}

void SceneWindow::mousePressEvent(QMouseEvent* event) { tools_.press(input(*event)); }
void SceneWindow::mouseMoveEvent(QMouseEvent* event) { tools_.move(input(*event)); }
void SceneWindow::mouseReleaseEvent(QMouseEvent* event) { tools_.release(input(*event)); }
void SceneWindow::mouseDoubleClickEvent(QMouseEvent* event) { tools_.double_click(input(*event)); }

void SceneWindow::wheelEvent(QWheelEvent* event) {
  constexpr double kNotch = 120.0;  // eighths of a degree, as Qt counts
  const QPoint turned = event->angleDelta();
  // With Shift or Alt the platform turns the wheel sideways.
  tools_.wheel(input(*event), (turned.y() != 0 ? turned.y() : turned.x()) / kNotch);
}

void SceneWindow::tabletEvent(QTabletEvent* event) {
  const bool pen = event->pointerType() == QPointingDevice::PointerType::Pen;
  const bool up = event->type() == QEvent::TabletRelease;
  // Events that the tools do not take come again, as mouse events.
  event->setAccepted(pen && tools_.pen(input(*event), up ? 0.0 : event->pressure()));
}

void SceneWindow::keyPressEvent(QKeyEvent* event) {
  event->setAccepted(tools_.key_press(event->key(), event->modifiers(), event->isAutoRepeat()));
}

void SceneWindow::keyReleaseEvent(QKeyEvent* event) {
  event->setAccepted(!event->isAutoRepeat() && tools_.key_release(event->key()));
}

void SceneWindow::focusOutEvent(QFocusEvent*) { tools_.forget_keys(); }

}  // namespace icome::ui
