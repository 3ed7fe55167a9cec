#pragma once
#include <QWidget>
#include <functional>
#include <optional>

#include "ui/window/note.h"

class QVBoxLayout;

namespace icome::ui {

class BannerRow;
class ProgressRow;

/// The messages of the window, in a place above the scene: errors with their remedies, and work in progress.
/// The newest stands on top; those that do not fit wait for these to be closed.
class Banner final : public QWidget {
 public:
  explicit Banner(QWidget* parent);

  /// Sets the callback of a note's buttons. The note has been removed when it is called.
  void on_remedy(std::function<void(const Note&, Note::Remedy)> remedy) { remedy_ = std::move(remedy); }

  void tell(const Note& note);
  /// Removes the notes of the topic.
  void forget(const std::string& topic);

  /// Shows work in progress: the part that is done, [0, 1], or none if it is unknown. `cancel` may be empty.
  void show_progress(const QString& text, std::optional<double> part, const std::function<void()>& cancel);
  void hide_progress();

 private:
  void take_away(BannerRow* row);
  void arrange();

  QVBoxLayout* rows_;
  ProgressRow* progress_ = nullptr;
  std::vector<BannerRow*> told_;  // the newest first
  std::function<void(const Note&, Note::Remedy)> remedy_ = [](const Note&, Note::Remedy) {};
};

}  // namespace icome::ui
