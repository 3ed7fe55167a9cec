// The formats that are rows of numbers: .svc, .scap and .dat.
#include <fmt/format.h>

#include <cmath>

#include "io/text_scanner.h"
#include "sketch/files/stroke_collector.h"
#include "sketch/files/stroke_formats.h"

namespace icome::sketch {
namespace {

using io::TextScanner;

constexpr double kSecondsOfMs = 1e-3;

double pen_number(TextScanner& scanner, const char* what) {
  const double number = scanner.number(what);
  if (!std::isfinite(number)) scanner.fail(fmt::format("{:g} is not {}: it is not finite", number, what));
  return number;
}

base::Vector2 pen_place(TextScanner& scanner) {
  const double x = pen_number(scanner, "x of the pen");
  const double y = pen_number(scanner, "y of the pen");
  return kMetresOfMm * base::Vector2(x, y);
}

void add_or_fail(const PenSample& sample, StrokeCollector& collector, TextScanner& scanner) {
  if (const auto added = collector.add(sample); !added) scanner.fail(added.error().message);
}

/// A row of .svc behind x, y: time, pen status, azimuth, tilt, pressure.
void read_svc_row(TextScanner& scanner, StrokeCollector& collector, double seconds_of_time) {
  PenSample sample;
  sample.place = pen_place(scanner);
  sample.time = seconds_of_time * pen_number(scanner, "the time");
  const double status = pen_number(scanner, "the pen status (1 down, 0 lifted)");
  pen_number(scanner, "the azimuth");
  pen_number(scanner, "the tilt");
  sample.pressure = pen_number(scanner, "the pressure");
  if (!scanner.failed() && scanner.more_on_line())
    scanner.fail("more than the seven numbers x y t status azimuth tilt pressure");
  if (scanner.failed()) return;
  if (status != 0.0 && status != 1.0) return scanner.fail("the pen status is 1 (down) or 0 (lifted)");
  if (status == 0.0) return collector.lift();
  add_or_fail(sample, collector, scanner);
}

void expect_brace(TextScanner& scanner, std::string_view word) {
  scanner.fail(fmt::format("{} is neither a row x y pressure, nor #, @, {{ or }}", io::quoted(word)));
}

/// A row of .scap whose first word was read: x y pressure, or only x y.
void read_scap_row(std::string_view first, TextScanner& scanner, StrokeCollector& collector) {
  TextScanner x_scanner(first, "", TextScanner::Lines::Matter, '\0');
  const double x = pen_number(x_scanner, "x");
  if (x_scanner.failed()) return expect_brace(scanner, first);
  const double y = pen_number(scanner, "y of the pen");
  PenSample sample;
  sample.place = kMetresOfMm * base::Vector2(x, y);
  sample.time = kSampleSpacing * double(collector.sample_count());
  sample.pressure = scanner.more_on_line() ? pen_number(scanner, "the pressure") : 0.0;
  if (!scanner.failed()) add_or_fail(sample, collector, scanner);
}

}  // namespace

base::Result<StrokesRead> read_svc_strokes(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name, TextScanner::Lines::Matter, '\0');
  StrokeCollector collector(name);
  // SVC 2004 has whole numbers, with times in ms; programs that write seconds write a point.
  const bool is_whole = text.find('.') == std::string_view::npos;
  if (scanner.at_end()) return base::fail(name + ": is empty; a .svc begins with the count of its rows");
  const std::int64_t count = scanner.integer("the count of rows, with which a .svc begins");
  if (!scanner.failed() && scanner.more_on_line()) scanner.fail("the first line is the count of rows alone");
  std::int64_t rows = 0;
  for (; !scanner.at_end(); ++rows) {
    read_svc_row(scanner, collector, is_whole ? kSecondsOfMs : 1.0);
    scanner.skip_line();
  }
  if (scanner.failed()) return tl::unexpected(scanner.error());
  if (rows != count)
    return base::fail(fmt::format("{}:1: there are {} rows, not the {} of the first line: {}", name, rows,
                                  count, rows < count ? "the file may be cut short" : "correct the count"));
  collector.note(is_whole ? "its whole numbers are taken as mm and ms" : "its lengths are taken as mm");
  return collector.finish(0.0);
}

base::Result<StrokesRead> read_scap_strokes(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name, TextScanner::Lines::Matter, '\0');
  StrokeCollector collector(name);
  bool in_stroke = false;
  while (!scanner.at_end()) {
    const std::string_view word = scanner.word();
    if (word == "{" || word == "}") {
      if (in_stroke == (word == "{"))
        scanner.fail(in_stroke ? "a { within a stroke: the } before it is missing" : "a } without a {");
      in_stroke = word == "{";
      collector.lift();
    } else if (word.starts_with('#') || word.starts_with('@')) {
      // The canvas, a thickness, a group: nothing of the pen's way.
      while (scanner.more_on_line()) pen_number(scanner, "a number of the stroke's head");
    } else if (!in_stroke) {
      expect_brace(scanner, word);
    } else {
      read_scap_row(word, scanner, collector);
    }
  }
  if (in_stroke && !scanner.failed())
    scanner.fail("the } of the last stroke is missing: the file may be cut short");
  if (scanner.failed()) return tl::unexpected(scanner.error());
  collector.note("it tells no units and no times: lengths are taken as mm, samples as 1/100 s apart");
  return collector.finish(0.0);
}

base::Result<StrokesRead> read_mypaint_strokes(std::string_view text, const std::string& name) {
  TextScanner scanner(text, name, TextScanner::Lines::Matter, '#');
  StrokeCollector collector(name);
  while (!scanner.at_end()) {
    PenSample sample;
    sample.time = pen_number(scanner, "the time");
    sample.place = pen_place(scanner);
    sample.pressure = pen_number(scanner, "the pressure");
    if (!scanner.failed() && sample.pressure != 0.0)
      add_or_fail(sample, collector, scanner);
    else
      collector.lift();
    scanner.skip_line();  // newer recordings have the pen's tilt behind the pressure
  }
  if (scanner.failed()) return tl::unexpected(scanner.error());
  collector.note("its lengths are taken as mm");
  return collector.finish(0.0);
}

}  // namespace icome::sketch
