#include "animation/files/part_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "io/number_text.h"
#include "io/web_colours.h"

namespace icome::animation {
namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;  // rad
constexpr const char* kPlaceForm = "two numbers: [120, 80]";

std::string degrees_text(double angle) { return fmt::format("{:.12g}", angle / kDegrees); }

std::string place_text(const Vector2& place) { return io::toml_numbers({place.x(), place.y()}); }

std::string colour_text(const Colour& colour) {
  std::string text = "#";
  for (const float part : colour) text += fmt::format("{:02x}", int(std::lround(255 * part)));
  return text;
}

std::string number_text(double number) {
  std::string text;
  io::append_number(text, number);
  return text;
}

std::string value_text(Channel channel, double value) {
  return channel == Channel::Angle ? degrees_text(value) : number_text(value);
}

bool is_number(const io::TomlNode& node) {
  return node.kind == io::TomlNode::Kind::Number && std::isfinite(node.number);
}

bool are_numbers(const io::TomlNode& node, std::size_t count) {
  return node.kind == io::TomlNode::Kind::Array && node.elements.size() == count &&
         std::ranges::all_of(node.elements, is_number);
}

bool is_frame(const io::TomlNode& node) {
  return is_number(node) && node.number == std::floor(node.number) &&
         std::abs(node.number) <= kGreatestNumber;
}

std::optional<Vector2> read_place(io::KeyReader& keys, const std::string& key) {
  const io::TomlNode* node = keys.value(key);
  if (node == nullptr) return std::nullopt;
  if (are_numbers(*node, 2)) return Vector2(node->elements[0].number, node->elements[1].number);
  keys.problems().add(node->place, fmt::format("{}: write {}.", key, kPlaceForm));
  return std::nullopt;
}

std::vector<Vector2> read_way(io::KeyReader& keys, const std::string& key) {
  std::vector<Vector2> way;
  const io::TomlNode* node = keys.value(key);
  if (node == nullptr || node->kind != io::TomlNode::Kind::Array) {
    keys.problems().add(keys.place_of(key), fmt::format("{}: write places: [[0, 0], [100, 50]].", key));
    return way;
  }
  for (const io::TomlNode& place : node->elements) {
    if (are_numbers(place, 2))
      way.emplace_back(place.elements[0].number, place.elements[1].number);
    else
      keys.problems().add(place.place, fmt::format("{}: write {}.", key, kPlaceForm));
  }
  return way;
}

CellId read_cell(io::KeyReader& keys, const std::string& key, const CellOfWords& cells) {
  const io::TomlNode* node = keys.value(key);
  const CellId cell = node == nullptr ? CellId{} : cells(*node);
  if (!cell) {
    const std::string said = node != nullptr ? node->text : "";
    keys.problems().add(keys.place_of(key), said.empty()
                                                ? fmt::format("{}: a cell's name is missing.", key)
                                                : fmt::format("{}: there is no cell '{}'.", key, said));
  }
  return cell;
}

template <typename Meaning>
std::string_view word_meaning(const io::Words<Meaning>& words, Meaning meaning) {
  for (const auto& [word, means] : words)
    if (means == meaning) return word;
  return {};
}

/// Writes what kind of constraint one is and what it is about.
struct ConstraintWriting {
  const CellWords& words;
  io::TomlFields& fields;

