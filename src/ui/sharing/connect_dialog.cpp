#include "ui/sharing/connect_dialog.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSettings>
#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/panels/object_look.h"
#include "ui/panels/wrapped_label.h"

namespace icome::ui {

using session::SessionSharing;

namespace {

constexpr const char* kNameKey = "person/name";
constexpr int kLongestPersonName = 60;  // characters
constexpr const char* kAddressHint =
    "Paste the address that the owner of a design gave you, as `icome invite` prints it. It is a key to the "
    "design: pass it on only to who may come in.";

}  // namespace

QString person_name(const QSettings& settings) { return settings.value(kNameKey).toString().simplified(); }

ConnectDialog::ConnectDialog(session::Session& session, QSettings& settings,
                             std::function<void(const QString&)> chosen, QWidget* parent)
    : QDialog(parent), session_(session), settings_(settings), chosen_(std::move(chosen)) {
  setObjectName("connect");
  setWindowTitle("Open an Address");
  setMinimumWidth(130 * kGrid);
  auto* rows = new QVBoxLayout(this);
  rows->addWidget(new WrappedLabel(kAddressHint, this));
  auto* form = new QFormLayout;
  address_ = new QLineEdit(this);
  address_->setObjectName("connect.address");
  address_->setPlaceholderText("icome://host:port/design#token=\u2026");
  name_ = new QLineEdit(person_name(settings), this);
  name_->setObjectName("connect.name");
  name_->setMaxLength(kLongestPersonName);
  name_->setPlaceholderText("as the system knows you");
  form->addRow("&Address", address_);
  form->addRow("Your &name", name_);
  rows->addLayout(form);
  remark_ = new WrappedLabel("", this);
  remark_->setObjectName("connect.remark");
  rows->addWidget(remark_);
  auto* title = new QLabel("Joined &before", this);
  recent_ = new QListWidget(this);
  recent_->setObjectName("connect.recent");
  recent_->setMaximumHeight(36 * kGrid);
  title->setBuddy(recent_);
  rows->addWidget(title);
  rows->addWidget(recent_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Open | QDialogButtonBox::Cancel, this);
  open_ = buttons->button(QDialogButtonBox::Open);
  forget_ = buttons->addButton("&Forget", QDialogButtonBox::ActionRole);
  forget_->setToolTip("Takes the chosen address off the list");
  rows->addWidget(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, [this] { finish(); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(forget_, &QPushButton::clicked, this, [this] { forget_recent(); });
  connect(address_, &QLineEdit::textChanged, this, [this] { check(); });
  connect(recent_, &QListWidget::currentRowChanged, this, [this](int row) { choose_recent(row); });
  connect(recent_, &QListWidget::itemActivated, this, [this] { finish(); });
  fill_recent();
  title->setVisible(recent_->count() > 0);
  recent_->setVisible(recent_->count() > 0);
  forget_->setVisible(recent_->count() > 0);
  const QString copied = QGuiApplication::clipboard()->text().trimmed();
  if (SessionSharing::is_address(copied.toStdString())) address_->setText(copied);
  address_->selectAll();
  check();
}

void ConnectDialog::fill_recent() {
  const QSignalBlocker quiet(recent_);
  recent_->clear();
  for (const std::string& link : session_.sharing().recent())
    if (const auto shown = SessionSharing::shown(link)) recent_->addItem(one_line(*shown));
  forget_->setEnabled(false);
}

void ConnectDialog::choose_recent(int row) {
  const auto& links = session_.sharing().recent();
  forget_->setEnabled(row >= 0);
  if (row >= 0 && std::size_t(row) < links.size())
    address_->setText(QString::fromStdString(links[std::size_t(row)]));
}

void ConnectDialog::forget_recent() {
  const auto row = std::size_t(std::max(0, recent_->currentRow()));
  const auto& links = session_.sharing().recent();
  if (row < links.size()) session_.sharing().forget(std::string(links[row]));
  fill_recent();
}

/// Says what is wrong with an address while it is typed.
void ConnectDialog::check() {
  const QString text = address_->text().trimmed();
  const auto shown = SessionSharing::shown(text.toStdString());
  open_->setEnabled(shown.has_value());
  remark_->say(shown            ? "Opens " + one_line(*shown)
               : text.isEmpty() ? QString()
                                : one_line(shown.error().message));
}

void ConnectDialog::finish() {
  if (!open_->isEnabled()) return;
  settings_.setValue(kNameKey, name_->text().simplified());
  const QString address = address_->text().trimmed();
  accept();
  chosen_(address);
}

}  // namespace icome::ui
