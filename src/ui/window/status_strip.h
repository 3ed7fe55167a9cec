#pragma once
#include <QWidget>
#include <memory>

#include "session/session.h"

namespace icome::ui {

/// The live state of hand and servo: pointer device, servo rate, haptic load, lateness and force over time.
/// Reads the session, which outlives it, some 15 times a second while it is visible.
class StatusStrip final : public QWidget {
 public:
  StatusStrip(session::Session& session, QWidget* parent);
  ~StatusStrip() override;

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
