#include "animation/project/project_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/edit_history.h"

namespace icome::animation {
namespace {

bool is_near(double number, double farthest) { return std::abs(number) <= farthest; }
bool is_near(const Vector2& place, double farthest) {
  return place.allFinite() && place.cwiseAbs().maxCoeff() <= farthest;
}

/// A complaint about a value of a channel of a cell with so many pictures; empty where there is none.
std::string complaint_about_value(Channel channel, double value, std::size_t pictures) {
  if (!std::isfinite(value)) return "a value is not finite";
  switch (channel) {
    case Channel::X:
    case Channel::Y:
      return is_near(value, kFarthest) ? "" : fmt::format("a place is at most {} px away", kFarthest);
    case Channel::Angle:
      return is_near(value, 1e6) ? "" : "an angle is too large";
    case Channel::Scale:
      return is_near(value, 1e4) ? "" : "a scale is -10,000 to 10,000";
    case Channel::Opacity:
      return value >= 0 && value <= 1 ? "" : "an opacity is 0 to 1";
    case Channel::Picture:
      if (value == std::floor(value) && value >= -1 && value < double(std::max<std::size_t>(pictures, 1)))
        return "";
      return fmt::format("a picture is a whole number from 0 to {} (-1: none), not {}",
                         pictures > 0 ? pictures - 1 : 0, value);
  }
  return "";
}

std::string complaint_about_keys(Channel channel, const Track& keys, std::size_t pictures) {
  int last = -1;
  for (const Key& key : keys) {
    if (key.frame < 0 || key.frame >= kLongestAnimation)
      return fmt::format("a frame is 0 to {}, not {}", kLongestAnimation - 1, key.frame);
    if (key.frame <= last) return fmt::format("frame {} does not come after frame {}", key.frame, last);
    last = key.frame;
    if (std::string why = complaint_about_value(channel, key.value, pictures); !why.empty())
      return fmt::format("at frame {}, {}", key.frame, why);
  }
  return "";
}

bool is_one_line(const std::string& name) {
  return std::ranges::none_of(name,
                              [](char c) { return static_cast<unsigned char>(c) < 0x20U || c == 0x7f; });
}

std::string complaint_about_look(const CellLook& look) {
  if (look.name.empty()) return "a cell needs a name";
  if (!is_one_line(look.name)) return "a name is one line of text";
  if (look.pictures.size() > kMostPictures)
    return fmt::format("a cell has at most {} pictures", kMostPictures);
  for (const std::string& picture : look.pictures)
    if (picture.empty()) return "a picture needs the name of a file";
  if (!is_near(look.pivot, kFarthest)) return "a pivot is finite and not far away";
  for (const Channel channel : kAllChannels) {
    const double value = channel_of(look.rest, channel);
    if (std::string why = complaint_about_value(channel, value, look.pictures.size()); !why.empty())
      return why;
  }
  return "";
}

std::string complaint_about_cell(const Cell& cell) {
  if (std::string why = complaint_about_look(look_of(cell)); !why.empty()) return why;
  for (const Channel channel : kAllChannels) {
    const Track& keys = cell.tracks[std::size_t(channel)];
    if (std::string why = complaint_about_keys(channel, keys, cell.pictures.size()); !why.empty()) return why;
  }
  return "";
}

bool may_be_camera(const CellLook& look) {
  return look.name == kCameraName && look.pictures.empty() && look.pivot == Vector2::Zero() &&
         look.rest.opacity == 1 && look.rest.picture == 0;
}

std::string complaint_about_stage(const Stage& stage) {
  for (const int side : {stage.width, stage.height})
    if (side < 2 || side > kLargestStage)
      return fmt::format("a stage is 2 to {} px wide and high, not {}", kLargestStage, side);
  if (!(stage.rate >= 1 && stage.rate <= 120))
    return fmt::format("there are 1 to 120 frames a second, not {}", stage.rate);
  if (stage.length < 1 || stage.length > kLongestAnimation)
    return fmt::format("an animation has 1 to {} frames, not {}", kLongestAnimation, stage.length);
  for (const float part : stage.background)
    if (!(part >= 0.0F && part <= 1.0F)) return "the parts of a colour are 0 to 1";
  return "";
}

std::string complaint_about_sound(const Sound& sound) {
  if (sound.file.empty()) return "a sound needs the name of a file";
  if (!is_near(sound.start, 1e6)) return "the start of a sound is finite and not far away";
  if (!(sound.gain >= 0 && sound.gain <= 4)) return fmt::format("a gain is 0 to 4, not {}", sound.gain);
  return "";
}

/// Looks for what is wrong with the shape of a constraint; which cells there are is not its matter.
struct ConstraintComplaint {
  std::string operator()(const DistanceLimit& limit) const {
    if (limit.one == limit.other) return "a distance is between two cells";
    if (!is_near(limit.on_one, kFarthest) || !is_near(limit.on_other, kFarthest)) return bad_point();
    if (!(limit.least >= 0 && limit.least <= limit.greatest && limit.greatest <= kFarthest))
      return "the least distance is 0 or more, and at most the greatest";
    return "";
  }
  std::string operator()(const Joint& joint) const {
    if (joint.parent == joint.child) return "a joint is between two cells";
    if (!is_near(joint.on_parent, kFarthest) || !is_near(joint.on_child, kFarthest)) return bad_point();
    if (joint.limits && !(joint.limits->least <= joint.limits->greatest &&
                          is_near(joint.limits->least, 1e6) && is_near(joint.limits->greatest, 1e6)))
      return "the least angle of a joint is at most the greatest";
    return "";
  }
  std::string operator()(const Chain& chain) const {
    return chain.cells.size() < 2 ? "a chain has two cells or more" : "";
  }
  std::string operator()(const PathGuide& guide) const {
    if (!is_near(guide.on_cell, kFarthest)) return bad_point();
    if (guide.way.size() < 2) return "a path has two places or more";
    for (const Vector2& place : guide.way)
      if (!is_near(place, kFarthest)) return "the places of a path are finite and not far away";
    return "";
  }
  std::string operator()(const AxisGuide& guide) const {
    if (!is_near(guide.on_cell, kFarthest)) return bad_point();
    if (!is_near(guide.through, kFarthest) || !is_near(guide.direction, 1e6)) return "an axis is finite";
    return "";
  }

