#include "devices/device_news.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace icome::devices {
namespace {

std::vector<std::string_view> lines_of(std::string_view condition) {
  std::vector<std::string_view> lines;
  while (!condition.empty()) {
    const std::size_t end = std::min(condition.find('\n'), condition.size());
    if (end > 0) lines.push_back(condition.substr(0, end));
    condition.remove_prefix(std::min(end + 1, condition.size()));
  }
  return lines;
}

std::string without_numbers(std::string_view line) {
  std::string text(line);
  std::erase_if(text, [](char letter) { return letter >= '0' && letter <= '9'; });
  return text;
}

std::string_view without_stop(std::string_view sentence) {
  if (sentence.ends_with('.')) sentence.remove_suffix(1);
  return sentence;
}

}  // namespace

bool gives_no_force(std::string_view condition) {
  const auto lines = lines_of(condition);
  return std::any_of(lines.begin(), lines.end(),
                     [](std::string_view line) { return line.starts_with(kNoForce); });
}

std::string in_one_line(std::string_view condition) {
  std::string all;
  for (const std::string_view line : lines_of(condition))
    all += fmt::format("{}{}.", all.empty() ? "" : " ", without_stop(line));
  return all;
}

std::string loss_text(const std::string& name, const std::string& why) {
  if (why.empty())
    return fmt::format(
        "The device \"{}\" does not answer: see that it is plugged in and switched on. It is used again as "
        "soon as it answers.",
        name);
  return fmt::format("The device \"{}\" is lost: {} It is used again as soon as it answers.", name,
                     in_one_line(why));
}

std::vector<DeviceNews::Item> DeviceNews::look(bool is_lost, std::string_view condition) {
  std::vector<Item> news;
  const bool was_lost = std::exchange(is_lost_, is_lost);
  if (is_lost) {
    if (!was_lost) news.push_back({Kind::Lost, loss_text(name_, std::string(condition))});
    // The next connection has a condition of its own.
    sentences_.clear();
    return news;
  }
  if (was_lost) news.push_back({Kind::Back, fmt::format("The device \"{}\" is back.", name_)});
  look_at(condition, news);
  return news;
}

void DeviceNews::look_at(std::string_view condition, std::vector<Item>& news) {
  std::vector<Sentence> now;
  for (const std::string_view line : lines_of(condition)) {
    Sentence sentence{without_numbers(line), false};
    const auto before = std::find_if(sentences_.begin(), sentences_.end(),
                                     [&](const Sentence& it) { return it.text == sentence.text; });
    if (before != sentences_.end()) {
      sentence.told = true;
      if (!before->told) news.push_back({Kind::Notice, fmt::format("{}: {}.", name_, without_stop(line))});
    }
    now.push_back(std::move(sentence));
  }
  sentences_ = std::move(now);
}

}  // namespace icome::devices
