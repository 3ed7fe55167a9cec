#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "animation/script/tool_arguments.h"

namespace icome::animation {
namespace {

std::string free_cell_name(const Project& project, const std::string& wish) {
  return free_name(wish, [&](const std::string& name) { return project.find(name) != nullptr; });
}

/// The layer that a new cell goes to: the named one, else the front one that is not locked, else a new one.
base::Result<LayerId> layer_for_cell(Staging& staging, const Arguments& arguments, ProjectEdit& edit) {
  const std::vector<Layer>& layers = staging.project.layers;
  if (arguments.has("layer")) {
    const auto layer = layer_named(staging.project, arguments.text("layer"));
    if (!layer) return tl::unexpected(layer.error());
    if ((*layer)->locked) return base::fail(fmt::format("layer '{}' is locked", (*layer)->name));
    return (*layer)->id;
  }
  for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
    if (!layer->locked) return layer->id;
  const LayerId made{staging.next_id++};
  const std::string name = free_name(fmt::format("layer {}", layers.size() + 1), [&](const std::string& it) {
    return std::ranges::find(layers, it, &Layer::name) != layers.end();
  });
  edit.push_back(PutLayer{made, layers.size(), {.name = name}});
  return made;
}

std::size_t cells_on(const Project& project, LayerId id) {
  const Layer* layer = project.find(id);
  return layer != nullptr ? layer->cells.size() : 0;
}

/// Reads the sizes of pictures, the first of which it gives. Fails for one that cannot be read; others of
/// another size are told.
base::Result<Vector2> size_of_all(Staging& staging, const std::vector<std::string>& pictures) {
  Vector2 first = Vector2::Zero();
  for (const std::string& picture : pictures) {
    const auto size = staging.disk.size(picture);
    if (!size) return tl::unexpected(size.error());
    if (&picture == &pictures.front()) first = *size;
    if (*size != first && staging.note.empty())
      staging.note = fmt::format("{} is {} x {} px, and {} {} x {}: they are laid upper left on upper left",
                                 picture, size->x(), size->y(), pictures.front(), first.x(), first.y());
  }
  return first;
}

std::string name_of_file(const std::string& picture) {
  const std::string stem = std::filesystem::path(picture).stem().string();
  return stem.empty() ? "cell" : stem;
}

base::Result<ProjectEdit> plan_new_cell(Staging& staging, const Arguments& arguments) {
  ProjectEdit edit;
  const auto layer = layer_for_cell(staging, arguments, edit);
  if (!layer) return tl::unexpected(layer.error());
  Cell cell;
  cell.id = CellId{staging.next_id++};
  cell.pictures = arguments.texts("pictures");
  const auto size = size_of_all(staging, cell.pictures);
  if (!size) return tl::unexpected(size.error());
  cell.name = arguments.has("name") ? arguments.text("name")
                                    : free_cell_name(staging.project, name_of_file(cell.pictures.front()));
  const Stage& stage = staging.project.stage;
  const auto pivot = arguments.has("pivot") ? place_of(arguments, "pivot") : Vector2(0.5 * *size);
  const auto place =
      arguments.has("place") ? place_of(arguments, "place") : Vector2(0.5 * stage.width, 0.5 * stage.height);
  if (!pivot) return tl::unexpected(pivot.error());
  if (!place) return tl::unexpected(place.error());
  cell.pivot = *pivot;
  cell.rest.place = *place;
  cell.rest.scale = arguments.number("scale");
  cell.rest.angle = arguments.number("angle") * kDegree;
  cell.rest.opacity = arguments.number("opacity");
  edit.push_back(PutCell{*layer, cells_on(staging.project, *layer), std::move(cell)});
  return edit;
}

/// Shows all pictures of a cell, one after the other.
Track exposed(std::size_t pictures, int from, int each) {
  Track track;
  for (std::size_t i = 0; i < pictures; ++i) {
    const std::int64_t frame = from + std::int64_t(i) * each;
    if (frame < kLongestAnimation) track.push_back({int(frame), double(i), Ease::Hold});
  }
  return track;
}

/// Takes the pictures out that cannot be read, and tells which. Fails where none is left.
base::Result<void> keep_readable(Staging& staging, std::vector<std::string>& pictures) {
  std::string faults;
  std::erase_if(pictures, [&](const std::string& picture) {
    const auto size = staging.disk.size(picture);
    if (!size) faults += (faults.empty() ? "" : "; ") + size.error().message;
    return !size;
  });
  if (pictures.empty()) return base::fail(faults);
  if (!faults.empty()) staging.note = "left out: " + faults;
  return {};
}

base::Result<ProjectEdit> plan_import(Staging& staging, const Arguments& arguments) {
  const std::string& folder = arguments.text("folder");
  auto pictures = staging.disk.pictures(folder);
  if (!pictures) return tl::unexpected(pictures.error());
  if (pictures->empty()) return base::fail(fmt::format("{}: there is no picture (.png, .jpg, .svg)", folder));
  if (arguments.flag("skip"))
    if (const auto kept = keep_readable(staging, *pictures); !kept) return tl::unexpected(kept.error());
  ProjectEdit edit;
  const auto layer = layer_for_cell(staging, arguments, edit);
  if (!layer) return tl::unexpected(layer.error());
  const bool one_cell = arguments.text("as") == "pictures";
  std::vector<std::vector<std::string>> cells;
  if (one_cell) cells.push_back(*pictures);
  for (const std::string& picture : *pictures)
    if (!one_cell) cells.push_back({picture});
  std::set<std::string> names;
  std::size_t place = cells_on(staging.project, *layer);
  for (const std::vector<std::string>& of_cell : cells) {
    const auto size = size_of_all(staging, of_cell);
    if (!size) return tl::unexpected(size.error());
    std::string wish =
        name_of_file(one_cell ? std::filesystem::path(folder).filename().string() : of_cell[0]);
    if (one_cell && arguments.has("name")) wish = arguments.text("name");
    Cell cell;
    cell.id = CellId{staging.next_id++};
    cell.name = free_name(wish, [&](const std::string& name) {
      return staging.project.find(name) != nullptr || names.contains(name);
    });
    names.insert(cell.name);
    cell.pictures = of_cell;
    cell.pivot = 0.5 * *size;
    cell.rest.place = 0.5 * Vector2(staging.project.stage.width, staging.project.stage.height);
    if (one_cell)
      cell.tracks[std::size_t(Channel::Picture)] =
          exposed(of_cell.size(), frame_of(arguments, "frame"), int(arguments.count("each")));
    edit.push_back(PutCell{*layer, place++, std::move(cell)});
  }
  return edit;
}

/// Adds what leaves the pictures of a cell where they are when its pivot moves: at each key of place, angle
/// and scale another place.
void keep_places(const Cell& cell, const Vector2& pivot, CellLook& look, ProjectEdit& edit) {
  look.rest.place = on_stage(cell, cell.rest, pivot);
  std::set<int> frames;
  for (const Channel channel : kCameraChannels)
    for (const Key& key : cell.tracks[std::size_t(channel)]) frames.insert(key.frame);
  if (frames.empty()) return;
  for (const Channel channel : {Channel::X, Channel::Y}) {
    Track track;
    for (const int frame : frames) {
      const Vector2 place = on_stage(cell, state_at(cell, frame), pivot);
      const Key* old = key_at(cell.tracks[std::size_t(channel)], frame);
      track.push_back(
          {frame, channel == Channel::X ? place.x() : place.y(), old ? old->ease : Ease::Straight});
    }
    edit.push_back(ChangeKeys{cell.id, channel, track.front().frame, track.back().frame, track});
  }
}

base::Result<ProjectEdit> plan_cell_look(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments);
  if (!cell) return tl::unexpected(cell.error());
  CellLook look = look_of(**cell);
  ProjectEdit edit;
  if (arguments.has("name")) look.name = arguments.text("name");
  if (arguments.has("pivot")) {
    const auto pivot = place_of(arguments, "pivot");
    if (!pivot) return tl::unexpected(pivot.error());
    if (arguments.flag("stays")) keep_places(**cell, *pivot, look, edit);
    look.pivot = *pivot;
  }
  edit.insert(edit.begin(), ChangeCell{(*cell)->id, look});
  return edit;
}

base::Result<ProjectEdit> plan_new_pictures(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments);
  if (!cell) return tl::unexpected(cell.error());
  CellLook look = look_of(**cell);
  for (const std::string& picture : arguments.texts("pictures")) look.pictures.push_back(picture);
  if (const auto size = size_of_all(staging, look.pictures); !size) return tl::unexpected(size.error());
  staging.note = fmt::format("the pictures of '{}' are now 0 to {}", look.name, look.pictures.size() - 1);
  return edit_of(ChangeCell{(*cell)->id, look});
}

