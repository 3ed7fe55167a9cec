#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/parse_number.h"
#include "io/file_bytes.h"
#include "io/text_scanner.h"
#include "sketch/files/stroke_collector.h"
#include "sketch/files/stroke_formats.h"

namespace icome::sketch {
namespace {

using io::TextScanner;

// Types and codes of linux/input-event-codes.h.
constexpr std::int64_t kEvSyn = 0, kEvKey = 1, kEvAbs = 3;
constexpr std::int64_t kSynReport = 0;
constexpr std::int64_t kBtnTouch = 0x14a;
constexpr std::int64_t kAbsX = 0, kAbsY = 1, kAbsPressure = 0x18;

constexpr std::uint64_t kLargestDescription = 1U << 20U;  // bytes

/// Range of an axis: an `A:` line.
struct PenAxis {
  double least = 0.0, greatest = 0.0;
  double resolution = 0.0;  // units a mm; 0: not told
};
struct PenAxes {
  std::optional<PenAxis> x, y, pressure;

  bool any() const { return x || y || pressure; }
  bool in_mm() const { return x && y && x->resolution > 0.0 && y->resolution > 0.0; }
};

std::int64_t hexadecimal(TextScanner& scanner, const char* what) {
  const std::string_view word = scanner.word();
  const auto number = base::parse_number<std::int64_t>(word, 16);
  if (!number) scanner.fail(fmt::format("{} is not {}", io::quoted(word), what));
  return number.value_or(0);
}

/// The rest of an `A:` line: code, least, greatest, fuzz, flat and, in newer ones, the resolution.
void read_axis(TextScanner& scanner, PenAxes& axes) {
  const std::int64_t code = hexadecimal(scanner, "the code of an axis");
  PenAxis axis;
  axis.least = double(scanner.integer("the least value of an axis"));
  axis.greatest = double(scanner.integer("the greatest value of an axis"));
  scanner.integer("the fuzz of an axis");
  scanner.integer("the flat part of an axis");
  if (!scanner.failed() && scanner.more_on_line())
    axis.resolution = double(scanner.integer("the resolution of an axis"));
  if (code == kAbsX) axes.x = axis;
  if (code == kAbsY) axes.y = axis;
  if (code == kAbsPressure) axes.pressure = axis;
}

/// The ranges in a description; none where it is not there or no description.
PenAxes axes_in(const std::filesystem::path& description) {
  PenAxes axes;
  const auto text = io::read_bytes(description, kLargestDescription);
  if (!text) return axes;
  TextScanner scanner(*text, description.string(), TextScanner::Lines::Matter, '#');
  for (; !scanner.at_end(); scanner.skip_line())
    if (scanner.word() == "A:") read_axis(scanner, axes);
  return scanner.failed() ? PenAxes{} : axes;
}

/// The ranges in a description beside `file`: "tablet.drag.events" has its own in tablet.drag.desc,
/// tablet.desc or, of the pen alone, tablet_Pen.desc. The first that tells mm, else the first of all.
PenAxes axes_beside(const std::filesystem::path& file) {
  PenAxes first;
  for (std::filesystem::path stem = file.stem(); !stem.empty(); stem = stem.stem()) {
    for (const char* const ending : {".desc", "_Pen.desc", " Pen.desc"}) {
      const PenAxes axes = axes_in(file.parent_path() / (stem.string() + ending));
      if (axes.in_mm()) return axes;
      if (!first.any()) first = axes;
    }
    if (!stem.has_extension()) break;
  }
  return first;
}

/// A recording while it is read: samples in the units of its axes, that the axes need not come first.
class EvemuRecording {
 public:
  EvemuRecording(std::string_view text, const std::string& name)
      : scanner_(text, name, TextScanner::Lines::Matter, '#') {}

  base::Result<void> read();
  PenAxes& axes() { return axes_; }
  const std::vector<PenStroke>& strokes() const { return strokes_; }

 private:
  void read_event();
  void end_report(double time);

  TextScanner scanner_;
  PenAxes axes_;
  std::vector<PenStroke> strokes_;
  std::optional<double> x_, y_;
  double pressure_ = 0.0;
  bool is_down_ = false, was_down_ = false;
};

void EvemuRecording::end_report(double time) {
  if (is_down_ && x_ && y_) {
    if (!was_down_) strokes_.emplace_back();
    strokes_.back().push_back({time, base::Vector2(*x_, *y_), pressure_});
    was_down_ = true;
  }
  if (!is_down_) was_down_ = false;
}

void EvemuRecording::read_event() {
  const double time = scanner_.number("the time of an event");
  const std::int64_t type = hexadecimal(scanner_, "the type of an event");
  const std::int64_t code = hexadecimal(scanner_, "the code of an event");
  const std::int64_t value = scanner_.integer("the value of an event");
  if (scanner_.failed()) return;
  if (type == kEvSyn && code == kSynReport) end_report(time);
  if (type == kEvKey && code == kBtnTouch) is_down_ = value != 0;
  if (type != kEvAbs) return;
  if (code == kAbsX) x_ = double(value);
  if (code == kAbsY) y_ = double(value);
  if (code == kAbsPressure) pressure_ = double(value);
}

base::Result<void> EvemuRecording::read() {
  for (; !scanner_.at_end(); scanner_.skip_line()) {
    const std::string_view word = scanner_.word();
    if (word == "A:") read_axis(scanner_, axes_);
    if (word == "E:") read_event();
    if (word.size() != 2 || word[1] != ':')
      scanner_.fail(io::quoted(word) +
                    " begins no line of an evemu recording, such as \"E: 0.01 0003 0000 7\"");
  }
  if (scanner_.failed()) return tl::unexpected(scanner_.error());
  return {};
}

base::Vector2 place_on_tablet(const base::Vector2& reported, const PenAxes& axes) {
  if (!axes.in_mm()) return kMetresOfMm * reported;
  return kMetresOfMm * base::Vector2((reported.x() - axes.x->least) / axes.x->resolution,
                                     (reported.y() - axes.y->least) / axes.y->resolution);
}

}  // namespace

base::Result<StrokesRead> read_evemu_strokes(std::string_view text, const std::filesystem::path& file) {
  const std::string name = file.string();
  EvemuRecording recording(text, name);
  if (const auto read = recording.read(); !read) return tl::unexpected(read.error());
  PenAxes axes = recording.axes();
  if (!axes.any()) axes = axes_beside(file);
  StrokeCollector collector(name);
  for (const PenStroke& stroke : recording.strokes()) {
    for (const PenSample& sample : stroke) {
      const auto added = collector.add({sample.time, place_on_tablet(sample.place, axes), sample.pressure});
      if (!added) return base::fail(fmt::format("{}: {}", name, added.error().message));
    }
    collector.lift();
  }
  if (!axes.in_mm()) collector.note("no resolution of x and y is known: they are taken as mm");
  const bool knows_pressure = axes.pressure && axes.pressure->greatest > 0.0;
  return collector.finish(knows_pressure ? axes.pressure->greatest : 0.0);
}

}  // namespace icome::sketch
