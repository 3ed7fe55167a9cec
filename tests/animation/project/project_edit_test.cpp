#include "animation/project/project_edit.h"

#include <gtest/gtest.h>

#include <set>

#include "animation/random_project.h"
#include "base/edit_history.h"

namespace icome::animation {
namespace {

/// A project with layers "back" (2) and "front" (3), and cells "sea" (4), "boat" (5) and "mast" (6).
Project harbour() {
  Project project;
  Cell sea, boat, mast;
  sea.id = CellId{4}, sea.name = "sea";
  boat.id = CellId{5}, boat.name = "boat";
  mast.id = CellId{6}, mast.name = "mast";
  EXPECT_TRUE(apply_edit(
      project, {PutLayer{LayerId{2}, 0, {.name = "back"}}, PutLayer{LayerId{3}, 1, {.name = "front"}},
                PutCell{LayerId{2}, 0, sea}, PutCell{LayerId{3}, 0, boat}, PutCell{LayerId{3}, 1, mast}}));
  return project;
}

CellLook named(const char* name) {
  CellLook look;
  look.name = name;
  return look;
}

std::string refusal_of(const ProjectChange& change, const Project& start = harbour()) {
  Project project = start;
  const auto done = apply_edit(project, {change});
  EXPECT_EQ(project, start);
  return done ? "" : done.error().message;
}

/// Expects of a project what all must be, looked at without the code of edits.
void expect_sound(const Project& project) {
  std::set<std::uint64_t> numbers = {1};
  std::set<std::string> names = {"camera"};
  for (const Layer& layer : project.layers) {
    EXPECT_TRUE(numbers.insert(layer.id.value).second);
    for (const Cell& cell : layer.cells) {
      EXPECT_TRUE(numbers.insert(cell.id.value).second);
      EXPECT_TRUE(names.insert(cell.name).second) << cell.name;
      for (const Track& track : cell.tracks)
        for (std::size_t i = 1; i < track.size(); ++i) EXPECT_LT(track[i - 1].frame, track[i].frame);
    }
  }
  for (const Constraint& constraint : project.constraints) {
    EXPECT_TRUE(numbers.insert(constraint.id.value).second);
    for (const CellId cell : cells_of(constraint)) EXPECT_NE(project.find(cell), nullptr);
  }
  for (const Mapping& mapping : project.mappings)
    EXPECT_TRUE(!mapping.cell || project.find(mapping.cell) != nullptr);
  EXPECT_LT(*numbers.rbegin(), project.next_id);
}

TEST(ProjectEdit, TakesEveryRandomChangeBack) {
  base::Random random(7);
  Project project;
  std::vector<Project> before;
  std::vector<ProjectEdit> back;
  std::set<std::size_t> kinds;
  for (int i = 0; i < 4000; ++i) {
    const Project start = project;
    const ProjectChange change = random_change(project, random);
    const auto undone = apply_edit(project, {change});
    if (!undone) {
      ASSERT_EQ(project, start);
      continue;
    }
    kinds.insert(change.index());
    before.push_back(start);
    back.push_back(*undone);
  }
  EXPECT_EQ(kinds.size(), std::variant_size_v<ProjectChange>);
  expect_sound(project);
  while (!back.empty()) {
    ASSERT_TRUE(apply_edit(project, back.back()));
    project.next_id = before.back().next_id;  // numbers are not given again
    ASSERT_EQ(project, before.back());
    back.pop_back();
    before.pop_back();
  }
}

TEST(ProjectEdit, DoesAllPartsOrNone) {
  const Project start = harbour();
  Project project = start;
  EXPECT_FALSE(apply_edit(project, {ChangeLayer{LayerId{2}, {.name = "sky"}}, TakeLayer{LayerId{3}}}));
  EXPECT_EQ(project, start);
}

TEST(ProjectEdit, SaysWhyItRefuses) {
  EXPECT_EQ(refusal_of(TakeLayer{LayerId{3}}), "layer 'front' has cells");
  EXPECT_EQ(refusal_of(PutLayer{LayerId{4}, 0, {.name = "x"}}),
            "the number 4 is taken already, or no number");
  EXPECT_EQ(refusal_of(ChangeLayer{LayerId{2}, {.name = "front"}}), "there is a layer 'front' already");
  EXPECT_EQ(refusal_of(ChangeCell{CellId{5}, named("sea")}), "there is a cell 'sea' already");
  EXPECT_EQ(refusal_of(ChangeCell{CellId{5}, named("camera")}), "there is a cell 'camera' already");
  EXPECT_EQ(refusal_of(ChangeCell{kCamera, named("eye")}),
            "the camera keeps its name, and has a place, an angle and a scale only");
  EXPECT_EQ(refusal_of(MoveCell{CellId{5}, LayerId{3}, 2}),
            "there are 1 other cells in that layer, so there is no place 2");
  EXPECT_EQ(refusal_of(ChangeKeys{CellId{5}, Channel::X, 0, 9, {{3, 1}, {3, 2}}}),
            "frame 3 does not come after frame 3");
  EXPECT_EQ(refusal_of(ChangeKeys{CellId{5}, Channel::X, 4, 9, {{3, 1}}}),
            "a key lies outside of the frames 4 to 9");
  EXPECT_EQ(refusal_of(ChangeKeys{CellId{5}, Channel::Opacity, 0, 9, {{3, 1.5}}}),
            "at frame 3, an opacity is 0 to 1");
  EXPECT_EQ(refusal_of(ChangeKeys{CellId{5}, Channel::X, 0, 9, {{3, std::nan("")}}}),
            "at frame 3, a value is not finite");
  EXPECT_EQ(refusal_of(ChangeKeys{CellId{5}, Channel::Picture, 0, 9, {{3, 2}}}),
            "at frame 3, a picture is a whole number from 0 to 0 (-1: none), not 2");
  EXPECT_EQ(refusal_of(ChangeStage{{1, 5}}), "a stage is 2 to 8192 px wide and high, not 1");
  EXPECT_EQ(refusal_of(ChangeMapping{"t1", Mapping{"t1", MappingMode::Absolute, CellId{99}}}),
            "there is no cell 99");
}

TEST(ProjectEdit, KeepsJointsWithoutRingsAndChainsJoined) {
  Project project = harbour();
  const auto joint = [](std::uint64_t id, std::uint64_t parent, std::uint64_t child) {
    return PutConstraint{0, {ConstraintId{id}, Joint{CellId{parent}, CellId{child}}}};
  };
  ASSERT_TRUE(apply_edit(project, {joint(10, 4, 5), joint(11, 5, 6)}));
  EXPECT_EQ(refusal_of(joint(12, 6, 4), project), "'sea' would hang on itself");
  EXPECT_EQ(refusal_of(joint(12, 4, 6), project), "'mast' hangs on another cell already");
  EXPECT_EQ(refusal_of(joint(12, 4, 1), project), "the camera takes no part in constraints");
  const auto chain = [](std::vector<CellId> cells) {
    return PutConstraint{0, {ConstraintId{20}, Chain{std::move(cells)}}};
  };
  EXPECT_EQ(refusal_of(chain({CellId{4}, CellId{6}}), project),
            "'mast' is not joined to 'sea', the one before it in the chain");
  ASSERT_TRUE(apply_edit(project, {chain({CellId{4}, CellId{5}, CellId{6}})}));
  EXPECT_EQ(refusal_of(TakeConstraint{ConstraintId{11}}, project),
            "the chain from 'sea' to 'mast' needs this joint");
  EXPECT_EQ(refusal_of(TakeCell{CellId{6}}, project), "a constraint needs the cell 'mast'");
}

TEST(ProjectEdit, IsHeardByASinkThatMayRefuseIt) {
  base::EditHistory<Project, ProjectEdit> history(harbour());
  std::size_t heard = 0;
  history.set_sink([&](const ProjectEdit&) -> base::Result<void> {
    if (++heard == 2) return base::fail("full");
    return {};
  });
  EXPECT_TRUE(history.perform({ChangeStage{{100, 50}}}));
  const Project after = history.value();
  EXPECT_EQ(history.perform({SmoothHands{true}}).error().message, "full");
  EXPECT_EQ(history.value(), after);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.value(), harbour());
}

TEST(ProjectEdit, AllThatIsDoneTogetherIsOneStep) {
  base::EditHistory<Project, ProjectEdit> history(harbour());
  EXPECT_TRUE(history.perform({SmoothHands{true}}));
  const Project before = history.value();
  history.as_one_step([&] {
    EXPECT_TRUE(history.perform({ChangeStage{{100, 50}}}));
    EXPECT_FALSE(history.perform({TakeCell{CellId{99}}}));
    EXPECT_TRUE(history.perform({ChangeStage{{300, 200}}}));
    EXPECT_TRUE(history.perform({SmoothHands{false}}));
  });
  history.as_one_step([] {});
  const Project after = history.value();
  EXPECT_EQ(after.stage.width, 300);
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.value(), before);
  EXPECT_TRUE(history.redo());
  EXPECT_EQ(history.value(), after);
  EXPECT_TRUE(history.undo());
  EXPECT_TRUE(history.undo());
  EXPECT_EQ(history.value(), harbour());
  EXPECT_FALSE(history.can_undo());
}

}  // namespace
}  // namespace icome::animation
