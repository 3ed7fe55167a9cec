#pragma once
#include <cstdint>
#include <string>

namespace icome::io {

// Numbers as the shortest decimal text that reads back to the same bits: 0.9, not 0.89999998.

void append_number(std::string& text, double number);
void append_number(std::string& text, float number);
void append_number(std::string& text, std::uint32_t number);

/// In single precision; a number out of range becomes the largest of its sign.
float to_single(double number);

/// The double that the shortest text of a float stands for: 0.9, not 0.89999998.
double as_written(float number);

}  // namespace icome::io
