// Files made to break the process that parses VRML: each is answered or refused, in time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <thread>

#include "base/random.h"
#include "files/damage.h"
#include "files/sample_files.h"
#include "files/vrml_seen.h"
#include "io/file_bytes.h"
#include "places.h"

namespace icome::files {
namespace {

namespace fs = std::filesystem;

#ifdef ICOME_ADDRESS_SANITIZER
constexpr int kSlowness = 8;
#else
constexpr int kSlowness = 1;
#endif

DesignReadOptions bounds() { return {.memory_limit = 2ULL << 30U, .seconds_limit = 60.0 * kSlowness}; }

SeenAnswer answer_to(const std::string& text) { return ask_about(text, bounds()); }

void expect_refusal(const std::string& text, const std::string& why) {
  const std::string refusal = answer_to(text).refusal();
  EXPECT_NE(refusal.find(why), std::string::npos) << refusal;
}

void expect_note(const std::string& text, const std::string& note) {
  const SeenAnswer answer = answer_to(text);
  EXPECT_EQ(answer.refusal(), "");
  EXPECT_NE(answer.notes().find(note), std::string::npos) << answer.notes();
}

TEST(VrmlHostile, CountsThatNothingStandsBehind) {
  expect_note("Shape { geometry ElevationGrid { xDimension 1000000000 zDimension 1000000000 height [ 0 ] } }",
              "ElevationGrid: it is left out");
  expect_note("Shape { geometry ElevationGrid { xDimension -1 zDimension 2147483647 height [ 0 0 0 0 ] } }",
              "ElevationGrid: it is left out");
  expect_note("Shape { geometry Extrusion { crossSection [ " + repeated("1 0 ", 3000) + "] spine [ " +
                  repeated("0 0 0 ", 3000) + "] } }",
              "too many points");
  expect_note("Shape { geometry Text { string \"" + repeated("a", 20'000) + "\" } }", "too many letters");
}

TEST(VrmlHostile, NodesThatDoubleWithEachUse) {
  std::string text = "DEF A0 Group { children Shape { geometry Box {} } }\n";
  for (int i = 1; i <= 40; ++i)
    text += fmt::format("DEF A{0} Group {{ children [ USE A{1} USE A{1} ] }}\n", i, i - 1);
  expect_refusal(text, "holds more than 2000000 nodes");
}

TEST(VrmlHostile, NodesAndProtosThatHoldThemselves) {
  EXPECT_EQ(answer_to("PROTO A [] { Group { children A {} } } A {}").refusal(), "");
  EXPECT_EQ(answer_to("PROTO A [] { Group { children B {} } } PROTO B [] { A {} } B {}").refusal(), "");
  EXPECT_EQ(answer_to("DEF A Group { children USE A }").refusal(), "");
  expect_note("DEF A Group {} DEF A Group { children USE A }", "A node that holds itself");
}

TEST(VrmlHostile, NestingWithoutEnd) {
  expect_refusal(repeated("Group { children [ ", 1'000'000), "nests nodes more than 2000 deep");
  expect_refusal(repeated("Group { children ", 1'000'000), "nests nodes more than 2000 deep");
  expect_refusal(repeated("PROTO P [ field MFNode c [ ", 1'000'000), "nests nodes more than 2000 deep");
  const SeenAnswer deep = answer_to(repeated("Group { children [ ", 990) + repeated("] } ", 990));
  ASSERT_EQ(deep.refusal(), "");
  EXPECT_EQ(deep->nodes()->size(), 990U);
}

TEST(VrmlHostile, LongLinesAndWords) {
  const SeenAnswer line =
      answer_to("Shape { geometry IndexedFaceSet { coord Coordinate { point [ " +
                repeated("1 2 3,", 1'000'000 / kSlowness) + "] } coordIndex [ 0 1 2 -1 ] } }");
  EXPECT_EQ(line.refusal(), "");
  const std::string word = repeated("a", 10'000'000);
  const SeenAnswer name = answer_to("DEF " + word + " Group {} WorldInfo { title \"" + word + "\" }");
  ASSERT_EQ(name.refusal(), "");
  EXPECT_EQ(name->nodes()->Get(0)->def()->size(), word.size());
  expect_refusal("Group { " + word + " 3 }" + word + " {}", "has a word of more than 1000 letters");
}

TEST(VrmlHostile, NodesOfCoinThatAreNotOfVrml) {
  const SeenAnswer answer = answer_to(
      "Separator { File { name \"/etc/passwd\" } } SoFile { name \"/etc/passwd\" } libm {}\n"
      "Shape { geometry Box {} }");
  ASSERT_EQ(answer.refusal(), "");
  EXPECT_EQ(answer->nodes()->size(), 1U);
}

/// A file that has something of everything.
std::string sample() {
  return R"(WorldInfo { title "Sample" info [ "a" "b" ] }
PROTO Thing [ field SFColor c 1 0 0 field MFNode k [] exposedField SFVec3f t 0 0 0 eventIn SFBool on ] {
  Transform { translation IS t children [ Group { children IS k } Shape {
    appearance Appearance { material DEF M Material { diffuseColor IS c } } geometry Box {} } ] }
}
EXTERNPROTO Far [ field SFFloat size ] "urn:far"
DEF T Transform { rotation 0 1 0 1.57 scale 1 2 3 center 0 1 0 children [
  DEF S Shape { appearance Appearance { material Material { } texture PixelTexture { image 2 2 3 1 2 3 4 }
      textureTransform TextureTransform { scale 2 2 } }
    geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 1 1 0, 0 1 0, 0 0 1 ] }
      coordIndex [ 0 1 2 3 -1 0 1 4 -1 ] texCoord TextureCoordinate { point [ 0 0 1 0 1 1 0 1 ] }
      texCoordIndex [ 0 1 2 3 -1 0 1 2 -1 ] color Color { color [ 1 0 0 0 1 0 ] } colorPerVertex FALSE
      normal Normal { vector [ 0 0 1 0 1 0 ] } normalPerVertex FALSE normalIndex [ 0 1 ] creaseAngle 0.5 } }
  USE S Thing { c 0 1 0 t 1 2 3 k [ Shape { geometry Sphere { radius 2 } } ] } Far { size 2 } ] }
Shape { geometry Extrusion { crossSection [ 1 1 1 -1 -1 -1 -1 1 1 1 ] spine [ 0 0 0 0 1 0 1 2 0 ] scale [ 1 1 2 2 ]
  orientation [ 0 1 0 0.3 ] } }
Shape { geometry ElevationGrid { xDimension 3 zDimension 2 height [ 0 1 2 3 4 5 ] } }
Shape { geometry Text { string [ "Hello" ] fontStyle FontStyle { size 2 justify "MIDDLE" } length [ 3 ] } }
LOD { level [ Shape { geometry Cone { bottom FALSE } } Group {} ] range [ 10 ] }
Switch { whichChoice 0 choice [ Shape { geometry Cylinder { top FALSE } } ] }
Viewpoint { position 0 0 5 description "front" } SpotLight { beamWidth 0.3 } DirectionalLight { }
DEF TS TimeSensor { loop TRUE } DEF PI PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0 1 1 1 ] }
Script { field SFNode self USE TS url "javascript:" } Inline { url "nothere.wrl" }
ROUTE TS.fraction_changed TO PI.set_fraction
ROUTE PI.value_changed TO T.set_translation
)";
}

