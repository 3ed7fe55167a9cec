#pragma once
// The formats behind read_strokes(), one function each. `name` is the file's, for errors and notes.
#include <filesystem>
#include <string>
#include <string_view>

#include "sketch/files/stroke_files.h"

namespace icome::sketch {

base::Result<StrokesRead> read_csv_strokes(std::string_view text, const std::string& name);
base::Result<StrokesRead> read_inkml_strokes(std::string_view text, const std::string& name);
base::Result<StrokesRead> read_svc_strokes(std::string_view text, const std::string& name);
base::Result<StrokesRead> read_scap_strokes(std::string_view text, const std::string& name);
base::Result<StrokesRead> read_mypaint_strokes(std::string_view text, const std::string& name);
/// Looks for the ranges of the axes beside `file` where the recording has none.
base::Result<StrokesRead> read_evemu_strokes(std::string_view text, const std::filesystem::path& file);

}  // namespace icome::sketch
