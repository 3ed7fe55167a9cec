#pragma once
#include <cstdint>
#include <string>

namespace icome::io {

// Numbers as the shortest decimal text that reads back to the same bits: 0.9, not 0.89999998.

void append_number(std::string& text, double number);
void append_number(std::string& text, float number);
void append_number(std::string& text, std::uint32_t number);

/// In single precision; what is beyond it becomes the largest number there is.
float to_single(double number);

/// The number that such a text of a float says, to all digits of a double: 0.9, not 0.89999998.
double as_written(float number);

}  // namespace icome::io
