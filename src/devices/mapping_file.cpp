#include "devices/mapping_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <vector>

#include "base/near_names.h"
#include "devices/axes.h"
#include "io/file_bytes.h"
#include "io/new_file.h"
#include "io/toml_tree.h"

namespace icome::devices {
namespace {

constexpr std::uint64_t kLongestMapping = 100'000;  // bytes

using io::TomlNode;

/// Reads a mapping's keys; the first problem is kept.
class MappingReader {
 public:
  explicit MappingReader(std::string source) : source_(std::move(source)) {}

  void take(const io::TomlMember& member) {
    const TomlNode& value = member.value;
    if (member.key == "centre_m") {
      if (const auto place = three(value, member.key)) mapping.centre = *place;
    } else if (member.key == "axes") {
      take_axes(value);
    } else if (member.key == "scale") {
      mapping.scale = number(value, member.key, 0.01, 100.0);
    } else if (member.key == "workspace_radius_m") {
      mapping.workspace_radius = number(value, member.key, 0.001, 10.0);
    } else if (member.key == "scale_follows_view") {
      take_following(value);
    } else if (member.key == "max_force_n") {
      mapping.max_force = number(value, member.key, 0.01, 1000.0);
    } else if (member.key == "clutch_button") {
      take_button(value);
    } else if (member.key != "device" && member.key != "made_by") {
      const std::vector<std::string> known = {
          "centre_m",      "axes",   "scale",  "scale_follows_view", "workspace_radius_m", "max_force_n",
          "clutch_button", "device", "made_by"};
      fail(member.place,
           fmt::format("a device has no key \"{}\"{}", member.key, base::suggestion(member.key, known)));
    }
  }

  DeviceMapping mapping;
  std::optional<base::Error> error;

 private:
  void fail(const io::Place& place, const std::string& sentence) {
    if (!error) error = base::Error{fmt::format("{}:{}:{}: {}", source_, place.line, place.column, sentence)};
  }

  double number(const TomlNode& node, const std::string& key, double least, double most) {
    if (node.kind == TomlNode::Kind::Number && node.number >= least && node.number <= most)
      return node.number;
    fail(node.place, fmt::format("{} must be a number from {} to {}", key, least, most));
    return least;
  }

  std::optional<Vector3> three(const TomlNode& node, const std::string& key) {
    Vector3 result = Vector3::Zero();
    if (node.kind != TomlNode::Kind::Array || node.elements.size() != 3) {
      fail(node.place, key + " must be three numbers, such as [0.0, 0.02, 0.0]");
      return std::nullopt;
    }
    for (int i = 0; i < 3; ++i) result[i] = number(node.elements[std::size_t(i)], key, -10.0, 10.0);
    return result;
  }

  void take_axes(const TomlNode& node) {
    const auto rotation = rotation_from_axes(node.kind == TomlNode::Kind::String ? node.text : "");
    if (!rotation) return fail(node.place, "axes: " + rotation.error().message);
    mapping.ours_from_device = Quaternion(*rotation);
  }

  void take_button(const TomlNode& node) {
    const double button = number(node, "clutch_button", 0.0, 31.0);
    if (button != std::floor(button))
      fail(node.place, "clutch_button must be a whole number, counted from 0");
    mapping.clutch_button = int(button);
  }

  void take_following(const TomlNode& node) {
    if (node.kind != TomlNode::Kind::Boolean)
      return fail(node.place, "scale_follows_view must be true or false");
    mapping.scale_follows_view = node.boolean;
  }

  std::string source_;
};

std::string lower_case(std::string text) {
  for (char& letter : text) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return text;
}

std::string file_name_of(std::string_view address) {
  if (address.ends_with(':')) address.remove_suffix(1);
  std::string name;
  for (const char letter : address) {
    const bool plain =
        std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '-' || letter == '.';
    name += plain ? letter : '_';
  }
  return name + ".toml";
}

/// The file with a device's profile, however its address is spelled; empty: there is none. A file of the
/// whole back-end counts for all its devices that have none of their own, and the only file of one of its
/// devices for its first device, so that a limit that somebody set is not passed by.
base::Result<std::filesystem::path> find_profile(std::string_view address) {
  const std::filesystem::path own = mapping_path(address);
  const std::string name = lower_case(own.filename().string());
  const std::string back_end = lower_case(file_name_of(address.substr(0, address.find(':'))));
  const std::string beginning = back_end.substr(0, back_end.size() - std::string_view(".toml").size()) + "_";
  std::filesystem::path general;
  std::vector<std::filesystem::path> others;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(own.parent_path(), error)) {
    const std::string file = lower_case(entry.path().filename().string());
    if (file == name) return entry.path();
    if (file == back_end) general = entry.path();
    if (file.starts_with(beginning) && file.ends_with(".toml")) others.push_back(entry.path());
  }
  if (name != back_end) return general;
  if (others.size() > 1)
    return base::fail(
        fmt::format("{}: several of its devices have profiles ({}, {}); say which device is meant", address,
                    others[0].string(), others[1].string()));
  return others.empty() ? std::filesystem::path() : others.front();
}

}  // namespace

