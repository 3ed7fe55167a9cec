#pragma once
#include <QFrame>
#include <functional>
#include <optional>

#include "ui/window/note.h"

class QBoxLayout;
class QLabel;
class QProgressBar;

namespace icome::ui {

/// One line of the banner, with a mark in the colour of its weight.
class BannerStrip : public QFrame {
 public:
  BannerStrip(Note::Weight weight, QWidget* parent);

 protected:
  void paintEvent(QPaintEvent* event) override;
  QBoxLayout* line() const { return line_; }

 private:
  Note::Weight weight_;
  QBoxLayout* line_;
};

/// A note with its buttons, and its details on demand.
class BannerRow final : public BannerStrip {
 public:
  BannerRow(const Note& note, QWidget* parent);

  const Note& note() const { return note_; }
  void on_close(std::function<void()> close) { close_ = std::move(close); }
  void on_remedy(std::function<void(Note::Remedy)> remedy) { remedy_ = std::move(remedy); }

 private:
  void add_details();

  Note note_;
  std::function<void()> close_ = [] {};
  std::function<void(Note::Remedy)> remedy_ = [](Note::Remedy) {};
};

/// A row with the progress of some work.
class ProgressRow final : public BannerStrip {
 public:
  ProgressRow(const std::function<void()>& cancel, QWidget* parent);
  void report(const QString& text, std::optional<double> part);
  bool can_be_cancelled() const { return can_be_cancelled_; }

 private:
  QLabel* text_;
  QProgressBar* bar_;
  bool can_be_cancelled_;
};

}  // namespace icome::ui