  static std::string bad_point() { return "a point on a cell is finite and not far away"; }
};

const Joint* joint_of_child(const Project& project, CellId child) {
  for (const Constraint& constraint : project.constraints)
    if (const Joint* joint = std::get_if<Joint>(&constraint.what); joint != nullptr && joint->child == child)
      return joint;
  return nullptr;
}

/// A complaint about a constraint beside the others of the project.
std::string complaint_about_constraint(const Project& project, const Constraint& constraint) {
  if (std::string why = std::visit(ConstraintComplaint{}, constraint.what); !why.empty()) return why;
  for (const CellId cell : cells_of(constraint)) {
    if (cell == kCamera) return "the camera takes no part in constraints";
    if (project.find(cell) == nullptr) return fmt::format("there is no cell {}", cell.value);
  }
  if (const Joint* joint = std::get_if<Joint>(&constraint.what)) {
    if (joint_of_child(project, joint->child) != nullptr)
      return fmt::format("'{}' hangs on another cell already", project.find(joint->child)->name);
    for (const Joint* above = joint_of_child(project, joint->parent); above != nullptr;
         above = joint_of_child(project, above->parent))
      if (above->parent == joint->child)
        return fmt::format("'{}' would hang on itself", project.find(joint->child)->name);
  }
  if (const Chain* chain = std::get_if<Chain>(&constraint.what)) {
    for (std::size_t i = 1; i < chain->cells.size(); ++i) {
      const Joint* joint = joint_of_child(project, chain->cells[i]);
      if (joint == nullptr || joint->parent != chain->cells[i - 1])
        return fmt::format("'{}' is not joined to '{}', the one before it in the chain",
                           project.find(chain->cells[i])->name, project.find(chain->cells[i - 1])->name);
    }
  }
  return "";
}

/// The chain that needs a joint; null where none does.
const Constraint* chain_with(const Project& project, const Joint& joint) {
  for (const Constraint& constraint : project.constraints) {
    const Chain* chain = std::get_if<Chain>(&constraint.what);
    if (chain == nullptr) continue;
    const auto child = std::find(chain->cells.begin(), chain->cells.end(), joint.child);
    if (child != chain->cells.end() && child != chain->cells.begin() && *(child - 1) == joint.parent)
      return &constraint;
  }
  return nullptr;
}

/// Applies parts one after the other to a project of its own.
class ProjectApplying {
 public:
  explicit ProjectApplying(Project& project) : project_(project) {}

