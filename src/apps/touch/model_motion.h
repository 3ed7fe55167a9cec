#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "geometry/implicit/formula.h"
#include "haptics/servo/servo.h"

namespace icome::apps {

struct TouchModel;
struct TouchOptions;

/// The motion of a MODEL, as --motion gives it: "0:0.02*sin(3*t),0,0" or "1:0,0,0,0,0,2*t". Immutable.
class ModelMotion {
 public:
  /// A number from 0, a colon, and three or six formulas in t (s): the way of the model (m), and the turn
  /// about the world's origin (rad, a vector along the axis), world frame. Fails with a sentence.
  static base::Result<ModelMotion> parse(const std::string& text);

  std::size_t model() const { return model_; }  // its number on the command line
  /// The pose at that time of the world's frame if it goes along with the model.
  base::Pose at(double time) const;

 private:
  ModelMotion() = default;

  std::size_t model_ = 0;
  std::vector<geometry::Formula> formulas_;  // three or six; finite at t = 0
};

/// The pose of a thing at a moment (s) by the motions of its file, before its model moves; empty: it stays.
using Course = std::function<base::Pose(double time)>;

/// The carriers of a body or an effect: the motions of its file, and its model with everything in it.
struct Carrier {
  Course course = {};
  const ModelMotion* model = nullptr;  // null: the model stands

  bool moves() const { return course || model != nullptr; }
  /// The pose at a moment (s) of a thing whose pose is `first` at the moment 0.
  base::Pose at(const base::Pose& first, double time) const;
};

/// Does anything of the model move?
bool moves(const TouchModel& model);

/// Fails unless every --motion is well written, each of another existing MODEL.
base::Result<void> check_motions(const TouchOptions& options);

/// Gives the models their motions, and puts them at the start of these.
void set_going(std::vector<TouchModel>& models, const TouchOptions& options);

/// The models as a servo feels them, some of which move: main publishes again and again where they are and
/// how they go on. One thread owns it; models and options outlive it.
class MovingScene {
 public:
  /// The usual time between two such moments, s.
  static constexpr double kPeriod = 0.01;

  /// `scene` is that of the models.
  MovingScene(const std::vector<TouchModel>& models, const TouchOptions& options,
              std::shared_ptr<const haptics::HapticScene> scene);

  /// Does anything move?
  bool moves() const { return moves_; }
  /// Publishes to the servo where everything is at `moment` (s) and, moving evenly, until `next`. A scene in
  /// which nothing moves needs this once.
  void publish(haptics::Servo& servo, double moment, double next) const;

 private:
  const std::vector<TouchModel>& models_;
  std::shared_ptr<const haptics::HapticScene> scene_;
  std::vector<haptics::PlacedEffect> effects_;  // as they are at the moment 0
  std::vector<Carrier> carriers_;               // of each effect
  bool moves_ = false;
};

}  // namespace icome::apps
