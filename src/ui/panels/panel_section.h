#pragma once
#include <QGridLayout>
#include <QLabel>
#include <QToolButton>
#include <QWidget>
#include <vector>

#include "ui/panels/panel_note.h"

namespace icome::ui {

/// A part of a panel under a heading that folds it: rows, each of a label with its fields, and a note.
/// Without a title it has no heading.
class PanelSection final : public QWidget {
 public:
  PanelSection(const QString& title, QWidget* parent);

  /// A label and its field or fields, which appear and disappear together.
  struct Row {
    QLabel* label = nullptr;
    std::vector<QWidget*> fields = {};
    void set_visible(bool visible) const;
  };
  Row add_row(const QString& label, const QString& tip, std::vector<QWidget*> fields);
  /// Adds a widget as wide as the section.
  void add_wide(QWidget* widget);
  /// Adds a widget as wide as the fields, under those of the last row.
  void add_below(QWidget* widget);

  QWidget* body() const { return body_; }
  PanelNote& note() const { return *note_; }

 private:
  void fold(bool open);

  QToolButton* heading_;
  QWidget* body_;
  QGridLayout* grid_;
  PanelNote* note_;
};

}  // namespace icome::ui
