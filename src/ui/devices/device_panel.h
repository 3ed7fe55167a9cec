#pragma once
#include <QWidget>
#include <memory>

#include "session/session.h"
#include "ui/devices/device_search.h"

namespace icome::ui {

/// The panel to find devices, to connect and disconnect them while all goes on, and to set how each is used.
/// The session outlives it.
class DevicePanel final : public QWidget {
 public:
  DevicePanel(session::Session& session, DeviceWays ways, QWidget* parent);
  ~DevicePanel() override;

  /// Commits what is being typed; false: it was refused.
  bool finish_typing();

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
