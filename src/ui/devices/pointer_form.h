#pragma once
#include <QCheckBox>
#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "session/session.h"
#include "ui/forms/quantity_field.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/panels/panel_section.h"
#include "ui/panels/wrapped_label.h"

namespace icome::ui {

/// The form of one connected pointer: its condition, force and place as they are now, and the mapping that
/// it is used through, which changes at once and is kept in the device's profile by Save. The session
/// outlives it.
class PointerForm final : public QWidget {
 public:
  PointerForm(session::Session& session, std::size_t pointer, QWidget* parent);

  /// PointerUse::number of its pointer.
  std::uint64_t number() const { return number_; }
  /// Shows what is so now.
  void refresh();
  /// Commits what is being typed; false: it was refused.
  bool finish_typing();

 private:
  std::optional<std::size_t> pointer() const;
  void add_live();
  void add_mapping();
  void add_buttons(const session::PointerUse& use);
  void refresh_mapping(const session::PointerUse& use);
  base::Result<void> change(const std::function<void(devices::DeviceMapping&)>& edit);
  void try_change(const std::function<void(devices::DeviceMapping&)>& edit);
  void save();

  session::Session& session_;
  std::uint64_t number_;
  PanelSection* section_;
  WrappedLabel* condition_ = nullptr;
  QLabel* force_ = nullptr;
  QLabel* place_ = nullptr;
  QuantityField* scale_ = nullptr;
  QCheckBox* follows_ = nullptr;
  QuantityField* most_force_ = nullptr;
  QuietComboBox* clutch_ = nullptr;
  QLabel* reach_ = nullptr;
  QCheckBox* shown_ = nullptr;
};

}  // namespace icome::ui
