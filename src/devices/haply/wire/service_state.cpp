#include "devices/haply/wire/service_state.h"

#include <simdjson.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "devices/haply/wire/web_socket.h"

namespace icome::devices {
namespace {

namespace json = simdjson::dom;
static_assert(WebSocket::kPadding >= simdjson::SIMDJSON_PADDING);

constexpr std::size_t kDeepest = 32;  // levels of a message

bool is_id_letter(char letter) {
  return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == '_' ||
         letter == '.' || letter == ':';
}

// Each function reads a part of a message: true if it makes sense. Null stands for a part that is left out.

/// Calls `read(key, value)` for each field, until one is false.
template <typename Read>
bool read_fields(json::element from, Read&& read) {
  if (from.is_null()) return true;
  json::object object;
  if (from.get(object) != simdjson::SUCCESS) return false;
  return std::all_of(object.begin(), object.end(), [&](const json::key_value_pair& field) {
    return read(std::string_view(field.key), field.value);
  });
}

bool read_number(json::element from, double& to) {
  return from.get(to) == simdjson::SUCCESS && std::isfinite(to);
}

/// Sets a bit of `seen` for each coordinate that is there.
bool read_vector(json::element from, Vector3& to, std::uint8_t& seen) {
  return read_fields(from, [&](std::string_view key, json::element value) {
    const std::size_t axis = std::string_view("xyz").find(key);
    if (key.size() != 1 || axis == std::string_view::npos) return true;
    seen |= std::uint8_t(1U << axis);
    return read_number(value, to[Eigen::Index(axis)]);
  });
}

bool read_quaternion(json::element from, Quaternion& to) {
  return read_fields(from, [&](std::string_view key, json::element value) {
    const std::size_t part = std::string_view("xyzw").find(key);  // as Eigen keeps them
    if (key.size() != 1 || part == std::string_view::npos) return true;
    return read_number(value, to.coeffs()[Eigen::Index(part)]);
  });
}

/// Reads true, false or a number; anything else counts as not told.
void read_flag(json::element from, bool& to) {
  double number = 0.0;
  if (from.get(to) == simdjson::SUCCESS) return;
  if (from.get(number) == simdjson::SUCCESS) to = number != 0.0;
}

void read_button(json::element from, unsigned bit, std::uint32_t& buttons) {
  bool down = (buttons >> bit & 1U) != 0;
  read_flag(from, down);
  buttons = (buttons & ~(1U << bit)) | (down ? 1U << bit : 0U);
}

bool read_buttons(json::element from, std::uint32_t& buttons) {
  return read_fields(from, [&](std::string_view key, json::element value) {
    const std::size_t bit = std::string_view("abc").find(key);
    if (key.size() == 1 && bit != std::string_view::npos) read_button(value, unsigned(bit), buttons);
    return true;
  });
}

bool read_part(std::string_view key, json::element value, ServiceArm& arm) {
  if (key == "state") {
    return read_fields(value, [&](std::string_view name, json::element part) {
      std::uint8_t seen = 0;
      if (name == "cursor_position") return read_vector(part, arm.position, arm.placed);
      return name != "cursor_velocity" || read_vector(part, arm.velocity, seen);
    });
  }
  if (key == "status") {
    return read_fields(value, [&](std::string_view name, json::element part) {
      if (name == "calibrated") read_flag(part, arm.calibrated);
      if (name == "power_supply") read_flag(part, arm.powered);
      if (name == "ready") read_flag(part, arm.ready);
      return true;
    });
  }
  return true;
}

bool read_part(std::string_view key, json::element value, ServiceGrip& grip) {
  if (key != "state") return true;
  return read_fields(value, [&](std::string_view name, json::element part) {
    if (name == "orientation") return read_quaternion(part, grip.orientation);
    if (name == "buttons") return read_buttons(part, grip.buttons);
    if (name == "button") read_button(part, 0, grip.buttons);
    if (name == "hall") read_button(part, 1, grip.buttons);
    return true;
  });
}

/// The device of an entry, a new one where its id is new; null for an entry without an id whose place has
/// none, and where there is no room.
template <typename Listed>
auto find_device(Listed& listed, std::size_t place, std::string_view id) -> decltype(&listed.devices[0]) {
  if (id.empty()) {
    const bool known = place < listed.places.size() && listed.places[place] > 0;
    return known ? &listed.devices[listed.places[place] - 1U] : nullptr;
  }
  const auto end = listed.devices.begin() + std::ptrdiff_t(listed.count);
  const auto same = [&](const auto& device) { return device.id.text() == id; };
  auto found = std::find_if(listed.devices.begin(), end, same);
  if (found == end) {
    if (listed.count == listed.devices.size()) return nullptr;
    *found = {};
    found->id.set(id);
    ++listed.count;
  }
  if (place < listed.places.size()) listed.places[place] = std::uint8_t(found - listed.devices.begin() + 1);
  return &*found;
}

template <typename Listed>
bool read_device(json::element from, std::size_t place, Listed& listed, std::uint64_t message) {
  json::object object;
  if (from.get(object) != simdjson::SUCCESS) return false;
  std::string_view id;
  if (const auto named = object["device_id"]; named.error() == simdjson::SUCCESS) {
    ServiceDeviceId checked;
    if (named.get(id) != simdjson::SUCCESS || !checked.set(id)) return false;
  }
  auto* const device = find_device(listed, place, id);
  if (!device) return true;
  if constexpr (requires { device->told; }) device->told = message;
  return read_fields(
      from, [&](std::string_view key, json::element value) { return read_part(key, value, *device); });
}

template <typename Listed>
bool read_devices(json::element from, Listed& listed, std::uint64_t message) {
  if (from.is_null()) return true;
  json::array array;
  if (from.get(array) != simdjson::SUCCESS) return false;
  std::size_t place = 0;
  return std::all_of(array.begin(), array.end(),
                     [&](json::element entry) { return read_device(entry, place++, listed, message); });
}

std::string text_field(json::element from, std::string_view key) {
  std::string_view text;
  if (from[key].get(text) != simdjson::SUCCESS) return {};
  return std::string(text);
}

/// The first "MAJOR.MINOR" of a text.
bool find_version(std::string_view text, ServiceVersion& version) {
  for (; !text.empty(); text.remove_prefix(1)) {
    if (std::isdigit(static_cast<unsigned char>(text.front())) == 0) continue;
    const char* const end = text.data() + text.size();
    const auto [dot, error] = std::from_chars(text.data(), end, version.major);
    if (error == std::errc() && dot != end && *dot == '.' &&
        std::from_chars(dot + 1, end, version.minor).ec == std::errc())
      return true;
    while (!text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) != 0)
      text.remove_prefix(1);
    if (text.empty()) break;
  }
  version.major = version.minor = 0;
  return false;
}

}  // namespace

