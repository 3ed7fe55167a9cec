#include "study/definition/scene_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "session/elements/element_picture.h"
#include "study/definition/scene_reader.h"
#include "study/definition/spoken_choices.h"
#include "study/definition/study_parts.h"
#include "study/definition/trial_draws.h"
#include "study/definition/trial_goal.h"

namespace icome::study {
namespace {

constexpr std::size_t kMostThingsTold = 10;  // in a sentence

/// The message with a full stop, which messages that begin with file and line lack.
std::string ended(const std::string& message) {
  return message.ends_with('.') || message.ends_with('?') ? message : message + ".";
}

/// Checks the scenes and the trials that may take place in each.
class SceneChecker {
 public:
  SceneChecker(const Study& study, const std::filesystem::path& folder, StudyCheck& check)
      : study_(study), folder_(folder), check_(check), reader_(study, folder) {
    if (study.task) draws_ = possible_draws(study);
    const auto needs_speech = [](const Level& level) {
      return std::ranges::find(level.needs, "speech") != level.needs.end();
    };
    for (const IndependentVariable& factor : study.independent)
      is_spoken_in_a_level_ |= std::ranges::any_of(factor.levels, needs_speech);
  }

  void go() {
    const Trials& trials = study_.trials;
    for (std::size_t i = 0; i < trials.scenes.size(); ++i) {
      TrialPlan plan;
      plan.scene = i;
      if (is_there(trials.scenes[i])) look_into(trials.scenes[i], plan);
    }
    // The practice scene must be there even if nobody practises, since it goes into the data.
    if (trials.practice_scene && is_there(*trials.practice_scene) && is_practised(trials)) {
      TrialPlan plan;
      plan.practice = true;
      look_into(*trials.practice_scene, plan);
    }
    check_wrong();
  }

 private:
  void refuse(const TrialScene& scene, Place place, const std::string& why) {
    refused_ = true;
    check_.reasons.push_back({place, fmt::format("scene '{}': {}", scene.id, why)});
  }

  bool is_there(const TrialScene& scene) {
    if (scene.file.empty()) return false;
    std::error_code failed;
    if (std::filesystem::is_regular_file(folder_ / scene.file, failed)) return true;
    refuse(scene, scene.place, fmt::format("there is no file {} beside the study.", scene.file));
    return false;
  }

  void look_into(const TrialScene& scene, TrialPlan plan) {
    const auto& world = reader_.whole(scene.file);
    if (!world) return refuse(scene, scene.place, ended(world.error().message));
    const auto element = reader_.element_in(plan);
    if (!element) return refuse(scene, scene.element->place, ended(element.error().message));
    if (*element != nullptr) check_texts(scene, **element);
    if (!study_.task) return;
    looked_ = true;
    std::string why;             // of the first draw that has no goal
    std::set<std::string> none;  // targets of those that follow
    for (const std::vector<std::size_t>& draw : draws_) {
      plan.values = draw;
      const auto goal = goal_of(plan);
      if (goal) {
        if (goal->speech || is_spoken_in_a_level_) check_said(scene, *goal);
        wrong_found_ |= std::ranges::any_of(goal->things, &Thing::wrong);
        continue;
      }
      if (why.empty())
        why = goal.error().message;
      else
        none.insert(name_in_trial(study_, plan, study_.task->target));
    }
    if (!none.empty()) why += fmt::format(" Trials with {} as the target have none either.", listed(none));
    if (!why.empty()) refuse(scene, study_.task->place, why);
    check_shown(scene, *world);
  }

  /// The goal for any group and condition: these change how things are chosen, but not which things.
  base::Result<TrialGoal> goal_of(const TrialPlan& plan) {
    const auto world = reader_.in_trial(plan);
    if (!world) return tl::unexpected(world.error());
    const auto element = reader_.element_in(plan);
    if (!element) return tl::unexpected(element.error());
    return trial_goal(study_, {}, plan, *world, *element);
  }

  /// Names that cannot be said, or told apart, are told once for each scene.
  void check_said(const TrialScene& scene, const TrialGoal& goal) {
    const auto choices = spoken_choices(goal);
    if (!choices && unsayable_.insert(scene.id).second)
      refuse(scene, study_.task->place, choices.error().message);
  }

  void check_texts(const TrialScene& scene, const StageElement& element) {
    for (const std::string& language : languages_lacking(element, study_))
      check_.warnings.push_back(
          {scene.element->place,
           fmt::format("scene '{}': {} has no texts in '{}'; people who read that see "
                       "those in '{}'.",
                       scene.id, scene.element->file, language, element.element->languages.front())});
    std::set<std::string> boxes;
    for (const std::string& language : study_.languages)
      boxes.insert(session::letters_without_font(*element.element,
                                                 interaction::language_of(*element.element, language)));
    boxes.erase("");
    for (const std::string& letters : boxes)
      check_.warnings.push_back(
          {scene.element->place,
           fmt::format("scene '{}': {} has letters that no font here has, which people see as "
                       "boxes: {}",
                       scene.id, scene.element->file, letters)});
  }

  void check_shown(const TrialScene& scene, const world::World& world) {
    std::set<std::string> names, missing;
    for (const auto& [id, object] : world.objects()) names.insert(object.name);
    for (const std::vector<std::size_t>& draw : draws_) {
      TrialPlan plan;
      plan.values = draw;
      for (const std::string& shown : study_.task->shown) {
        std::string name = name_in_trial(study_, plan, shown);
        if (!names.contains(name)) missing.insert(std::move(name));
      }
    }
    if (missing.empty()) return;
    check_.warnings.push_back(
        {study_.task->place,
         fmt::format("scene '{}': the task shows {}, and nothing in the scene is called so.", scene.id,
                     listed(missing))});
  }

  void check_wrong() {
    // If a target is missing the reasons say so, and wrong things cannot be told.
    if (!study_.task || refused_ || !looked_) return;
    const std::string& wrong = study_.task->wrong;
    if (wrong.empty() || wrong == "*" || wrong_found_) return;
    check_.warnings.push_back(
        {study_.task->place,
         fmt::format("choosing '{}' is an error, and no scene has things called so beside the target: there "
                     "will be no errors.",
                     wrong)});
  }

  const Study& study_;
  const std::filesystem::path& folder_;
  StudyCheck& check_;
  SceneReader reader_;
  std::vector<std::vector<std::size_t>> draws_;  // see possible_draws()
  bool is_spoken_in_a_level_ = false;            // are things chosen by their names, in any scene?
  std::set<std::string> unsayable_;              // scenes whose names have been told
  bool looked_ = false;                          // a scene at least has been looked into
  bool refused_ = false;                         // a scene at least has been refused
  bool wrong_found_ = false;                     // a wrong thing, in any scene
};

}  // namespace

std::string listed(const std::set<std::string>& names) {
  std::string all;
  std::size_t told = 0;
  for (const std::string& name : names) {
    if (told++ == kMostThingsTold) return all + fmt::format(" and {} more", names.size() - kMostThingsTold);
    all += fmt::format("{}'{}'", all.empty() ? "" : ", ", name);
  }
  return all;
}

void check_scenes(const Study& study, const std::filesystem::path& folder, StudyCheck& check) {
  SceneChecker(study, folder, check).go();
}

}  // namespace icome::study
