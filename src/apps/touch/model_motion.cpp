#include "apps/touch/model_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "apps/touch/effect_options.h"
#include "apps/touch/touch_models.h"
#include "base/parse_number.h"
#include "base/shown_text.h"
#include "haptics/effects/parameter_text.h"

namespace icome::apps {
namespace {

using base::Pose;
using base::Vector3;

base::Result<geometry::Formula> formula_of_time(std::string_view text, std::size_t number) {
  auto formula = geometry::Formula::parse(std::string(text));
  if (!formula) return base::fail(fmt::format("formula {}: {}", number, formula.error().message));
  if (formula->uses_place()) return base::fail(fmt::format("formula {} may use t alone.", number));
  if (!std::isfinite(formula->value(Vector3::Zero(), 0.0)))
    return base::fail(fmt::format("formula {} has no value at t = 0.", number));
  return formula;
}

/// The pose at `moment`, and the motion from then on, of a thing that is at `first` at the moment 0.
struct Going {
  Pose pose;
  haptics::Motion motion;

  Going(const Carrier& by, const Pose& first, double moment, double next) : pose(by.at(first, moment)) {
    motion = haptics::motion_between(pose, by.at(first, next), next - moment);
    motion.arrives = 0.0;
    motion.ends = haptics::Motion::kHorizon;
  }
};

}  // namespace

base::Result<ModelMotion> ModelMotion::parse(const std::string& text) {
  const std::size_t colon = text.find(':');
  const auto number = base::parse_number<std::size_t>(std::string_view(text).substr(0, colon));
  if (!number || colon == std::string::npos)
    return base::fail("say the number of the MODEL, from 0, a colon, and how it moves: 0:0.02*sin(3*t),0,0.");
  ModelMotion motion;
  motion.model_ = *number;
  const std::string_view formulas = std::string_view(text).substr(colon + 1);
  for (const std::string_view part : haptics::split_outside_parentheses(formulas, ',')) {
    auto formula = formula_of_time(part, motion.formulas_.size() + 1);
    if (!formula) return tl::unexpected(formula.error());
    motion.formulas_.push_back(std::move(*formula));
  }
  const std::size_t count = motion.formulas_.size();
  if (count == 3 || count == 6) return motion;
  return base::fail(fmt::format("it takes X,Y,Z or X,Y,Z,RX,RY,RZ: three or six formulas, not {}.", count));
}

/// A formula without a value counts as at the start.
Pose ModelMotion::at(double time) const {
  const auto value = [&](std::size_t i) {
    const double now = formulas_[i].value(Vector3::Zero(), time);
    return std::isfinite(now) ? now : formulas_[i].value(Vector3::Zero(), 0.0);
  };
  Pose pose = Pose::Identity();
  pose.translation() = Vector3(value(0), value(1), value(2));
  if (formulas_.size() < 6) return pose;
  const Vector3 turn(value(3), value(4), value(5));
  if (turn.norm() > 0.0) pose.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
  return pose;
}

base::Result<void> check_motions(const TouchOptions& options) {
  const std::size_t models = options.models.size() + (options.implicit ? 1 : 0);
  std::set<std::size_t> named;
  for (const std::string& text : options.motions) {
    const std::string whose = fmt::format("--motion \"{}\": ", base::shown_text(text));
    const auto motion = ModelMotion::parse(text);
    if (!motion) return base::fail(whose + motion.error().message);
    if (motion->model() >= models)
      return base::fail(fmt::format("{}there is no MODEL {}; the first is 0, the last {}.", whose,
                                    motion->model(), models - 1));
    if (!named.insert(motion->model()).second)
      return base::fail(fmt::format("{}MODEL {} has another motion.", whose, motion->model()));
  }
  return {};
}

void set_going(std::vector<TouchModel>& models, const TouchOptions& options) {
  for (const std::string& text : options.motions) {
    const auto motion = std::make_shared<const ModelMotion>(ModelMotion::parse(text).value());
    TouchModel& model = models[motion->model()];
    model.motion = motion;
    const Pose first = motion->at(0.0);
    for (TouchBody& body : model.bodies) body.world_from_body = first * body.world_from_body;
    for (haptics::PlacedEffect& effect : model.effects)
      effect.world_from_effect = first * effect.world_from_effect;
  }
}

Pose Carrier::at(const Pose& first, double time) const {
  if (model == nullptr) return course ? course(time) : first;
  const Pose within = course ? course(time) : Pose(model->at(0.0).inverse() * first);
  return model->at(time) * within;
}

bool moves(const TouchModel& model) {
  const auto goes = [](const Course& it) { return bool(it); };
  return model.motion || std::ranges::any_of(model.effect_courses, goes) ||
         std::ranges::any_of(model.bodies, goes, &TouchBody::course);
}

MovingScene::MovingScene(const std::vector<TouchModel>& models, const TouchOptions& options,
                         std::shared_ptr<const haptics::HapticScene> scene)
    : models_(models), scene_(std::move(scene)), effects_(effects_of(models, options)) {
  carriers_.resize(effects_.size());
  std::size_t next = options.effects.size();  // those of the models follow
  for (const TouchModel& model : models) {
    moves_ = moves_ || apps::moves(model);
    for (const Course& course : model.effect_courses) carriers_[next++] = {course, model.motion.get()};
  }
}

void MovingScene::publish(haptics::Servo& servo, double moment, double next) const {
  std::vector<haptics::HapticScene::Move> moves;
  for (const haptics::HapticObject& object : scene_->objects()) {
    const TouchModel& model = models_[object.id.index];
    const Carrier by{model.bodies[object.id.generation - 1].course, model.motion.get()};
    if (!by.moves()) continue;
    const Going going(by, object.world_from_object, moment, next);
    moves.push_back({object.id, going.pose, going.motion});
  }
  servo.publish(moves_ ? scene_->moved(moves, moment) : scene_);
  std::vector<haptics::PlacedEffect> effects = effects_;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (!carriers_[i].moves()) continue;
    const Going going(carriers_[i], effects[i].world_from_effect, moment, next);
    effects[i].world_from_effect = going.pose;
    effects[i].motion = going.motion;
  }
  servo.publish_effects(effects);
}

}  // namespace icome::apps
