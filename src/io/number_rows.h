#pragma once
#include <span>
#include <string>
#include <string_view>

#include "base/function_ref.h"
#include "base/result.h"

namespace icome::io {

/// Called with each row of numbers. A failure is the end of a sentence that begins with file and line.
using VisitNumbers = base::FunctionRef<base::Result<void>(std::span<const double>)>;

/// Reads rows of finite numbers from a CSV table whose first line names these columns, each by one letter
/// ("xyz" for the line `x,y,z`). Empty lines may stand at its end. Fails, naming `source` and line, on
/// another first line, a row with more or fewer numbers, a cell that is no finite number, and where `visit`
/// does.
base::Result<void> read_number_rows(std::string_view text, const std::string& source,
                                    std::string_view columns, VisitNumbers visit);

}  // namespace icome::io
