#pragma once
#include <QWidget>
#include <memory>

#include "session/session.h"

namespace icome::ui {

/// The panel to read and change what the selected objects are, look and feel like. For several objects it
/// shows common values, and changes all. Changes go through the session, which outlives it.
class PropertyPanel final : public QWidget {
 public:
  PropertyPanel(session::Session& session, QWidget* parent);
  ~PropertyPanel() override;

  /// Commits the text that is being typed in a field; false: it was refused, and the panel tells why.
  bool finish_typing();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