  using Undone = base::Result<ProjectChange>;

  Undone operator()(const PutLayer& part) {
    if (auto free = check_new(part.id.value); !free) return tl::unexpected(free.error());
    if (project_.layers.size() >= kMostLayers)
      return base::fail(fmt::format("there are at most {} layers", kMostLayers));
    if (part.place > project_.layers.size())
      return base::fail(no_place("layers", project_.layers.size(), part.place));
    if (auto named = check_layer_name(part.id, part.look.name); !named) return tl::unexpected(named.error());
    project_.layers.insert(project_.layers.begin() + std::ptrdiff_t(part.place),
                           Layer{part.id, part.look.name, part.look.visible, part.look.locked, {}});
    note_number(part.id.value);
    return ProjectChange(TakeLayer{part.id});
  }

  Undone operator()(const TakeLayer& part) {
    Layer* const layer = find_layer(part.id);
    if (layer == nullptr) return base::fail(no_layer(part.id));
    if (!layer->cells.empty()) return base::fail(fmt::format("layer '{}' has cells", layer->name));
    const PutLayer back = {part.id, std::size_t(layer - project_.layers.data()), look_of(*layer)};
    project_.layers.erase(project_.layers.begin() + std::ptrdiff_t(back.place));
    return ProjectChange(back);
  }

  Undone operator()(const ChangeLayer& part) {
    Layer* const layer = find_layer(part.id);
    if (layer == nullptr) return base::fail(no_layer(part.id));
    if (auto named = check_layer_name(part.id, part.look.name); !named) return tl::unexpected(named.error());
    const ChangeLayer back = {part.id, look_of(*layer)};
    layer->name = part.look.name;
    layer->visible = part.look.visible;
    layer->locked = part.look.locked;
    return ProjectChange(back);
  }

  Undone operator()(const MoveLayer& part) {
    Layer* const layer = find_layer(part.id);
    if (layer == nullptr) return base::fail(no_layer(part.id));
    if (part.place >= project_.layers.size())
      return base::fail(no_place("layers", project_.layers.size(), part.place));
    const std::size_t from = std::size_t(layer - project_.layers.data());
    Layer moved = std::move(*layer);
    project_.layers.erase(project_.layers.begin() + std::ptrdiff_t(from));
    project_.layers.insert(project_.layers.begin() + std::ptrdiff_t(part.place), std::move(moved));
    return ProjectChange(MoveLayer{part.id, from});
  }

  Undone operator()(const PutCell& part) {
    Layer* const layer = find_layer(part.layer);
    if (layer == nullptr) return base::fail(no_layer(part.layer));
    if (auto free = check_new(part.cell.id.value); !free) return tl::unexpected(free.error());
    if (project_.cell_count() >= kMostCells)
      return base::fail(fmt::format("there are at most {} cells", kMostCells));
    if (part.place > layer->cells.size())
      return base::fail(no_place("cells in that layer", layer->cells.size(), part.place));
    if (std::string why = complaint_about_cell(part.cell); !why.empty()) return base::fail(why);
    if (auto named = check_cell_name(part.cell.id, part.cell.name); !named)
      return tl::unexpected(named.error());
    layer->cells.insert(layer->cells.begin() + std::ptrdiff_t(part.place), part.cell);
    note_number(part.cell.id.value);
    return ProjectChange(TakeCell{part.cell.id});
  }

