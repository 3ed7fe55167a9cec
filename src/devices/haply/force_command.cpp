#include "devices/haply/force_command.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

namespace icome::devices {

ForceCommand::ForceCommand(std::string_view device_id, std::string_view field) {
  begin_ = "\"inverse3\":[{\"device_id\":\"";
  begin_ += device_id;
  begin_ += "\",\"commands\":{\"set_cursor_force\":{\"";
  begin_ += field;
  begin_ += "\":{\"x\":";
  assert(begin_.size() < text_.size() / 2);
}

std::string_view ForceCommand::write(const base::Vector3& force, bool full) {
  size_ = 0;
  append("{");
  if (full) append(R"("session":{"force_render_full_state":{}},)");
  append(begin_);
  append(force.x());
  append(",\"y\":");
  append(force.y());
  append(",\"z\":");
  append(force.z());
  append("}}}}]}");
  return {text_.data(), size_};
}

void ForceCommand::append(std::string_view text) {
  assert(size_ + text.size() <= text_.size());
  std::copy(text.begin(), text.end(), text_.begin() + std::ptrdiff_t(size_));
  size_ += text.size();
}

void ForceCommand::append(double newtons) {
  constexpr int kDigits = 6;  // after the point: a micronewton
  const double bounded = std::isfinite(newtons) ? std::clamp(newtons, -kMostForce, kMostForce) : 0.0;
  const auto [end, error] = std::to_chars(text_.data() + size_, text_.data() + text_.size(), bounded,
                                          std::chars_format::fixed, kDigits);
  assert(error == std::errc());
  size_ = std::size_t(end - text_.data());
}

std::string_view greeting_message() {
  return R"({"session":{"configure":{"profile":{"name":"ICOME"}},"force_render_full_state":{}}})";
}

}  // namespace icome::devices
