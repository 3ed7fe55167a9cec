#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace icome::devices {

/// The beginning of a sentence of PointerDevice::condition() that says why the device may not push now.
inline constexpr std::string_view kNoForce = "No force: ";

/// Does a condition say that the device may not push now?
bool gives_no_force(std::string_view condition);
/// The sentences of a condition behind one another.
std::string in_one_line(std::string_view condition);
/// Sentences for people about a device that is lost, named `name`; `why` is its PointerDevice::condition().
std::string loss_text(const std::string& name, const std::string& why);

/// The news of a device: that it is lost and back, and each sentence of its condition once while it lasts,
/// whatever else comes and goes meanwhile. One thread's.
class DeviceNews {
 public:
  enum class Kind : std::uint8_t { Lost, Back, Notice };
  struct Item {
    Kind kind = Kind::Notice;
    std::string text;  // a sentence or two that name the device
  };

  explicit DeviceNews(std::string name) : name_(std::move(name)) {}

  /// What there is to tell since the last look, from whether the device is lost now and its condition. A
  /// sentence is told once it is there at two looks, as one that comes just before a loss says why it is
  /// lost.
  std::vector<Item> look(bool is_lost, std::string_view condition);
  bool is_lost() const { return is_lost_; }

 private:
  struct Sentence {
    std::string text;  // without numbers, as counts go on
    bool told = false;
  };
  void look_at(std::string_view condition, std::vector<Item>& news);

  std::string name_;
  bool is_lost_ = false;
  std::vector<Sentence> sentences_;  // of the last look
};

}  // namespace icome::devices
