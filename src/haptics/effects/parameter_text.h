#pragma once
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::haptics {

/// A number of an effect or a texture as people write it.
struct Parameter {
  std::string_view name;       // in capitals, as the help shows it: "RADIUS"
  std::string_view unit = {};  // "m"; empty: none
  double least = -1e6;         // limits of the value, both ends included
  double most = 1e6;
  std::optional<double> usual = {};  // value if left out; only the last parameters have one
};

/// "X,Y,Z[,STIFFNESS[,DAMPING]]"
std::string usage_of(std::span<const Parameter> parameters);

/// "STIFFNESS 0 to 1e+06 N/m (200)", separated by commas; with the default limits the unit alone is shown.
std::string ranges_of(std::span<const Parameter> parameters);

/// Reads "0,0,0.05,0.01": all parameters, those that are left out at their usual value. Fails with a sentence
/// that names the number that is wrong by its place and name.
base::Result<std::vector<double>> read_parameters(std::string_view text,
                                                  std::span<const Parameter> parameters);

/// 'there is no effect "wel"; did you mean 'well'?': a sentence about a kind of thing that is not among
/// `names`.
std::string unknown_name(std::string_view kind, std::string_view said, std::vector<std::string> names);

/// The parts of a text between separators that stand in no parentheses: "min(x,y),0" has two. Without a
/// separator there is one, which may be empty.
std::vector<std::string_view> split_outside_parentheses(std::string_view text, char separator);

}  // namespace icome::haptics
