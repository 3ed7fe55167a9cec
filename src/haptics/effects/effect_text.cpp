#include "haptics/effects/effect_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <utility>

#include "geometry/implicit/formula.h"
#include "haptics/effects/drag.h"
#include "haptics/effects/fields.h"
#include "haptics/effects/parameter_text.h"
#include "haptics/effects/springs.h"

namespace icome::haptics {
namespace {

using EffectPointer = std::unique_ptr<Effect>;
using EffectResult = base::Result<EffectPointer>;
using Values = std::span<const double>;

constexpr SpringSettings kUsualSpring;
constexpr FrictionSettings kUsualFriction;

constexpr Parameter coordinate(std::string_view name) { return {name, "m"}; }
constexpr Parameter component(std::string_view name) { return {name, ""}; }
constexpr Parameter force_named(std::string_view name, double least = 0.0) {
  return {name, "N", least, 1000.0};
}
constexpr Parameter radius_named(std::string_view name, double least) { return {name, "m", least, 1000.0}; }
constexpr Parameter kStiffness = {"STIFFNESS", "N/m", 0.0, 1e6, kUsualSpring.stiffness};
constexpr Parameter kDamping = {"DAMPING", "N s/m", 0.0, 1e3, kUsualSpring.damping};

// The smallest length that means anything to a hand.
constexpr double kShortest = 1e-6;  // m

// Limits on the work that fits into one tick beside everything else.
constexpr std::size_t kMostCurvePoints = 1000;
constexpr std::size_t kMostFieldSteps = 1000;
constexpr double kMostField = 1000.0;  // N, of each component

constexpr std::array kPoint = {coordinate("X"), coordinate("Y"), coordinate("Z"), kStiffness, kDamping};
constexpr std::array kLine = {coordinate("X"), coordinate("Y"), coordinate("Z"), component("DX"),
                              component("DY"), component("DZ"), kStiffness,      kDamping};
constexpr std::array kPlane = {coordinate("X"), coordinate("Y"), coordinate("Z"), component("NX"),
                               component("NY"), component("NZ"), kStiffness,      kDamping};
constexpr std::array kCurvePoint = {coordinate("X"), coordinate("Y"), coordinate("Z")};
constexpr std::array kCurveFeel = {kStiffness, kDamping};
constexpr std::array kViscous = {Parameter{"DAMPING", "N s/m", 0.0, 1e3}};
constexpr std::array kFriction = {force_named("STATIC"), force_named("DYNAMIC"),
                                  Parameter{"STIFFNESS", "N/m", 1.0, 1e6, kUsualFriction.stiffness}};
constexpr std::array kInertia = {Parameter{"MASS", "kg", 0.0, 10.0},
                                 Parameter{"CORNER", "Hz", 1.0, 500.0, 50.0}};
constexpr std::array kWell = {coordinate("X"), coordinate("Y"), coordinate("Z"),
                              radius_named("RADIUS", kShortest), force_named("FORCE")};
constexpr std::array kRecess = {coordinate("X"),
                                coordinate("Y"),
                                coordinate("Z"),
                                component("AX"),
                                component("AY"),
                                component("AZ"),
                                radius_named("FLOOR", 0.0),
                                radius_named("RIM", kShortest),
                                force_named("FORCE")};
constexpr std::array kConstant = {force_named("FX", -1000.0), force_named("FY", -1000.0),
                                  force_named("FZ", -1000.0)};

Vector3 vector_in(Values numbers, std::size_t first = 0) {
  return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

base::Result<Vector3> direction_in(Values numbers, std::size_t first) {
  const Vector3 direction = vector_in(numbers, first);
  if (direction.squaredNorm() > 0.0) return direction;
  return base::fail(fmt::format("numbers {} to {} are a direction: 0,0,0 has none.", first + 1, first + 3));
}

SpringSettings spring_in(Values numbers, std::size_t first) { return {numbers[first], numbers[first + 1]}; }

EffectResult point_of(Values n) { return std::make_unique<PointSpring>(vector_in(n), spring_in(n, 3)); }

EffectResult line_of(Values n) {
  const auto direction = direction_in(n, 3);
  if (!direction) return tl::unexpected(direction.error());
  return std::make_unique<LineSpring>(vector_in(n), *direction, spring_in(n, 6));
}

EffectResult plane_of(Values n) {
  const auto normal = direction_in(n, 3);
  if (!normal) return tl::unexpected(normal.error());
  return std::make_unique<PlaneSpring>(vector_in(n), *normal, spring_in(n, 6));
}

EffectResult viscous_of(Values n) { return std::make_unique<ViscousDamping>(n[0]); }

EffectResult friction_of(Values n) {
  if (n[0] < n[1]) return base::fail("STATIC friction must not be below DYNAMIC friction.");
  return std::make_unique<FrictionEffect>(FrictionSettings{n[0], n[1], n[2]});
}

EffectResult inertia_of(Values n) { return std::make_unique<Inertia>(n[0], n[1]); }

EffectResult well_of(Values n) {
  return std::make_unique<GravityWell>(vector_in(n), n[3], GravityWell::stiffness_of(n[3], n[4]));
}

EffectResult recess_of(Values n) {
  const auto axis = direction_in(n, 3);
  if (!axis) return tl::unexpected(axis.error());
  if (n[7] <= n[6]) return base::fail("RIM, the outer radius, must be larger than FLOOR, the inner one.");
  return std::make_unique<Recess>(RecessSettings{vector_in(n), *axis, n[6], n[7], n[8]});
}

EffectResult constant_of(Values n) { return std::make_unique<ConstantForce>(vector_in(n)); }

struct WrittenCurve {
  std::vector<Vector3> points;
  SpringSettings spring;
};

// "0,0,0;0.1,0,0;200,1": points, and at the end stiffness and damping where there are one or two numbers.
base::Result<WrittenCurve> read_curve(std::string_view text) {
  std::vector<std::string_view> groups = split_outside_parentheses(text, ';');
  SpringSettings spring = kUsualSpring;
  if (groups.size() > 1 && std::ranges::count(groups.back(), ',') < 2) {
    const auto feel = read_parameters(groups.back(), kCurveFeel);
    if (!feel) return base::fail("its last group: " + feel.error().message);
    spring = spring_in(*feel, 0);
    groups.pop_back();
  }
  if (groups.size() > kMostCurvePoints)
    return base::fail(fmt::format("it has {} points; {} are the most.", groups.size(), kMostCurvePoints));
  std::vector<Vector3> points;
  for (const std::string_view group : groups) {
    const auto point = read_parameters(group, kCurvePoint);
    if (!point) return base::fail(fmt::format("point {}: {}", points.size() + 1, point.error().message));
    points.push_back(vector_in(*point));
  }
  if (points.size() == 1)
    return base::fail("it has one point; a curve has at least two, and point:X,Y,Z draws to one.");
  return WrittenCurve{std::move(points), spring};
}

EffectResult curve_of(std::string_view text) {
  auto curve = read_curve(text);
  if (!curve) return tl::unexpected(curve.error());
  return std::make_unique<CurveSpring>(std::move(curve->points), curve->spring);
}

// "0,0,-0.5*sin(20*z)": three formulas in x, y, z (m) and t (s).
EffectResult field_of(std::string_view text) {
  const auto parts = split_outside_parentheses(text, ',');
  if (parts.size() != 3)
    return base::fail(fmt::format("it takes FX,FY,FZ: three formulas, not {}.", parts.size()));
  std::vector<geometry::Formula> formulas;
  std::size_t steps = 0;
  for (const std::string_view part : parts) {
    auto formula = geometry::Formula::parse(std::string(part));
    if (!formula)
      return base::fail(fmt::format("formula {}: {}", formulas.size() + 1, formula.error().message));
    formulas.push_back(std::move(*formula));
    steps += formulas.back().steps();
  }
  if (steps > kMostFieldSteps)
    return base::fail(fmt::format("its formulas take {} steps; {} are the most.", steps, kMostFieldSteps));
  return std::make_unique<ForceField>(
      [formulas = std::move(formulas)](const Vector3& position, double time) -> Vector3 {
        const Vector3 force(formulas[0].value(position, time), formulas[1].value(position, time),
                            formulas[2].value(position, time));
        if (!force.allFinite()) return Vector3::Zero();
        return force.cwiseMax(-kMostField).cwiseMin(kMostField);
      });
}

/// A kind of effect and its reader; effects that consist of numbers only are read by `parameters`.
struct EffectMaker {
  EffectKind kind;
  std::function<EffectResult(std::string_view)> make;
  std::span<const Parameter> parameters = {};  // of effects that consist of numbers only
};

EffectMaker of_numbers(std::string_view name, std::span<const Parameter> parameters,
                       EffectResult (*make)(Values), std::string_view summary, std::string_view example) {
  const auto read = [parameters, make](std::string_view text) -> EffectResult {
    const auto numbers = read_parameters(text, parameters);
    if (!numbers) return tl::unexpected(numbers.error());
    return make(*numbers);
  };
  return {{name, usage_of(parameters), ranges_of(parameters), summary, example}, read, parameters};
}

const std::vector<EffectMaker>& effect_makers() {
  static const std::vector<EffectMaker> kMakers = {
      of_numbers("point", kPoint, point_of, "a spring holds the tip at X,Y,Z", "point:0,0,0.06"),
      of_numbers("line", kLine, line_of,
                 "a spring holds it on the line through X,Y,Z along DX,DY,DZ, free along it",
                 "line:0,0,0.06,1,0,0,300"),
      of_numbers("plane", kPlane, plane_of,
                 "a spring holds it on the plane through X,Y,Z with normal NX,NY,NZ, free within it",
                 "plane:0,0,0.06,0,0,1"),
      {{"curve", "X,Y,Z;X,Y,Z;...[;STIFFNESS[,DAMPING]]",
        ranges_of(kCurvePoint) + ", " + ranges_of(kCurveFeel),
        "a spring holds it on the lines from point to point, free along them",
        "curve:0,0,0.06;0.05,0,0.06;0.05,0.05,0.06;300,2"},
       curve_of},
      of_numbers("viscous", kViscous, viscous_of, "syrup: a force against the velocity", "viscous:2"),
      of_numbers("friction", kFriction, friction_of,
                 "dry friction everywhere: it sticks up to STATIC, then slides against DYNAMIC",
                 "friction:0.5,0.4"),
      of_numbers("inertia", kInertia, inertia_of,
                 "the tip feels heavier by MASS, without weight; faster changes than CORNER are left out",
                 "inertia:0.2"),
      of_numbers("well", kWell, well_of,
                 "attracts within RADIUS of X,Y,Z, with FORCE where it pulls most (0.447 of the radius)",
                 "well:0,0,0.06,0.01,1.5"),
      of_numbers(
          "recess", kRecess, recess_of,
          "a round dent about the axis AX,AY,AZ: free within FLOOR, pushed inwards up to RIM, FORCE at most",
          "recess:0,0,0,0,0,1,0.008,0.012,1"),
      of_numbers("constant", kConstant, constant_of, "the same force everywhere, such as weight",
                 "constant:0,0,-0.5"),
      {{"field", "FX,FY,FZ", "FX, FY, FZ formulas in N of x, y, z (m) and t (s)",
        "a force that depends on place and time; where a formula has no value there is none",
        "field:-5*y,5*x,0.2*sin(6*t)"},
       field_of},
  };
  return kMakers;
}

/// The parts of a text before and after its colon.
std::pair<std::string_view, std::string_view> parts_of(std::string_view text) {
  const std::size_t colon = text.find(':');
  return {text.substr(0, colon), colon == std::string_view::npos ? "" : text.substr(colon + 1)};
}

/// The maker of this name; null if there is no such kind.
const EffectMaker* maker_named(std::string_view name) {
  const auto& makers = effect_makers();
  const auto maker = std::ranges::find(makers, name, [](const EffectMaker& it) { return it.kind.name; });
  return maker == makers.end() ? nullptr : &*maker;
}

}  // namespace

const std::vector<EffectKind>& effect_kinds() {
  static const std::vector<EffectKind> kKinds = [] {
    std::vector<EffectKind> kinds;
    for (const EffectMaker& maker : effect_makers()) kinds.push_back(maker.kind);
    return kinds;
  }();
  return kKinds;
}

EffectResult make_effect(std::string_view text) {
  const auto [name, numbers] = parts_of(text);
  if (const EffectMaker* maker = maker_named(name)) return maker->make(numbers);
  std::vector<std::string> names;
  for (const EffectMaker& it : effect_makers()) names.emplace_back(it.kind.name);
  return base::fail(unknown_name("effect", name, std::move(names)));
}

std::vector<EffectNumber> effect_numbers(std::string_view text) {
  const auto [name, said] = parts_of(text);
  const EffectMaker* maker = maker_named(name);
  if (maker == nullptr || !maker->make(said)) return {};
  std::vector<EffectNumber> numbers;
  const auto values = read_parameters(said, maker->parameters);
  for (std::size_t i = 0; i < maker->parameters.size(); ++i) {
    const Parameter& it = maker->parameters[i];
    numbers.push_back({it.name, it.unit, it.least, it.most, (*values)[i]});
  }
  return numbers;
}

std::vector<Vector3> curve_points(std::string_view text) {
  const auto [name, said] = parts_of(text);
  auto curve = read_curve(said);
  return name == "curve" && curve ? std::move(curve->points) : std::vector<Vector3>();
}

std::string effect_of_numbers(std::string_view kind, const std::vector<double>& numbers) {
  return fmt::format("{}:{}", kind, fmt::join(numbers, ","));
}

}  // namespace icome::haptics