  Undone operator()(const TakeCell& part) {
    const auto [layer, place] = find_cell(part.id);
    if (layer == nullptr) return base::fail(no_cell(part.id));
    const std::string& name = layer->cells[place].name;
    for (const Constraint& constraint : project_.constraints)
      for (const CellId named : cells_of(constraint))
        if (named == part.id) return base::fail(fmt::format("a constraint needs the cell '{}'", name));
    for (const Mapping& mapping : project_.mappings)
      if (mapping.cell == part.id)
        return base::fail(fmt::format("triangle '{}' moves the cell '{}'", mapping.triangle, name));
    PutCell back = {layer->id, place, std::move(layer->cells[place])};
    layer->cells.erase(layer->cells.begin() + std::ptrdiff_t(place));
    return ProjectChange(std::move(back));
  }

  Undone operator()(const ChangeCell& part) {
    Cell* const cell = find(part.id);
    if (cell == nullptr) return base::fail(no_cell(part.id));
    if (std::string why = complaint_about_look(part.look); !why.empty()) return base::fail(why);
    if (part.id == kCamera && !may_be_camera(part.look))
      return base::fail("the camera keeps its name, and has a place, an angle and a scale only");
    if (auto named = check_cell_name(part.id, part.look.name); !named) return tl::unexpected(named.error());
    const Track& shown = cell->tracks[std::size_t(Channel::Picture)];
    if (std::string why = complaint_about_keys(Channel::Picture, shown, part.look.pictures.size());
        !why.empty())
      return base::fail(why);
    const ChangeCell back = {part.id, look_of(*cell)};
    cell->name = part.look.name;
    cell->pictures = part.look.pictures;
    cell->pivot = part.look.pivot;
    cell->rest = part.look.rest;
    return ProjectChange(back);
  }

  Undone operator()(const MoveCell& part) {
    const auto [from, place] = find_cell(part.id);
    if (from == nullptr) return base::fail(no_cell(part.id));
    Layer* const to = find_layer(part.layer);
    if (to == nullptr) return base::fail(no_layer(part.layer));
    const std::size_t others = to->cells.size() - (to == from ? 1 : 0);
    if (part.place > others) return base::fail(no_place("other cells in that layer", others, part.place));
    const MoveCell back = {part.id, from->id, place};
    Cell moved = std::move(from->cells[place]);
    from->cells.erase(from->cells.begin() + std::ptrdiff_t(place));
    to->cells.insert(to->cells.begin() + std::ptrdiff_t(part.place), std::move(moved));
    return ProjectChange(back);
  }

  Undone operator()(const ChangeKeys& part) {
    Cell* const cell = find(part.cell);
    if (cell == nullptr) return base::fail(no_cell(part.cell));
    if (part.from > part.to)
      return base::fail(fmt::format("frame {} comes after frame {}", part.from, part.to));
    if (part.cell == kCamera && (part.channel == Channel::Opacity || part.channel == Channel::Picture))
      return base::fail("the camera has a place, an angle and a scale only");
    if (std::string why = complaint_about_keys(part.channel, part.keys, cell->pictures.size()); !why.empty())
      return base::fail(why);
    if (!part.keys.empty() && (part.keys.front().frame < part.from || part.keys.back().frame > part.to))
      return base::fail(fmt::format("a key lies outside of the frames {} to {}", part.from, part.to));
    Track& track = cell->tracks[std::size_t(part.channel)];
    const auto before = [](const Key& key, int frame) { return key.frame < frame; };
    const auto first = std::lower_bound(track.begin(), track.end(), part.from, before);
    const auto last = std::find_if(first, track.end(), [&](const Key& key) { return key.frame > part.to; });
    ChangeKeys back = {part.cell, part.channel, part.from, part.to, Track(first, last)};
    const auto place = track.erase(first, last);
    track.insert(place, part.keys.begin(), part.keys.end());
    return ProjectChange(std::move(back));
  }

