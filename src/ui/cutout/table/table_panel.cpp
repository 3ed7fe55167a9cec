#include "ui/cutout/table/table_panel.h"

#include <fmt/format.h>

#include <QCheckBox>
#include <QFileDialog>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "base/clock.h"
#include "ui/actions/recent_files.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

using animation::MappingMode;

constexpr double kScreenBudget = 0.015;  // s from a frame of the table to the screen
constexpr int kWordsEvery = 250;         // ms between renewals of words that change with each frame
constexpr double kLargestTable = 10.0;   // m
constexpr const char* kModeNames[] = {"nothing", "absolute", "relative", "nearest"};
constexpr const char* kModeTips[] = {"The triangle moves nothing", "The cell is where the triangle is",
                                     "What the triangle is moved is added to the cell",
                                     "The triangle takes the cell that lies nearest below it"};

const animation::Mapping* mapping_of(const animation::Project& project, const std::string& triangle) {
  const auto found = std::ranges::find(project.mappings, triangle, &animation::Mapping::triangle);
  return found == project.mappings.end() ? nullptr : &*found;
}

QString milliseconds_text(double seconds) { return QString::number(1000.0 * seconds, 'f', 1); }

}  // namespace

TablePanel::TablePanel(CutoutDocument& document, QSettings& settings, QWidget* parent)
    : QWidget(parent),
      document_(document),
      kept_(settings),
      hands_(document),
      delays_(kScreenBudget),
      section_(new PanelSection("Table", this)),
      triangles_(new PanelSection("Triangles", this)) {
  setObjectName("table");
  source_ = add_text("table.source", "Source of frames", "camera, a folder, a video, rtsp://\u2026");
  section_->add_row("Source",
                    "A camera (camera, camera:2, /dev/video2), a stream, a folder of pictures or a video",
                    {source_});
  known_ = add_text("table.known", "List of known triangles", "known.toml");
  section_->add_row(
      "Triangles", "The list of known triangles, as `icome track` has it",
      {with_chooser(known_, "List of Known Triangles", "Lists of triangles (*.toml);;All files (*)")});
  view_ = add_text("table.view", "View of the camera", "none: the frame is the table");
  section_->add_row("View", "What `icome track --calibrate` has found",
                    {with_chooser(view_, "View of the Camera", "Views (*.toml);;All files (*)")});
  width_ = add_size("table.width", "Width of the table");
  height_ = add_size("table.height", "Height of the table");
  section_->add_row("Size, mm", "Of the table, where there is no view", {width_, height_});
  start_ = new QPushButton("Watch the table", section_->body());
  start_->setObjectName("table.start");
  connect(start_, &QPushButton::clicked, this, [this] { is_running() ? stop() : start(); });
  section_->add_below(start_);
  status_ = new WrappedLabel("The table is not watched.", section_->body());
  status_->setObjectName("table.status");
  status_->setAccessibleName("State of the table");
  section_->add_wide(status_);
  steady_ = new QCheckBox("steady hands", triangles_->body());
  steady_->setObjectName("table.steady");
  steady_->setToolTip("Takes the trembling out of what triangles do, without a lag at speed");
  connect(steady_, &QCheckBox::clicked, this, [this](bool on) {
    document_.perform(cutout_command("steady", {{"on", on}}));
  });
  triangles_->add_wide(steady_);
  table_ = new QWidget(triangles_->body());
  rows_ = new QGridLayout(table_);
  rows_->setContentsMargins(0, 0, 0, 0);
  rows_->setColumnStretch(2, 1);
  triangles_->add_wide(table_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  column->addWidget(section_);
  column->addWidget(triangles_);
  column->addStretch();
  source_->setText(kept_.value("table/source", "camera").toString());
  known_->setText(kept_.value("table/known").toString());
  view_->setText(kept_.value("table/view").toString());
  table_width_ = kept_.value("table/width", table_width_).toDouble();
  table_height_ = kept_.value("table/height", table_height_).toDouble();
  width_->show_value(0.001 * table_width_);
  height_->show_value(0.001 * table_height_);
  follower_.on_sight([this](const TableSight& sight) { take_sight(sight); });
  follower_.on_state([this] { show_state(); });
  words_.setSingleShot(true);
  words_.setInterval(kWordsEvery);
  connect(&words_, &QTimer::timeout, this, [this] { show_status(); });
  refresh();
}

TablePanel::~TablePanel() { follower_.stop(); }

QLineEdit* TablePanel::add_text(const char* name, const QString& accessible, const QString& hint) {
  auto* field = new QLineEdit(section_->body());
  field->setObjectName(name);
  field->setAccessibleName(accessible);
  field->setPlaceholderText(hint);
  connect(field, &QLineEdit::editingFinished, this, [=, this] {
    field->setText(field->text());  // what was entered is not undone letter by letter
    keep_settings();
  });
  return field;
}

QWidget* TablePanel::with_chooser(QLineEdit* field, const QString& title, const QString& filter) {
  auto* both = new QWidget(section_->body());
  auto* row = new QHBoxLayout(both);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kGrid);
  row->addWidget(field, 1);
  auto* button = new QToolButton(both);
  button->setIcon(icon(Icon::Open));
  button->setAccessibleName("Choose: " + title);
  button->setToolTip(title);
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::StrongFocus);
  connect(button, &QToolButton::clicked, this, [=, this] {
    auto* dialog = new QFileDialog(this, title);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFile);
    dialog->setNameFilters(filter.split(";;"));
    connect(dialog, &QFileDialog::fileSelected, this, [=, this](const QString& path) {
      field->setText(path);
      keep_settings();
    });
    dialog->open();
  });
  row->addWidget(button);
  return both;
}