bool ServiceDeviceId::set(std::string_view text) {
  if (text.empty() || text.size() > kLongest || !std::all_of(text.begin(), text.end(), is_id_letter))
    return false;
  std::copy(text.begin(), text.end(), letters_.begin());
  size_ = text.size();
  return true;
}

bool ServiceDeviceId::is(std::string_view text) const {
  const auto same = [](unsigned char left, unsigned char right) {
    return std::tolower(left) == std::tolower(right);
  };
  return text.size() == size_ && std::equal(text.begin(), text.end(), letters_.begin(), same);
}

class ServiceState::Reader {
 public:
  Reader() { failed_ = parser_.allocate(WebSocket::kMostBytes, kDeepest) != simdjson::SUCCESS; }

  bool read(std::string_view message, Told& told) {
    json::element root;
    // Without room for it, the parser would take more memory.
    if (failed_ || message.size() > WebSocket::kMostBytes ||
        parser_.parse(message.data(), message.size(), false).get(root) != simdjson::SUCCESS ||
        !root.is_object())
      return false;
    return read_fields(root, [&](std::string_view key, json::element value) {
      if (key == "inverse3") return read_devices(value, told.arms, told.messages);
      if (key == "verse_grip") return read_devices(value, told.wired, told.messages);
      return key != "wireless_verse_grip" || read_devices(value, told.wireless, told.messages);
    });
  }

 private:
  json::parser parser_{WebSocket::kMostBytes};
  bool failed_ = false;
};

ServiceState::ServiceState() : reader_(std::make_unique<Reader>()) {}
ServiceState::~ServiceState() = default;

bool ServiceState::take(std::string_view message) {
  next_ = told_;
  ++next_.messages;
  if (!reader_->read(message, next_)) {
    ++refused_;
    return false;
  }
  told_ = next_;
  return true;
}

const ServiceGrip* ServiceState::grip_of(std::size_t arm, std::string_view id) const {
  for (const auto* const listed : {&told_.wireless, &told_.wired}) {
    if (id.empty() && arm < listed->count) return &listed->devices[arm];
    for (std::size_t i = 0; i < listed->count && !id.empty(); ++i) {
      if (listed->devices[i].id.is(id)) return &listed->devices[i];
    }
  }
  return nullptr;
}

ServiceVersion read_service_version(std::string_view answer) {
  ServiceVersion version;
  json::parser parser;
  json::element root;
  if (parser.parse(answer.data(), answer.size()).get(root) != simdjson::SUCCESS || !root.is_object())
    return version;
  for (const std::string_view key : {"project_version", "git_tag"}) {
    const std::string text = text_field(root, key);
    if (version.text.empty()) version.text = text;
    if (find_version(text, version)) {
      version.text = text;
      break;
    }
  }
  return version;
}

std::optional<ServiceEvent> read_service_event(std::string_view message) {
  json::parser parser;
  json::element root;
  if (parser.parse(message.data(), message.size()).get(root) != simdjson::SUCCESS || !root.is_object())
    return std::nullopt;
  ServiceEvent event = {
      text_field(root, "name"),   text_field(root, "category"), text_field(root, "level"), {}, {},
      text_field(root, "message")};
  if (event.name.empty()) return std::nullopt;
  if (json::element data; root["data"].get(data) == simdjson::SUCCESS && data.is_object()) {
    event.device_family = text_field(data, "device_family");
    event.device_id = text_field(data, "device_id");
  }
  return event;
}

}  // namespace icome::devices
