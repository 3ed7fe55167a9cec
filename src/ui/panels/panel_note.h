#pragma once
#include <QLabel>
#include <QTimer>

namespace icome::ui {

/// A line on a panel that tells why something was refused, or a remark, near the place where it was asked
/// for. It takes no room while it is empty. A text of say() disappears after some time.
class PanelNote final : public QLabel {
 public:
  explicit PanelNote(QWidget* parent);

  void say(const QString& why);
  /// Shows a refusal until another text is set: for errors that must be put right before going on.
  void keep(const QString& why);
  /// Shows a remark that is no refusal, until another text is set.
  void remark(const QString& what);
  void clear();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void put(const QString& text, bool refusal);
  void dress();

  bool refusal_ = true;
  QTimer timer_;
};

}  // namespace icome::ui