QuantityField* TablePanel::add_size(const char* name, const QString& accessible) {
  auto* field = new QuantityField(Quantity::Length, section_->body());
  field->setObjectName(name);
  field->setAccessibleName(accessible);
  field->on_refusal([this](const QString& why) { section_->note().keep(why); });
  const bool is_width = std::string(name) == "table.width";
  field->on_commit([=, this](std::optional<double> value, bool) -> base::Result<void> {
    if (!value || *value <= 0.0 || *value > kLargestTable)
      return base::fail("A length of some hundred mm is needed.");
    (is_width ? table_width_ : table_height_) = 1000.0 * *value;
    field->show_value(value);
    keep_settings();
    return {};
  });
  return field;
}

TableSettings TablePanel::settings_now() const {
  return {.source = path_of(source_->text().trimmed()).string(),
          .known = path_of(known_->text().trimmed()),
          .view = path_of(view_->text().trimmed()),
          .width = table_width_,
          .height = table_height_};
}

void TablePanel::keep_settings() {
  kept_.setValue("table/source", source_->text());
  kept_.setValue("table/known", known_->text());
  kept_.setValue("table/view", view_->text());
  kept_.setValue("table/width", table_width_);
  kept_.setValue("table/height", table_height_);
}

bool TablePanel::is_running() const {
  return follower_.state() == TableFollower::State::Opening ||
         follower_.state() == TableFollower::State::Running;
}

void TablePanel::start() {
  keep_settings();
  last_ = {};
  hands_.forget();
  const auto started = follower_.start(settings_now());
  if (!started) {
    section_->note().keep(QString::fromStdString(started.error().message));
    return show_state();
  }
  section_->note().clear();
  map_named_cells();
  show_mappings();
  show_state();
}

/// Triangles of the list that name a cell, and move nothing yet, move that one.
void TablePanel::map_named_cells() {
  animation::ProjectEdit edit;
  std::string missing;
  for (const cutout::KnownTriangle& triangle : follower_.known().triangles) {
    if (triangle.cell.empty() || mapping_of(document_.project(), triangle.id)) continue;
    const animation::Cell* const cell = document_.project().find(triangle.cell);
    if (cell != nullptr)
      edit.push_back(animation::ChangeMapping{
          triangle.id, animation::Mapping{triangle.id, MappingMode::Absolute, cell->id}});
    else
      missing +=
          fmt::format(" The list lets '{}' move '{}', which is no cell here.", triangle.id, triangle.cell);
  }
  document_.perform(edit);
  if (!missing.empty()) section_->note().keep(QString::fromStdString(missing.substr(1)));
}

void TablePanel::stop() {
  follower_.stop();
  hands_.forget();
  awaited_ = 0;
  document_.give_up();
  show_state();
}

void TablePanel::take_sight(const TableSight& sight) {
  last_ = sight;
  // A frame that moves nothing is not painted. Words wait: they would keep the picture waiting.
  if (hands_.take(sight, follower_.known())) awaited_ = sight.arrived;
  if (!words_.isActive()) words_.start();
}

void TablePanel::follow_frame() {
  if (follower_.state() == TableFollower::State::Running) hands_.take_again();
}

void TablePanel::painted() {
  if (awaited_ == 0) return;
  delays_.record({.scheduled = awaited_, .started = awaited_, .finished = base::steady_nanoseconds()});
  awaited_ = 0;
}

// Words.

void TablePanel::show_state() {
  const bool running = is_running();
  start_->setText(running ? "Stop watching" : "Watch the table");
  for (QWidget* it :
       {static_cast<QWidget*>(source_), static_cast<QWidget*>(known_), static_cast<QWidget*>(view_),
        static_cast<QWidget*>(width_), static_cast<QWidget*>(height_)})
    it->setEnabled(!running);
  const std::string problem = follower_.problem();
  if (follower_.state() == TableFollower::State::Ended) {
    hands_.let_go();
    document_.remark(problem);
  }
  show_status();
}

