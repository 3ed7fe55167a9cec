#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "interaction/operations/value.h"

namespace icome::interaction {

/// What may be said for a parameter.
enum class ParameterKind : std::uint8_t {
  Flag,     ///< true or false
  Number,   ///< finite
  Count,    ///< a whole number
  Text,     ///< a name or words
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

/// One parameter of an operation, as people are told of it and as what they say is held to it. Text in SI:
/// metres, radians where `unit` does not say degrees.
struct Parameter {
  std::string name;
  ParameterKind kind = ParameterKind::Number;
  std::string meaning = {};  // a phrase, its unit in it: "how far it reaches, m"
  bool required = false;     // must be said
  Value fallback = {};       // where nothing is said; null: left to the operation, which has() tells
  double least = -std::numeric_limits<double>::infinity();  // of every number in it
  double most = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices = {};
  std::size_t components = 3;          // of Points
  std::vector<Parameter> fields = {};  // of Records
  /// Only where the operation's first parameter, a Choice, is one of these; empty: always.
  std::vector<std::string> only_for = {};
};

}  // namespace icome::interaction
