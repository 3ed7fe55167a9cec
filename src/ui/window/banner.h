#pragma once
#include <QWidget>
#include <functional>
#include <optional>

#include "ui/window/note.h"

class QVBoxLayout;

namespace icome::ui {

class BannerRow;
class ProgressRow;

/// Where the window tells people something, above the scene and in nobody's way: what went wrong and what to
/// do, what is being read. The newest stands on top; those that do not fit wait for these to be closed.
class Banner final : public QWidget {
 public:
  explicit Banner(QWidget* parent);

  /// What happens when one of a note's buttons is pressed. The note has gone then.
  void on_remedy(std::function<void(const Note&, Note::Remedy)> remedy) { remedy_ = std::move(remedy); }

  void tell(const Note& note);
  /// Takes away what was told of the topic.
  void forget(const std::string& topic);

  /// Something is going on: how far it is, [0, 1], or that nobody knows (none). `cancel` may be empty.
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
