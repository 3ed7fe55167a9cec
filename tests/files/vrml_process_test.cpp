#include "files/vrml_process.h"

#include <gtest/gtest.h>

#include "files/file_bytes.h"
#include "vrml_seen.h"

namespace icome::files {
namespace {

namespace fs = std::filesystem;

TEST(VrmlProcess, TellsTheSceneOfAFile) {
  const SeenAnswer answer = ask_about(
      "Transform { translation 0.1 0 -2.5 children [\n"
      "  DEF Ball Shape { appearance Appearance { material DEF Red Material { diffuseColor 1 0 0 } }\n"
      "    geometry Sphere { radius 0.3 } }\n"
      "  USE Ball ] }");
  ASSERT_EQ(answer.refusal(), "");
  EXPECT_EQ(answer.notes(), "");
  ASSERT_EQ(answer->nodes()->size(), 3U);
  EXPECT_EQ(answer->pieces()->size(), 1U);
  EXPECT_EQ(answer->looks()->size(), 1U);
  const flat::Node* ball = answer->nodes()->Get(1);
  EXPECT_EQ(ball->def()->str(), "Ball");
  EXPECT_EQ(ball->parent(), 0);
  EXPECT_FALSE(ball->reused());
  EXPECT_TRUE(answer->nodes()->Get(2)->reused());
  EXPECT_EQ(answer->nodes()->Get(0)->matrix()->Get(3), 0.1);
  EXPECT_EQ(answer->pieces()->Get(0)->sizes()->Get(0), 0.3);
  EXPECT_EQ(answer->looks()->Get(0)->name()->str(), "Red");
}

TEST(VrmlProcess, AnswersEverySharedFileOrSaysWhyNot) {
  const fs::path folder = fs::path(ICOME_SHARED_DATA) / "vrml";
  if (!fs::exists(folder)) GTEST_SKIP() << "shared VRML files are not here";
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto ending = entry.path().extension();
    if (ending != ".wrl" && ending != ".vrml") continue;
    const auto bytes = read_bytes(entry.path(), 1U << 30U);
    ASSERT_TRUE(bytes) << entry.path();
    const SeenAnswer answer(ask_vrml_worker(*bytes, entry.path()));
    ASSERT_TRUE(answer.is_scene()) << entry.path() << ": " << answer.failure;
    if (answer.refusal().empty()) ++read;
    const bool may_be_refused = entry.path().string().find("/malformed/") != std::string::npos ||
                                entry.path().filename() == "face.vrml";
    EXPECT_TRUE(answer.refusal().empty() || may_be_refused) << entry.path() << " " << answer.refusal();
  }
  EXPECT_GT(read, 130);
}

}  // namespace
}  // namespace icome::files
