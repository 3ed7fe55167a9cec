#include "ui/window/banner.h"

#include <QAccessible>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/window/banner_row.h"

namespace icome::ui {
namespace {

constexpr std::size_t kMostRows = 3;  // that are visible
constexpr std::size_t kMostKept = 50;
constexpr int kPassing = 5000;  // ms

}  // namespace

Banner::Banner(QWidget* parent) : QWidget(parent), rows_(new QVBoxLayout(this)) {
  setObjectName("banner");
  setAccessibleName("Messages");
  rows_->setContentsMargins(0, 0, 0, 0);
  rows_->setSpacing(0);
  hide();
}

void Banner::tell(const Note& note) {
  if (!note.topic.empty()) forget(note.topic);
  auto* row = new BannerRow(note, this);
  row->on_close([this, row] { take_away(row); });
  row->on_remedy([this, row](Note::Remedy remedy) {
    const Note taken = row->note();
    take_away(row);
    remedy_(taken, remedy);
  });
  told_.insert(told_.begin(), row);
  rows_->insertWidget(progress_ ? 1 : 0, row);
  if (told_.size() > kMostKept) take_away(told_.back());
  if (note.weight == Note::Weight::Passing)
    QTimer::singleShot(kPassing, row, [this, row] { take_away(row); });
  arrange();
  QAccessibleEvent alert(row, QAccessible::Alert);
  QAccessible::updateAccessibility(&alert);
}

void Banner::take_away(BannerRow* row) {
  const auto found = std::find(told_.begin(), told_.end(), row);
  if (found == told_.end()) return;
  told_.erase(found);
  row->hide();
  row->deleteLater();
  arrange();
}

void Banner::forget(const std::string& topic) {
  for (std::size_t i = told_.size(); i-- > 0;) {
    if (told_[i]->note().topic == topic) take_away(told_[i]);
  }
}

void Banner::arrange() {
  for (std::size_t i = 0; i < told_.size(); ++i) told_[i]->setVisible(i < kMostRows);
  setVisible(progress_ || !told_.empty());
}

void Banner::show_progress(const QString& text, std::optional<double> part,
                           const std::function<void()>& cancel) {
  // The work may have become another, such as reading after saving.
  if (progress_ && progress_->can_be_cancelled() != bool(cancel)) hide_progress();
  if (!progress_) {
    progress_ = new ProgressRow(cancel, this);
    rows_->insertWidget(0, progress_);
    progress_->show();
    arrange();
  }
  progress_->report(text, part);
}

void Banner::hide_progress() {
  if (!progress_) return;
  progress_->hide();
  progress_->deleteLater();
  progress_ = nullptr;
  arrange();
}

}  // namespace icome::ui
