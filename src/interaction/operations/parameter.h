#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "interaction/operations/value.h"

namespace icome::interaction {

/// The kinds of values that a parameter may have.
enum class ParameterKind : std::uint8_t {
  Flag,     ///< true or false
  Number,   ///< finite
  Count,    ///< a whole number
  Text,     ///< a name or words
  Texts,    ///< a list of names or words; one may stand alone
  Picture,  ///< the name of a picture's file
  Choice,   ///< one of `choices`
  Colour,   ///< red, green and blue in [0, 1], "#rrggbb" or the name of a colour
  Vector,   ///< three numbers
  Numbers,  ///< a list of numbers
  Counts,   ///< a list of whole numbers, such as vertices
  Points,   ///< a list of points, each as many numbers as `components`
  Object,   ///< an object of the design, by name
  Objects,  ///< one or several
  Records   ///< a list of named values again, each as `fields` say
};

/// One parameter of an operation: its description for people, and the limits that given values must keep.
/// Text in SI: metres, radians where `meaning` does not say degrees.
struct Parameter {
  std::string name;
  ParameterKind kind = ParameterKind::Number;
  std::string meaning = {};  // a phrase, its unit in it: "how far it reaches, m"
  bool required = false;     // must be given
  Value fallback = {};       // where none is given; null: left to the operation, which asks has()
  double least = -std::numeric_limits<double>::infinity();  // of every number in it
  double most = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};
  std::size_t components = 3;          // of Points
  std::vector<Parameter> fields = {};  // of Records
  /// Taken only where the operation's first parameter, a Choice, is one of these; empty: always.
  std::vector<std::string> only_for = {};
};

}  // namespace icome::interaction
