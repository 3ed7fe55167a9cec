#include "random_project.h"

#include <numbers>

namespace icome::animation {
namespace {

constexpr double kDegreeHere = std::numbers::pi / 180.0;

/// Draws the parts of changes for a project.
class ChangeMaker {
 public:
  ChangeMaker(const Project& project, base::Random& random) : project_(project), random_(random) {}

  ProjectChange change() {
    switch (random_.index(16)) {
      case 0:
        return PutLayer{LayerId{number()}, place(), {name(), one_in(2), one_in(4)}};
      case 1:
        return TakeLayer{layer()};
      case 2:
        return ChangeLayer{layer(), {name(), one_in(2), one_in(2)}};
      case 3:
        return MoveLayer{layer(), place()};
      case 4:
      case 5:
        return PutCell{layer(), place(), new_cell()};
      case 6:
        return TakeCell{cell()};
      case 7:
        return one_in(4) ? camera()
                         : ProjectChange(ChangeCell{cell(), {name(), pictures(), point(), state()}});
      case 8:
        return MoveCell{cell(), layer(), place()};
      case 9:
      case 10:
        return keys();
      case 11:
        return ChangeStage{{int(random_.index(3000)), 480, random_.uniform(0, 130), 50, {0, 1, 0}}};
      case 12:
        return one_in(2) ? ChangeSound{std::nullopt} : ChangeSound{Sound{"a \"b\".wav", -1.5, 0.25}};
      case 13: {
        const int frame = int(random_.index(20));
        return one_in(2) ? ChangeMark{frame, std::nullopt} : ChangeMark{frame, name()};
      }
      case 14:
        return one_in(2) ? ProjectChange(TakeConstraint{constraint()}) : new_constraint();
      default:
        return one_in(3) ? ProjectChange(SmoothHands{one_in(2)}) : mapping();
    }
  }

 private:
  bool one_in(std::uint64_t count) { return random_.index(count) == 0; }
  std::uint64_t number() { return one_in(8) ? random_.index(6) : project_.next_id; }
  std::size_t place() { return random_.index(4); }
  double angle() { return double(random_.index(720)) * kDegreeHere; }
  Vector2 point() { return {std::floor(random_.uniform(-99, 99)), random_.uniform(-99, 99)}; }
  std::string name() {
    static const std::vector<std::string> kNames = {
        "boat", "sea", "a \"quoted\" one", "b\\c", "\xc3\xa9t\xc3\xa9", "[x]", "7", "", "camera"};
    return kNames[random_.index(kNames.size())] + (one_in(2) ? std::to_string(random_.index(9)) : "");
  }
  std::vector<std::string> pictures() {
    std::vector<std::string> names;
    for (std::uint64_t i = random_.index(3); i > 0; --i) names.push_back("p" + std::to_string(i) + ".png");
    return names;
  }
  CellState state() {
    return {point(), angle(), random_.uniform(-2, 2), random_.uniform(), int(random_.index(2))};
  }
  LayerId layer() {
    if (project_.layers.empty() || one_in(9)) return LayerId{random_.index(9)};
    return project_.layers[random_.index(project_.layers.size())].id;
  }
  CellId cell() {
    std::vector<CellId> all = {kCamera, CellId{77777}};
    for (const Layer& layer : project_.layers)
      for (const Cell& cell : layer.cells) all.insert(all.end(), 4, cell.id);
    return all[random_.index(all.size())];
  }
  ConstraintId constraint() {
    if (project_.constraints.empty()) return ConstraintId{3};
    return project_.constraints[random_.index(project_.constraints.size())].id;
  }
  ProjectChange camera() {
    CellLook look = look_of(project_.camera);
    look.rest.place = point();
    look.rest.angle = angle();
    return ChangeCell{kCamera, look};
  }
  Track track(Channel channel) {
    Track keys;
    for (int frame = int(random_.index(5)); frame < 20; frame += 1 + int(random_.index(8))) {
      double value = random_.uniform();
      if (channel == Channel::Angle) value = angle();
      if (channel == Channel::Picture) value = double(random_.index(3)) - 1;
      keys.push_back({frame, value, Ease(random_.index(3))});
    }
    return keys;
  }
  Cell new_cell() {
    Cell cell = {CellId{number()}, name(), pictures(), point(), state(), {}};
    for (const Channel channel : kAllChannels)
      if (one_in(2)) cell.tracks[std::size_t(channel)] = track(channel);
    return cell;
  }
  ProjectChange keys() {
    const Channel channel = kAllChannels[random_.index(kChannels)];
    Track keys = track(channel);
    const int from = one_in(3) ? 2 : 0;
    return ChangeKeys{cell(), channel, from, 30 - int(random_.index(20)), keys};
  }
  ProjectChange new_constraint() {
    Constraint constraint = {ConstraintId{number()}, {}};
    switch (random_.index(5)) {
      case 0:
        constraint.what = DistanceLimit{cell(), cell(), point(), point(), 2, 1 + random_.uniform(0, 9)};
        break;
      case 1: {
        Joint joint = {cell(), cell(), point(), point(), std::nullopt};
        if (one_in(2)) joint.limits = AngleLimits{-angle(), angle()};
        constraint.what = joint;
        break;
      }
      case 2: {
        Chain chain = {{cell(), cell()}};
        for (const Constraint& other : project_.constraints)
          if (const auto* joint = std::get_if<Joint>(&other.what))
            chain.cells = {joint->parent, joint->child};
        constraint.what = chain;
        break;
      }
      case 3:
        constraint.what = PathGuide{cell(), point(), {point(), point()}, one_in(2), one_in(2)};
        break;
      default:
        constraint.what = AxisGuide{cell(), point(), point(), angle()};
    }
    return PutConstraint{random_.index(3), constraint};
  }
  ProjectChange mapping() {
    const std::string triangle = "t" + std::to_string(random_.index(4));
    if (one_in(3)) return ChangeMapping{triangle, std::nullopt};
    const auto mode = MappingMode(random_.index(3));
    const CellId moved = mode == MappingMode::Nearest && !one_in(5) ? CellId{} : cell();
    return ChangeMapping{triangle, Mapping{triangle, mode, moved}};
  }

  const Project& project_;
  base::Random& random_;
};

}  // namespace

ProjectChange random_change(const Project& project, base::Random& random) {
  return ChangeMaker(project, random).change();
}

Project random_project(base::Random& random, int changes) {
  Project project;
  for (int i = 0; i < changes; ++i) {
    ProjectEdit edit;
    edit.push_back(random_change(project, random));
    (void)apply_edit(project, edit);
  }
  return project;
}

}  // namespace icome::animation
