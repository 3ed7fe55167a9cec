#pragma once
#include <string>

#include "interaction/elements/element_file.h"
#include "interaction/elements/element_use.h"

namespace icome::interaction {

/// Letters that are all 0.8 of a capital's height wide.
inline TextMeasure even_letters() {
  return [](const std::string& text) { return 0.8 * double(text.size()); };
}

/// An element from TOML that has to be right.
inline Element element_of(const std::string& toml) { return read_element(toml, "sample.toml").value(); }

}  // namespace icome::interaction
