#include "ui/cutout/time/play_bar.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <cmath>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr double kRates[] = {12.0, 24.0, 25.0, 30.0};  // frames/s
constexpr const char* kSteps[] = {"on ones", "on twos", "on threes", "on fours"};
constexpr int kPlayIcon = 20;  // pixels

QString rate_text(double rate) { return QString("%1 frames/s").arg(rate, 0, 'g', 6); }

}  // namespace

PlayBar::PlayBar(CutoutDocument& document, CutoutLook& look, QWidget* parent)
    : QWidget(parent), document_(document), look_(look) {
  setObjectName("play_bar");
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  row->setSpacing(kGrid / 2);
}

void PlayBar::add_actions(const std::vector<QAction*>& actions) {
  auto* row = static_cast<QHBoxLayout*>(layout());
  if (row->count() > 0) row->addSpacing(3 * kGrid);
  for (QAction* action : actions) {
    auto* button = new QToolButton(this);
    button->setDefaultAction(action);
    button->setAutoRaise(true);
    button->setIconSize(QSize(kPlayIcon, kPlayIcon));
    button->setAccessibleName(action->text().remove('&'));
    button->setFocusPolicy(Qt::TabFocus);
    row->addWidget(button);
  }
}

void PlayBar::add_choices() {
  auto* row = static_cast<QHBoxLayout*>(layout());
  row->addSpacing(3 * kGrid);
  rate_ = new QuietComboBox(this);
  rate_->setObjectName("play.rate");
  rate_->setAccessibleName("Frames a second");
  rate_->setToolTip("Frames a second");
  rate_->setMinimumContentsLength(int(rate_text(25.0).size()));
  for (const double rate : kRates) rate_->addItem(rate_text(rate), rate);
  connect(rate_, &QComboBox::activated, this, [this](int at) {
    document_.perform(cutout_command("stage", {{"rate", rate_->itemData(at).toDouble()}}));
  });
  row->addWidget(rate_);
  step_ = new QuietComboBox(this);
  step_->setObjectName("play.step");
  step_->setAccessibleName("Frames from pose to pose");
  step_->setToolTip("Frames from one pose to the next, by Space");
  for (const char* step : kSteps) step_->addItem(step);
  connect(step_, &QComboBox::activated, this, [this](int at) {
    look_.step = at + 1;
    looked_();
  });
  row->addWidget(step_);
  row->addStretch();
  place_ = new QLabel(this);
  place_->setObjectName("play.place");
  place_->setAccessibleName("Frame and time");
  row->addWidget(place_);
}

void PlayBar::refresh() {
  const animation::Stage& stage = document_.project().stage;
  const QSignalBlocker quiet(rate_);
  int at = rate_->findData(stage.rate);
  if (at < 0) {
    while (rate_->count() > int(std::size(kRates))) rate_->removeItem(rate_->count() - 1);
    rate_->addItem(rate_text(stage.rate), stage.rate);
    at = rate_->count() - 1;
  }
  rate_->setCurrentIndex(at);
  place_->setText(QString("Frame %1 of %2   %3 s")
                      .arg(document_.frame())
                      .arg(stage.length)
                      .arg(document_.frame() / stage.rate, 0, 'f', 2));
}

}  // namespace icome::ui
