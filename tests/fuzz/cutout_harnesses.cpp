// Cut-out animation: projects and edits as text, known triangles, pictures of a camera.
#include "animation/files/project_text.h"
#include "cutout/source/picture_bytes.h"
#include "cutout/tracker/known_triangles.h"
#include "fuzz/harness.h"

namespace icome::fuzz {
namespace {

/// A project that was read is written, and read again as the same.
void run_project(std::string_view bytes) {
  const auto read = animation::read_project(bytes, "f");
  if (!read) return require_told(read.error());
  const std::string text = animation::project_text(*read);
  const auto again = animation::read_project(text, "f");
  require(again.has_value(), "a project that was written can be read");
  require(animation::project_text(*again) == text, "and is written as the same");
}

/// An edit that was read leaves a project as it was, or can be taken back.
void run_project_edit(std::string_view bytes) {
  const auto edit = animation::read_edit(bytes, "f");
  if (!edit) return require_told(edit.error());
  const animation::Project start;
  animation::Project project = start;
  const auto back = animation::apply_edit(project, *edit);
  if (back) require(animation::apply_edit(project, *back).has_value(), "an edit can be taken back");
  project.next_id = start.next_id;
  require(project == start, "and nothing is left of it");
}

void run_known_triangles(std::string_view bytes) {
  const auto read = cutout::read_known_triangles(bytes, "f");
  if (!read) return require_told(read.error());
  const auto again = cutout::read_known_triangles(cutout::known_triangles_text(*read), "f");
  require(again.has_value() && again->triangles.size() == read->triangles.size(),
          "a list that was read can be written and read");
}

void run_camera_picture(std::string_view bytes) {
  const auto frame = cutout::decode_picture(bytes, "f");
  if (!frame) return require_told(frame.error());
  require(frame->width > 0 && frame->height > 0 && frame->width <= cutout::kMostPictureSide &&
              frame->height <= cutout::kMostPictureSide,
          "a picture has sides within bounds");
}

animation::Project small_project() {
  using namespace animation;
  Project project;
  Cell body, arm;
  body.id = CellId{3}, body.name = "body", body.pictures = {"body.png"};
  arm.id = CellId{4}, arm.name = "arm", arm.pictures = {"a.svg", "b.svg"};
  arm.tracks[std::size_t(Channel::Angle)] = {{0, 0.5, Ease::Eased}, {12, -0.25}};
  Joint joint;
  joint.parent = body.id, joint.child = arm.id;
  (void)apply_edit(project, {PutLayer{LayerId{2}, 0, {.name = "figure"}}, PutCell{LayerId{2}, 0, body},
                             PutCell{LayerId{2}, 1, arm}, PutConstraint{0, {ConstraintId{5}, joint}},
                             PutConstraint{1, {ConstraintId{6}, Chain{{body.id, arm.id}}}},
                             ChangeMark{7, "Ah"}, ChangeSound{Sound{"talk.ogg", 0.5, 1}},
                             ChangeMapping{"t1", Mapping{"t1", MappingMode::Relative, arm.id}}});
  return project;
}

std::vector<std::string> project_seeds() {
  return {animation::project_text({}), animation::project_text(small_project())};
}

std::vector<std::string> project_edit_seeds() {
  using namespace animation;
  const Project whole = small_project();
  ProjectEdit making = {PutLayer{LayerId{2}, 0, {.name = "figure"}},
                        PutCell{LayerId{2}, 0, whole.layers[0].cells[0]},
                        PutCell{LayerId{2}, 1, whole.layers[0].cells[1]},
                        PutConstraint{0, whole.constraints[0]}, MoveCell{CellId{3}, LayerId{2}, 1}};
  return {edit_text(making), edit_text({ChangeStage{}, ChangeMark{3, "O"}, SmoothHands{true}}),
          edit_text({ChangeKeys{kCamera, Channel::Scale, 0, 9, {{4, 2.0, Ease::Hold}}}})};
}

std::vector<std::string> known_triangle_seeds() {
  return {"[[triangle]]\nid = \"t1\"\nbase_angle_deg = 70\nheight_mm = 80\ncell = \"boat\"\n"};
}

std::vector<std::string> camera_picture_seeds() {
  cutout::Frame frame;
  frame.width = 8, frame.height = 6;
  frame.bgr.assign(std::size_t(3 * 8 * 6), 90);
  return {*cutout::encode_png(frame.view()), *cutout::encode_jpeg(frame.view(), 80)};
}

constexpr Harness kCutout[] = {{"project", run_project, project_seeds},
                               {"project_edit", run_project_edit, project_edit_seeds},
                               {"known_triangles", run_known_triangles, known_triangle_seeds},
                               {"camera_picture", run_camera_picture, camera_picture_seeds}};

}  // namespace

std::span<const Harness> cutout_harnesses() { return kCutout; }

}  // namespace icome::fuzz
