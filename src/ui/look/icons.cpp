#include "ui/look/icons.h"

#include <QIconEngine>
#include <QPainterPath>
#include <QPixmap>
#include <QTransform>

#include "ui/look/icon_paths.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr double kSquare = 20.0;  // side of the square of paths_of()

/// An icon that is drawn whenever it is needed, so that it follows a change of theme.
class DrawnIcon : public QIconEngine {
 public:
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap picture(size);
    picture.fill(Qt::transparent);
    QPainter painter(&picture);
    paint(&painter, QRect(QPoint(), size), mode, state);
    return picture;
  }
  QPixmap scaledPixmap(const QSize& size, QIcon::Mode mode, QIcon::State state, qreal /*scale*/) override {
    return pixmap(size, mode, state);  // the size is in physical pixels
  }
};

class ThemedIcon final : public DrawnIcon {
 public:
  explicit ThemedIcon(Icon which) : which_(which) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State /*state*/) override {
    const ThemeColours& theme = colours();
    QColor ink = mode == QIcon::Selected ? theme.selection_text : theme.text;
    QColor accent = theme.accent;
    if (mode == QIcon::Disabled) {
      ink.setAlphaF(0.35F);
      accent = ink;
    }
    paint_icon(*painter, rect, which_, ink, accent);
  }
  QIconEngine* clone() const override { return new ThemedIcon(*this); }

 private:
  Icon which_;
};

/// A ball that a finger's tip dents, on a dark tile.
class AppIcon final : public DrawnIcon {
 public:
  void paint(QPainter* painter, const QRect& rect, QIcon::Mode /*mode*/, QIcon::State /*state*/) override {
    const double side = std::min(rect.width(), rect.height());
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->translate(QRectF(rect).center());
    painter->scale(side / 64.0, side / 64.0);
    painter->translate(-32.0, -32.0);
    paint_tile(*painter);
    painter->restore();
  }
  QIconEngine* clone() const override { return new AppIcon(*this); }

 private:
  static void paint_tile(QPainter& painter) {
    QLinearGradient night(0.0, 2.0, 0.0, 62.0);
    night.setColorAt(0.0, QColor(0x3b, 0x43, 0x4e));
    night.setColorAt(1.0, QColor(0x1c, 0x20, 0x26));
    painter.setPen(Qt::NoPen);
    painter.setBrush(night);
    painter.drawRoundedRect(QRectF(2.0, 2.0, 60.0, 60.0), 14.0, 14.0);
    // The surface, with a dent where it is touched.
    QPainterPath ball;
    ball.moveTo(10.0, 44.0);
    ball.cubicTo(10.0, 34.0, 16.0, 28.5, 22.0, 27.5);
    ball.cubicTo(26.0, 27.0, 26.5, 35.0, 32.0, 35.0);
    ball.cubicTo(37.5, 35.0, 38.0, 27.0, 42.0, 27.5);
    ball.cubicTo(48.0, 28.5, 54.0, 34.0, 54.0, 44.0);
    ball.cubicTo(54.0, 51.0, 45.0, 56.0, 32.0, 56.0);
    ball.cubicTo(19.0, 56.0, 10.0, 51.0, 10.0, 44.0);
    QRadialGradient glow(QPointF(24.0, 32.0), 34.0);
    glow.setColorAt(0.0, QColor(0xff, 0xc0, 0x74));
    glow.setColorAt(0.6, QColor(0xff, 0x8c, 0x1a));
    glow.setColorAt(1.0, QColor(0xc4, 0x56, 0x00));
    painter.setBrush(glow);
    painter.drawPath(ball);
    painter.setBrush(QColor(0xf4, 0xf6, 0xf8));
    painter.drawRoundedRect(QRectF(26.5, 8.0, 11.0, 25.0), 5.5, 5.5);
  }
};

}  // namespace

QIcon icon(Icon which) { return QIcon(new ThemedIcon(which)); }

QIcon app_icon() { return QIcon(new AppIcon); }

void paint_icon(QPainter& painter, const QRectF& square, Icon which, const QColor& ink,
                const QColor& accent) {
  const IconPaths paths = paths_of(which);
  const double side = std::min(square.width(), square.height());
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.translate(square.center());
  painter.scale(side / kSquare, side / kSquare);
  painter.translate(-kSquare / 2.0, -kSquare / 2.0);
  QColor wash = ink;
  wash.setAlphaF(wash.alphaF() * 0.18F);
  painter.fillPath(paths.wash, wash);
  // Lines are at least 1.2 pixels wide, or small icons would look pale.
  const double width = std::max(1.5, 1.2 * kSquare / side);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(ink, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(paths.ink);
  painter.setPen(QPen(accent, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(paths.accent);
  painter.restore();
}

}  // namespace icome::ui
