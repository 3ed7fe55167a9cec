#pragma once
#include <QAbstractButton>
#include <functional>
#include <optional>

#include "world/shape/fixture.h"

namespace icome::ui {

/// A colour of the world, as it is drawn on the screen. A click chooses another.
class ColourButton final : public QAbstractButton {
 public:
  /// `what`: whose colour it is, for the title of the dialog and for screen readers.
  ColourButton(const QString& what, QWidget* parent);

  void on_choice(std::function<void(const world::Colour&)> choose) { choose_ = std::move(choose); }
  /// Nothing: several objects, several colours.
  void show_colour(std::optional<world::Colour> colour);
  /// What stands there where there is no colour to be shown.
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

/// Both are as displays show them.
QColor screen_colour(const world::Colour& colour);
world::Colour world_colour(const QColor& colour);

}  // namespace icome::ui
