#include "ui/devices/device_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "ui/devices/device_row.h"
#include "ui/devices/pointer_form.h"
#include "ui/look/theme.h"
#include "ui/panels/column_area.h"
#include "ui/panels/object_look.h"
#include "ui/panels/panel_section.h"

namespace icome::ui {
namespace {

constexpr int kEvery = 200;  // ms, between two looks at the devices

/// The index of the pointer whose device has this address or, however it was addressed, this identity;
/// nothing: none is connected.
std::optional<std::size_t> connected_as(const session::Session& session, const std::string& address,
                                        const std::string& identity) {
  for (std::size_t i = 0; i < session.hands().pointers(); ++i) {
    const session::PointerUse use = session.hands().use(i);
    if (use.address == address || (!identity.empty() && use.identity == identity)) return i;
  }
  return std::nullopt;
}

}  // namespace

struct DevicePanel::Parts {
  Parts(session::Session& of, DeviceWays ways, DevicePanel& panel);

  void build_found();
  void build_address();
  void tick();
  void look();
  void take_found();
  void take_opened();
  void show_found(const std::vector<devices::DeviceEntry>& entries);
  void show_states();
  void show_pointers();
  void open(const std::string& address, const std::string& identity);
  void act_on(const std::string& address, const std::string& identity);
  DeviceRow::State state_of(const std::string& address, const std::string& identity) const;
  void complain(const QString& why);

