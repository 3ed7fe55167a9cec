#include "ui/devices/device_row.h"

#include <QGridLayout>
#include <utility>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"
#include "ui/panels/wrapped_label.h"

namespace icome::ui {
namespace {

QString family_words(const devices::DeviceEntry& entry) {
  if (entry.family == "navigation") return "moves the view";
  if (entry.family == "head") return "follows the head";
  return one_line(entry.family);
}

/// What is said under the name of a device.
QString words_about(const devices::DeviceEntry& entry) {
  const QString family = family_words(entry);
  if (entry.present && entry.family != "pointer")
    return family + (entry.why.empty() ? QString() : ": " + one_line(entry.why));
  return entry.why.empty() ? family : one_line(entry.why);
}

}  // namespace

DeviceRow::DeviceRow(const devices::DeviceEntry& entry, std::function<void()> act, QWidget* parent)
    : QWidget(parent), address_(entry.name), identity_(entry.identity) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, kGrid, 0, kGrid);
  grid->setHorizontalSpacing(2 * kGrid);
  grid->setVerticalSpacing(0);
  grid->setColumnStretch(0, 1);
  const QString name = one_line(entry.name);
  setAccessibleName(name);
  auto* title = new QLabel(name, this);
  title->setTextFormat(Qt::PlainText);
  title->setToolTip(QString("%1, %2").arg(one_line(entry.backend), family_words(entry)));
  auto* about = new WrappedLabel(words_about(entry), this);
  about->setForegroundRole(QPalette::PlaceholderText);
  grid->addWidget(title, 0, 0);
  grid->addWidget(about, 1, 0, 1, 2);
  if (!entry.present || entry.family != "pointer") return;
  button_ = new QPushButton(this);
  grid->addWidget(button_, 0, 1);
  connect(button_, &QPushButton::clicked, this, [act = std::move(act)] { act(); });
  show(State::Free);
}

void DeviceRow::show(State state) {
  if (!button_) return;
  static constexpr const char* kTexts[] = {"Connect", "Opening\u2026", "Disconnect", "Closing\u2026"};
  const QString text = kTexts[std::size_t(state)];
  if (button_->text() != text) button_->setText(text);
  button_->setAccessibleName(text + " " + accessibleName());
  button_->setEnabled(state == State::Free || state == State::Connected);
}

}  // namespace icome::ui
