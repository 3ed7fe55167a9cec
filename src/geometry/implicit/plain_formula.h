#pragma once
#include <functional>
#include <string>

#include "base/result.h"
#include "base/vector.h"

namespace icome::geometry {

/// The value of a formula at a point (m) and a time (s); NaN where it has none.
using PlainFormula = std::function<double(const base::Vector3& point, double time)>;

/// Reads the same text as Formula and lets muParser compute it, on plain numbers: a reference for formulas in
/// checks. It shares neither expressions nor programs with Formula. Fails with muParser's words on text that
/// it cannot read. Copies of the function share their state: one thread at a time.
base::Result<PlainFormula> plain_formula(const std::string& text);

}  // namespace icome::geometry