base::Result<std::size_t> picture_number(const Cell& cell, const Arguments& arguments) {
  const auto number = std::size_t(arguments.count("number"));
  if (number < cell.pictures.size()) return number;
  return base::fail(fmt::format("'{}' has {} pictures, so there is no picture {}", cell.name,
                                cell.pictures.size(), number));
}

base::Result<ProjectEdit> plan_other_picture(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments);
  if (!cell) return tl::unexpected(cell.error());
  const auto number = picture_number(**cell, arguments);
  if (!number) return tl::unexpected(number.error());
  CellLook look = look_of(**cell);
  look.pictures[*number] = arguments.text("picture");
  if (const auto size = staging.disk.size(look.pictures[*number]); !size) return tl::unexpected(size.error());
  return edit_of(ChangeCell{(*cell)->id, look});
}

base::Result<ProjectEdit> plan_no_picture(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments);
  if (!cell) return tl::unexpected(cell.error());
  const auto number = picture_number(**cell, arguments);
  if (!number) return tl::unexpected(number.error());
  const auto renumbered = [&](double shown) {
    if (shown == double(*number)) return -1.0;
    return shown > double(*number) ? shown - 1 : shown;
  };
  CellLook look = look_of(**cell);
  look.pictures.erase(look.pictures.begin() + std::ptrdiff_t(*number));
  look.rest.picture = int(renumbered(look.rest.picture));
  Track track = (*cell)->tracks[std::size_t(Channel::Picture)];
  for (Key& key : track) key.value = renumbered(key.value);
  ProjectEdit edit;
  if (!track.empty())
    edit.push_back(ChangeKeys{(*cell)->id, Channel::Picture, track.front().frame, track.back().frame, track});
  edit.push_back(ChangeCell{(*cell)->id, look});
  return edit;
}

