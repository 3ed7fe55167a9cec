#include "ui/panel_note.h"

#include <QEvent>

#include "ui/theme.h"

namespace icome::ui {
namespace {

constexpr int kShownFor = 12'000;  // ms: long enough to read two sentences twice

}  // namespace

PanelNote::PanelNote(QWidget* parent) : QLabel(parent) {
  setWordWrap(true);
  setTextFormat(Qt::PlainText);
  setContentsMargins(kGrid, kGrid, kGrid, kGrid);
  setAccessibleName("Why something was refused");
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, [this] { clear(); });
  dress();
  clear();
}

void PanelNote::say(const QString& why) {
  setText(why);
  setVisible(!why.isEmpty());
  timer_.start(kShownFor);
}

void PanelNote::clear() {
  timer_.stop();
  setText({});
  hide();
}

void PanelNote::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) dress();
}

void PanelNote::dress() {
  if (palette().color(QPalette::WindowText) == colours().bad_text) return;
  QPalette words = palette();
  words.setColor(QPalette::WindowText, colours().bad_text);
  setPalette(words);
}

}  // namespace icome::ui
