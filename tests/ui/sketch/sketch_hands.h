#pragma once
#include <QCoreApplication>
#include <QMouseEvent>
#include <QPointingDevice>
#include <QTabletEvent>
#include <QTemporaryDir>
#include <vector>

#include "ui/desktop_test.h"
#include "ui/sketch/sketch_window.h"

namespace icome::ui {

/// The window of a drawing, with a pen and a mouse over its paper. Places are mm on the paper.
class SketchHands : public ::testing::Test {
 protected:
  SketchHands() {
    application();
    window_ = std::make_unique<SketchWindow>(settings_file());
    window_->resize(1000, 700);
    window_->show();
    QCoreApplication::processEvents();
  }

  struct At {
    double x, y;
    double pressure = 0.5;
  };

  QString settings_file() const { return folder_.filePath("settings.conf"); }
  SketchDocument& document() { return window_->document(); }
  SketchCanvas& canvas() { return window_->canvas(); }
  QPointF on_canvas(const At& at) const {
    return window_->canvas().view().to_screen({0.001 * at.x, 0.001 * at.y});
  }

  void mouse(const std::vector<At>& way, Qt::KeyboardModifiers modifiers = {}) {
    mouse_event(QEvent::MouseButtonPress, way.front(), modifiers);
    for (const At& at : way) mouse_event(QEvent::MouseMove, at, modifiers);
    mouse_event(QEvent::MouseButtonRelease, way.back(), modifiers);
  }
  void pen(QEvent::Type type, const At& at,
           QPointingDevice::PointerType end = QPointingDevice::PointerType::Pen) {
    static const QPointingDevice kPen(
        "pen", 1, QInputDevice::DeviceType::Stylus, QPointingDevice::PointerType::Pen,
        QInputDevice::Capability::Pressure | QInputDevice::Capability::Position, 1, 1);
    static const QPointingDevice kEraser(
        "eraser", 2, QInputDevice::DeviceType::Stylus, QPointingDevice::PointerType::Eraser,
        QInputDevice::Capability::Pressure | QInputDevice::Capability::Position, 1, 1);
    const bool down = at.pressure > 0.0;
    QTabletEvent event(type, end == QPointingDevice::PointerType::Eraser ? &kEraser : &kPen, on_canvas(at),
                       on_canvas(at), at.pressure, 10.0F, 0.0F, 0.0F, 0.0, 0.0F, {},
                       type == QEvent::TabletMove ? Qt::NoButton : Qt::LeftButton,
                       down ? Qt::LeftButton : Qt::NoButton);
    event.setTimestamp(time_ += 8);
    QCoreApplication::sendEvent(&canvas(), &event);
  }
  void pen_stroke(const std::vector<At>& way,
                  QPointingDevice::PointerType end = QPointingDevice::PointerType::Pen) {
    pen(QEvent::TabletPress, way.front(), end);
    for (const At& at : way) pen(QEvent::TabletMove, at, end);
    pen(QEvent::TabletRelease, {way.back().x, way.back().y, 0.0}, end);
  }

  std::vector<drawing::StrokePointer> strokes() {
    std::vector<drawing::StrokePointer> all;
    for (const drawing::Layer& layer : document().drawing().layers)
      all.insert(all.end(), layer.strokes.begin(), layer.strokes.end());
    return all;
  }

  QTemporaryDir folder_;
  std::unique_ptr<SketchWindow> window_;

 private:
  void mouse_event(QEvent::Type type, const At& at, Qt::KeyboardModifiers modifiers) {
    const bool moves = type == QEvent::MouseMove;
    QMouseEvent event(type, on_canvas(at), on_canvas(at), moves ? Qt::NoButton : Qt::LeftButton,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, modifiers);
    event.setTimestamp(time_ += 8);
    QCoreApplication::sendEvent(&canvas(), &event);
  }

  quint64 time_ = 1000;  // ms
};

}  // namespace icome::ui
