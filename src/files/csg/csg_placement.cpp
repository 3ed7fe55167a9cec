#include "files/csg/csg_placement.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "files/csg/csg_arguments.h"
#include "files/csg/csg_colours.h"
#include "files/csg/csg_shapes.h"

namespace icome::files {
namespace {

using geometry::Affine3;
using geometry::CsgTree;
using Index = CsgDocument::Index;
using Kind = CsgDocument::Kind;

/// The determinant of a matrix with columns of length 1 that rounding leaves where it should be zero.
constexpr double kFlat = 1e-14;

/// Red, green, blue and alpha as given by the vector; alpha is 1 in a vector of three.
std::array<double, 4> channels(CsgArguments& arguments, Index vector) {
  if (arguments.length(vector) != 3) return arguments.numbers<4>(vector, "a colour");
  const auto [red, green, blue] = arguments.numbers<3>(vector, "a colour");
  return {red, green, blue, 1.0};
}

}  // namespace

base::Result<Affine3> read_matrix(const CsgDocument& document, Index statement) {
  CsgArguments arguments(document, statement, {"m"});
  Affine3 matrix = Affine3::Identity();
  const auto given = arguments.find("m");
  if (arguments.failed()) return tl::unexpected(arguments.error());
  if (!given) {
    const CsgDocument::Offset offset = document.statements()[statement].offset;
    return tl::unexpected(document.error_at(offset, "multmatrix needs a matrix, 4 rows of 4 numbers"));
  }
  if (document.value(*given).kind != Kind::Vector || arguments.length(*given) != 4)
    arguments.fail(*given, "a matrix is expected, 4 rows of 4 numbers");
  Index row = *given + 1;
  for (int i = 0; i < 4 && !arguments.failed(); ++i, row = document.value_end(row)) {
    const auto numbers = arguments.numbers<4>(row, "a row of the matrix");
    if (i == 3 && numbers != std::array<double, 4>{0.0, 0.0, 0.0, 1.0})
      arguments.fail(row, "[0, 0, 0, 1] is expected, for the last row of an affine matrix is always that");
    matrix.matrix().row(i) << numbers[0], numbers[1], numbers[2],
        i == 3 ? numbers[3] : numbers[3] / kMillimetresPerMetre;
  }
  if (arguments.failed()) return tl::unexpected(arguments.error());
  return matrix;
}

bool flattens(const Affine3& transform) {
  Eigen::Matrix3d columns = transform.linear();
  for (int i = 0; i < 3; ++i) {
    const double length = columns.col(i).stableNorm();
    if (length == 0.0) return true;
    columns.col(i) /= length;
  }
  return std::abs(columns.determinant()) <= kFlat;
}

base::Result<CsgColour> read_colour(const CsgDocument& document, Index statement) {
  CsgArguments arguments(document, statement, {"c", "alpha"});
  CsgColour result;
  std::optional<std::array<double, 4>> rgba;
  if (const auto given = arguments.find("c")) {
    const CsgDocument::Value& value = document.value(*given);
    if (value.kind == Kind::String) {
      if (const auto named = parse_colour(document.string(value)))
        rgba = {(*named)[0], (*named)[1], (*named)[2], (*named)[3]};
      result.unknown_name = !rgba;
    } else if (value.kind == Kind::Vector) {
      rgba = channels(arguments, *given);
    } else {
      arguments.fail_kind(*given, "a colour is expected, a vector of 3 or 4 numbers or a name");
    }
  }
  const std::optional<double> alpha = arguments.number("alpha");
  if (arguments.failed()) return tl::unexpected(arguments.error());
  if (rgba && alpha) rgba->back() = *alpha;
  // OpenSCAD writes -1 for channels that were not given, and ignores such a colour.
  if (!rgba || *std::min_element(rgba->begin(), rgba->end()) < 0.0) return result;
  result.clamped = *std::max_element(rgba->begin(), rgba->end()) > 1.0;
  result.colour.emplace();
  std::transform(rgba->begin(), rgba->end(), result.colour->begin(),
                 [](double channel) { return static_cast<float>(std::min(channel, 1.0)); });
  return result;
}

}  // namespace icome::files
