#include "ui/window/status_strip.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QTimer>
#include <cmath>

#include "base/clock.h"
#include "charts/length_text.h"
#include "devices/device_news.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"
#include "ui/plots/force_plot.h"
#include "ui/plots/load_plot.h"
#include "ui/plots/load_window.h"

namespace icome::ui {

using devices::DeviceStatus;

namespace {

constexpr int kRefreshEvery = 66;  // ms
constexpr int kStalledLooks = 8;   // in a row that are worth a word: half a second
constexpr const char* kTouchedTip = "The object under the hand";

/// A lamp that shows the state of the device.
class StateDot final : public QWidget {
 public:
  explicit StateDot(QWidget* parent) : QWidget(parent) { setFixedSize(3 * kGrid, 3 * kGrid); }

  void show(DeviceStatus status) {
    if (status == status_) return;
    status_ = status;
    update();
  }

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const ThemeColours& theme = colours();
    const QColor colour = status_ == DeviceStatus::Ok        ? theme.good
                          : status_ == DeviceStatus::Stalled ? theme.warning
                                                             : theme.bad;
    const QRectF round = QRectF(rect()).adjusted(1.5, 1.5, -1.5, -1.5);
    // Not by colour alone: a lost device is a ring.
    painter.setPen(QPen(colour, 1.6));
    painter.setBrush(status_ == DeviceStatus::Lost ? QBrush(Qt::NoBrush) : QBrush(colour));
    painter.drawEllipse(round);
  }

 private:
  DeviceStatus status_ = DeviceStatus::Lost;
};

QLabel* figure(const QString& caption, const QString& tip, QGridLayout& grid, int row, QWidget* parent) {
  auto* name = new QLabel(caption, parent);
  name->setForegroundRole(QPalette::PlaceholderText);
  auto* value = new QLabel(parent);
  value->setAccessibleName(caption);
  value->setTextInteractionFlags(Qt::TextSelectableByMouse);
  name->setToolTip(tip);
  value->setToolTip(tip);
  grid.addWidget(name, row, 0);
  grid.addWidget(value, row, 1, Qt::AlignRight);
  return value;
}

void set(QLabel& label, const QString& text) {
  if (label.text() == text) return;
  label.setText(text);
  label.setAccessibleDescription(text);
}

/// `others`: pointers beside it, but for the mouse's.
QString words_of(DeviceStatus status, const std::string& condition, std::size_t others) {
  if (status == DeviceStatus::Lost) return others > 0 ? "lost; the others go on" : "lost";
  if (devices::gives_no_force(condition)) return "may not push";
  return status == DeviceStatus::Stalled ? "no place for a while" : "ready";
}

QString explanation_of(DeviceStatus status, const std::string& condition) {
  if (!condition.empty()) return one_line(devices::in_one_line(condition));
  switch (status) {
    case DeviceStatus::Ok:
      return "The pointer device gives its place at every tick.";
    case DeviceStatus::Stalled:
      return "The pointer device is there, but has not told its place for half a second.";
    case DeviceStatus::Lost:
      break;
  }
  return "The pointer device does not answer: plug it in again. Forces go nowhere meanwhile.";
}

QString softer_words(const session::PointerView& view) {
  return QString(
             "It was made %1 N/m hard and is felt as %2 N/m, the most that is stable on this device at this "
             "servo rate.")
      .arg(std::llround(view.asked_stiffness))
      .arg(std::llround(view.stiffness));
}

QString sparing_words(const devices::DeviceInfo& device) {
  return QString(
             "The motors of this device can hold %1 N for long. More has been asked of them for some time, "
             "so "
             "the force sinks to that until they have rested.")
      .arg(device.continuous_force);
}

/// Text on the first few effects: their names, and what they are felt as.
QString capped_words(const world::World& world, const std::vector<haptics::CappedEffect>& effects) {
  constexpr std::size_t kMostTold = 6;
  QStringList lines{"Together with what else acts, this device renders less than was asked for:"};
  for (std::size_t i = 0; i < std::min(effects.size(), kMostTold); ++i) {
    const QString name = shown_name(world, world::ObjectId{effects[i].id});
    lines << QString("%1: %2").arg(name, one_line(effects[i].what));
  }
  if (effects.size() > kMostTold) lines << QString("and %1 more").arg(effects.size() - kMostTold);
  return lines.join('\n');
}

QString grouped(double number) {
  return number >= 0.0 && number < 1e15
             ? QString::fromStdString(charts::grouped(std::size_t(std::llround(number))))
             : QString("–");
}

QString microseconds(double seconds) {
  return std::isfinite(seconds) ? QString("%1 µs").arg(grouped(seconds * 1e6)) : QString("–");
}

}  // namespace

