#include "sketch/files/stroke_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/parse_number.h"
#include "io/file_bytes.h"
#include "io/table_reader.h"
#include "io/text_scanner.h"
#include "sketch/files/stroke_formats.h"

namespace icome::sketch {
namespace {

constexpr std::uint64_t kLargestStrokeFile = 1U << 30U;  // bytes

enum class StrokeFormat : std::uint8_t { Unknown, Csv, InkMl, Svc, Scap, MyPaint, Evemu };

StrokeFormat format_by_ending(const std::filesystem::path& file) {
  static constexpr std::array<std::pair<std::string_view, StrokeFormat>, 9> kEndings = {
      {{".csv", StrokeFormat::Csv},
       {".tsv", StrokeFormat::Csv},
       {".inkml", StrokeFormat::InkMl},
       {".ink", StrokeFormat::InkMl},
       {".svc", StrokeFormat::Svc},
       {".scap", StrokeFormat::Scap},
       {".dat", StrokeFormat::MyPaint},
       {".events", StrokeFormat::Evemu},
       {".evemu", StrokeFormat::Evemu}}};
  const std::string ending = file.extension().string();
  for (const auto& [name, format] : kEndings)
    if (io::same_word(name, ending)) return format;
  return StrokeFormat::Unknown;
}

/// Guesses by the first words, which differ between all formats.
StrokeFormat format_by_content(std::string_view text) {
  io::TextScanner scanner(text, "", io::TextScanner::Lines::AreSpace, '\0');
  const std::string_view first = scanner.word();
  if (first.starts_with('<')) return StrokeFormat::InkMl;
  if (first == "E:" || first == "N:" || first == "I:") return StrokeFormat::Evemu;
  if (first == "{" || first.starts_with('@')) return StrokeFormat::Scap;
  if (first == "#") return StrokeFormat::Evemu;
  if (first.starts_with('#')) return StrokeFormat::Scap;
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  if (line.find("pressure") != std::string_view::npos) return StrokeFormat::Csv;
  if (base::parse_number<std::int64_t>(line)) return StrokeFormat::Svc;
  return base::parse_finite(first) ? StrokeFormat::MyPaint : StrokeFormat::Unknown;
}

}  // namespace

base::Result<StrokesRead> read_strokes(const std::filesystem::path& file) {
  const auto bytes = io::read_bytes(file, kLargestStrokeFile);
  if (!bytes) return tl::unexpected(bytes.error());
  const std::string name = file.string();
  StrokeFormat format = format_by_ending(file);
  const std::string_view text = *bytes, unmarked = io::without_byte_order_mark(text);
  if (format == StrokeFormat::Unknown) format = format_by_content(unmarked);
  switch (format) {
    case StrokeFormat::Csv:
      return read_csv_strokes(text, name);
    case StrokeFormat::InkMl:
      return read_inkml_strokes(text, name);
    case StrokeFormat::Svc:
      return read_svc_strokes(unmarked, name);
    case StrokeFormat::Scap:
      return read_scap_strokes(unmarked, name);
    case StrokeFormat::MyPaint:
      return read_mypaint_strokes(unmarked, name);
    case StrokeFormat::Evemu:
      return read_evemu_strokes(unmarked, file);
    case StrokeFormat::Unknown:
      break;
  }
  return base::fail(name +
                    ": is no recording of a pen that is known: give a CSV with the header t,x,y,pressure, or "
                    "a file that ends in .inkml, .svc, .scap, .dat or .events");
}

}  // namespace icome::sketch
