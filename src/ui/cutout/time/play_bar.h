#pragma once
#include <QWidget>
#include <vector>

#include "ui/cutout/cutout_look.h"
#include "ui/cutout/document/cutout_document.h"
#include "ui/forms/quiet_combo_box.h"

class QAction;
class QLabel;

namespace icome::ui {

/// The buttons below the stage: steps in time, playing and recording, the rate, and where the film is.
/// Document and look outlive it.
class PlayBar final : public QWidget {
 public:
  PlayBar(CutoutDocument& document, CutoutLook& look, QWidget* parent);

  /// Adds a group of buttons.
  void add_actions(const std::vector<QAction*>& actions);
  /// Adds what stands behind the buttons; after all of them.
  void add_choices();
  void refresh();
  void on_look(std::function<void()> look) { looked_ = std::move(look); }

 private:
  CutoutDocument& document_;
  CutoutLook& look_;
  QuietComboBox *rate_ = nullptr, *step_ = nullptr;
  QLabel* place_ = nullptr;
  std::function<void()> looked_ = [] {};
};

}  // namespace icome::ui