  Undone operator()(const ChangeStage& part) {
    if (std::string why = complaint_about_stage(part.stage); !why.empty()) return base::fail(why);
    const ChangeStage back = {project_.stage};
    project_.stage = part.stage;
    return ProjectChange(back);
  }

  Undone operator()(const ChangeSound& part) {
    if (part.sound) {
      if (std::string why = complaint_about_sound(*part.sound); !why.empty()) return base::fail(why);
    }
    const ChangeSound back = {project_.sound};
    project_.sound = part.sound;
    return ProjectChange(back);
  }

  Undone operator()(const ChangeMark& part) {
    if (part.frame < 0 || part.frame >= kLongestAnimation)
      return base::fail(fmt::format("a frame is 0 to {}, not {}", kLongestAnimation - 1, part.frame));
    if (part.text && part.text->empty()) return base::fail("a mark needs a text");
    const auto at = std::lower_bound(project_.marks.begin(), project_.marks.end(), part.frame,
                                     [](const Mark& mark, int frame) { return mark.frame < frame; });
    const bool is_there = at != project_.marks.end() && at->frame == part.frame;
    ChangeMark back = {part.frame, is_there ? std::optional(at->text) : std::nullopt};
    if (is_there && part.text) at->text = *part.text;
    if (is_there && !part.text) project_.marks.erase(at);
    if (!is_there && part.text) project_.marks.insert(at, Mark{part.frame, *part.text});
    return ProjectChange(std::move(back));
  }

  Undone operator()(const PutConstraint& part) {
    if (auto free = check_new(part.constraint.id.value); !free) return tl::unexpected(free.error());
    if (project_.constraints.size() >= kMostConstraints)
      return base::fail(fmt::format("there are at most {} constraints", kMostConstraints));
    if (part.place > project_.constraints.size())
      return base::fail(no_place("constraints", project_.constraints.size(), part.place));
    if (std::string why = complaint_about_constraint(project_, part.constraint); !why.empty())
      return base::fail(why);
    project_.constraints.insert(project_.constraints.begin() + std::ptrdiff_t(part.place), part.constraint);
    note_number(part.constraint.id.value);
    return ProjectChange(TakeConstraint{part.constraint.id});
  }

  Undone operator()(const TakeConstraint& part) {
    const auto found = std::find_if(project_.constraints.begin(), project_.constraints.end(),
                                    [&](const Constraint& c) { return c.id == part.id; });
    if (found == project_.constraints.end())
      return base::fail(fmt::format("there is no constraint {}", part.id.value));
    if (const Joint* joint = std::get_if<Joint>(&found->what))
      if (const Constraint* chain = chain_with(project_, *joint))
        return base::fail(fmt::format("the chain from {} needs this joint", ends_of(*chain)));
    const PutConstraint back = {std::size_t(found - project_.constraints.begin()), *found};
    project_.constraints.erase(found);
    return ProjectChange(back);
  }

