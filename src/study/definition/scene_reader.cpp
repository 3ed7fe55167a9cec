#include "study/definition/scene_reader.h"

#include "files/design_files.h"
#include "interaction/object_edits.h"
#include "study/definition/trial_goal.h"
#include "world/edit/edit.h"

namespace icome::study {
namespace {

base::Result<world::World> read_onto_stage(const std::filesystem::path& file) {
  auto design = files::read_design(file);
  if (!design) return tl::unexpected(design.error());
  return std::move(design->world);
}

}  // namespace

SceneReader::SceneReader(const Study& study, std::filesystem::path folder)
    : study_(study), folder_(std::move(folder)) {}

const base::Result<world::World>& SceneReader::whole(const std::string& file) {
  const auto found = worlds_.find(file);
  if (found != worlds_.end()) return found->second;
  return worlds_.emplace(file, read_onto_stage(folder_ / file)).first->second;
}

base::Result<const StageElement*> SceneReader::element_in(const TrialPlan& plan) {
  const TrialScene* const scene = scene_of(study_, plan);
  if (scene == nullptr || !scene->element) return nullptr;
  auto found = elements_.find(scene);
  if (found == elements_.end())
    found = elements_.emplace(scene, read_stage_element(*scene->element, folder_)).first;
  if (!found->second) return tl::unexpected(found->second.error());
  return &*found->second;
}

base::Result<world::World> SceneReader::in_trial(const TrialPlan& plan) {
  const TrialScene* const scene = scene_of(study_, plan);
  if (scene == nullptr || scene->file.empty())
    return base::fail(
        "no scene file says where trials take place: write scenes = [{ id = \"room\", file = \"room.wrl\" "
        "}].");
  auto world = whole(scene->file);
  if (!world) return world;
  const auto hidden = hidden_things(study_, plan, *world);
  if (hidden.empty()) return world;
  if (const auto done = world::apply(*world, interaction::delete_objects(*world, hidden)); !done)
    return tl::unexpected(done.error());
  return world;
}

}  // namespace icome::study