struct StatusStrip::Parts {
  Parts(session::Session& of, StatusStrip& strip);

  QWidget* build_device(QWidget* strip);
  QWidget* build_servo(QWidget* strip);
  void look();
  void look_at_device();
  void look_at_effects();
  void look_at_servo(std::int64_t now);

  session::Session& session;
  LoadWindow window{};
  StateDot* dot = nullptr;
  QLabel* device = nullptr;
  QLabel* state = nullptr;
  QLabel* touched = nullptr;
  QLabel* capped = nullptr;
  int stalled_looks = 0;   // in a row
  bool held_back = false;  // the device may not push now
  QLabel* rate = nullptr;
  QLabel* overruns = nullptr;
  QLabel* lateness = nullptr;
  LoadPlot* load;
  ForcePlot* force;
  QTimer* timer;
};

StatusStrip::Parts::Parts(session::Session& of, StatusStrip& strip)
    : session(of), load(new LoadPlot(&strip)), force(new ForcePlot(&strip)), timer(new QTimer(&strip)) {
  auto* row = new QHBoxLayout(&strip);
  row->setContentsMargins(3 * kGrid, 2 * kGrid, 3 * kGrid, 2 * kGrid);
  row->setSpacing(5 * kGrid);
  row->addWidget(build_device(&strip));
  row->addWidget(build_servo(&strip));
  row->addWidget(load, 3);
  row->addWidget(force, 4);
  QObject::connect(timer, &QTimer::timeout, &strip, [this] { look(); });
  timer->setInterval(kRefreshEvery);
}

QWidget* StatusStrip::Parts::build_device(QWidget* strip) {
  auto* block = new QWidget(strip);
  block->setFixedWidth(42 * kGrid);
  auto* grid = new QGridLayout(block);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(kGrid);
  grid->setColumnStretch(1, 1);
  dot = new StateDot(block);
  device = new QLabel(block);
  QFont bold = device->font();
  bold.setWeight(QFont::DemiBold);
  device->setFont(bold);
  device->setAccessibleName("Pointer device");
  state = new QLabel(block);
  state->setForegroundRole(QPalette::PlaceholderText);
  state->setAccessibleName("State of the pointer device");
  touched = new QLabel(block);
  touched->setAccessibleName("Object that is touched");
  touched->setToolTip(kTouchedTip);
  grid->addWidget(dot, 0, 0);
  grid->addWidget(device, 0, 1);
  grid->addWidget(state, 1, 1);
  capped = new QLabel(block);
  capped->setForegroundRole(QPalette::PlaceholderText);
  capped->setAccessibleName("Effects that are felt softer than asked for");
  grid->addWidget(touched, 2, 1);
  grid->addWidget(capped, 3, 1);
  grid->setRowStretch(4, 1);
  return block;
}

QWidget* StatusStrip::Parts::build_servo(QWidget* strip) {
  auto* block = new QWidget(strip);
  block->setFixedWidth(46 * kGrid);
  auto* grid = new QGridLayout(block);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setVerticalSpacing(kGrid);
  grid->setColumnStretch(0, 1);
  rate = figure("Servo rate",
                "How often a second the servo asks the device where the hand is and answers with a "
                "force (Hz), and how often it was asked to.",
                *grid, 0, block);
  overruns = figure("Overruns",
                    "Ticks since the start that took longer than there was time: the next one was due "
                    "before they had ended.",
                    *grid, 1, block);
  lateness = figure("Lateness",
                    "How long after its time a tick begins (p99.9 since the start: all but one in a "
                    "thousand are earlier). The system decides; real-time priority helps.",
                    *grid, 2, block);
  grid->setRowStretch(3, 1);
  return block;
}

