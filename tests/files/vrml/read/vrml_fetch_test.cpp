// What the process that parses VRML gets of other files, and what it does not.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "files/vrml/read/vrml_header.h"
#include "files/vrml_seen.h"

namespace icome::files {
namespace {

namespace fs = std::filesystem;

constexpr const char* kHeader = "#VRML V2.0 utf8\n";

class VrmlFetch : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_ / "design/parts"); }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  SeenAnswer ask(const std::string& text, const DesignReadOptions& options = {}) const {
    const auto answer = ask_vrml_worker(kHeader + text, folder_ / "design/main.wrl", options);
    if (answer) files_ = answer->files;
    return SeenAnswer(answer);
  }
  /// The notes on a file that has one Inline.
  std::string notes_on(const std::string& url, const DesignReadOptions& options = {}) const {
    return ask("Inline { url " + url + " }", options).notes();
  }

  const fs::path folder_ = fs::path(testing::TempDir()) /
                           fmt::format("vrml_fetch_{}_{}", ::getpid(),
                                       testing::UnitTest::GetInstance()->current_test_info()->name());
  mutable std::vector<fs::path> files_ = {};
};

TEST_F(VrmlFetch, InlinesAFileAsChildrenWithItsOwnUrls) {
  write("design/parts/arm.wrl", std::string(kHeader) +
                                    "DEF Arm Group { children Inline { url \"hand.wrl\" } }\n"
                                    "Shape { appearance Appearance { texture ImageTexture { "
                                    "url \"skin.png\" } } geometry Box {} }");
  // Parts without a header are common.
  write("design/parts/hand.wrl", "# only a part\nDEF Hand Shape { geometry Sphere {} }");
  const SeenAnswer answer = ask("DEF Robot Inline { url [ \"nothere.wrl\" \"parts/arm.wrl\" ] }");
  ASSERT_EQ(answer.refusal(), "");
  EXPECT_EQ(answer.notes(), "");
  ASSERT_EQ(answer->nodes()->size(), 5U);
  EXPECT_EQ(answer->nodes()->Get(0)->def()->str(), "Robot");
  EXPECT_EQ(answer->nodes()->Get(1)->def()->str(), "Arm");
  EXPECT_EQ(answer->nodes()->Get(1)->parent(), 0);
  EXPECT_EQ(answer->nodes()->Get(3)->def()->str(), "Hand");
  EXPECT_EQ(answer->nodes()->Get(3)->parent(), 2);
  EXPECT_EQ(answer->pictures()->Get(0)->base()->str(), fs::canonical(folder_ / "design/parts/arm.wrl"));
  ASSERT_EQ(files_.size(), 3U);
  EXPECT_EQ(files_[2], fs::canonical(folder_ / "design/parts/hand.wrl"));
}

TEST_F(VrmlFetch, SharesTheShapesOfAFileThatIsInlinedTwice) {
  write("design/wheel.wrl", std::string(kHeader) + "DEF W Shape { geometry Sphere {} } USE W");
  const SeenAnswer answer = ask("Inline { url \"wheel.wrl\" } Inline { url \"./wheel.wrl\" }");
  ASSERT_EQ(answer->nodes()->size(), 6U);
  EXPECT_EQ(answer->geometries()->size(), 1U);
  EXPECT_EQ(files_.size(), 2U);
  for (const flatbuffers::uoffset_t i : {1U, 2U, 4U, 5U})
    EXPECT_EQ(answer->nodes()->Get(i)->reused(), i == 2 || i == 5) << i;
}

TEST_F(VrmlFetch, TakesExternprotosByName) {
  write("design/protos.wrl", std::string(kHeader) +
                                 "PROTO Other [] { Group {} }\n"
                                 "PROTO Ball [ field SFFloat size 1 field MFString skin [] ] { Shape {\n"
                                 "  appearance Appearance { texture ImageTexture { url IS skin } }\n"
                                 "  geometry Sphere { radius IS size } } }");
  const SeenAnswer answer =
      ask("EXTERNPROTO Ball [ field SFFloat size field MFString skin ] \"protos.wrl#Ball\"\n"
          "DEF B Ball { size 2.5 skin \"own.png\" }");
  ASSERT_EQ(answer.refusal(), "");
  EXPECT_EQ(answer.notes(), "");
  EXPECT_EQ(answer->nodes()->Get(0)->def()->str(), "B");
  EXPECT_EQ(answer->geometries()->Get(0)->sizes()->Get(0), 2.5);
  // What the instance says stands in the design.
  EXPECT_EQ(answer->pictures()->Get(0)->base()->str(), fs::canonical(folder_ / "design") / "main.wrl");
}

TEST_F(VrmlFetch, ReadsOnWhereAnExternprotoIsNotToBeHad) {
  const SeenAnswer answer =
      ask("EXTERNPROTO Far [ field SFFloat size exposedField MFNode children eventIn SFBool on ]\n"
          "  [ \"urn:inet:far\" \"http://far/far.wrl\" ]\n"
          "Far { size 2 children [ Group {} ] } Shape { geometry Box {} }");
  ASSERT_EQ(answer.refusal(), "");
  EXPECT_NE(answer.notes().find("EXTERNPROTO: 'urn:inet:far' is not fetched"), std::string::npos);
  EXPECT_EQ(answer->geometries()->size(), 1U);
}

