#include "ui/window/scene_label.h"

#include <QFontMetricsF>
#include <QGuiApplication>
#include <QImage>
#include <QPainter>
#include <cmath>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

constexpr int kLongestName = 60;  // characters

std::shared_ptr<const charts::Image> draw_text(const QString& text, double pixel_ratio) {
  const QFont font = QGuiApplication::font();
  const QFontMetricsF metrics(font);
  const double width = std::ceil(metrics.horizontalAdvance(text)) + 4.0 * kGrid;
  const double height = std::ceil(metrics.height()) + 2.0 * kGrid;
  QImage image(int(std::ceil(width * pixel_ratio)), int(std::ceil(height * pixel_ratio)),
               QImage::Format_RGBA8888_Premultiplied);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  painter.scale(pixel_ratio, pixel_ratio);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  QColor ground = colours().window;
  ground.setAlphaF(0.85F);
  painter.setPen(QPen(colours().line, 1.0));
  painter.setBrush(ground);
  painter.drawRoundedRect(QRectF(0.5, 0.5, width - 1.0, height - 1.0), kGrid, kGrid);
  painter.setFont(font);
  painter.setPen(colours().text);
  painter.drawText(QRectF(0.0, 0.0, width, height), Qt::AlignCenter, text);
  painter.end();
  auto picture = std::make_shared<charts::Image>();
  picture->width = image.width();
  picture->height = image.height();
  for (int y = 0; y < image.height(); ++y) {
    const uchar* row = image.constScanLine(y);
    picture->rgba.insert(picture->rgba.end(), row, row + 4 * std::ptrdiff_t(image.width()));
  }
  return picture;
}

}  // namespace

const std::shared_ptr<const charts::Image>& SceneWords::picture(const QString& text, double pixel_ratio) {
  const Look look{text, pixel_ratio, is_dark()};
  if (!picture_ || look != drawn_) picture_ = draw_text(text, pixel_ratio);
  drawn_ = look;
  return picture_;
}

std::optional<render::SceneOverlay::Panel> panel_above(const session::Session& session, world::ObjectId id,
                                                       const std::shared_ptr<const charts::Image>& picture,
                                                       double pixel_ratio) {
  if (session.world().find(id) == nullptr) return std::nullopt;
  const base::Bounds bounds = world::bounds(session.world(), id);
  if (bounds.isEmpty()) return std::nullopt;
  base::Vector3 above = bounds.center();
  above.y() = bounds.max().y();
  return render::SceneOverlay::Panel{.picture = picture,
                                     .at = above,
                                     .anchor = {0.5, 0.0},
                                     .shift = {0.0, std::round(2.0 * kGrid * pixel_ratio)}};
}

std::optional<render::SceneOverlay::Panel> SceneLabel::panel(const session::Session& session,
                                                             world::ObjectId id, double pixel_ratio) {
  const world::PhysicalObject* object = session.world().find(id);
  QString text = object ? shortened(one_line(object->name), kLongestName) : QString();
  if (const auto holder = session.sharing().holder_of(id))
    text += QString("%1%2 has it").arg(text.isEmpty() ? "" : " \u2013 ", shortened(one_line(holder->name)));
  if (text.isEmpty()) return std::nullopt;
  return panel_above(session, id, words_.picture(text, pixel_ratio), pixel_ratio);
}

}  // namespace icome::ui
