#include "files/vrml/write/vrml_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "io/number_text.h"

namespace icome::files {
namespace {

constexpr std::size_t kFlushAt = 1U << 20U;
constexpr std::size_t kSpacesPerLevel = 2;
// Deeper lines begin in the same column: a chain of objects must not make a file of spaces.
constexpr int kMostLevels = 32;

}  // namespace

void VrmlText::begin_line() {
  if (empty_) buffer_ += '\n';
  empty_ = false;
  if (buffer_.size() > kFlushAt) finish();
  buffer_.append(kSpacesPerLevel * std::size_t(std::min(depth_, kMostLevels)), ' ');
}

void VrmlText::finish() {
  file_.write(buffer_);
  buffer_.clear();
}

void VrmlText::add(std::string_view vrml) {
  begin_line();
  buffer_ += vrml;
  buffer_ += '\n';
}

void VrmlText::open(std::string_view head) {
  begin_line();
  buffer_ += head;
  buffer_ += " {";
  ++depth_;
  empty_ = true;
}

void VrmlText::close() {
  --depth_;
  const bool empty = empty_;
  empty_ = false;
  if (!empty) begin_line();
  buffer_ += empty ? " }\n" : "}\n";
}

void VrmlText::open_list(std::string_view name) {
  begin_line();
  buffer_ += name;
  buffer_ += " [";
  ++depth_;
  empty_ = true;
}

void VrmlText::close_list() {
  --depth_;
  const bool empty = empty_;
  empty_ = false;
  if (!empty) begin_line();
  buffer_ += empty ? " ]\n" : "]\n";
}

void VrmlText::begin_field(std::string_view name) {
  begin_line();
  buffer_ += name;
  buffer_ += ' ';
}

void VrmlText::field(std::string_view name, bool value) {
  begin_field(name);
  buffer_ += value ? "TRUE\n" : "FALSE\n";
}

void VrmlText::field(std::string_view name, double value) {
  const float shortened = single(value);
  field(name, std::span(&shortened, 1));
}

void VrmlText::field(std::string_view name, const base::Vector3& value) {
  const std::array<float, 3> shortened = {single(value.x()), single(value.y()), single(value.z())};
  field(name, shortened);
}

void VrmlText::field(std::string_view name, std::span<const float> values) {
  begin_line();
  buffer_ += name;
  for (const float value : values) {
    buffer_ += ' ';
    append(value);
  }
  buffer_ += '\n';
}

void VrmlText::text_field(std::string_view name, std::string_view value) {
  begin_field(name);
  append_quoted(value);
  buffer_ += '\n';
}

void VrmlText::text_row(std::string_view value) {
  begin_line();
  append_quoted(value);
  buffer_ += '\n';
}

void VrmlText::row(std::span<const float> values) {
  begin_line();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) buffer_ += ' ';
    append(values[i]);
  }
  buffer_ += '\n';
}

void VrmlText::polygon(std::span<const std::uint32_t> indices) {
  begin_line();
  append(indices);
  buffer_ += " -1\n";
}

void VrmlText::indices(std::span<const std::uint32_t> values) {
  begin_line();
  append(values);
  buffer_ += '\n';
}

void VrmlText::append(std::span<const std::uint32_t> values) {
  std::array<char, 16> digits;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) buffer_ += ' ';
    buffer_.append(digits.data(), std::to_chars(digits.begin(), digits.end(), values[i]).ptr);
  }
}

void VrmlText::row(const base::Vector3& value) {
  const std::array<float, 3> shortened = {single(value.x()), single(value.y()), single(value.z())};
  row(shortened);
}

/// Without an exponent where people would not use one.
void VrmlText::append(float value) {
  constexpr float kLarge = 1e7F, kSmall = 1e-4F;
  const float size = std::fabs(value);
  std::array<char, 48> digits;
  std::to_chars_result end{};
  if (size < kLarge && std::trunc(value) == value)  // also -0
    end = std::to_chars(digits.begin(), digits.end(), std::int32_t(value));
  else if (size >= kSmall && size < kLarge)
    end = std::to_chars(digits.begin(), digits.end(), value, std::chars_format::fixed);
  else
    end = std::to_chars(digits.begin(), digits.end(), value);
  buffer_.append(digits.data(), end.ptr);
}

float VrmlText::single(double value) {
  clipped_ |= std::fabs(value) > std::numeric_limits<float>::max();
  return io::to_single(value);
}

void VrmlText::append_quoted(std::string_view value) {
  buffer_ += '"';
  for (const char c : value) {
    if (c == '"' || c == '\\') buffer_ += '\\';
    buffer_ += c;
  }
  buffer_ += '"';
}

}  // namespace icome::files
