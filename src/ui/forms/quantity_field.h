#pragma once
#include <QLineEdit>
#include <functional>
#include <optional>

#include "base/result.h"
#include "ui/forms/quantity_text.h"

namespace icome::ui {

/// A field for a number with a unit, which is typed, or stepped by the arrow keys (with Shift ten times as
/// far, with Ctrl a tenth) and, with the keyboard's focus, by the wheel.
class QuantityField final : public QLineEdit {
 public:
  /// Sets a value; `more` is true for further steps of the same turn, which are one action to undo. A refused
  /// value stays in the field, marked, until it is put right or given up with Escape.
  using Commit = std::function<base::Result<void>(std::optional<double> value, bool more)>;

  QuantityField(Quantity quantity, QWidget* parent);

  void on_commit(Commit commit) { commit_ = std::move(commit); }
  /// `hear` gets the reason why a value was refused, and an empty text when the next one is accepted.
  void on_refusal(std::function<void(const QString&)> hear) { refused_ = std::move(hear); }
  /// `typing` is called when the text changes before it is committed.
  void on_typing(std::function<void()> typing) { typing_ = std::move(typing); }
  /// The value, including text that is not committed yet. Fails for text that is no value.
  base::Result<std::optional<double>> typed_value() const;
  /// Allows an empty field, and shows the meaning of that: "device's best".
  void allow_none(const QString& meaning);
  /// Shows a value; without one, the meaning that allow_none() has set.
  void show_value(std::optional<double> value);
  /// Shows that several objects have several values.
  void show_mixed();
  /// Commits the text that is being typed; false: it was refused, and is still in the field.
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
  QString shown_ = {};     // text of the value, before anything is typed
  bool edited_ = false;    // typed, and not committed yet
  bool stepping_ = false;  // a next step belongs to the same turn
  double wheel_ = 0.0;     // eighths of degrees turned, less than a step
};

}  // namespace icome::ui
