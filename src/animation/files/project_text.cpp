#include "animation/files/project_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "animation/files/part_text.h"
#include "base/near_names.h"

namespace icome::animation {
namespace {

constexpr int kFormat = 1;
const std::vector<std::string> kOneLanguage;

void write_cell(const Cell& cell, io::TomlFields& fields) {
  fields.add("id", int(cell.id.value));
  write_look(look_of(cell), fields);
  write_tracks(cell.tracks, fields);
}

std::string marks_text(const std::vector<Mark>& marks) {
  std::string list;
  for (const Mark& mark : marks)
    list += fmt::format("{}[{}, {}]", list.empty() ? "" : ", ", mark.frame, io::quoted_toml(mark.text));
  return fmt::format("[{}]", list);
}

/// Reads a project part by part, each as the change that puts it into the project.
class ProjectReader {
 public:
  ProjectReader(const io::TomlNode& tree, io::Problems& problems)
      : problems_(problems), keys_(tree, "the animation", kOneLanguage, problems) {}

  Project read() {
    keys_.require("cutout", "cutout = 1, the version of the format");
    if (keys_.whole("cutout", kFormat, 1, kGreatestNumber) > kFormat)
      problems_.add(keys_.place_of("cutout"), "the file was written by a later version of ICOME.");
    if (auto stage = table("stage", "the stage")) {
      put(stage->place(), ChangeStage{read_stage(*stage)});
      stage->finish();
    }
    project_.camera.rest.place = 0.5 * Vector2(project_.stage.width, project_.stage.height);
    if (auto camera = table("camera", "the camera")) read_camera(*camera);
    for (io::KeyReader& layer : keys_.tables("layer", "layer")) read_one_layer(layer);
    if (auto sound = table("sound", "the sound")) {
      put(sound->place(), ChangeSound{read_sound(*sound)});
      sound->finish();
    }
    read_marks();
    for (io::KeyReader& constraint : keys_.tables("constraint", "constraint")) read_one(constraint);
    for (io::KeyReader& triangle : keys_.tables("triangle", "triangle")) {
      const Mapping mapping = read_mapping(triangle, cells());
      put(triangle.place(), ChangeMapping{mapping.triangle, mapping});
      triangle.finish();
    }
    project_.smooth_hands = keys_.flag("smooth_hands", false);
    keys_.finish();
    return std::move(project_);
  }

 private:
  std::optional<io::KeyReader> table(const std::string& key, const char* what) {
    const io::TomlNode* node = keys_.table(key);
    if (node == nullptr) return std::nullopt;
    return io::KeyReader(*node, what, kOneLanguage, problems_);
  }

  /// Does nothing once something was wrong, which would be said again of all parts that need it.
  void put(io::Place place, ProjectChange change) {
    if (!problems_.none()) return;
    ProjectEdit edit;
    edit.push_back(std::move(change));
    if (const auto done = apply_edit(project_, edit); !done) problems_.add(place, done.error().message + ".");
  }

  int number(io::KeyReader& keys) {
    keys.require("id", "id = 2, a number that nothing else has");
    return keys.whole("id", 0, 1, kGreatestNumber);
  }

  void read_camera(io::KeyReader& keys) {
    CellLook look = look_of(project_.camera);
    read_state(keys, kCameraChannels, look.rest);
    put(keys.place(), ChangeCell{kCamera, look});
    put_tracks(kCamera, keys.place(), read_tracks(keys));
    keys.finish();
  }

  void put_tracks(CellId cell, io::Place place, const Tracks& tracks) {
    for (const Channel channel : kAllChannels) {
      const Track& track = tracks[std::size_t(channel)];
      if (!track.empty())
        put(place, ChangeKeys{cell, channel, track.front().frame, track.back().frame, track});
    }
  }

  void read_one_layer(io::KeyReader& keys) {
    const LayerId id{std::uint64_t(number(keys))};
    put(keys.place(), PutLayer{id, project_.layers.size(), read_layer(keys)});
    for (io::KeyReader& cell : keys.tables("cell", "cell")) {
      const io::Place place = cell.place();
      Cell read = read_cell_of(cell);
      const Layer* layer = project_.find(id);
      put(place, PutCell{id, layer != nullptr ? layer->cells.size() : 0, std::move(read)});
    }
    keys.finish();
  }

 public:
  static Cell read_cell_of(io::KeyReader& keys) {
    Cell cell;
    keys.require("id", "id = 3, a number that nothing else has");
    cell.id = CellId{std::uint64_t(keys.whole("id", 0, 1, kGreatestNumber))};
    keys.require("name", "name = \"boat\"");
    CellLook look = read_look(keys);
    cell.name = std::move(look.name);
    cell.pictures = std::move(look.pictures);
    cell.pivot = look.pivot;
    cell.rest = look.rest;
    cell.tracks = read_tracks(keys);
    keys.finish();
    return cell;
  }

