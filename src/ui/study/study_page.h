#pragma once
#include <QPushButton>
#include <QWidget>
#include <functional>

class QLabel;
class QScrollArea;
class QTimer;
class QVBoxLayout;

namespace icome::ui {

/// A button as large as the type of studies; the main one of a page is filled with the accent's colour.
class StudyButton final : public QPushButton {
 public:
  StudyButton(const QString& text, bool main, QWidget* parent);

 protected:
  void paintEvent(QPaintEvent* event) override;
  /// The second click of a double one was not meant for the page that the first one brought.
  void mouseDoubleClickEvent(QMouseEvent* /*event*/) override {}

 private:
  bool main_;
};

/// A page of a study: a column of text or fields in the middle, which scrolls where it is long, and buttons
/// below. Enter presses the button that has the keyboard, or else the main one.
class StudyPage : public QWidget {
 public:
  StudyPage(const QString& title, QWidget* parent);

  /// Paragraphs are parted by empty lines; a single line break is one.
  void add_text(const QString& text);
  /// A button that is not the main one.
  void add_button(const QString& text, std::function<void()> pressed);
  void add_main_button(const QString& text, std::function<void()> pressed);
  /// In small letters below the buttons.
  void show_hint(const QString& text);
  /// The keyboard goes to what it is for.
  virtual void take_keyboard();

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  /// What Enter does where no button has the keyboard.
  virtual void enter();
  void add_field(QWidget* field);
  /// Scrolls until it is seen.
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
  /// `left` says how long it still takes, with %1 for the time. Make the main button next, then wait.
  StudyRestPage(const QString& title, QString left, QWidget* parent);

  void wait(double seconds);
  /// It may be left now.
  void end_wait();

 private:
  void count_down();

  QString words_;
  QLabel* left_;
  QTimer* timer_;
  std::int64_t end_ = 0;  // ns, steady clock
};

}  // namespace icome::ui
