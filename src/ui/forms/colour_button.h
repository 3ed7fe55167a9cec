#pragma once
#include <QAbstractButton>
#include <functional>
#include <optional>

#include "world/shape/fixture.h"

namespace icome::ui {

/// A button that shows a colour of the world as the screen shows it. A click opens a dialog for another.
class ColourButton final : public QAbstractButton {
 public:
  /// `what` names the colour, for the title of the dialog and for screen readers.
  ColourButton(const QString& what, QWidget* parent);

  void on_choice(std::function<void(const world::Colour&)> choose) { choose_ = std::move(choose); }
  /// Shows a colour; none where several objects have several colours.
  void show_colour(std::optional<world::Colour> colour);
  /// Sets the text that is shown in place of a colour; "mixed" unless it is set.
  void set_none(const QString& none) { none_ = none; }

  QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void open_dialog();

  QString what_;
  QString none_ = "mixed";
  std::function<void(const world::Colour&)> choose_ = {};
  std::optional<world::Colour> colour_ = {};
};

/// Conversions between the two types of colours, both as displays show them.
QColor screen_colour(const world::Colour& colour);
world::Colour world_colour(const QColor& colour);

}  // namespace icome::ui
