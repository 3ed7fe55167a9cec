#pragma once
#include <QSettings>
#include <QTimer>
#include <QWidget>
#include <functional>
#include <vector>

#include "realtime/recorder.h"
#include "ui/cutout/document/cutout_document.h"
#include "ui/cutout/table/table_follower.h"
#include "ui/cutout/table/table_hands.h"
#include "ui/forms/quantity_field.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/panels/panel_section.h"
#include "ui/panels/wrapped_label.h"

class QCheckBox;
class QGridLayout;
class QLineEdit;
class QPushButton;

namespace icome::ui {

/// The table with triangles that a camera watches: where it is seen from, which triangle moves which cell,
/// and what is seen or wrong, in words. Document and settings outlive it.
class TablePanel final : public QWidget {
 public:
  TablePanel(CutoutDocument& document, QSettings& settings, QWidget* parent);
  ~TablePanel() override;

  /// Shows mappings and names of cells as they are now.
  void refresh();
  /// Moves cells once more as the hands lie, in another frame of the animation.
  void follow_frame();
  /// Takes notice that the stage was painted: the way of the last frame to the screen ends there.
  void painted();

  void start();
  void stop();
  bool is_running() const;
  TableFollower& follower() { return follower_; }
  /// From frames of the table to the screen, s.
  realtime::LoopSummary delays() const { return delays_.summary(); }

 private:
  QLineEdit* add_text(const char* name, const QString& accessible, const QString& hint);
  QWidget* with_chooser(QLineEdit* field, const QString& title, const QString& filter);
  QuantityField* add_size(const char* name, const QString& accessible);
  void take_sight(const TableSight& sight);
  void show_status();
  void show_state();
  void show_mappings();
  void add_mapping_row(const std::string& triangle);
  void map(const std::string& triangle, int mode, const std::string& cell);
  TableSettings settings_now() const;
  void keep_settings();
  void map_named_cells();

  CutoutDocument& document_;
  QSettings& kept_;
  TableFollower follower_;
  TableHands hands_;
  TableSight last_;
  std::int64_t awaited_ = 0;  // ns: when the frame had arrived that is not painted yet; 0: none
  realtime::LoopRecorder delays_;
  PanelSection *section_, *triangles_;
  QLineEdit *source_ = nullptr, *known_ = nullptr, *view_ = nullptr;
  QuantityField *width_ = nullptr, *height_ = nullptr;
  QPushButton* start_ = nullptr;
  QCheckBox* steady_ = nullptr;
  WrappedLabel* status_ = nullptr;
  QGridLayout* rows_ = nullptr;
  QWidget* table_ = nullptr;
  double table_width_ = 640, table_height_ = 480;  // mm
  QTimer words_;
};

}  // namespace icome::ui
