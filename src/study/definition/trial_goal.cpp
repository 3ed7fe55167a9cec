#include "study/definition/trial_goal.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <limits>
#include <set>

#include "charts/lettering.h"
#include "study/definition/conditions.h"
#include "study/definition/study_parts.h"

namespace icome::study {
namespace {

double distance(const base::Bounds& bounds, const base::Vector3& point) {
  return bounds.exteriorDistance(point);
}

/// The names of an object and of the objects that it is part of, its own first.
std::vector<std::string> names_of(const world::World& world, world::ObjectId id) {
  std::vector<std::string> names;
  for (const world::PhysicalObject* object = world.find(id); object != nullptr;
       object = world.find(object->parent))
    if (!object->name.empty()) names.push_back(object->name);
  return names;
}

bool any_meant(const std::string& pattern, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& name) { return is_meant(pattern, name); });
}

/// Objects with a shape, in the order that people see.
std::vector<world::ObjectId> shaped_objects(const world::World& world) {
  std::vector<world::ObjectId> shaped;
  for (const world::ObjectId root : world.roots())
    for (const world::ObjectId id : world::subtree(world, root))
      if (world.find(id)->geometry) shaped.push_back(id);
  return shaped;
}

bool has_need(const std::vector<std::string>& needs, const char* need) {
  return std::ranges::find(needs, need) != needs.end();
}

bool needs_stereo(const std::vector<std::string>& needs) { return has_need(needs, "stereo"); }
bool needs_speech(const std::vector<std::string>& needs) { return has_need(needs, "speech"); }

/// Stereo in trials whose levels say nothing of it: on where all of the study, or the scene, needs it, and
/// off where only some levels have it.
std::optional<bool> usual_stereo(const Study& study, const TrialScene* scene) {
  if (study.task->stereo) return study.task->stereo;
  if (needs_stereo(study.needs) || (scene != nullptr && needs_stereo(scene->needs))) return true;
  const auto speaks_of_it = [](const Level& level) { return level.stereo || needs_stereo(level.needs); };
  for (const IndependentVariable& factor : study.independent)
    if (std::ranges::any_of(factor.levels, speaks_of_it)) return false;
  const auto is_needed = [](const TrialScene& it) { return needs_stereo(it.needs); };
  return std::ranges::any_of(study.trials.scenes, is_needed) ? std::optional(false) : std::nullopt;
}

/// Applies the changes that the levels of a crossing make.
void apply_levels(const Study& study, bool between, std::size_t crossing, TrialGoal& goal) {
  const auto factors = factors_of(study, between);
  const Crossing levels = crossings(study, between)[crossing];
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const Level& level = factors[i]->levels[levels[i]];
    goal.choosing = level.choosing.value_or(goal.choosing);
    goal.forces = level.forces.value_or(goal.forces);
    goal.head = level.head.value_or(goal.head);
    if (needs_stereo(level.needs)) goal.stereo = true;
    if (needs_speech(level.needs)) goal.speech = true;
    if (level.stereo) goal.stereo = level.stereo;
  }
}

/// The name with a variable in braces replaced.
std::string with_value(const std::string& name, const std::string& variable, const std::string& value) {
  const std::string braced = fmt::format("{{{}}}", variable);
  std::string full;
  std::size_t from = 0;
  for (std::size_t at = name.find(braced); at != std::string::npos; at = name.find(braced, from)) {
    full.append(name, from, at - from).append(value);
    from = at + braced.size();
  }
  return full.append(name, from);
}

/// The part of a study that names the task's things, for this trial.
struct NamesInTrial {
  std::string target, wrong;
  bool all_wrong = false;
};

/// Adds the element's widgets that can be chosen, in the order of the file. What only opens a menu is not
/// wrong: it is on the way.
void add_widgets(const TrialElement& element, const std::vector<interaction::Widget>& widgets,
                 const NamesInTrial& names, std::vector<Thing>& things) {
  for (const interaction::Widget& widget : widgets) {
    if (!widget.can_be_chosen()) continue;
    Thing thing;
    thing.name = fmt::format("{}/{}", element.id, widget.name);
    thing.target = is_meant(names.target, thing.name);
    thing.wrong =
        !thing.target && widget.widgets.empty() && (names.all_wrong || is_meant(names.wrong, thing.name));
    thing.widget = &widget;
    things.push_back(std::move(thing));
    add_widgets(element, widget.widgets, names, things);
  }
}

/// Gives widgets their place in the scene while all menus are closed.
void place_widgets(const TrialElement& element, TrialGoal& goal) {
  const auto layout = interaction::lay_out(*element.element, element.language, charts::line_width);
  const interaction::ElementFrame frame{element.element->centre, element.element->turn};
  for (const interaction::LaidWidget& laid : layout.widgets) {
    const int number = goal.thing_of(*laid.widget);
    if (number < 0) continue;
    for (const double right : {-1.0, 1.0})
      for (const double up : {-1.0, 1.0})
        goal.things[std::size_t(number)].bounds.extend(
            frame.in_world(laid.centre + laid.half.cwiseProduct(base::Vector2(right, up))));
  }
}

/// The element as it is chosen from in a trial: by click or push alone, as the trial has it.
interaction::Element in_trial(interaction::Element element, const Task& task, Choosing choosing) {
  element.choosing.by_click = choosing == Choosing::Click;
  element.choosing.by_push = choosing == Choosing::Push;
  element.choosing.near = task.near.value_or(element.choosing.near);
  element.choosing.recede = std::max(element.choosing.recede, 2.0 * element.choosing.near);
  element.choosing.push_depth = task.depth.value_or(element.choosing.push_depth);
  return element;
}