base::Result<DeviceMapping> parse_mapping(std::string_view text, const std::string& source) {
  const auto root = io::parse_toml(text, source);
  if (!root) return tl::unexpected(root.error());
  MappingReader reader(source);
  for (const io::TomlMember& member : root->members) reader.take(member);
  if (reader.error) return tl::unexpected(*reader.error);
  return reader.mapping;
}

std::string mapping_text(const DeviceMapping& mapping, const std::string& made_by) {
  std::string text = fmt::format("# {}\n", made_by);
  text += fmt::format("centre_m = [{:.6f}, {:.6f}, {:.6f}]  # the middle of the workspace, in these axes\n",
                      mapping.centre.x(), mapping.centre.y(), mapping.centre.z());
  text += fmt::format(
      "axes = \"{}\"  # which of its axes, as ICOME shows them without this, point right, up and to the "
      "user\n",
      axes_text(mapping.ours_from_device.toRotationMatrix()));
  // A scale that follows the view is that of the last view, and no choice of anybody's.
  if (mapping.scale && !mapping.scale_follows_view)
    text += fmt::format("scale = {:.6g}  # m that the tip moves for each m of the hand\n", *mapping.scale);
  if (mapping.scale_follows_view)
    text += "scale_follows_view = true  # in the window: the workspace spans what is seen\n";
  if (mapping.workspace_radius > 0.0)
    text += fmt::format("workspace_radius_m = {:.6g}\n", mapping.workspace_radius);
  if (mapping.max_force > 0.0) text += fmt::format("max_force_n = {:.6g}\n", mapping.max_force);
  if (mapping.clutch_button >= 0)
    text += fmt::format("clutch_button = {}  # while it is down the tip stays\n", mapping.clutch_button);
  return text;
}

std::filesystem::path mapping_path(std::string_view address) {
  const char* const config = std::getenv("XDG_CONFIG_HOME");
  const char* const home = std::getenv("HOME");
  std::filesystem::path folder;
  if (config != nullptr && *config == '/') {
    folder = config;
  } else {
    if (home == nullptr || *home == '\0') return {};
    folder = std::filesystem::path(home) / ".config";
  }
  return folder / "icome" / "devices" / file_name_of(address);
}

base::Result<DeviceMapping> read_mapping(std::string_view address) {
  const auto path = find_profile(address);
  if (!path) return tl::unexpected(path.error());
  if (path->empty()) return DeviceMapping{};
  const auto text = io::read_bytes(*path, kLongestMapping);
  if (!text) return tl::unexpected(text.error());
  return parse_mapping(*text, path->string());
}

base::Result<void> check_mapping_place(std::string_view address) {
  const std::filesystem::path path = mapping_path(address);
  if (path.empty())
    return base::fail(
        "neither XDG_CONFIG_HOME nor HOME is set, so there is no place for a device's profile; set one of "
        "them "
        "to a folder");
  std::error_code error;
  std::filesystem::path folder = path.parent_path();
  while (folder.has_relative_path() && !std::filesystem::exists(folder, error)) folder = folder.parent_path();
  if (std::filesystem::is_directory(folder, error) && ::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  return base::fail(fmt::format(
      "the device's profile cannot be written to {}, as {} may not be written to; permit that, or set "
      "XDG_CONFIG_HOME to a folder of yours",
      path.string(), folder.string()));
}

base::Result<void> write_mapping(std::string_view address, const DeviceMapping& mapping,
                                 const std::string& made_by) {
  if (const auto checked = check_mapping_place(address); !checked) return checked;
  const std::filesystem::path path = mapping_path(address);
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  auto file = io::NewFile::create(path);
  if (!file) return tl::unexpected(file.error());
  file->write(mapping_text(mapping, made_by));
  return file->finish();
}

}  // namespace icome::devices
