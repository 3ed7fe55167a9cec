#pragma once
#include <QLineEdit>
#include <functional>
#include <optional>

#include "base/result.h"
#include "ui/forms/quantity_text.h"

namespace icome::ui {

/// A number with a unit to be typed, or stepped by the arrow keys (with Shift ten times as far, with Ctrl a
/// tenth) and, with the keyboard's focus, by the wheel.
class QuantityField final : public QLineEdit {
 public:
  /// A value to be set; `more` for further steps of the same turn, which are one action to undo. What is
  /// refused stays in the field, marked, until it is put right or given up with Escape.
  using Commit = std::function<base::Result<void>(std::optional<double> value, bool more)>;

  QuantityField(Quantity quantity, QWidget* parent);

  void on_commit(Commit commit) { commit_ = std::move(commit); }
  /// Hears why something was refused, and nothing (empty) when the next value is fine.
  void on_refusal(std::function<void(const QString&)> hear) { refused_ = std::move(hear); }
  /// Hears of what is typed before it is committed.
  void on_typing(std::function<void()> typing) { typing_ = std::move(typing); }
  /// The value with what is typed and not committed yet. Fails for what is none.
  base::Result<std::optional<double>> typed_value() const;
  /// Allows nothing as a value, and says what that means: "device's best".
  void allow_none(const QString& meaning);
  /// Nothing is what allow_none() says.
  void show_value(std::optional<double> value);
  /// Several objects, several values.
  void show_mixed();
  /// Commits what is being typed; false: it was refused, and is still there.
  bool finish();

 protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;

 private:
  void commit_text();
  void commit(std::optional<double> value, bool more);
  void step(double steps, Qt::KeyboardModifiers modifiers);
  void restore();
  QString fitting_text(double value) const;
  bool shortened() const;
  void refuse(const std::string& why);
  void mark(bool refused);

  Quantity quantity_;
  Commit commit_ = {};
  std::function<void(const QString&)> refused_ = {};
  std::function<void()> typing_ = {};
  std::optional<QString> none_ = {};
  std::optional<double> value_ = {};
  bool mixed_ = false;
  QString shown_ = {};     // of the value, before anything is typed
  bool edited_ = false;    // typed, and not committed yet
  bool stepping_ = false;  // the last step was of this turn
  double wheel_ = 0.0;     // eighths of degrees turned, less than a step
};

}  // namespace icome::ui