 private:
  void read_marks() {
    const io::TomlNode* node = keys_.value("marks");
    if (node == nullptr) return;
    for (const io::TomlNode& mark : node->elements) {
      const bool fits = mark.kind == io::TomlNode::Kind::Array && mark.elements.size() == 2 &&
                        mark.elements[0].kind == io::TomlNode::Kind::Number && mark.elements[0].number >= 0 &&
                        mark.elements[0].number < kLongestAnimation &&
                        mark.elements[1].kind == io::TomlNode::Kind::String;
      if (fits)
        put(mark.place, ChangeMark{int(mark.elements[0].number), mark.elements[1].text});
      else
        problems_.add(mark.place, "marks: write a frame and a text: [12, \"A\"].");
    }
  }

  void read_one(io::KeyReader& keys) {
    Constraint constraint = read_constraint(keys, cells());
    constraint.id = ConstraintId{std::uint64_t(number(keys))};
    put(keys.place(), PutConstraint{project_.constraints.size(), std::move(constraint)});
    keys.finish();
  }

  CellOfWords cells() const {
    return [this](const io::TomlNode& node) {
      const Cell* cell = node.kind == io::TomlNode::Kind::String ? project_.find(node.text) : nullptr;
      return cell != nullptr ? cell->id : CellId{};
    };
  }

  io::Problems& problems_;
  io::KeyReader keys_;
  Project project_;
};

/// Writes the parts of an edit as inline tables.
struct ChangeWriting {
  io::TomlFields& fields;

  template <typename ThingId>
  void number(const char* key, ThingId id) const {
    fields.add(key, int(id.value));
  }
  void place(std::size_t place) const { fields.add("place", int(place)); }
  void kind(const char* word) const { fields.add("do", word); }

  void operator()(const PutLayer& part) const {
    kind("put_layer");
    number("id", part.id);
    place(part.place);
    write_layer(part.look, fields);
  }
  void operator()(const TakeLayer& part) const {
    kind("take_layer");
    number("id", part.id);
  }
  void operator()(const ChangeLayer& part) const {
    kind("change_layer");
    number("id", part.id);
    write_layer(part.look, fields);
  }
  void operator()(const MoveLayer& part) const {
    kind("move_layer");
    number("id", part.id);
    place(part.place);
  }
  void operator()(const PutCell& part) const {
    kind("put_cell");
    number("layer", part.layer);
    place(part.place);
    io::TomlFields cell;
    write_cell(part.cell, cell);
    fields.add("cell", cell);
  }
  void operator()(const TakeCell& part) const {
    kind("take_cell");
    number("id", part.id);
  }
  void operator()(const ChangeCell& part) const {
    kind("change_cell");
    number("id", part.id);
    write_look(part.look, fields);
  }
  void operator()(const MoveCell& part) const {
    kind("move_cell");
    number("id", part.id);
    number("layer", part.layer);
    place(part.place);
  }
  void operator()(const ChangeKeys& part) const {
    kind("change_keys");
    number("cell", part.cell);
    fields.add("channel", name_of(part.channel));
    fields.add("from", part.from);
    fields.add("to", part.to);
    fields.add_text("keys", keys_text(part.channel, part.keys));
  }
  void operator()(const ChangeStage& part) const {
    kind("change_stage");
    write_stage(part.stage, fields);
  }
  void operator()(const ChangeSound& part) const {
    kind("change_sound");
    if (part.sound) write_sound(*part.sound, fields);
  }
  void operator()(const ChangeMark& part) const {
    kind("change_mark");
    fields.add("frame", part.frame);
    if (part.text) fields.add("text", *part.text);
  }
  void operator()(const PutConstraint& part) const {
    kind("put_constraint");
    place(part.place);
    io::TomlFields constraint;
    number_of(constraint, part.constraint.id);
    write_constraint(part.constraint, number_of_cell, constraint);
    fields.add("constraint", constraint);
  }
  void operator()(const TakeConstraint& part) const {
    kind("take_constraint");
    number("id", part.id);
  }
  void operator()(const ChangeMapping& part) const {
    kind("change_mapping");
    fields.add("triangle", part.triangle);
    if (!part.mapping) return;
    io::TomlFields mapping;
    write_mapping(*part.mapping, number_of_cell, mapping);
    fields.add("mapping", mapping);
  }
  void operator()(const SmoothHands& part) const {
    kind("smooth_hands");
    fields.add("smooth", part.smooth);
  }

