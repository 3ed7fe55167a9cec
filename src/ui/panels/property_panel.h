#pragma once
#include <QWidget>
#include <memory>

#include "session/session.h"

namespace icome::ui {

/// What the selected objects are, look and feel like, to be read and changed. Of several it shows what they
/// have in common, and changes all. Changes go through the session, which outlives it.
class PropertyPanel final : public QWidget {
 public:
  PropertyPanel(session::Session& session, QWidget* parent);
  ~PropertyPanel() override;

  /// Commits what is being typed in a field; false: it was refused, which is shown.
  bool finish_typing();

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