  Undone operator()(const ChangeMapping& part) {
    if (part.triangle.empty()) return base::fail("a triangle needs its id");
    if (part.mapping) {
      const bool by_place = part.mapping->mode == MappingMode::Nearest;
      if (part.mapping->triangle != part.triangle) return base::fail("a mapping is of its own triangle");
      if (by_place && part.mapping->cell)
        return base::fail("a triangle that takes the nearest names no cell");
      if (!by_place && find(part.mapping->cell) == nullptr) return base::fail(no_cell(part.mapping->cell));
    }
    const auto found = std::find_if(project_.mappings.begin(), project_.mappings.end(),
                                    [&](const Mapping& m) { return m.triangle == part.triangle; });
    const bool is_there = found != project_.mappings.end();
    ChangeMapping back = {part.triangle, is_there ? std::optional(*found) : std::nullopt};
    if (is_there) project_.mappings.erase(found);
    if (part.mapping) {
      const auto place = std::find_if(project_.mappings.begin(), project_.mappings.end(),
                                      [&](const Mapping& m) { return m.triangle > part.triangle; });
      project_.mappings.insert(place, *part.mapping);
    }
    return ProjectChange(std::move(back));
  }

  Undone operator()(const SmoothHands& part) {
    const SmoothHands back = {project_.smooth_hands};
    project_.smooth_hands = part.smooth;
    return ProjectChange(back);
  }

 private:
  struct CellPlace {
    Layer* layer;
    std::size_t place;
  };

  std::string ends_of(const Constraint& chain) const {
    const auto& cells = std::get<Chain>(chain.what).cells;
    return fmt::format("'{}' to '{}'", project_.find(cells.front())->name, project_.find(cells.back())->name);
  }
  static std::string no_layer(LayerId id) { return fmt::format("there is no layer {}", id.value); }
  static std::string no_cell(CellId id) { return fmt::format("there is no cell {}", id.value); }
  static std::string no_place(const char* things, std::size_t count, std::size_t place) {
    return fmt::format("there are {} {}, so there is no place {}", count, things, place);
  }

  void note_number(std::uint64_t number) { project_.next_id = std::max(project_.next_id, number + 1); }

  base::Result<void> check_new(std::uint64_t number) const {
    bool is_taken = number == 0 || number > std::uint64_t(kGreatestNumber) || number == kCamera.value ||
                    project_.find(CellId{number}) != nullptr || project_.find(LayerId{number}) != nullptr;
    for (const Constraint& constraint : project_.constraints)
      is_taken = is_taken || constraint.id.value == number;
    if (is_taken) return base::fail(fmt::format("the number {} is taken already, or no number", number));
    return {};
  }

  base::Result<void> check_layer_name(LayerId id, const std::string& name) const {
    if (name.empty()) return base::fail("a layer needs a name");
    if (!is_one_line(name)) return base::fail("a name is one line of text");
    for (const Layer& layer : project_.layers)
      if (layer.name == name && layer.id != id)
        return base::fail(fmt::format("there is a layer '{}' already", name));
    return {};
  }

  base::Result<void> check_cell_name(CellId id, const std::string& name) const {
    const Cell* other = project_.find(name);
    if (other != nullptr && other->id != id)
      return base::fail(fmt::format("there is a cell '{}' already", name));
    return {};
  }

  Layer* find_layer(LayerId id) {
    const auto found = std::find_if(project_.layers.begin(), project_.layers.end(),
                                    [&](const Layer& layer) { return layer.id == id; });
    return found == project_.layers.end() ? nullptr : &*found;
  }

  Cell* find(CellId id) {
    if (id == kCamera) return &project_.camera;
    const auto [layer, place] = find_cell(id);
    return layer == nullptr ? nullptr : &layer->cells[place];
  }

  CellPlace find_cell(CellId id) {
    for (Layer& layer : project_.layers)
      for (std::size_t i = 0; i < layer.cells.size(); ++i)
        if (layer.cells[i].id == id) return {&layer, i};
    return {nullptr, 0};
  }

  Project& project_;
};

}  // namespace

LayerLook look_of(const Layer& layer) { return {layer.name, layer.visible, layer.locked}; }
CellLook look_of(const Cell& cell) { return {cell.name, cell.pictures, cell.pivot, cell.rest}; }

base::Result<ProjectEdit> apply_edit(Project& project, const ProjectEdit& edit) {
  ProjectApplying applying(project);
  return base::apply_parts(applying, edit);
}

}  // namespace icome::animation
