#include "interaction/techniques/bench/person.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace icome::interaction {
namespace {

/// Probability that a movement ends within the tolerance, with those deviations along and across it.
double chance_to_hit(double tolerance, double along, double across) {
  const double hits_along = std::erf(tolerance / (along * std::numbers::sqrt2));
  const double hits_across = 1.0 - std::exp(-0.5 * tolerance * tolerance / (across * across));
  return hits_along * hits_across;
}

double index_within(double amplitude, double tolerance) {
  return std::log2(amplitude / (2.0 * tolerance) + 1.0);
}

void add_limb(std::vector<PersonAssumption>& list, const std::string& name, const std::string& unit,
              const LimbModel& limb) {
  list.push_back(
      {name + ": endpoint deviation = this * amplitude / duration", limb.noise, "s",
       "form: Schmidt et al. 1979, Meyer et al. 1988, signal-dependent noise of Harris and Wolpert "
       "1998; value chosen: 5 % for 0.5 s"});
  list.push_back({name + ": greatest acceleration", limb.acceleration, unit + "/s^2", "chosen"});
  list.push_back({name + ": tremor, root mean square", limb.tremor, unit,
                  "form: physiological tremor, Elble and Koller 1990; value chosen"});
  list.push_back({name + ": jolt of pressing the button", limb.press_jolt, unit,
                  "form: \"Heisenberg effect\" of Bowman et al. 2001; value chosen"});
}

}  // namespace

std::vector<PersonAssumption> assumptions(const PersonModel& model) {
  const std::string processor = "Card, Moran and Newell 1983: ";
  std::vector<PersonAssumption> list;
  add_limb(list, "arm", "m", model.arm);
  add_limb(list, "wrist", "rad", model.wrist);
  add_limb(list, "head", "rad", model.head);
  list.push_back({"deviation across, as a share of that along", model.aside, "",
                  "form: van Beers, Haggard and Wolpert 2004; value chosen"});
  list.push_back({"frequency of tremor", model.tremor_hz, "Hz", "8 to 12 Hz, Elble and Koller 1990"});
  list.push_back({"reaction", model.reaction, "s", processor + "perceive 100, decide 70, move 70 ms"});
  list.push_back({"seeing and deciding after a movement", model.correction, "s",
                  processor + "perceive 100, decide 70 ms"});
  list.push_back({"pressing the button", model.press, "s", processor + "move 70 ms"});
  list.push_back({"shortest movement", model.shortest, "s", "chosen"});
  list.push_back({"presses anyway after", model.give_up, "s", "chosen"});
  list.push_back({"stereo acuity; depth deviation = acuity * distance^2 / eye distance", model.stereo_acuity,
                  "rad", "form: geometry of stereopsis, Howard and Rogers 1995; value chosen, 1 arc minute"});
  list.push_back({"eye distance", model.eye_distance, "m", "Dodgson 2004: mean of adults 63 mm"});
  list.push_back({"arm's length from the chest", model.arm_length, "m", "chosen"});
  list.push_back({"spread between people, deviation of the logarithm", model.spread, "", "chosen"});
  return list;
}

double normal_number(base::Random& random) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * random.uniform());
}

PersonModel drawn_person(const PersonModel& model, base::Random& random) {
  PersonModel person = model;
  const auto factor = [&] { return std::exp(model.spread * normal_number(random)); };
  const double noise = factor(), tremor = factor(), time = factor();
  for (LimbModel* limb : {&person.arm, &person.wrist, &person.head}) {
    limb->noise *= noise;
    limb->tremor *= tremor;
    limb->press_jolt *= tremor;
  }
  person.reaction *= time;
  person.correction *= time;
  person.press *= time;
  return person;
}

double minimum_jerk(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

double shortest_duration(const LimbModel& limb, const PersonModel& person, double amplitude) {
  const double peak = 10.0 / std::numbers::sqrt3;  // acceleration of minimum jerk, of amplitude / duration^2
  return std::max(person.shortest, std::sqrt(peak * amplitude / limb.acceleration));
}

double planned_duration(const LimbModel& limb, const PersonModel& person, double amplitude,
                        double tolerance) {
  if (person.known) return person.known->intercept + person.known->slope * index_within(amplitude, tolerance);
  const double shortest = shortest_duration(limb, person, amplitude);
  if (!(amplitude > 0.0) || !(limb.noise > 0.0) || !(tolerance > 0.0)) return shortest;
  constexpr int kSteps = 48;
  constexpr double kSlowest = 8.0;  // times the shortest duration
  double best = shortest;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    const double duration = shortest * std::pow(kSlowest, double(i) / kSteps);
    const double along = limb.noise * amplitude / duration;
    const double again = person.correction + shortest_duration(limb, person, along);
    const double cost = duration + (1.0 - chance_to_hit(tolerance, along, person.aside * along)) * again;
    if (cost >= least) continue;
    least = cost;
    best = duration;
  }
  return best;
}

}  // namespace icome::interaction
