#pragma once
#include <QPainter>
#include <QString>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "ui/cutout/document/cutout_document.h"

namespace icome::ui {

/// A row of the timeline.
struct TimeRow {
  enum class Kind : std::uint8_t { Marks, Sound, Layer, Cell, Channel };
  Kind kind = Kind::Cell;
  animation::LayerId layer = {};  // none: the camera's
  CellId cell = {};
  Channel channel = Channel::X;
  QString name = {};
  int top = 0, height = 0;  // pixels, from the first row

  bool contains(int y) const { return y >= top && y < top + height; }
};

/// The parts of the timeline that are open or folded.
struct TimeFolds {
  std::set<CellId> open;                // cells whose channels have rows
  std::set<animation::LayerId> folded;  // layers whose cells have none
};

/// All rows from the top: marks, sound, then layers and their cells from the front, the camera last.
std::vector<TimeRow> time_rows(const animation::Project& project, const TimeFolds& folds);
/// Pixels of all rows together.
int height_of(const std::vector<TimeRow>& rows);
/// Null where there is none.
const TimeRow* row_at(const std::vector<TimeRow>& rows, int y);
/// The frames from one to another at which a row has keys, and the keys of each.
std::map<int, KeyPlaces> keys_of(const animation::Project& project, const TimeRow& row, int from = 0,
                                 int to = animation::kLongestAnimation);
/// The first and the last frame with a key of a row; nothing where it has none.
std::optional<std::pair<int, int>> span_of_keys(const animation::Project& project, const TimeRow& row);

/// The name of a channel for people.
const char* channel_name(Channel channel);

/// Frames along a line: pixels from its beginning.
struct FrameScale {
  double frame_width = 12.0;  // pixels
  double scroll = 0.0;        // pixels

  double left_of(double frame) const { return frame * frame_width - scroll; }
  double middle_of(double frame) const { return left_of(frame + 0.5); }
  /// The frame whose room it is; may lie outside of the animation.
  int frame_at(double x) const;
  /// The scale at which the frame under a place stays there.
  void zoom(double about, double factor);
  /// Frames between numbers of the ruler, so that they do not touch.
  int number_step(double rate) const;
};

/// Draws a key: a square holds, a diamond goes straight, a circle is eased.
void paint_key(QPainter& painter, QPointF middle, animation::Ease ease, const QColor& fill,
               const QColor& line, double radius);

/// The height of a sound over time: least and greatest values, -1 to 1, at an even rate.
struct SoundShape {
  double rate = 0;  // pairs a second
  std::vector<float> least, greatest;

  double seconds() const { return rate > 0 ? double(least.size()) / rate : 0.0; }
  /// The least and the greatest value in a span, s; both 0 outside of the sound.
  std::pair<float, float> within(double from, double to) const;
};

}  // namespace icome::ui
