#include "ui/cutout/time/time_rows.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

using animation::Cell;
using animation::Layer;
using animation::Project;

constexpr int kRowHeight = 22;      // pixels
constexpr int kSoundHeight = 40;    // pixels
constexpr int kChannelHeight = 18;  // pixels
constexpr double kLeastFrameWidth = 1.5;
constexpr double kMostFrameWidth = 60.0;
constexpr double kNumberRoom = 52.0;  // pixels for a number of the ruler

class RowMaker {
 public:
  RowMaker(const Project& project, const TimeFolds& folds) : project_(project), folds_(folds) {}

  std::vector<TimeRow> make() {
    add({.kind = TimeRow::Kind::Marks, .name = "Marks"}, kRowHeight);
    if (project_.sound)
      add({.kind = TimeRow::Kind::Sound, .name = one_line(project_.sound->file).section('/', -1)},
          kSoundHeight);
    for (auto layer = project_.layers.rbegin(); layer != project_.layers.rend(); ++layer) {
      add({.kind = TimeRow::Kind::Layer, .layer = layer->id, .name = one_line(layer->name)}, kRowHeight);
      if (folds_.folded.contains(layer->id)) continue;
      for (auto cell = layer->cells.rbegin(); cell != layer->cells.rend(); ++cell) add_cell(*cell, layer->id);
    }
    add_cell(project_.camera, {});
    return std::move(rows_);
  }

 private:
  void add(TimeRow row, int height) {
    row.top = top_;
    row.height = height;
    top_ += height;
    rows_.push_back(std::move(row));
  }
  void add_cell(const Cell& cell, animation::LayerId layer) {
    const QString name = cell.id == animation::kCamera ? QString("Camera") : one_line(cell.name);
    add({.kind = TimeRow::Kind::Cell, .layer = layer, .cell = cell.id, .name = name}, kRowHeight);
    if (!folds_.open.contains(cell.id)) return;
    for (const Channel channel : channels_of(cell.id))
      add({.kind = TimeRow::Kind::Channel,
           .layer = layer,
           .cell = cell.id,
           .channel = channel,
           .name = channel_name(channel)},
          kChannelHeight);
  }

  const Project& project_;
  const TimeFolds& folds_;
  std::vector<TimeRow> rows_;
  int top_ = 0;
};

/// Calls with each track that a row shows the keys of.
template <typename Use>
void each_track(const Project& project, const TimeRow& row, const Use& use) {
  const auto all_of = [&](const Cell& cell) {
    for (const Channel channel : animation::kAllChannels)
      use(cell.id, channel, cell.tracks[std::size_t(channel)]);
  };
  if (row.kind == TimeRow::Kind::Layer) {
    if (const Layer* const layer = project.find(row.layer))
      for (const Cell& cell : layer->cells) all_of(cell);
    return;
  }
  const Cell* const cell = row.cell ? project.find(row.cell) : nullptr;
  if (cell == nullptr) return;
  if (row.kind == TimeRow::Kind::Cell) all_of(*cell);
  if (row.kind == TimeRow::Kind::Channel) use(cell->id, row.channel, cell->tracks[std::size_t(row.channel)]);
}

}  // namespace

const char* channel_name(Channel channel) {
  switch (channel) {
    case Channel::X:
      return "x";
    case Channel::Y:
      return "y";
    case Channel::Angle:
      return "Angle";
    case Channel::Scale:
      return "Scale";
    case Channel::Opacity:
      return "Opacity";
    case Channel::Picture:
      return "Picture";
  }
  return "";
}

std::vector<TimeRow> time_rows(const Project& project, const TimeFolds& folds) {
  return RowMaker(project, folds).make();
}

int height_of(const std::vector<TimeRow>& rows) {
  return rows.empty() ? 0 : rows.back().top + rows.back().height;
}

const TimeRow* row_at(const std::vector<TimeRow>& rows, int y) {
  const auto found = std::ranges::find_if(rows, [y](const TimeRow& row) { return row.contains(y); });
  return found == rows.end() ? nullptr : &*found;
}

std::map<int, KeyPlaces> keys_of(const Project& project, const TimeRow& row, int from, int to) {
  std::map<int, KeyPlaces> keys;
  each_track(project, row, [&](CellId cell, Channel channel, const animation::Track& track) {
    const auto first =
        std::lower_bound(track.begin(), track.end(), from,
                         [](const animation::Key& key, int frame) { return key.frame < frame; });
    for (auto key = first; key != track.end() && key->frame <= to; ++key)
      keys[key->frame].insert({cell, channel, key->frame});
  });
  return keys;
}

std::optional<std::pair<int, int>> span_of_keys(const Project& project, const TimeRow& row) {
  std::optional<std::pair<int, int>> span;
  each_track(project, row, [&](CellId, Channel, const animation::Track& track) {
    if (track.empty()) return;
    const int first = track.front().frame, last = track.back().frame;
    span =
        span ? std::pair(std::min(span->first, first), std::max(span->second, last)) : std::pair(first, last);
  });
  return span;
}

int FrameScale::frame_at(double x) const { return int(std::floor((x + scroll) / frame_width)); }

void FrameScale::zoom(double about, double factor) {
  const double frame = (about + scroll) / frame_width;
  frame_width = std::clamp(frame_width * factor, kLeastFrameWidth, kMostFrameWidth);
  scroll = std::max(0.0, frame * frame_width - about);
}

int FrameScale::number_step(double rate) const {
  const int second = std::max(1, int(std::lround(rate)));
  for (const int step : {1, 2, 5, 10})
    if (step < second && step * frame_width >= kNumberRoom) return step;
  int step = second;
  while (step * frame_width < kNumberRoom) step *= 2;
  return step;
}

void paint_key(QPainter& painter, QPointF middle, animation::Ease ease, const QColor& fill,
               const QColor& line, double radius) {
  painter.setPen(QPen(line, 1.0));
  painter.setBrush(fill);
  switch (ease) {
    case animation::Ease::Hold: {
      const double half = 0.82 * radius;
      painter.drawRect(QRectF(middle.x() - half, middle.y() - half, 2 * half, 2 * half));
      break;
    }
    case animation::Ease::Straight: {
      const QPointF corners[] = {middle + QPointF(0, -radius), middle + QPointF(radius, 0),
                                 middle + QPointF(0, radius), middle + QPointF(-radius, 0)};
      painter.drawPolygon(corners, 4);
      break;
    }
    case animation::Ease::Eased:
      painter.drawEllipse(middle, 0.88 * radius, 0.88 * radius);
      break;
  }
}

std::pair<float, float> SoundShape::within(double from, double to) const {
  if (to <= 0.0) return {0.0F, 0.0F};
  const auto begin = std::max(0.0, std::floor(from * rate));
  const auto end = std::min(double(least.size()), std::max(begin + 1.0, std::ceil(to * rate)));
  if (!(begin < end)) return {0.0F, 0.0F};
  const auto first = std::size_t(begin), last = std::size_t(end);
  return {
      *std::min_element(least.begin() + std::ptrdiff_t(first), least.begin() + std::ptrdiff_t(last)),
      *std::max_element(greatest.begin() + std::ptrdiff_t(first), greatest.begin() + std::ptrdiff_t(last))};
}

}  // namespace icome::ui