  static void number_of(io::TomlFields& fields, ConstraintId id) { fields.add("id", int(id.value)); }
};

enum class ChangeKind : std::uint8_t {
  PutLayer,
  TakeLayer,
  ChangeLayer,
  MoveLayer,
  PutCell,
  TakeCell,
  ChangeCell,
  MoveCell,
  ChangeKeys,
  ChangeStage,
  ChangeSound,
  ChangeMark,
  PutConstraint,
  TakeConstraint,
  ChangeMapping,
  SmoothHands,
};

const io::Words<ChangeKind>& change_words() {
  static const io::Words<ChangeKind> kWords = {{"put_layer", ChangeKind::PutLayer},
                                               {"take_layer", ChangeKind::TakeLayer},
                                               {"change_layer", ChangeKind::ChangeLayer},
                                               {"move_layer", ChangeKind::MoveLayer},
                                               {"put_cell", ChangeKind::PutCell},
                                               {"take_cell", ChangeKind::TakeCell},
                                               {"change_cell", ChangeKind::ChangeCell},
                                               {"move_cell", ChangeKind::MoveCell},
                                               {"change_keys", ChangeKind::ChangeKeys},
                                               {"change_stage", ChangeKind::ChangeStage},
                                               {"change_sound", ChangeKind::ChangeSound},
                                               {"change_mark", ChangeKind::ChangeMark},
                                               {"put_constraint", ChangeKind::PutConstraint},
                                               {"take_constraint", ChangeKind::TakeConstraint},
                                               {"change_mapping", ChangeKind::ChangeMapping},
                                               {"smooth_hands", ChangeKind::SmoothHands}};
  return kWords;
}

template <typename ThingId>
ThingId read_number(io::KeyReader& keys, const char* key) {
  return ThingId{std::uint64_t(keys.whole(key, 0, 1, kGreatestNumber))};
}

std::size_t read_list_place(io::KeyReader& keys) {
  return std::size_t(keys.whole("place", 0, 0, kGreatestNumber));
}

io::KeyReader part_of(io::KeyReader& keys, const char* key) {
  static const io::TomlNode kNothing;
  const io::TomlNode* node = keys.table(key);
  return {node != nullptr ? *node : kNothing, key, kOneLanguage, keys.problems()};
}

ChangeKeys read_keys_change(io::KeyReader& keys) {
  ChangeKeys part;
  part.cell = read_number<CellId>(keys, "cell");
  part.channel = keys.word("channel", channel_words(), Channel::X);
  part.from = keys.whole("from", 0, 0, kGreatestNumber);
  part.to = keys.whole("to", 0, 0, kGreatestNumber);
  if (const io::TomlNode* list = keys.value("keys"))
    part.keys = read_keys(part.channel, *list, keys.problems());
  return part;
}

ChangeMapping read_mapping_change(io::KeyReader& keys) {
  ChangeMapping part = {keys.plain("triangle"), std::nullopt};
  if (!keys.has("mapping")) return part;
  io::KeyReader mapping = part_of(keys, "mapping");
  part.mapping = read_mapping(mapping, numbered_cell);
  mapping.finish();
  return part;
}

PutCell read_new_cell(io::KeyReader& keys) {
  PutCell part = {read_number<LayerId>(keys, "layer"), read_list_place(keys), {}};
  io::KeyReader cell = part_of(keys, "cell");
  part.cell = ProjectReader::read_cell_of(cell);
  return part;
}

PutConstraint read_new_constraint(io::KeyReader& keys) {
  PutConstraint part = {read_list_place(keys), {}};
  io::KeyReader constraint = part_of(keys, "constraint");
  part.constraint = read_constraint(constraint, numbered_cell);
  part.constraint.id = read_number<ConstraintId>(constraint, "id");
  constraint.finish();
  return part;
}

ProjectChange read_change(io::KeyReader& keys) {
  keys.require("do", "do = \"put_cell\" or another change");
  switch (keys.word("do", change_words(), ChangeKind::SmoothHands)) {
    case ChangeKind::PutLayer:
      return PutLayer{read_number<LayerId>(keys, "id"), read_list_place(keys), read_layer(keys)};
    case ChangeKind::TakeLayer:
      return TakeLayer{read_number<LayerId>(keys, "id")};
    case ChangeKind::ChangeLayer:
      return ChangeLayer{read_number<LayerId>(keys, "id"), read_layer(keys)};
    case ChangeKind::MoveLayer:
      return MoveLayer{read_number<LayerId>(keys, "id"), read_list_place(keys)};
    case ChangeKind::PutCell:
      return read_new_cell(keys);
    case ChangeKind::TakeCell:
      return TakeCell{read_number<CellId>(keys, "id")};
    case ChangeKind::ChangeCell:
      return ChangeCell{read_number<CellId>(keys, "id"), read_look(keys)};
    case ChangeKind::MoveCell:
      return MoveCell{read_number<CellId>(keys, "id"), read_number<LayerId>(keys, "layer"),
                      read_list_place(keys)};
    case ChangeKind::ChangeKeys:
      return read_keys_change(keys);
    case ChangeKind::ChangeStage:
      return ChangeStage{read_stage(keys)};
    case ChangeKind::ChangeSound:
      return ChangeSound{keys.has("file") ? std::optional(read_sound(keys)) : std::nullopt};
    case ChangeKind::ChangeMark: {
      const int frame = keys.whole("frame", 0, 0, kGreatestNumber);
      return ChangeMark{frame, keys.has("text") ? std::optional(keys.plain("text")) : std::nullopt};
    }
    case ChangeKind::PutConstraint:
      return read_new_constraint(keys);
    case ChangeKind::TakeConstraint:
      return TakeConstraint{read_number<ConstraintId>(keys, "id")};
    case ChangeKind::ChangeMapping:
      return read_mapping_change(keys);
    case ChangeKind::SmoothHands:
      return SmoothHands{keys.flag("smooth", false)};
  }
  return SmoothHands{};
}

}  // namespace

std::string project_text(const Project& project) {
  const CellWords words = [&](CellId id) {
    const Cell* cell = project.find(id);
    return io::quoted_toml(cell != nullptr ? cell->name : "");
  };
  io::TomlFields head, stage, camera;
  head.add("cutout", kFormat);
  if (project.smooth_hands) head.add("smooth_hands", true);
  if (!project.marks.empty()) head.add_text("marks", marks_text(project.marks));
  write_stage(project.stage, stage);
  write_state(project.camera.rest, kCameraChannels, camera);
  write_tracks(project.camera.tracks, camera);
  std::string text = "# A cut-out animation of ICOME: places in px, angles in degrees, frames from 0.\n" +
                     head.lines() + "\n[stage]\n" + stage.lines() + "\n[camera]\n" + camera.lines();
  if (project.sound) {
    io::TomlFields sound;
    write_sound(*project.sound, sound);
    text += "\n[sound]\n" + sound.lines();
  }
  for (const Layer& layer : project.layers) {
    io::TomlFields of_layer;
    of_layer.add("id", int(layer.id.value));
    write_layer(look_of(layer), of_layer);
    text += "\n[[layer]]\n" + of_layer.lines();
    for (const Cell& cell : layer.cells) {
      io::TomlFields of_cell;
      write_cell(cell, of_cell);
      text += "\n[[layer.cell]]\n" + of_cell.lines();
    }
  }
  for (const Constraint& constraint : project.constraints) {
    io::TomlFields fields;
    ChangeWriting::number_of(fields, constraint.id);
    write_constraint(constraint, words, fields);
    text += "\n[[constraint]]\n" + fields.lines();
  }
  for (const Mapping& mapping : project.mappings) {
    io::TomlFields fields;
    write_mapping(mapping, words, fields);
    text += "\n[[triangle]]\n" + fields.lines();
  }
  return text;
}

base::Result<Project> read_project(std::string_view text, const std::string& name) {
  const auto tree = io::parse_toml(text, name);
  if (!tree) return tl::unexpected(tree.error());
  io::Problems problems;
  Project project = ProjectReader(*tree, problems).read();
  if (!problems.none()) return base::fail(problems.text(name));
  return project;
}

std::string edit_text(const ProjectEdit& edit) {
  std::string list;
  for (const ProjectChange& change : edit) {
    io::TomlFields fields;
    std::visit(ChangeWriting{fields}, change);
    list.append(list.empty() ? "" : ", ").append(fields.inline_table());
  }
  return fmt::format("edit = [{}]", list);
}

base::Result<ProjectEdit> read_edit(std::string_view line, const std::string& name) {
  const auto tree = io::parse_toml(line, name);
  if (!tree) return tl::unexpected(tree.error());
  io::Problems problems;
  io::KeyReader keys(*tree, "the line", kOneLanguage, problems);
  ProjectEdit edit;
  keys.require("edit", "edit = [{ do = ... }]");
  for (io::KeyReader& part : keys.tables("edit", "change")) {
    edit.push_back(read_change(part));
    part.finish();
  }
  keys.finish();
  if (!problems.none()) return base::fail(problems.text(name));
  return edit;
}

}  // namespace icome::animation