TEST_F(VrmlFetch, FollowsNoCircle) {
  write("design/a.wrl", std::string(kHeader) + "Inline { url \"b.wrl\" } Shape { geometry Box {} }");
  write("design/b.wrl", std::string(kHeader) + "Inline { url \"a.wrl\" } Shape { geometry Sphere {} }");
  SeenAnswer answer = ask("Inline { url \"a.wrl\" }");
  EXPECT_EQ(answer->geometries()->size(), 2U);
  EXPECT_NE(answer.notes().find("b.wrl:0: An Inline of the file that it is in"), std::string::npos)
      << answer.notes();
  write("design/main.wrl", "");  // the circle is seen by the name
  EXPECT_NE(notes_on("\"main.wrl\"").find("An Inline of the file that it is in"), std::string::npos);
  write("design/c.wrl", std::string(kHeader) + "EXTERNPROTO X [] \"c.wrl\" X {} Shape { geometry Box {} }");
  answer = ask("Inline { url \"c.wrl\" }");
  EXPECT_EQ(answer->geometries()->size(), 1U);
  EXPECT_NE(answer.notes().find("leads back to a file that asks for it"), std::string::npos)
      << answer.notes();
}

TEST_F(VrmlFetch, BoundsHowFarAndHowManyFilesAre) {
  for (int i = 0; i < 30; ++i)
    write(fmt::format("design/{}.wrl", i), fmt::format("{}Inline {{ url \"{}.wrl\" }}", kHeader, i + 1));
  const SeenAnswer deep = ask("Inline { url \"0.wrl\" }");
  EXPECT_EQ(files_.size(), 17U);
  EXPECT_NE(deep.notes().find("more than 16 files away"), std::string::npos) << deep.notes();
  std::string many;
  for (int i = 0; i < 1010; ++i) many += fmt::format("Inline {{ url \"nothere{}.wrl\" }}\n", i);
  EXPECT_NE(ask(many).notes().find("only 1000 urls of a design are followed"), std::string::npos);
  write("design/large.wrl", kHeader + std::string(10'000, ' '));
  EXPECT_NE(ask("Inline { url \"large.wrl\" }", {.size_limit = 5000}).notes().find("larger than the limit"),
            std::string::npos);
}

TEST_F(VrmlFetch, GivesNothingAwayThatIsNotTheDesigns) {
  EXPECT_NE(notes_on("\"/etc/passwd\"").find("names a place on this machine"), std::string::npos);
  const std::string passwd = "\"../../../../../../../../../../etc/passwd\"";
  const DesignReadOptions anywhere{.follows_urls_above = true};
  const std::string climbing = notes_on(passwd, anywhere);
  EXPECT_NE(notes_on(passwd).find("it leads above the folder of the design"), std::string::npos);
  EXPECT_NE(climbing.find("passwd is not fetched: it is not VRML 2.0"), std::string::npos) << climbing;
  EXPECT_EQ(climbing.find("root"), std::string::npos);
  EXPECT_NE(notes_on("\"http://example.org/a.wrl\"").find("only files that came with the design"),
            std::string::npos);
  EXPECT_NE(notes_on("\"parts\"").find("there is no such file"), std::string::npos);
  // A part without a header may lie only where the design does.
  write("part.wrl", "Shape { geometry Box {} }");
  write("whole.wrl", std::string(kHeader) + "Shape { geometry Box {} }");
  write("design/text.wrl", "key { secret }");
  EXPECT_NE(notes_on("\"../part.wrl\"", anywhere).find("is not VRML 2.0"), std::string::npos);
  EXPECT_NE(notes_on("\"text.wrl\"").find("is not VRML 2.0"), std::string::npos);
  fs::create_symlink("../part.wrl", folder_ / "design/link.wrl");
  EXPECT_NE(notes_on("\"link.wrl\"", anywhere).find("is not VRML 2.0"), std::string::npos);
  EXPECT_NE(notes_on("\"link.wrl\"").find("it leads above"), std::string::npos);
  EXPECT_EQ(notes_on("\"../whole.wrl\"", anywhere), "");
  EXPECT_NE(notes_on("\"../whole.wrl\"").find("it leads above"), std::string::npos);
}

TEST(VrmlHeader, IsFoundAlsoBehindAByteOrderMark) {
  EXPECT_EQ(find_vrml_header("#VRML V2.0 utf8\n").value(), 0U);
  EXPECT_EQ(find_vrml_header("#VRML V2.0 utf8 by me\r\n").value(), 0U);
  EXPECT_EQ(find_vrml_header("\xef\xbb\xbf#VRML V2.0 utf8").value(), 3U);
  for (const char* text : {"", "\xef\xbb\xbf", "#VRML V1.0 ascii\n", "#VRML V2.0", "#VRML V2.0 utf82\n",
                           " #VRML V2.0 utf8\n", "#X3D V3.0 utf8\n", "\x01\x02"})
    EXPECT_FALSE(find_vrml_header(text)) << text;
  EXPECT_EQ(find_vrml_header("solid\tpart\n").error().message,
            "is not VRML 2.0: it begins with 'solid?part' and not with '#VRML V2.0 utf8'");
}

TEST(VrmlHeader, PartsBeginLikeVrml) {
  for (const char* text : {"Shape { }", "# note\n\n DEF x Group {}", "PROTO P [] {}", "Group # note\n{ ",
                           "\xef\xbb\xbf"
                           "EXTERNPROTO P [] \"u\""})
    EXPECT_TRUE(begins_like_vrml(text)) << text;
  for (const char* text :
       {"", "DEF", "# only", "root:x:0:0:", "Group", "Group [", "server {", "{", "Shapes {"})
    EXPECT_FALSE(begins_like_vrml(text)) << text;
}

}  // namespace
}  // namespace icome::files
