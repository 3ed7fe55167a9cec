#include "ui/window/shortcut_sheet.h"

#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

/// The text of an action without the marks of its mnemonic and of a dialog to come.
QString plain(QString text) {
  const QString kept("\x01");
  text.replace("&&", kept).remove('&').replace(kept, "&");
  while (text.endsWith("…") || text.endsWith('.')) text.chop(1);
  return text;
}

QLabel* heading_of(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  QFont font = label->font();
  font.setWeight(QFont::DemiBold);
  label->setFont(font);
  return label;
}

void fill(QGridLayout& table, const ShortcutSheet::Part& part, QWidget* parent) {
  int row = table.rowCount();
  if (row > 1) table.setRowMinimumHeight(row++, 3 * kGrid);
  table.addWidget(heading_of(part.heading, parent), row++, 0, 1, 2);
  for (const auto& [what, keys] : part.rows) {
    table.addWidget(new QLabel(what, parent), row, 0);
    auto* label = new QLabel(keys, parent);
    label->setForegroundRole(QPalette::PlaceholderText);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    table.addWidget(label, row++, 1, Qt::AlignRight);
  }
}

}  // namespace

ShortcutSheet::ShortcutSheet(const std::vector<Part>& parts, QWidget* parent) : QDialog(parent) {
  setWindowTitle("Keyboard and mouse");
  auto* sheet = new QWidget(this);
  auto* table = new QGridLayout(sheet);
  table->setContentsMargins(4 * kGrid, 3 * kGrid, 4 * kGrid, 3 * kGrid);
  table->setHorizontalSpacing(8 * kGrid);
  table->setVerticalSpacing(kGrid);
  table->setColumnStretch(0, 1);
  for (const Part& part : parts) {
    if (!part.rows.empty()) fill(*table, part, sheet);
  }
  table->setRowStretch(table->rowCount(), 1);
  auto* scroll = new QScrollArea(this);
  scroll->setWidget(sheet);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFrameShape(QFrame::NoFrame);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(2 * kGrid, 2 * kGrid, 2 * kGrid, 3 * kGrid);
  all->addWidget(scroll);
  all->addWidget(buttons);
  const QSize wanted = sheet->sizeHint();
  resize(std::max(wanted.width() + 12 * kGrid, 100 * kGrid),
         std::min(wanted.height() + 20 * kGrid, 170 * kGrid));
}

ShortcutSheet::Part ShortcutSheet::of_actions(const QString& heading, const QList<QAction*>& actions) {
  Part part{heading, {}};
  for (const QAction* action : actions) {
    QStringList keys;
    for (const QKeySequence& sequence : action->shortcuts())
      keys << sequence.toString(QKeySequence::NativeText);
    if (!keys.isEmpty()) part.rows.emplace_back(plain(action->text()), keys.join("  or  "));
  }
  return part;
}

}  // namespace icome::ui