  session::Session& session;
  DeviceSearch search;
  QWidget* sheet;
  QVBoxLayout* column;
  PanelSection* found;
  PanelSection* missing;
  QWidget* found_rows = nullptr;
  QWidget* missing_rows = nullptr;
  QLabel* status = nullptr;
  QPushButton* refresh = nullptr;
  QLineEdit* address = nullptr;
  PanelNote* note = nullptr;      // on what is being opened
  QScrollArea* scroll = nullptr;  // around the sheet
  std::vector<DeviceRow*> rows;
  QWidget* forms_box;
  std::vector<PointerForm*> forms;
  QTimer* timer;
  bool has_looked = false;
  int turns = 0;  // of the text that shows that something is going on
};

DevicePanel::Parts::Parts(session::Session& of, DeviceWays ways, DevicePanel& panel)
    : session(of),
      search(std::move(ways)),
      sheet(new QWidget(&panel)),
      column(new QVBoxLayout(sheet)),
      found(new PanelSection("Found", sheet)),
      missing(new PanelSection("Not there", sheet)),
      forms_box(new QWidget(sheet)),
      timer(new QTimer(&panel)) {
  column->setContentsMargins(0, 2 * kGrid, 0, 2 * kGrid);
  column->setSpacing(0);
  new QVBoxLayout(forms_box);
  forms_box->layout()->setContentsMargins(0, 0, 0, 0);
  build_found();
  build_address();
  column->addWidget(forms_box);
  column->addWidget(found);
  column->addWidget(missing);
  column->addStretch(1);
  missing->hide();
  timer->setInterval(kEvery);
  QObject::connect(timer, &QTimer::timeout, &panel, [this] { tick(); });
}

void DevicePanel::Parts::build_found() {
  auto* row = new QWidget(found->body());
  auto* across = new QHBoxLayout(row);
  across->setContentsMargins(0, 0, 0, 0);
  status = new QLabel(row);
  status->setAccessibleName("Search for devices");
  status->setForegroundRole(QPalette::PlaceholderText);
  refresh = new QPushButton("Refresh", row);
  refresh->setToolTip("Looks again for what is plugged in");
  QObject::connect(refresh, &QPushButton::clicked, row, [this] { look(); });
  across->addWidget(status, 1);
  across->addWidget(refresh);
  found->add_wide(row);
  found_rows = new QWidget(found->body());
  found->add_wide(found_rows);
  missing_rows = new QWidget(missing->body());
  missing->add_wide(missing_rows);
}

void DevicePanel::Parts::build_address() {
  auto* row = new QWidget(found->body());
  auto* across = new QHBoxLayout(row);
  across->setContentsMargins(0, 0, 0, 0);
  address = new QLineEdit(row);
  address->setAccessibleName("Address of a device");
  address->setPlaceholderText("or vrpn:Tracker0@host");
  address->setToolTip("A device that is not listed: BACKEND:WHICH, or the name of a profile such as Touch");
  auto* button = new QPushButton("Connect", row);
  button->setAccessibleName("Connect this address");
  across->addWidget(address, 1);
  across->addWidget(button);
  found->add_wide(row);
  // Here, as below the list nobody would see it.
  note = new PanelNote(found->body());
  found->add_wide(note);
  const auto connect_it = [this] {
    const std::string wanted = address->text().trimmed().toStdString();
    if (!wanted.empty()) open(wanted, {});
  };
  QObject::connect(button, &QPushButton::clicked, row, connect_it);
  QObject::connect(address, &QLineEdit::returnPressed, row, connect_it);
}

void DevicePanel::Parts::look() {
  has_looked = true;
  search.look();
  tick();
}

void DevicePanel::Parts::tick() {
  take_opened();
  take_found();
  show_states();
  show_pointers();
  if (!sheet->isVisible() && !search.looks() && !search.is_opening()) timer->stop();
}

void DevicePanel::Parts::take_found() {
  if (search.looks()) status->setText("Looking for devices" + QString(1 + turns++ % 3, '.'));
  refresh->setEnabled(!search.looks());
  const auto result = search.take_found();
  if (!result) return;
  refresh->setEnabled(true);
  if (!*result) {
    status->setText("The search ended early.");
    complain(QString::fromStdString(result->error().message));
    return;
  }
  show_found(**result);
}

void DevicePanel::Parts::show_found(const std::vector<devices::DeviceEntry>& entries) {
  const auto renew = [](QWidget*& box, PanelSection& section) {
    delete box;
    box = new QWidget(section.body());
    auto* lines = new QVBoxLayout(box);
    lines->setContentsMargins(0, 0, 0, 0);
    lines->setSpacing(0);
    section.add_wide(box);
  };
  rows.clear();
  renew(found_rows, *found);
  renew(missing_rows, *missing);
  std::size_t present = 0;
  for (const devices::DeviceEntry& entry : entries) {
    QWidget* const box = entry.present ? found_rows : missing_rows;
    auto* row = new DeviceRow(
        entry, [this, name = entry.name, identity = entry.identity] { act_on(name, identity); }, box);
    box->layout()->addWidget(row);
    rows.push_back(row);
    present += entry.present ? 1 : 0;
  }
  missing->setVisible(present < entries.size());
  status->setText(present == 1 ? QString("1 device is there.")
                               : QString("%1 devices are there.").arg(present));
}

DeviceRow::State DevicePanel::Parts::state_of(const std::string& of, const std::string& identity) const {
  if (connected_as(session, of, identity)) return DeviceRow::State::Connected;
  if (search.is_opening(of)) return DeviceRow::State::Opening;
  if (session.hands().is_closing(of, identity)) return DeviceRow::State::Closing;
  return DeviceRow::State::Free;
}

void DevicePanel::Parts::show_states() {
  for (DeviceRow* row : rows) row->show(state_of(row->address(), row->identity()));
}

/// Says why something was refused, where it is seen.
void DevicePanel::Parts::complain(const QString& why) {
  note->keep(why);
  // Once it has its place.
  QTimer::singleShot(0, note, [this] { scroll->ensureWidgetVisible(note); });
}

void DevicePanel::Parts::act_on(const std::string& of, const std::string& identity) {
  if (const auto index = connected_as(session, of, identity)) {
    (void)session.hands().disconnect(*index);  // it is no mouse's, which has no address
    show_states();
    show_pointers();
  } else {
    open(of, identity);
  }
}

void DevicePanel::Parts::open(const std::string& of, const std::string& identity) {
  switch (state_of(of, identity)) {
    case DeviceRow::State::Connected:
      return complain(one_line(of) + " is connected already.");
    case DeviceRow::State::Closing:
      return complain(one_line(of) + " is still being closed: try again in a moment.");
    case DeviceRow::State::Opening:
      return;
    case DeviceRow::State::Free:
      break;
  }
  note->remark("Opening " + one_line(of) + "\u2026");
  search.open(of);
  timer->start();
  show_states();
}

void DevicePanel::Parts::take_opened() {
  for (DeviceSearch::Opened& it : search.take_opened()) {
    base::Result<void> done = {};
    if (!it.connection) {
      done = tl::unexpected(it.connection.error());
    } else if (const auto index = session.hands().connect(std::move(*it.connection)); !index) {
      done = tl::unexpected(index.error());
    }
    if (!done) {
      complain(QString("%1: %2").arg(one_line(it.address), one_line(done.error().message)));
      continue;
    }
    note->clear();
    if (address->text().trimmed().toStdString() == it.address) address->clear();
  }
}

/// Makes the forms anew when other pointers are there than before; else shows what is so now.
void DevicePanel::Parts::show_pointers() {
  std::vector<std::uint64_t> now;
  for (std::size_t i = 0; i < session.hands().pointers(); ++i) {
    const session::PointerUse use = session.hands().use(i);
    if (!use.is_mouse) now.push_back(use.number);
  }
  const bool same =
      std::equal(now.begin(), now.end(), forms.begin(), forms.end(),
                 [](std::uint64_t number, const PointerForm* form) { return number == form->number(); });
  if (same) {
    for (PointerForm* form : forms) form->refresh();
    return;
  }
  for (PointerForm* form : forms) {
    form->hide();
    form->deleteLater();  // this may be called by a button of it
  }
  forms.clear();
  // The mouse's pointer is the last one.
  for (std::size_t i = 0; i < now.size(); ++i) {
    forms.push_back(new PointerForm(session, i, forms_box));
    forms_box->layout()->addWidget(forms.back());
    forms.back()->show();
  }
}

DevicePanel::DevicePanel(session::Session& session, DeviceWays ways, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(session, std::move(ways), *this)) {
  setAccessibleName("Devices");
  auto* scroll = new ColumnArea(this);
  parts_->scroll = scroll;
  scroll->setWidget(parts_->sheet);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(scroll);
}

DevicePanel::~DevicePanel() = default;

bool DevicePanel::finish_typing() {
  for (PointerForm* form : parts_->forms)
    if (!form->finish_typing()) return false;
  return true;
}

void DevicePanel::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  parts_->timer->start();
  if (!parts_->has_looked) parts_->look();
  parts_->show_pointers();
}

void DevicePanel::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  parts_->tick();
}

}  // namespace icome::ui