base::Result<ProjectEdit> plan_copy_cell(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments, false);
  if (!cell) return tl::unexpected(cell.error());
  const Layer* from = staging.project.layer_of((*cell)->id);
  if (from == nullptr) return base::fail("there is one camera only");
  ProjectEdit edit;
  LayerId layer = from->id;
  if (arguments.has("layer") || from->locked) {
    const auto found = layer_for_cell(staging, arguments, edit);
    if (!found) return tl::unexpected(found.error());
    layer = *found;
  }
  Cell copy = **cell;
  copy.id = CellId{staging.next_id++};
  copy.name = arguments.has("name") ? arguments.text("name") : free_cell_name(staging.project, copy.name);
  edit.push_back(PutCell{layer, cells_on(staging.project, layer), std::move(copy)});
  return edit;
}

base::Result<ProjectEdit> plan_cell_depth(Staging& staging, const Arguments& arguments) {
  const auto cell = cell_of(staging, arguments);
  if (!cell) return tl::unexpected(cell.error());
  const Layer* from = staging.project.layer_of((*cell)->id);
  if (from == nullptr) return base::fail("the camera lies on no layer");
  const auto to = arguments.has("layer") ? layer_named(staging.project, arguments.text("layer"))
                                         : base::Result<const Layer*>(from);
  if (!to) return tl::unexpected(to.error());
  if ((*to)->locked) return base::fail(fmt::format("layer '{}' is locked", (*to)->name));
  const std::size_t others = (*to)->cells.size() - (*to == from ? 1 : 0);
  const std::size_t place = arguments.has("place") ? std::size_t(arguments.count("place")) : others;
  return edit_of(MoveCell{(*cell)->id, (*to)->id, place});
}

base::Result<ProjectEdit> plan_no_cells(Staging& staging, const Arguments& arguments) {
  const auto cells = meant_cells(staging, arguments);
  if (!cells) return tl::unexpected(cells.error());
  ProjectEdit edit;
  for (const Cell* cell : *cells) {
    if (cell->id == kCamera) return base::fail("the camera stays");
    take_cell(staging.project, cell->id, edit);
  }
  return edit;
}

Parameter pictures_parameter() {
  return {.name = "pictures",
          .kind = ParameterKind::Texts,
          .meaning =
              "files, relative to the project's: .png, .jpg, .svg, or a drawing in a design: "
              "body.icome#arm",
          .required = true};
}

Parameter picture_number_parameter() {
  return {.name = "number",
          .kind = ParameterKind::Count,
          .meaning = "the picture's place, from 0",
          .required = true,
          .least = 0,
          .most = double(kMostPictures)};
}

Parameter with_fallback(Parameter parameter, double fallback) {
  parameter.fallback = fallback;
  return parameter;
}

}  // namespace

