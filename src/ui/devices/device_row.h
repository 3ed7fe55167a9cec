#pragma once
#include <QLabel>
#include <QPushButton>
#include <QWidget>
#include <functional>

#include "devices/back_end.h"

namespace icome::ui {

/// A device that was found, or one that is missing: its address and family, what it is or why it is not
/// there, and the button that connects it.
class DeviceRow final : public QWidget {
 public:
  enum class State : std::uint8_t { Free, Opening, Connected, Closing };

  /// `act` is called when the button is clicked, which is there for pointers that are present.
  DeviceRow(const devices::DeviceEntry& entry, std::function<void()> act, QWidget* parent);

  const std::string& address() const { return address_; }
  /// devices::DeviceEntry::identity.
  const std::string& identity() const { return identity_; }
  void show(State state);

 private:
  std::string address_;
  std::string identity_;
  QPushButton* button_ = nullptr;  // null where there is nothing to connect
};

}  // namespace icome::ui