  void operator()(const DistanceLimit& limit) const {
    fields.add("kind", "distance");
    fields.add_text("one", words(limit.one));
    fields.add_text("other", words(limit.other));
    fields.add_text("on_one", place_text(limit.on_one));
    fields.add_text("on_other", place_text(limit.on_other));
    fields.add("least", limit.least);
    fields.add("greatest", limit.greatest);
  }
  void operator()(const Joint& joint) const {
    fields.add("kind", "joint");
    fields.add_text("parent", words(joint.parent));
    fields.add_text("child", words(joint.child));
    fields.add_text("on_parent", place_text(joint.on_parent));
    fields.add_text("on_child", place_text(joint.on_child));
    if (joint.limits)
      fields.add_text("limits", fmt::format("[{}, {}]", degrees_text(joint.limits->least),
                                            degrees_text(joint.limits->greatest)));
  }
  void operator()(const Chain& chain) const {
    fields.add("kind", "chain");
    std::string list;
    for (const CellId cell : chain.cells) list.append(list.empty() ? "" : ", ").append(words(cell));
    fields.add_text("cells", fmt::format("[{}]", list));
  }
  void operator()(const PathGuide& guide) const {
    fields.add("kind", "path");
    fields.add_text("cell", words(guide.cell));
    fields.add_text("on_cell", place_text(guide.on_cell));
    std::string list;
    for (const Vector2& place : guide.way) list.append(list.empty() ? "" : ", ").append(place_text(place));
    fields.add_text("way", fmt::format("[{}]", list));
    fields.add("closed", guide.closed);
    fields.add("turns", guide.turns);
  }
  void operator()(const AxisGuide& guide) const {
    fields.add("kind", "axis");
    fields.add_text("cell", words(guide.cell));
    fields.add_text("on_cell", place_text(guide.on_cell));
    fields.add_text("through", place_text(guide.through));
    fields.add_text("direction", degrees_text(guide.direction));
  }
};

enum class ConstraintKind : std::uint8_t { Distance, Joint, Chain, Path, Axis };

DistanceLimit read_distance(io::KeyReader& keys, const CellOfWords& cells) {
  DistanceLimit limit;
  limit.one = read_cell(keys, "one", cells);
  limit.other = read_cell(keys, "other", cells);
  limit.on_one = read_place(keys, "on_one").value_or(Vector2::Zero());
  limit.on_other = read_place(keys, "on_other").value_or(Vector2::Zero());
  limit.least = keys.number("least", 0, 0, kFarthest);
  limit.greatest = keys.number("greatest", kFarthest, 0, kFarthest);
  return limit;
}

Joint read_joint(io::KeyReader& keys, const CellOfWords& cells) {
  Joint joint;
  joint.parent = read_cell(keys, "parent", cells);
  joint.child = read_cell(keys, "child", cells);
  joint.on_parent = read_place(keys, "on_parent").value_or(Vector2::Zero());
  joint.on_child = read_place(keys, "on_child").value_or(Vector2::Zero());
  if (const auto limits = read_place(keys, "limits"))
    joint.limits = AngleLimits{limits->x() * kDegrees, limits->y() * kDegrees};
  return joint;
}

Chain read_chain(io::KeyReader& keys, const CellOfWords& cells) {
  Chain chain;
  const io::TomlNode* node = keys.value("cells");
  if (node == nullptr || node->kind != io::TomlNode::Kind::Array) {
    keys.problems().add(keys.place_of("cells"), "cells: write names: [\"upper arm\", \"lower arm\"].");
    return chain;
  }
  for (const io::TomlNode& one : node->elements) {
    chain.cells.push_back(cells(one));
    if (!chain.cells.back())
      keys.problems().add(one.place, fmt::format("cells: there is no cell '{}'.", one.text));
  }
  return chain;
}

PathGuide read_path(io::KeyReader& keys, const CellOfWords& cells) {
  PathGuide guide;
  guide.cell = read_cell(keys, "cell", cells);
  guide.on_cell = read_place(keys, "on_cell").value_or(Vector2::Zero());
  guide.way = read_way(keys, "way");
  guide.closed = keys.flag("closed", false);
  guide.turns = keys.flag("turns", false);
  return guide;
}

AxisGuide read_axis(io::KeyReader& keys, const CellOfWords& cells) {
  AxisGuide guide;
  guide.cell = read_cell(keys, "cell", cells);
  guide.on_cell = read_place(keys, "on_cell").value_or(Vector2::Zero());
  guide.through = read_place(keys, "through").value_or(Vector2::Zero());
  guide.direction = keys.number("direction", 0, -1e6, 1e6) * kDegrees;
  return guide;
}

/// The key of an array [frame, value] or [frame, value, "eased"].
std::optional<Key> read_key(Channel channel, const io::TomlNode& node) {
  if (node.kind != io::TomlNode::Kind::Array || node.elements.size() < 2 || node.elements.size() > 3)
    return std::nullopt;
  if (!is_frame(node.elements[0]) || !is_number(node.elements[1])) return std::nullopt;
  const double unit = channel == Channel::Angle ? kDegrees : 1.0;
  Key key = {int(node.elements[0].number), node.elements[1].number * unit};
  if (node.elements.size() == 2) return key;
  for (const auto& [word, ease] : ease_words())
    if (node.elements[2].text == word) return key.ease = ease, key;
  return std::nullopt;
}

}  // namespace