std::vector<AnimationTool> cell_tools() {
  const Parameter each = {.name = "each",
                          .kind = ParameterKind::Count,
                          .meaning = "frames for which a picture stays",
                          .fallback = 1,
                          .least = 1,
                          .most = kLongestAnimation};
  Parameter frame = frame_parameter("frame", "at which the first picture is shown", false);
  frame.fallback = 0;
  return {
      {{.name = "add-cell",
        .title = "New Cell",
        .group = "Cells",
        .summary =
            "Puts a cell with these pictures on a layer, in the middle of the stage, turning about its own.",
        .parameters = {pictures_parameter(), text_parameter("name", "its name; the file's, else", false),
                       layer_parameter(false), place_parameter("place", "where its pivot lies on the stage"),
                       place_parameter("pivot", "about which it turns, in its picture"),
                       with_fallback(number_parameter("scale", "1: as large as its picture", 0, 1e4), 1),
                       with_fallback(number_parameter("angle", "degrees, counter-clockwise", -36e4, 36e4), 0),
                       with_fallback(number_parameter("opacity", "1: nothing is seen through it", 0, 1), 1)}},
       plan_new_cell},
      {{.name = "import",
        .title = "Import Folder",
        .group = "Cells",
        .summary = "Makes a cell of all pictures of a folder, one after the other, or a cell of each.",
        .parameters = {text_parameter("folder", "relative to the project's"),
                       {.name = "as",
                        .kind = ParameterKind::Choice,
                        .meaning = "what the files become",
                        .fallback = "pictures",
                        .choices = {"pictures", "cells"}},
                       text_parameter("name", "of the one cell; the folder's, else", false),
                       layer_parameter(false),
                       frame,
                       each,
                       {.name = "skip",
                        .kind = ParameterKind::Flag,
                        .meaning = "leaves pictures out that cannot be read, and tells which",
                        .fallback = false}}},
       plan_import},
      {{.name = "change-cell",
        .title = "Change Cell",
        .group = "Cells",
        .summary = "Renames a cell, or lets it turn about another point.",
        .parameters = {cell_parameter("cell", "its name"),
                       text_parameter("name", "its new name", false),
                       place_parameter("pivot", "about which it turns, in its picture"),
                       {.name = "stays",
                        .kind = ParameterKind::Flag,
                        .meaning =
                            "do its pictures stay where they are, or does the new pivot come to the old",
                        .fallback = true}}},
       plan_cell_look},
      {{.name = "add-picture",
        .title = "More Pictures",
        .group = "Cells",
        .summary = "Gives a cell more pictures, to be swapped by the channel 'picture'.",
        .parameters = {cell_parameter("cell", "its name"), pictures_parameter()}},
       plan_new_pictures},
      {{.name = "replace-picture",
        .title = "Replace Picture",
        .group = "Cells",
        .summary = "Puts another file in the place of a picture.",
        .parameters = {cell_parameter("cell", "its name"), picture_number_parameter(),
                       text_parameter("picture", "the file, relative to the project's")}},
       plan_other_picture},
      {{.name = "delete-picture",
        .title = "Delete Picture",
        .group = "Cells",
        .summary = "Takes a picture from a cell, which shows none where it showed that one.",
        .parameters = {cell_parameter("cell", "its name"), picture_number_parameter()}},
       plan_no_picture},
      {{.name = "copy-cell",
        .title = "Copy Cell",
        .group = "Cells",
        .summary = "Puts another cell with the same pictures and keys in front of the layer.",
        .parameters = {cell_parameter("cell", "its name"), text_parameter("name", "the copy's", false),
                       layer_parameter(false)}},
       plan_copy_cell},
      {{.name = "move-cell",
        .title = "Move Cell",
        .group = "Cells",
        .summary = "Puts a cell at another depth of its layer, or on another layer.",
        .parameters = {cell_parameter("cell", "its name"),
                       layer_parameter(false),
                       {.name = "place",
                        .kind = ParameterKind::Count,
                        .meaning = "0: behind the others of the layer; in front of all, else",
                        .least = 0,
                        .most = double(kMostCells)}}},
       plan_cell_depth},
      {{.name = "delete-cell",
        .title = "Delete Cells",
        .group = "Cells",
        .summary = "Takes cells away, with their constraints and what moves them.",
        .parameters = {cells_parameter(true)}},
       plan_no_cells},
  };
}

}  // namespace icome::animation