void TablePanel::show_status() {
  QStringList words;
  switch (follower_.state()) {
    case TableFollower::State::Off:
      words << "The table is not watched.";
      break;
    case TableFollower::State::Opening:
      words << "The source is being opened\u2026";
      break;
    case TableFollower::State::Ended:
      words << QString::fromStdString(follower_.problem());
      if (document_.is_recording()) words << "What was recorded is kept: stop the recording to have it.";
      break;
    case TableFollower::State::Running: {
      const std::size_t all = follower_.known().triangles.size();
      words << QString("%1 of %2 triangles are seen.").arg(last_.seen.size()).arg(all);
      QStringList ids;
      for (const cutout::Sighting& sighting : last_.seen)
        ids << one_line(follower_.known().triangles[sighting.triangle].id);
      if (!ids.isEmpty()) words << shortened(ids.join(", "), 80) + ".";
      if (last_.dropped > 0)
        words << QString("%L1 frames came too fast and were left out.").arg(last_.dropped);
      for (const std::string& complaint : follower_.complaints()) words << QString::fromStdString(complaint);
      const realtime::LoopSummary summary = delays_.summary();
      if (summary.ticks > 0)
        words << QString("From frame to screen: %1 ms in half of %L2 frames, %3 ms in 99 of 100.")
                     .arg(milliseconds_text(summary.busy.median))
                     .arg(summary.ticks)
                     .arg(milliseconds_text(summary.busy.p99));
      break;
    }
  }
  status_->say(words.join(' '));
}

// Mappings.

void TablePanel::refresh() {
  const QSignalBlocker quiet(steady_);
  steady_->setChecked(document_.project().smooth_hands);
  show_mappings();
}

void TablePanel::show_mappings() {
  // Those of the list, and those that the animation knows from another one.
  std::vector<std::string> names;
  for (const cutout::KnownTriangle& triangle : follower_.known().triangles) names.push_back(triangle.id);
  for (const animation::Mapping& mapping : document_.project().mappings)
    if (std::ranges::find(names, mapping.triangle) == names.end()) names.push_back(mapping.triangle);
  while (QLayoutItem* const item = rows_->takeAt(0)) {
    // Not at once: it may be one of these that has asked for the change.
    if (QWidget* const widget = item->widget()) {
      widget->hide();
      widget->deleteLater();
    }
    delete item;
  }
  for (const std::string& name : names) add_mapping_row(name);
  if (!names.empty()) return;
  auto* label = new QLabel("Each triangle of the list moves a cell of your choice.", table_);
  label->setWordWrap(true);
  rows_->addWidget(label, 0, 0, 1, 3);
}

void TablePanel::add_mapping_row(const std::string& triangle) {
  const int row = rows_->count() / 3;
  const animation::Mapping* const mapping = mapping_of(document_.project(), triangle);
  const QString name = one_line(triangle);
  auto* label = new QLabel(shortened(name, 16), table_);
  rows_->addWidget(label, row, 0);
  auto* mode = new QuietComboBox(table_);
  mode->setObjectName("table.mode." + name);
  mode->setAccessibleName("Way in which " + name + " moves a cell");
  for (int i = 0; i < int(std::size(kModeNames)); ++i) {
    mode->addItem(kModeNames[i]);
    mode->setItemData(i, kModeTips[i], Qt::ToolTipRole);
  }
  mode->setCurrentIndex(mapping ? 1 + int(mapping->mode) : 0);
  rows_->addWidget(mode, row, 1);
  auto* cell = new QuietComboBox(table_);
  cell->setObjectName("table.cell." + name);
  cell->setAccessibleName("Cell that " + name + " moves");
  for (const animation::Cell* it : cells_from_front(document_.project()))
    cell->addItem(it->id == animation::kCamera ? QString("Camera") : one_line(it->name),
                  QString::fromStdString(it->name));
  const animation::Cell* const moved = mapping ? document_.project().find(mapping->cell) : nullptr;
  cell->setCurrentIndex(moved ? cell->findData(QString::fromStdString(moved->name)) : -1);
  cell->setEnabled(!mapping || mapping->mode != MappingMode::Nearest);
  rows_->addWidget(cell, row, 2);
  connect(mode, &QComboBox::activated, this, [=, this](int chosen) {
    const animation::Cell* const leading = document_.leading();
    std::string to = cell->currentData().toString().toStdString();
    if (to.empty() && leading != nullptr) to = leading->name;
    if (to.empty() && cell->count() > 0) to = cell->itemData(0).toString().toStdString();
    map(triangle, chosen, to);
  });
  connect(cell, &QComboBox::activated, this, [=, this](int) {
    map(triangle, std::max(1, mode->currentIndex()), cell->currentData().toString().toStdString());
  });
}

void TablePanel::map(const std::string& triangle, int mode, const std::string& cell) {
  if (mode == 0) {
    if (mapping_of(document_.project(), triangle))
      document_.perform(cutout_command("unmap", {{"triangle", triangle}}));
    return;
  }
  interaction::Value::Fields fields = {{"triangle", triangle}, {"mode", kModeNames[mode]}};
  if (mode != 1 + int(MappingMode::Nearest)) fields.emplace_back("cell", cell);
  document_.perform(cutout_command("map", std::move(fields)));
}

}  // namespace icome::ui
