#include "ui/sharing/conflict_dialog.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"
#include "ui/panels/wrapped_label.h"

namespace icome::ui {

using collab::Choice;
using session::SessionSharing;

namespace {

constexpr const char* kWords =
    "These were changed both by you and by others while there was no connection. What you choose for all of "
    "them "
    "is one action, which can be undone.";

void add_choices(QComboBox& box, const SessionSharing::Conflict& conflict) {
  box.addItem(conflict.is_gone ? "theirs: it stays deleted" : "theirs: what you did to it is given up",
              int(Choice::Theirs));
  if (!conflict.is_gone) box.addItem("yours: what they did to it is replaced", int(Choice::Mine));
  if (conflict.object)
    box.addItem(conflict.is_gone ? "yours, as a new object" : "both: yours beside theirs, as a copy",
                int(Choice::Both));
}

/// "Changed by Ann", or nothing where it is not known by whom.
QString others_part(const SessionSharing::Conflict& conflict) {
  if (conflict.whose.empty()) return {};
  return (conflict.is_gone ? "deleted by " : "changed by ") + shortened(one_line(conflict.whose));
}

}  // namespace

ConflictDialog::ConflictDialog(session::Session& session,
                               std::function<void(const base::Result<void>&)> chosen, QWidget* parent)
    : QDialog(parent), session_(session), chosen_(std::move(chosen)) {
  setObjectName("conflicts");
  setWindowTitle("Yours and Theirs");
  setMinimumWidth(130 * kGrid);
  auto* rows = new QVBoxLayout(this);
  rows->addWidget(new WrappedLabel(kWords, this));
  auto* sheet = new QWidget(this);
  auto* grid = new QGridLayout(sheet);
  grid->setColumnStretch(2, 1);
  for (const SessionSharing::Conflict& it : session.sharing().conflicts()) {
    auto* name = new QLabel(tip_of(shortened(one_line(it.what))), sheet);
    auto* box = new QComboBox(sheet);
    box->setAccessibleName("What becomes of " + one_line(it.what));
    add_choices(*box, it);
    name->setBuddy(box);
    const int row = int(choices_.size());
    grid->addWidget(name, row, 0);
    grid->addWidget(new QLabel(tip_of(others_part(it)), sheet), row, 1);
    grid->addWidget(box, row, 2);
    choices_.push_back(box);
  }
  grid->setRowStretch(int(choices_.size()), 1);
  auto* scroll = new QScrollArea(this);
  scroll->setWidget(sheet);
  scroll->setWidgetResizable(true);
  rows->addWidget(scroll, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok, this);
  auto* all_theirs = buttons->addButton("All &Theirs", QDialogButtonBox::ActionRole);
  auto* all_mine = buttons->addButton("All &Yours", QDialogButtonBox::ActionRole);
  auto* all_both = buttons->addButton("&Both of All", QDialogButtonBox::ActionRole);
  auto* later = buttons->addButton("&Later", QDialogButtonBox::RejectRole);
  later->setToolTip(
      "Nothing of what you did is sent until you have chosen: the message above the scene leads back");
  rows->addWidget(buttons);
  connect(all_theirs, &QPushButton::clicked, this, [this] { choose_all(int(Choice::Theirs)); });
  connect(all_mine, &QPushButton::clicked, this, [this] { choose_all(int(Choice::Mine)); });
  connect(all_both, &QPushButton::clicked, this, [this] { choose_all(int(Choice::Both)); });
  connect(buttons, &QDialogButtonBox::accepted, this, [this] { finish(); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  choose_all(int(Choice::Both));  // nothing is lost where nobody looks closely
}

/// A thing that does not have that choice stays as it is.
void ConflictDialog::choose_all(int choice) {
  for (QComboBox* it : choices_)
    if (const int row = it->findData(choice); row >= 0) it->setCurrentIndex(row);
}

void ConflictDialog::finish() {
  std::vector<Choice> choices;
  for (const QComboBox* it : choices_) choices.push_back(Choice(it->currentData().toInt()));
  accept();
  chosen_(session_.sharing().resolve(choices));
}

}  // namespace icome::ui