void add_element(const StageElement& stage, const Task& task, const std::string& language,
                 const NamesInTrial& names, TrialGoal& goal) {
  TrialElement element;
  element.id = stage.id;
  element.element =
      std::make_shared<const interaction::Element>(in_trial(*stage.element, task, goal.choosing));
  element.language = interaction::language_of(*element.element, language);
  add_widgets(element, element.element->widgets, names, goal.things);
  place_widgets(element, goal);
  if (goal.is_in_element()) {
    goal.near = element.element->choosing.near;
    goal.depth = element.element->choosing.push_depth;
    goal.vicinity = task.vicinity.value_or(goal.near);
  }
  goal.element = std::move(element);
}

base::Error no_target(const std::string& target, const std::vector<Thing>& things) {
  std::set<std::string> names;
  for (const Thing& thing : things) names.insert(thing.name);
  const std::string all = fmt::format("{}", fmt::join(names, ", "));
  return {fmt::format("the task's target is '{}', and nothing in the scene is called so; there {}.", target,
                      all.empty() ? "is nothing with a name" : fmt::format("are {}", all))};
}

}  // namespace

bool TrialGoal::is_in_element() const {
  return std::ranges::any_of(things, [](const Thing& it) { return it.target && it.widget != nullptr; });
}

int TrialGoal::thing_of(const interaction::Widget& widget) const {
  const auto found = std::ranges::find(things, &widget, &Thing::widget);
  return found == things.end() ? -1 : int(found - things.begin());
}

double TrialGoal::distance_to_vicinity(const base::Vector3& tip) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Thing& thing : things)
    if (thing.widget == nullptr && (thing.target || (thing.wrong && choosing != Choosing::Touch)))
      least = std::min(least, distance(thing.bounds, tip));
  return least;
}

int TrialGoal::nearest(const base::Vector3& tip) const {
  int best = -1;
  double least = near;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (things[i].widget != nullptr || (!things[i].target && !things[i].wrong)) continue;
    const double far = distance(things[i].bounds, tip);
    if (far > least || (far == least && best >= 0)) continue;
    least = far;
    best = int(i);
  }
  return best;
}

std::string name_in_trial(const Study& study, const TrialPlan& plan, const std::string& name) {
  std::string full = name;
  for (std::size_t i = 0; i < study.trials.variables.size(); ++i)
    full =
        with_value(full, study.trials.variables[i].id, study.trials.variables[i].values[plan.values[i]].id);
  return full;
}

bool is_meant(const std::string& pattern, const std::string& name) {
  return fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
}

std::vector<world::ObjectId> hidden_things(const Study& study, const TrialPlan& plan,
                                           const world::World& world) {
  std::vector<world::ObjectId> hidden;
  if (!study.task) return hidden;
  for (const std::string& shown : study.task->shown) {
    std::string family = shown;
    for (const std::string& variable : variables_in(shown)) family = with_value(family, variable, "*");
    const std::string one = name_in_trial(study, plan, shown);
    for (const auto& [id, object] : world.objects())
      if (is_meant(family, object.name) && object.name != one) hidden.push_back(id);
  }
  std::ranges::sort(hidden);
  return hidden;
}

base::Result<TrialGoal> trial_goal(const Study& study, const Participant& participant, const TrialPlan& plan,
                                   const world::World& world, const StageElement* element) {
  if (!study.task) return base::fail("the study has no [task]: nothing says what is to be done in a trial.");
  const Task& task = *study.task;
  const TrialScene* const scene = scene_of(study, plan);
  TrialGoal goal;
  goal.choosing = task.choosing;
  goal.forces = task.forces;
  goal.head = task.head;
  goal.speech = needs_speech(study.needs) || (scene != nullptr && needs_speech(scene->needs));
  goal.stereo = usual_stereo(study, scene);
  goal.start = scene != nullptr && scene->start ? *scene->start : task.start;
  goal.near = task.near.value_or(goal.near);
  goal.depth = task.depth.value_or(goal.depth);
  goal.vicinity = task.vicinity.value_or(goal.vicinity);
  goal.limit = task.limit;
  goal.hold = study.trials.hold;
  apply_levels(study, true, participant.group, goal);
  apply_levels(study, false, plan.condition, goal);
  const NamesInTrial meant{name_in_trial(study, plan, task.target), name_in_trial(study, plan, task.wrong),
                           task.wrong == "*"};
  for (const world::ObjectId id : shaped_objects(world)) {
    const auto names = names_of(world, id);
    Thing thing;
    thing.name = names.empty() ? std::string() : names.front();
    thing.bounds = world::bounds(world, id);
    thing.target = any_meant(meant.target, names);
    thing.wrong = !thing.target && (meant.all_wrong || any_meant(meant.wrong, names));
    thing.object = id;
    goal.things.push_back(std::move(thing));
  }
  if (element != nullptr) add_element(*element, task, study.languages[participant.language], meant, goal);
  if (std::ranges::none_of(goal.things, &Thing::target))
    return tl::unexpected(no_target(meant.target, goal.things));
  for (const Thing& thing : goal.things)
    if (thing.target && thing.widget != nullptr && !thing.widget->enabled)
      return base::fail(fmt::format("the task's target '{}' is disabled in the element.", thing.name));
  return goal;
}

}  // namespace icome::study
