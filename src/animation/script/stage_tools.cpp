#include <fmt/format.h>

#include "animation/script/tool_arguments.h"

namespace icome::animation {
namespace {

base::Result<ProjectEdit> plan_stage(Staging& staging, const Arguments& arguments) {
  Stage stage = staging.project.stage;
  if (arguments.has("width")) stage.width = int(arguments.count("width"));
  if (arguments.has("height")) stage.height = int(arguments.count("height"));
  if (arguments.has("rate")) stage.rate = arguments.number("rate");
  if (arguments.has("length")) stage.length = int(arguments.count("length"));
  if (arguments.has("background")) stage.background = arguments.colour("background");
  ProjectEdit edit = edit_of(ChangeStage{stage});
  const Stage& old = staging.project.stage;
  CellLook camera = look_of(staging.project.camera);
  const bool in_the_middle = camera.rest.place == 0.5 * Vector2(old.width, old.height);
  if (in_the_middle && (stage.width != old.width || stage.height != old.height)) {
    camera.rest.place = 0.5 * Vector2(stage.width, stage.height);
    edit.push_back(ChangeCell{kCamera, camera});
  }
  return edit;
}

base::Result<ProjectEdit> plan_sound(Staging& staging, const Arguments& arguments) {
  Sound sound = staging.project.sound.value_or(Sound{});
  if (arguments.has("file")) sound.file = arguments.text("file");
  if (arguments.has("start")) sound.start = arguments.number("start");
  if (arguments.has("gain")) sound.gain = arguments.number("gain");
  if (sound.file.empty()) return base::fail("'file' is missing: there is no sound yet");
  if (arguments.has("file")) {
    if (const auto good = staging.disk.check_sound(sound); !good) return tl::unexpected(good.error());
  }
  return edit_of(ChangeSound{sound});
}

base::Result<ProjectEdit> plan_silence(Staging& staging, const Arguments& /*arguments*/) {
  if (!staging.project.sound) return base::fail("there is no sound");
  return edit_of(ChangeSound{std::nullopt});
}

base::Result<ProjectEdit> plan_mark(Staging& /*staging*/, const Arguments& arguments) {
  return edit_of(ChangeMark{frame_of(arguments, "frame"), arguments.text("text")});
}

base::Result<ProjectEdit> plan_unmark(Staging& staging, const Arguments& arguments) {
  const int frame = frame_of(arguments, "frame");
  for (const Mark& mark : staging.project.marks)
    if (mark.frame == frame) return edit_of(ChangeMark{frame, std::nullopt});
  return base::fail(fmt::format("there is no mark at frame {}", frame));
}

}  // namespace

std::vector<AnimationTool> stage_tools() {
  const auto side = [](const char* name) {
    return Parameter{
        .name = name, .kind = ParameterKind::Count, .meaning = "px", .least = 2, .most = kLargestStage};
  };
  return {
      {{.name = "stage",
        .title = "Stage",
        .group = "Stage",
        .summary = "Changes the page that is filmed; what is not named stays.",
        .parameters = {side("width"),
                       side("height"),
                       number_parameter("rate", "frames a second", 1, 120),
                       {.name = "length",
                        .kind = ParameterKind::Count,
                        .meaning = "frames",
                        .least = 1,
                        .most = kLongestAnimation},
                       {.name = "background", .kind = ParameterKind::Colour, .meaning = "its colour"}}},
       plan_stage},
      {{.name = "sound",
        .title = "Sound",
        .group = "Stage",
        .summary = "Lays a sound under the frames, or changes the one that is there.",
        .parameters = {text_parameter("file", "WAV, OGG or FLAC, relative to the project's", false),
                       number_parameter("start", "s of the animation at which it begins", -1e6, 1e6),
                       number_parameter("gain", "1: as it is", 0, 4)}},
       plan_sound},
      {{.name = "silence",
        .title = "No Sound",
        .group = "Stage",
        .summary = "Takes the sound away.",
        .parameters = {}},
       plan_silence},
      {{.name = "mark",
        .title = "Mark",
        .group = "Stage",
        .summary = "Writes a word at a frame, such as a sound of speech for the mouth.",
        .parameters = {frame_parameter("frame", "where"), text_parameter("text", "the word")}},
       plan_mark},
      {{.name = "unmark",
        .title = "Take Mark Away",
        .group = "Stage",
        .summary = "Takes the word of a frame away.",
        .parameters = {frame_parameter("frame", "where")}},
       plan_unmark},
  };
}

}  // namespace icome::animation
