#include "files/vrml/read/vrml_scanner.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace icome::files {
namespace {

constexpr const char* kScannedHeader = "#VRML V2.0 utf8\n";

VrmlLeftOut scanned(const std::string& body) {
  auto result = scan_vrml(kScannedHeader + body, "test.wrl");
  EXPECT_TRUE(result.has_value()) << result.error().message;
  return result ? *result : VrmlLeftOut{};
}

std::vector<std::string> sentences_of(const std::string& body) {
  std::vector<std::string> result;
  for (const Remark& remark : scanned(body).remarks)
    result.push_back(fmt::format("{}:{}", remark.line, remark.text));
  return result;
}

using Sentences = std::vector<std::string>;

std::string refusal(const std::string& text) {
  const auto result = scan_vrml(text, "test.wrl");
  return result ? "none" : result.error().message;
}

TEST(VrmlScanner, TakesTheHeaderWithAMarkACommentAndAnyLineEnd) {
  for (const char* text : {"#VRML V2.0 utf8", "#VRML V2.0 utf8\n", "#VRML V2.0 utf8\r\n", "#VRML V2.0 utf8\r",
                           "#VRML V2.0 utf8 CosmoWorlds V1.0\n", "\xEF\xBB\xBF#VRML V2.0 utf8\n"})
    EXPECT_EQ(refusal(text), "none") << text;
}

TEST(VrmlScanner, RefusesOtherHeadersExceptInParts) {
  for (const char* text : {"", "#VRML 2.0 utf8\n", "#VRML V2.0\n", "#VRML V2.0 utf8x\n", "#X3D V3.0 utf8\n",
                           "Group {}", "#VRML V1.0 ascii\n"})
    EXPECT_TRUE(refusal(text).starts_with("test.wrl: is ")) << text;
  EXPECT_NE(refusal("#VRML V1.0 ascii\n").find("is VRML 1.0"), std::string::npos);
  EXPECT_TRUE(scan_vrml("Group {}", "part.wrl", "part.wrl").has_value());
}

TEST(VrmlScanner, CountsWhatIsLeftOutWithItsLines) {
  EXPECT_EQ(sentences_of("TouchSensor {}"), Sentences{"2:A TouchSensor is left out."});
  EXPECT_EQ(
      sentences_of("Group { children [\nFog{} TouchSensor {}\n\nDEF t TouchSensor\n{}\nTouchSensor{}]}"),
      (Sentences{"3:A Fog is left out.", "3:3 TouchSensors are left out, at lines 3, 6 and 7."}));
  std::string many;
  for (int i = 0; i < 20; ++i) many += "Sound {}\n";
  EXPECT_EQ(sentences_of(many),
            Sentences{"2:20 Sounds are left out, at lines 2, 3, 4, 5, 6, 7, 8, 9 and others."});
}

TEST(VrmlScanner, SaysWhatIsTakenOtherwise) {
  EXPECT_EQ(sentences_of("Anchor {}\nBillboard {}\nBillboard {}\nLOD { level [] }"),
            (Sentences{"2:An Anchor is taken as a plain Group.",
                       "3:2 Billboards are taken as plain Groups, at lines 3 and 4.",
                       "5:An LOD is taken at the finest level."}));
}

TEST(VrmlScanner, SaysNothingOfWhatIsTaken) {
  EXPECT_EQ(
      sentences_of("Transform { children [ Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 "
                   "0, 1 -2.5e-3 .5 ] } } appearance Appearance { material Material {} } } ] } "
                   "WorldInfo { title \"x\" } Viewpoint {} PointLight {}"),
      Sentences{});
}

TEST(VrmlScanner, CountsRoutesOnce) {
  EXPECT_EQ(sentences_of("ROUTE a.b TO c.d"), Sentences{"2:A ROUTE is left out."});
  EXPECT_EQ(sentences_of("\nROUTE a.b TO c.d ROUTE a.b TO c.e\nROUTE a.b TO c.f"),
            Sentences{"3:3 ROUTEs are left out, the first at line 3."});
}

TEST(VrmlScanner, LooksPastCommentsStringsAndFields) {
  EXPECT_EQ(sentences_of("# TouchSensor {}\n"
                         "WorldInfo { title \"Fog { # \\\" Sound {}\" info \"\\\\\" }\n"
                         "DEF Fog Transform { } Transform { children [ USE Fog ] } # Sound {\n"
                         "Shape { geometry IndexedFaceSet { title [\"a\" \"TouchSensor {\"] } }"),
            Sentences{});
}

TEST(VrmlScanner, KnowsPrototypesButNotOthers) {
  EXPECT_EQ(
      sentences_of("PROTO Wheel [ field SFNode tyre Sphere {} eventIn SFBool Fog ] { Group {} }\n"
                   "EXTERNPROTO Lamp [ field SFBool on ] [ \"lamp.wrl\" ]\n"
                   "Wheel {} Lamp {} Gear {}\nGear { } Screw {}"),
      (Sentences{
          "4:'Gear' is 2 times left out, at lines 4 and 5: neither VRML 2.0 nor this file has such a node.",
          "5:'Screw' is left out: neither VRML 2.0 nor this file has such a node."}));
  const auto part = scan_vrml("Gear {}", "part.wrl", "part.wrl");
  ASSERT_TRUE(part.has_value());
  EXPECT_TRUE(part->remarks.empty());
}

TEST(VrmlScanner, LooksIntoPrototypes) {
  EXPECT_EQ(sentences_of("PROTO A [\nfield SFNode n TimeSensor {} ] {\n Group { children TouchSensor {} }\n"
                         "DEF s Script { url \"x\" } }"),
            (Sentences{"3:A TimeSensor is left out.", "4:A TouchSensor is left out.",
                       "5:A Script is left out with the PROTO around."}));
}

TEST(VrmlScanner, KeepsScriptsWhole) {
  const VrmlLeftOut out = scanned(
      "Transform { children [\n DEF door Script { # }\n field SFNode n Group { children [] }\n"
      " url \"javascript: function f() { '}' }\" } ] }\nScript {}");
  ASSERT_EQ(out.scripts.size(), 2U);
  EXPECT_EQ(out.scripts[0].name, "door");
  EXPECT_EQ(out.scripts[0].line, 3);
  EXPECT_EQ(out.scripts[0].source,
            "DEF door Script { # }\n field SFNode n Group { children [] }\n"
            " url \"javascript: function f() { '}' }\" }");
  EXPECT_EQ(out.scripts[1].name, "");
  EXPECT_EQ(out.scripts[1].source, "Script {}");
  ASSERT_EQ(out.remarks.size(), 1U);
  EXPECT_EQ(out.remarks[0].text, "2 Scripts are kept but not run, at lines 3 and 6.");
}

TEST(VrmlScanner, LeavesScriptsOutThatNameWhatIsAround) {
  const VrmlLeftOut out =
      scanned("DEF a Group {}\nScript { field SFNode n USE a }\nScript { url \"USE IS\" }");
  ASSERT_EQ(out.scripts.size(), 1U);
  EXPECT_EQ(out.scripts[0].line, 4);
  ASSERT_EQ(out.remarks.size(), 2U);
  EXPECT_EQ(out.remarks[0],
            (Remark{"", 3, "A Script is left out, as what it names around cannot be kept with it."}));
  EXPECT_EQ(out.remarks[1], (Remark{"", 4, "A Script is kept but not run."}));
}

TEST(VrmlScanner, CountsLinesThatEndInCarriageReturns) {
  const auto out = scan_vrml("#VRML V2.0 utf8\r# Fog {}\r\rSound {}", "x");
  ASSERT_TRUE(out.has_value());
  EXPECT_EQ(out->remarks, (std::vector<Remark>{{"", 4, "A Sound is left out."}}));
}

TEST(VrmlScanner, RefusesWhatIsNestedTooDeeply) {
  const auto nested = [](int depth) {
    std::string text = std::string(kScannedHeader) + "\n";
    for (int i = 0; i < depth; ++i) text += i % 2 == 0 ? "Group {" : " children [";
    return text;
  };
  EXPECT_EQ(refusal(nested(kMostNestedVrml)), "none");
  EXPECT_EQ(refusal(nested(kMostNestedVrml + 1)),
            fmt::format("test.wrl:3: braces and brackets lie more than {} deep within each other",
                        kMostNestedVrml));
}

TEST(VrmlScanner, StaysShortOnHostileText) {
  std::string types;
  for (int i = 0; i < 5000; ++i) types += fmt::format("N{} {{}}\n", i);
  const VrmlLeftOut out = scanned(types + std::string(100'000, 'y') + " {}");
  EXPECT_EQ(out.remarks.size(), 201U);
  for (const Remark& remark : out.remarks) EXPECT_LT(remark.text.size(), 200U);
  EXPECT_TRUE(out.remarks.back().text.starts_with("4801 more nodes are left out"));
}

TEST(VrmlScanner, EndsOnBrokenText) {
  for (const char* body : {"}", "]]]}", "{", "[", "\"", "\"\\", "Script {", "DEF", "DEF a", "PROTO",
                           "PROTO {", "PROTO A [", "DEF DEF DEF {", "}{}{", "Script { \"", "\0\0"})
    EXPECT_TRUE(scan_vrml(kScannedHeader + std::string(body), "x").has_value()) << body;
}

TEST(VrmlScanner, NamesTheFileInRemarks) {
  const auto out = scan_vrml("#VRML V2.0 utf8\nFog {}", "/a/part.wrl", "part.wrl");
  ASSERT_TRUE(out.has_value());
  EXPECT_EQ(out->remarks, (std::vector<Remark>{{"part.wrl", 2, "A Fog is left out."}}));
}

}  // namespace
}  // namespace icome::files