void StatusStrip::Parts::look() {
  const std::int64_t now = base::steady_nanoseconds();
  look_at_device();
  look_at_servo(now);
  const double reach = session.hands().pointers() > 0 ? session.hands().pointer_info(0).max_force : 0.0;
  std::vector<session::ForceSample> forces = session.hands().take_forces();
  // What the servo asks for goes nowhere then.
  for (session::ForceSample& it : forces) it.force = held_back ? 0.0F : it.force;
  force->add(forces, now, reach);
}

void StatusStrip::Parts::look_at_device() {
  if (session.hands().pointers() == 0) return set(*device, "No pointer device");
  const session::PointerView& view = session.hands().pointer(0);
  const QString name = one_line(session.hands().pointer_info(0).name);
  // The mouse beside a device is not worth a word.
  const std::size_t others = session.hands().mouse().value_or(session.hands().pointers()) - 1;
  const QString more =
      !session.hands().is_mouse_driven() && others > 0 ? QString(" + %1").arg(others) : QString();
  const int room = 36 * kGrid - device->fontMetrics().horizontalAdvance(more);
  set(*device, device->fontMetrics().elidedText(name, Qt::ElideRight, room) + more);
  device->setToolTip(name);
  // A slow device has nothing new at most ticks.
  stalled_looks = view.status == DeviceStatus::Stalled ? stalled_looks + 1 : 0;
  const bool is_slow = stalled_looks > 0 && stalled_looks < kStalledLooks;
  const DeviceStatus status = is_slow ? DeviceStatus::Ok : view.status;
  const std::string condition = session.hands().use(0).condition;
  held_back = status == DeviceStatus::Ok && devices::gives_no_force(condition);
  dot->show(held_back ? DeviceStatus::Stalled : status);
  const bool spared = view.spared && status == DeviceStatus::Ok && !held_back;
  set(*state, spared ? QString("ready, force held down") : words_of(status, condition, others));
  const QString explanation = explanation_of(status, condition);
  state->setToolTip(spared ? sparing_words(session.hands().pointer_info(0)) : explanation);
  dot->setToolTip(explanation);
  const auto object = view.touching ? session.hands().touched(0) : std::nullopt;
  const bool softer = object && view.stiffness < view.asked_stiffness;
  const QString what =
      object ? (softer ? "softly touches " : "touches ") + shown_name(session.world(), *object) : QString();
  touched->setToolTip(softer ? softer_words(view) : QString(kTouchedTip));
  set(*touched, touched->fontMetrics().elidedText(what, Qt::ElideRight, 36 * kGrid));
  look_at_effects();
}

void StatusStrip::Parts::look_at_effects() {
  const std::vector<haptics::CappedEffect>& softer = session.hands().capped_effects();
  capped->setVisible(!softer.empty());
  if (softer.empty()) return;
  set(*capped, softer.size() == 1 ? QString("1 effect felt softly")
                                  : QString("%1 effects felt softly").arg(softer.size()));
  capped->setToolTip(tip_of(capped_words(session.world(), softer)));
}

void StatusStrip::Parts::look_at_servo(std::int64_t now) {
  const session::ServoHealth health = session.hands().servo();
  const double period = health.summary.period.median;
  if (!health.running) {
    set(*rate, "stopped");
  } else {
    set(*rate, QString("%1 of %2 Hz")
                   .arg(period > 0.0 ? grouped(1.0 / period) : QString("–"), grouped(health.rate_hz)));
  }
  set(*overruns, grouped(double(health.summary.overruns)));
  set(*lateness, microseconds(health.summary.lateness.p999));
  window.add(now, health.load_histogram);
  load->show(window);
}

StatusStrip::StatusStrip(session::Session& session, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(session, *this)) {
  setAccessibleName("Hand and servo");
}

StatusStrip::~StatusStrip() = default;

void StatusStrip::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  parts_->look();
  parts_->timer->start();
}

void StatusStrip::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  parts_->timer->stop();
}

}  // namespace icome::ui
