#pragma once
#include <QLineEdit>
#include <functional>
#include <optional>
#include <string>

#include "base/result.h"

namespace icome::ui {

/// A field for a line of text, which is committed with Enter or by leaving it; Escape gives it up.
class TextField final : public QLineEdit {
 public:
  explicit TextField(QWidget* parent);

  void on_commit(std::function<base::Result<void>(const std::string&)> commit) {
    commit_ = std::move(commit);
  }
  /// `hear` gets the reason why a text was refused, and an empty text when the next one is accepted.
  void on_refusal(std::function<void(const QString&)> hear) { refused_ = std::move(hear); }
  /// Shows a text; none where several objects have several texts.
  void show_text(std::optional<std::string> text);
  /// Commits the text that is being typed; false: it was refused, and is still in the field.
  bool finish();

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void commit_text();
  void restore();
  void mark(bool refused);

  std::function<base::Result<void>(const std::string&)> commit_ = {};
  std::function<void(const QString&)> refused_ = {};
  std::optional<std::string> text_ = std::string();
  bool edited_ = false;
};

}  // namespace icome::ui
