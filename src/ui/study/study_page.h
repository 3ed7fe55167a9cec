#pragma once
#include <QPushButton>
#include <QWidget>
#include <functional>

class QLabel;
class QScrollArea;
class QTimer;
class QVBoxLayout;

namespace icome::ui {

/// A button as large as the text of studies; the main one of a page is filled with the accent's colour.
class StudyButton final : public QPushButton {
 public:
  StudyButton(const QString& text, bool main, QWidget* parent);

 protected:
  void paintEvent(QPaintEvent* event) override;
  /// Does nothing: the second click was not meant for the page that the first one may have opened.
  void mouseDoubleClickEvent(QMouseEvent* /*event*/) override {}

 private:
  bool main_;
};

/// A page of a study: a column of text or fields in the middle, which scrolls where it is long, and buttons
/// below. Enter presses the button that has the keyboard's focus, or else the main one.
class StudyPage : public QWidget {
 public:
  StudyPage(const QString& title, QWidget* parent);

  /// Adds text. Empty lines separate paragraphs; a single line break stays one.
  void add_text(const QString& text);
  /// Adds a button that is not the main one.
  void add_button(const QString& text, std::function<void()> pressed);
  void add_main_button(const QString& text, std::function<void()> pressed);
  /// Shows a text in small letters below the buttons.
  void show_hint(const QString& text);
  /// Gives the keyboard's focus to the widget that is used first.
  virtual void take_keyboard();

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  /// Called for Enter where no button has the keyboard's focus.
  virtual void enter();
  void add_field(QWidget* field);
  /// Scrolls until the field is visible.
  void show_field(QWidget* field);
  StudyButton* main_button() const { return main_; }

 private:
  bool scroll(int key);

  QScrollArea* area_;
  QVBoxLayout* column_;
  QLayout* buttons_;
  QLabel* hint_;
  StudyButton* main_ = nullptr;  // null until it is added
};

/// A page that cannot be left before some time has passed.
class StudyRestPage final : public StudyPage {
 public:
  /// `left` tells the remaining time, which replaces %1. Add the main button before calling wait().
  StudyRestPage(const QString& title, QString left, QWidget* parent);

  void wait(double seconds);
  /// Lets the person leave the page now.
  void end_wait();

 private:
  void count_down();

  QString words_;
  QLabel* left_;
  QTimer* timer_;
  std::int64_t end_ = 0;  // ns, steady clock
};

}  // namespace icome::ui