/// Has many texts answered by several workers at once; gives how many were read whole, and adds to `failures`
/// what processes died of.
int count_read(const std::vector<std::string>& texts, std::string& failures) {
  std::atomic<std::size_t> next = 0;
  std::atomic<int> read = 0;
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (std::size_t k = next++; k < texts.size(); k = next++) {
        const SeenAnswer answer = ask_about(texts[k], bounds());
        if (answer.refusal().empty()) ++read;
        if (answer.is_scene()) continue;
        const std::lock_guard lock(mutex);
        failures += fmt::format("{}: {}\n", k, answer.failure);
      }
    });
  for (std::thread& thread : threads) thread.join();
  return read;
}

TEST(VrmlHostile, FilesCutShort) {
  const std::string whole = sample();
  ASSERT_EQ(answer_to(whole).refusal(), "");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < 50; ++i) texts.push_back(whole.substr(0, whole.size() * i / 50));
  std::string failures;
  count_read(texts, failures);
  EXPECT_EQ(failures, "");
}

TEST(VrmlHostile, DamagedFilesNeverBringDownTheReader) {
  constexpr std::array<std::string_view, 16> kNasty = {
      "-1", "4294967295", "-2147483648", "1e308",  "nan",    "{",      "}",     "[",
      "]",  "\"",         "USE S ",      "DEF S ", " IS c ", "PROTO ", "NULL ", "\xff"};
  base::Random random(20240311);
  std::vector<std::string> texts;
  for (int i = 0; i < 240 / kSlowness; ++i) texts.push_back(damaged(sample(), kNasty, random));
  std::string failures;
  const int read = count_read(texts, failures);
  EXPECT_GT(read, 60 / kSlowness);
  // Coin itself may die of a file: that is told, and costs nothing but the file.
  const auto crashes = std::count(failures.begin(), failures.end(), '\n');
  EXPECT_LT(crashes, 5) << failures;
}

TEST(VrmlHostile, WrongNumbersInSharedFiles) {
  const fs::path folder = places::shared_data() / "vrml";
  if (!fs::exists(folder)) GTEST_SKIP() << "shared VRML files are not here";
  base::Random random(7);
  std::vector<std::string> texts;
  for (const char* name :
       {"xj3d/geometry/ifs-concave.wrl", "castle/vrml_2/extrusion_concave_cap.wrl",
        "xj3d/geometry/ElevationGrid-Color-CPF.wrl", "choreonoid/tire.wrl", "openhrp3/PA10/hand.wrl"}) {
    const auto bytes = io::read_bytes(folder / name, 1U << 30U);
    ASSERT_TRUE(bytes);
    for (int i = 0; i < 20 / kSlowness; ++i) {
      std::string text = *bytes;
      for (int k = 0; k < 5; ++k) {
        const std::size_t at = text.find_first_of("0123456789", random.index(text.size()));
        if (at != std::string::npos)
          text.replace(at, 1, std::array{"-7", "99999", "1e9", "0"}[random.index(4)]);
      }
      texts.push_back(text);
    }
  }
  std::string failures;
  count_read(texts, failures);
  EXPECT_EQ(failures, "");
}

}  // namespace
}  // namespace icome::files