std::string number_of_cell(CellId id) { return std::to_string(id.value); }

CellId numbered_cell(const io::TomlNode& node) {
  return is_frame(node) && node.number > 0 ? CellId{std::uint64_t(node.number)} : CellId{};
}

const char* name_of(Channel channel) {
  return word_meaning(channel_words(), channel).data();  // literals, which end with 0
}

const io::Words<Channel>& channel_words() {
  static const io::Words<Channel> kWords = {{"x", Channel::X},
                                            {"y", Channel::Y},
                                            {"angle", Channel::Angle},
                                            {"scale", Channel::Scale},
                                            {"opacity", Channel::Opacity},
                                            {"picture", Channel::Picture}};
  return kWords;
}

const io::Words<Ease>& ease_words() {
  static const io::Words<Ease> kWords = {
      {"straight", Ease::Straight}, {"eased", Ease::Eased}, {"hold", Ease::Hold}};
  return kWords;
}

const io::Words<MappingMode>& mapping_words() {
  static const io::Words<MappingMode> kWords = {{"absolute", MappingMode::Absolute},
                                                {"relative", MappingMode::Relative},
                                                {"nearest", MappingMode::Nearest}};
  return kWords;
}

void write_layer(const LayerLook& look, io::TomlFields& fields) {
  fields.add("name", look.name);
  fields.add("visible", look.visible);
  fields.add("locked", look.locked);
}

LayerLook read_layer(io::KeyReader& keys) {
  return {keys.plain("name"), keys.flag("visible", true), keys.flag("locked", false)};
}

void write_look(const CellLook& look, io::TomlFields& fields) {
  fields.add("name", look.name);
  if (!look.pictures.empty()) fields.add("pictures", look.pictures);
  fields.add_text("pivot", place_text(look.pivot));
  write_state(look.rest, kAllChannels, fields);
}

CellLook read_look(io::KeyReader& keys) {
  CellLook look;
  look.name = keys.plain("name");
  look.pictures = keys.strings("pictures");
  look.pivot = read_place(keys, "pivot").value_or(Vector2::Zero());
  read_state(keys, kAllChannels, look.rest);
  return look;
}

void write_state(const CellState& state, std::span<const Channel> channels, io::TomlFields& fields) {
  for (const Channel channel : channels)
    fields.add_text(name_of(channel), value_text(channel, channel_of(state, channel)));
}

void read_state(io::KeyReader& keys, std::span<const Channel> channels, CellState& state) {
  for (const Channel channel : channels) {
    const double unit = channel == Channel::Angle ? kDegrees : 1.0;
    const double otherwise = channel_of(state, channel) / unit;
    set_channel(state, channel, keys.number(name_of(channel), otherwise, -kFarthest, kFarthest) * unit);
  }
}

std::string keys_text(Channel channel, const Track& keys) {
  std::string list;
  for (const Key& key : keys) {
    list.append(list.empty() ? "" : ", ");
    list += fmt::format("[{}, {}", key.frame, value_text(channel, key.value));
    if (key.ease != Ease::Straight) list += fmt::format(", \"{}\"", word_meaning(ease_words(), key.ease));
    list += "]";
  }
  return fmt::format("[{}]", list);
}

void write_tracks(const Tracks& tracks, io::TomlFields& fields) {
  for (const Channel channel : kAllChannels) {
    const Track& track = tracks[std::size_t(channel)];
    if (!track.empty()) fields.add_text(fmt::format("keys.{}", name_of(channel)), keys_text(channel, track));
  }
}

Track read_keys(Channel channel, const io::TomlNode& node, io::Problems& problems) {
  Track track;
  if (node.kind != io::TomlNode::Kind::Array) {
    problems.add(node.place, "keys: write [[0, 12.5], [24, 80, \"eased\"]].");
    return track;
  }
  for (const io::TomlNode& element : node.elements) {
    const auto key = read_key(channel, element);
    if (!key) {
      problems.add(element.place,
                   "keys: write a whole frame, a value and, if wished, \"eased\" or \"hold\": [24, 80].");
    } else if (!track.empty() && key->frame <= track.back().frame) {
      problems.add(element.place, fmt::format("keys: frame {} does not come after frame {}.", key->frame,
                                              track.back().frame));
    } else {
      track.push_back(*key);
    }
  }
  return track;
}

