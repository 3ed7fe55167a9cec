#pragma once
#include <QLabel>
#include <QTimer>

namespace icome::ui {

/// A line on a panel that says why something was refused, or what else is to be known of it, near where it
/// was asked for. It takes no room while it has nothing to say, and goes by itself after some time.
class PanelNote final : public QLabel {
 public:
  explicit PanelNote(QWidget* parent);

  void say(const QString& why);
  /// The same until something else is said: for what is to be put right before anything can go on.
  void keep(const QString& why);
  /// What is no refusal, until something else is said.
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
