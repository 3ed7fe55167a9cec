#include "ui/panels/panel_section.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr int kColumns = 4;  // a label and up to three fields

}  // namespace

PanelSection::PanelSection(const QString& title, QWidget* parent)
    : QWidget(parent),
      heading_(new QToolButton(this)),
      body_(new QWidget(this)),
      grid_(new QGridLayout(body_)),
      note_(new PanelNote(this)) {
  heading_->setText(title);
  heading_->setVisible(!title.isEmpty());
  heading_->setAccessibleName(title);
  heading_->setCheckable(false);
  heading_->setAutoRaise(true);
  heading_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  heading_->setArrowType(Qt::DownArrow);
  heading_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  heading_->setFocusPolicy(Qt::StrongFocus);
  QFont bold = heading_->font();
  bold.setWeight(QFont::DemiBold);
  heading_->setFont(bold);
  connect(heading_, &QToolButton::clicked, this, [this] { fold(!body_->isVisibleTo(this)); });

  grid_->setContentsMargins(4 * kGrid, 0, 3 * kGrid, 2 * kGrid);
  grid_->setHorizontalSpacing(kGrid);
  grid_->setVerticalSpacing(kGrid);
  grid_->setColumnMinimumWidth(0, 27 * kGrid);
  for (int column = 1; column < kColumns; ++column) grid_->setColumnStretch(column, 1);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, kGrid, 0, 0);
  all->setSpacing(kGrid);
  all->addWidget(heading_);
  all->addWidget(body_);
  all->addWidget(note_);
  note_->setContentsMargins(4 * kGrid, 0, 3 * kGrid, 2 * kGrid);
}

void PanelSection::Row::set_visible(bool visible) const {
  label->setVisible(visible);
  for (QWidget* field : fields) field->setVisible(visible);
}

PanelSection::Row PanelSection::add_row(const QString& text, const QString& tip,
                                        std::vector<QWidget*> fields) {
  auto* label = new QLabel(text, body_);
  label->setForegroundRole(QPalette::PlaceholderText);
  label->setToolTip(tip);
  if (!fields.empty()) label->setBuddy(fields.front());
  const int row = grid_->rowCount();
  grid_->addWidget(label, row, 0);
  int column = 1;
  for (QWidget* field : fields) {
    const int span = field == fields.back() ? kColumns - column : 1;
    grid_->addWidget(field, row, column, 1, span);
    column += span;
    if (field->accessibleName().isEmpty()) field->setAccessibleName(text);
    if (field->toolTip().isEmpty()) field->setToolTip(tip);
  }
  return {label, std::move(fields)};
}

void PanelSection::add_wide(QWidget* widget) { grid_->addWidget(widget, grid_->rowCount(), 0, 1, kColumns); }

void PanelSection::add_below(QWidget* widget) {
  grid_->addWidget(widget, grid_->rowCount(), 1, 1, kColumns - 1);
}

void PanelSection::fold(bool open) {
  body_->setVisible(open);
  heading_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
}

}  // namespace icome::ui