Tracks read_tracks(io::KeyReader& keys) {
  Tracks tracks;
  const io::TomlNode* table = keys.table("keys");
  if (table == nullptr) return tracks;
  static const std::vector<std::string> kNoLanguages;
  io::KeyReader by_channel(*table, "keys", kNoLanguages, keys.problems());
  for (const Channel channel : kAllChannels)
    if (const io::TomlNode* node = by_channel.value(name_of(channel)))
      tracks[std::size_t(channel)] = read_keys(channel, *node, keys.problems());
  by_channel.finish();
  return tracks;
}

void write_stage(const Stage& stage, io::TomlFields& fields) {
  fields.add("width", stage.width);
  fields.add("height", stage.height);
  fields.add("rate", stage.rate);
  fields.add("length", stage.length);
  fields.add("background", colour_text(stage.background));
}

Stage read_stage(io::KeyReader& keys) {
  Stage stage;
  stage.width = keys.whole("width", stage.width, 2, kLargestStage);
  stage.height = keys.whole("height", stage.height, 2, kLargestStage);
  stage.rate = keys.number("rate", stage.rate, 1, 120);
  stage.length = keys.whole("length", stage.length, 1, kLongestAnimation);
  if (!keys.has("background")) return stage;
  const auto colour = io::web_colour(keys.plain("background"));
  if (!colour)
    keys.problems().add(keys.place_of("background"), "background: write a colour: \"#8fb7d9\" or \"white\".");
  else
    for (std::size_t i = 0; i < 3; ++i)
      stage.background[i] = float((*colour >> (24U - 8U * i)) & 0xffU) / 255.0F;
  return stage;
}

void write_sound(const Sound& sound, io::TomlFields& fields) {
  fields.add("file", sound.file);
  fields.add("start", sound.start);
  fields.add("gain", sound.gain);
}

Sound read_sound(io::KeyReader& keys) {
  Sound sound;
  sound.file = keys.plain("file");
  sound.start = keys.number("start", 0, -1e6, 1e6);
  sound.gain = keys.number("gain", 1, 0, 4);
  return sound;
}

void write_constraint(const Constraint& constraint, const CellWords& words, io::TomlFields& fields) {
  std::visit(ConstraintWriting{words, fields}, constraint.what);
}

Constraint read_constraint(io::KeyReader& keys, const CellOfWords& cells) {
  static const io::Words<ConstraintKind> kKinds = {{"distance", ConstraintKind::Distance},
                                                   {"joint", ConstraintKind::Joint},
                                                   {"chain", ConstraintKind::Chain},
                                                   {"path", ConstraintKind::Path},
                                                   {"axis", ConstraintKind::Axis}};
  keys.require("kind", "kind = \"joint\", \"distance\", \"chain\", \"path\" or \"axis\"");
  Constraint constraint;
  switch (keys.word("kind", kKinds, ConstraintKind::Distance)) {
    case ConstraintKind::Distance:
      constraint.what = read_distance(keys, cells);
      break;
    case ConstraintKind::Joint:
      constraint.what = read_joint(keys, cells);
      break;
    case ConstraintKind::Chain:
      constraint.what = read_chain(keys, cells);
      break;
    case ConstraintKind::Path:
      constraint.what = read_path(keys, cells);
      break;
    case ConstraintKind::Axis:
      constraint.what = read_axis(keys, cells);
      break;
  }
  return constraint;
}

void write_mapping(const Mapping& mapping, const CellWords& words, io::TomlFields& fields) {
  fields.add("id", mapping.triangle);
  fields.add("mode", word_meaning(mapping_words(), mapping.mode));
  if (mapping.cell) fields.add_text("cell", words(mapping.cell));
}

Mapping read_mapping(io::KeyReader& keys, const CellOfWords& cells) {
  Mapping mapping;
  keys.require("id", "id = \"t1\", a triangle of the known list");
  mapping.triangle = keys.plain("id");
  mapping.mode = keys.word("mode", mapping_words(), MappingMode::Absolute);
  if (mapping.mode != MappingMode::Nearest) mapping.cell = read_cell(keys, "cell", cells);
  return mapping;
}

}  // namespace icome::animation
