#include "animation/export/output_names.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "io/file_ending.h"

namespace icome::animation {
namespace {

using base::fail;
using base::Result;

constexpr int kUsualDigits = 4;

constexpr std::array<std::pair<std::string_view, OutputFormat>, 6> kEndings = {
    {{".png", OutputFormat::Png},
     {".svg", OutputFormat::Svg},
     {".mp4", OutputFormat::Mp4},
     {".webm", OutputFormat::WebM},
     {".gif", OutputFormat::Gif},
     {".apng", OutputFormat::Apng}}};

std::optional<OutputFormat> format_of(const std::string& name) {
  const std::string ending = io::ending_of(name).type;
  for (const auto& [text, format] : kEndings)
    if (ending == text) return format;
  return std::nullopt;
}

/// Splits a name at its number: %d, %4d or %04d. Without % it has none; fails on any other.
Result<void> split_at_number(const std::string& name, OutputNames& names) {
  const std::size_t at = name.find('%');
  names.before = name.substr(0, at);
  if (at == std::string::npos) return {};
  std::size_t end = at + 1;
  names.digits = 1;
  if (end < name.size() && name[end] == '0') ++end;
  if (end < name.size() && name[end] >= '1' && name[end] <= '9') names.digits = name[end++] - '0';
  if (end >= name.size() || name[end] != 'd' || name.find('%', end) != std::string::npos)
    return fail(fmt::format("{}: for a number of four digits, write one %04d, and no other %", name));
  names.behind = name.substr(end + 1);
  return {};
}

}  // namespace

std::string OutputNames::name_of(int frame) const {
  return digits < 0 ? before : fmt::format("{}{:0{}}{}", before, frame, digits, behind);
}

std::filesystem::path OutputNames::of(int frame) const { return folder / name_of(frame); }

Result<OutputNames> output_names(const std::string& out, int frames) {
  std::error_code ignored;
  if (out.empty()) return fail("there is no name of a file to write");
  if (out.back() == '/' || std::filesystem::is_directory(out, ignored))
    return OutputNames{OutputFormat::Png, out, "frame", ".png", kUsualDigits};
  const std::filesystem::path path = out;
  const std::string name = path.filename().string();
  const auto format = format_of(name);
  if (!format)
    return fail(
        fmt::format("{}: no such kind of file is written; end the name with .mp4, .webm, .gif, .apng, "
                    ".png or .svg, or with / for a folder of pictures",
                    out));
  OutputNames names;
  names.format = *format;
  names.folder = path.parent_path();
  if (!is_sequence(*format)) {
    names.before = name;
    return names;
  }
  if (const auto split = split_at_number(name, names); !split) return tl::unexpected(split.error());
  if (names.digits < 0 && frames != 1)
    return fail(fmt::format("{}: {} frames need as many names; write {}%04d{}", out, frames,
                            path.stem().string(), path.extension().string()));
  return names;
}

}  // namespace icome::animation
