#include "ui/panels/panel_note.h"

#include <QEvent>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr int kShownFor = 12'000;  // ms: long enough to read two sentences twice

}  // namespace

PanelNote::PanelNote(QWidget* parent) : QLabel(parent) {
  setWordWrap(true);
  setTextFormat(Qt::PlainText);
  setContentsMargins(kGrid, kGrid, kGrid, kGrid);
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, [this] { clear(); });
  clear();
}

void PanelNote::say(const QString& why) {
  keep(why);
  timer_.start(kShownFor);
}

void PanelNote::keep(const QString& why) { put(why, true); }

void PanelNote::remark(const QString& what) { put(what, false); }

void PanelNote::clear() { put({}, true); }

void PanelNote::put(const QString& text, bool refusal) {
  timer_.stop();
  refusal_ = refusal;
  setAccessibleName(refusal ? "Why something was refused" : "What is to be known");
  dress();
  setText(text);
  setVisible(!text.isEmpty());
}

void PanelNote::changeEvent(QEvent* event) {
  QLabel::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) dress();
}

void PanelNote::dress() {
  const QColor& wanted = refusal_ ? colours().bad_text : colours().faint;
  if (palette().color(QPalette::WindowText) == wanted) return;
  QPalette words = palette();
  words.setColor(QPalette::WindowText, wanted);
  setPalette(words);
}

}  // namespace icome::ui
