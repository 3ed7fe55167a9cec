#pragma once
#include <QWidget>

#include "ui/cutout/stage/stage_view.h"
#include "ui/forms/quantity_field.h"
#include "ui/look/icons.h"
#include "ui/panels/panel_section.h"

class QListWidget;
class QToolButton;

namespace icome::ui {

/// Makes constraints of what is selected, asking for places on the stage. Document and stage outlive it.
class ConstraintMaker {
 public:
  ConstraintMaker(CutoutDocument& document, StageView& stage) : document_(document), stage_(stage) {}

  /// Hangs the cell that was selected first on the one that was selected last.
  void join();
  /// Lets the leading cell, and those that it hangs on, bend together.
  void chain();
  /// Keeps two cells as far from each other as they are now.
  void keep_distance();
  /// Keeps the leading cell on a line that is clicked.
  void guide_by_path(bool turns);
  /// Keeps it on a straight line, whose direction is clicked.
  void guide_by_axis();
  /// Takes away all constraints of the cells that are selected.
  void release();

 private:
  void make(const interaction::Value& command);
  /// The leading cell, where it is paper; else says what is needed, and gives null.
  const animation::Cell* leading_paper(const char* need) const;
  /// The first and the last of two that are selected; else says so.
  std::optional<std::pair<std::string, std::string>> two_names(const char* need) const;

  CutoutDocument& document_;
  StageView& stage_;
};

/// The constraints of an animation in words, with the limits of the chosen one. Document and maker outlive
/// it.
class ConstraintPanel final : public QWidget {
 public:
  ConstraintPanel(CutoutDocument& document, ConstraintMaker& maker, QWidget* parent);

  void refresh();

 private:
  QToolButton* add_button(const char* name, const QString& text, Icon picture, std::function<void()> act);
  QuantityField* add_limit(Quantity quantity, const char* name, bool greatest);
  const animation::Constraint* chosen() const;
  void show_limits();
  base::Result<void> set_limit(bool greatest, std::optional<double> value);
  void release_chosen();

  CutoutDocument& document_;
  ConstraintMaker& maker_;
  PanelSection* section_;
  QListWidget* list_;
  QToolButton* release_ = nullptr;
  QuantityField *nearest_ = nullptr, *farthest_ = nullptr, *least_ = nullptr, *greatest_ = nullptr;
  PanelSection::Row distance_row_, angle_row_;
  bool showing_ = false;
};

/// A constraint as a sentence without an end: "arm hangs on body".
QString constraint_words(const animation::Project& project, const animation::Constraint& constraint);

}  // namespace icome::ui
