#pragma once
#include <QLabel>

namespace icome::ui {

/// Words in as many lines as they need at the width that there is. A label in a column of columns gets the
/// height of its first guess else, which cuts it off.
class WrappedLabel final : public QLabel {
 public:
  WrappedLabel(const QString& text, QWidget* parent);
  /// Shows another text.
  void say(const QString& text);

 protected:
  void resizeEvent(QResizeEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void fit();
};

}  // namespace icome::ui
