#include "animation/files/project_text.h"

#include <gtest/gtest.h>

#include "animation/random_project.h"

namespace icome::animation {
namespace {

std::string complaint_about(const std::string& text) {
  const auto read = read_project("cutout = 1\n" + text, "boat.cutout");
  return read ? "" : read.error().message;
}

TEST(ProjectText, ReadsBackWhatItWrote) {
  base::Random random(3);
  for (int i = 0; i < 60; ++i) {
    Project project = random_project(random, 300);
    const std::string text = project_text(project);
    auto read = read_project(text, "a");
    ASSERT_TRUE(read) << read.error().message << "\n" << text;
    read->next_id = project.next_id;  // numbers of what is gone are free in a file
    ASSERT_EQ(*read, project) << text;
    EXPECT_EQ(project_text(*read), text);
  }
}

TEST(ProjectText, ReadsBackEveryEdit) {
  base::Random random(4);
  Project project;
  for (int i = 0; i < 3000; ++i) {
    const ProjectChange change = random_change(project, random);
    Project once = project, again = project;
    if (!apply_edit(once, {change})) continue;
    const std::string line = edit_text({change, change});
    ASSERT_EQ(line.find('\n'), std::string::npos) << line;
    const auto read = read_edit(line, "line");
    ASSERT_TRUE(read) << read.error().message << "\n" << line;
    ASSERT_EQ(read->size(), 2U);
    ASSERT_TRUE(apply_edit(again, {read->front()})) << line;
    ASSERT_EQ(once, again) << line;
    project = once;
  }
}

TEST(ProjectText, IsWrittenByHandEasily) {
  const auto project = read_project(R"(cutout = 1
[stage]
width = 640
height = 480
rate = 12
background = "skyblue"

[[layer]]
id = 2
name = "sea"

[[layer.cell]]
id = 3
name = "boat"
pictures = ["boat.png"]
x = 320
angle = 90
keys.y = [[0, 240], [11, 260, "eased"]]
)",
                                    "a");
  ASSERT_TRUE(project) << project.error().message;
  const Cell* boat = project->find("boat");
  ASSERT_NE(boat, nullptr);
  EXPECT_EQ(project->stage.rate, 12);
  EXPECT_EQ(project->camera.rest.place, Vector2(320, 240));
  EXPECT_DOUBLE_EQ(state_at(*boat, 5.5).place.y(), 250);
  EXPECT_NEAR(boat->rest.angle, 1.5707963267948966, 1e-15);
}

TEST(ProjectText, TellsWhereItIsWrong) {
  EXPECT_EQ(
      complaint_about("[[layer]]\nid = 2\nname = \"a\"\n[[layer.cell]]\nid = 3\nname = \"x\"\nscal = 2\n"),
      "boat.cutout:8:1: cell: there is no key 'scal'; did you mean 'scale'?");
  EXPECT_EQ(complaint_about("[[layer]]\nid = 2\nname = \"a\"\n\n[[layer]]\nid = 2\nname = \"b\"\n"),
            "boat.cutout:6:1: the number 2 is taken already, or no number.");
  EXPECT_EQ(complaint_about("[[layer]]\nid = 2\nname = \"a\"\n[[layer.cell]]\nid = 3\nname = \"x\"\n"
                            "keys.x = [[4, 1], [2, 5]]\n"),
            "boat.cutout:8:19: keys: frame 2 does not come after frame 4.");
  EXPECT_EQ(
      complaint_about("[[constraint]]\nid = 2\nkind = \"path\"\ncell = \"boat\"\nway = [[0,0],[1,0]]\n"),
      "boat.cutout:5:8: cell: there is no cell 'boat'.");
  EXPECT_EQ(read_project("cutout = 9\n", "a").error().message,
            "a:1:10: the file was written by a later version of ICOME.");
  EXPECT_NE(read_project("", "a").error().message.find("cutout is missing"), std::string::npos);
  EXPECT_NE(complaint_about("[stage\n"), "");
  EXPECT_NE(complaint_about("[stage]\nwidth = nan\n"), "");
  EXPECT_NE(complaint_about("marks = [[0, \"a\"], [1]]\n"), "");
}

TEST(ProjectText, NeverFallsOverMutatedBytes) {
  base::Random random(5);
  std::size_t read = 0;
  for (int i = 0; i < 1500; ++i) {
    const Project project = random_project(random, 60);
    std::string text = i % 2 == 0 ? project_text(project) : edit_text({ChangeStage{}, SmoothHands{true}});
    for (std::uint64_t changes = 1 + random.index(4); changes > 0; --changes)
      text[random.index(text.size())] = char(random.index(256));
    if (random.index(4) == 0) text.resize(random.index(text.size()));
    read += read_project(text, "a").has_value();
    (void)read_edit(text, "a");
  }
  EXPECT_GT(read, 0U);
}

}  // namespace
}  // namespace icome::animation
