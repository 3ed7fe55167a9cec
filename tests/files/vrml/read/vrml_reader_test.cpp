#include "files/vrml/read/vrml_reader.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "files/design_files.h"
#include "files/sample_files.h"
#include "io/gzip_sample.h"
#include "world/shape/mesh_geometry.h"

namespace icome::files {
namespace {

const std::string kVrmlHead = "#VRML V2.0 utf8\n";
const std::string kRedBall =
    "DEF ball Transform { children Shape { geometry Sphere { radius 0.1 } appearance Appearance { material "
    "DEF "
    "red Material { diffuseColor 1 0 0 } } } }\n";
const std::string kGifBytes = "GIF89a and more";

std::string textured_by(const std::string& urls) {
  return kVrmlHead +
         "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0, 1 0 0, 0 2 0 ] } "
         "coordIndex [ 0 1 2 ] } appearance Appearance { material Material {} texture "
         "ImageTexture { url [ " +
         urls + " ] } } }\n";
}

std::string reading_failure(const std::filesystem::path& path, const DesignReadOptions& options = {}) {
  const auto design = read_design(path, options);
  return design ? "none" : design.error().message;
}

LoadedDesign read_good(const std::filesystem::path& path) {
  auto design = read_design(path);
  EXPECT_TRUE(design.has_value()) << (design ? "" : design.error().message);
  return design ? std::move(*design) : LoadedDesign{};
}

bool has_remark(const LoadedDesign& design, const std::string& text) {
  return std::any_of(design.remarks.begin(), design.remarks.end(),
                     [&](const Remark& it) { return it.text.find(text) != std::string::npos; });
}

TEST(VrmlReader, ReadsAFile) {
  const ScratchFolder folder;
  const LoadedDesign design = read_good(folder.write("a.wrl", kVrmlHead + kRedBall));
  EXPECT_EQ(design.format, "VRML 2.0");
  ASSERT_EQ(design.world.roots().size(), 1U);
  const world::PhysicalObject& ball = *design.world.find(design.world.roots()[0]);
  EXPECT_EQ(ball.name, "ball");
  EXPECT_EQ(design.world.find(ball.material)->name, "red");
  EXPECT_NEAR(design.world.find(ball.geometry)->shape->bounds().max().x(), 0.1, 1e-15);
  EXPECT_TRUE(design.remarks.empty());
}

TEST(VrmlReader, ReadsPackedFilesWhateverTheyAreCalled) {
  const ScratchFolder folder;
  for (const char* name : {"a.wrz", "a.wrl"}) {
    const LoadedDesign design = read_good(folder.write(name, io::gzipped(kVrmlHead + kRedBall)));
    EXPECT_EQ(design.format, "VRML 2.0, gzip");
    EXPECT_EQ(design.world.objects().size(), 1U);
  }
}

TEST(VrmlReader, RefusesFilesThatAreTooLarge) {
  const ScratchFolder folder;
  DesignReadOptions options;
  options.size_limit = 1 << 20;
  const auto large = folder.write("a.wrl", kVrmlHead + std::string(2 << 20, ' '));
  EXPECT_NE(reading_failure(large, options).find("larger than the limit"), std::string::npos);
  const auto bomb = folder.write("b.wrz", io::gzipped(kVrmlHead + std::string(2 << 20, ' ')));
  EXPECT_NE(reading_failure(bomb, options).find("unpacks to more than the limit"), std::string::npos);
}

TEST(VrmlReader, SaysWhyThereIsNothing) {
  const ScratchFolder folder;
  EXPECT_NE(reading_failure(folder.path() / "gone.wrl").find("gone.wrl: cannot be read"), std::string::npos);
  std::filesystem::create_directory(folder.path() / "folder.wrl");
  EXPECT_NE(reading_failure(folder.path() / "folder.wrl").find("is a folder"), std::string::npos);
  EXPECT_NE(reading_failure(folder.write("a.wrl", "")).find("a.wrl: is empty"), std::string::npos);
  EXPECT_NE(reading_failure(folder.write("b.wrl", kVrmlHead + "Group {")).find("b.wrl: "), std::string::npos);
}

TEST(VrmlReader, TellsItsProgressAndStops) {
  const ScratchFolder folder;
  const auto path = folder.write("a.wrl", kVrmlHead + kRedBall);
  std::vector<double> parts;
  DesignReadOptions options;
  options.progress = [&](double part) {
    parts.push_back(part);
    return true;
  };
  ASSERT_TRUE(read_design(path, options).has_value());
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_EQ(parts.back(), 1.0);
  for (const double end : {0.0, 0.3, 0.9}) {
    options.progress = [&](double part) { return part <= end; };
    EXPECT_EQ(reading_failure(path, options), "interrupted") << end;
  }
}

TEST(VrmlReader, TakesPicturesFromBesideTheFile) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path() / "part");
  folder.write("a.gif", kGifBytes);
  folder.write("part/b.gif", kGifBytes + "!");
  folder.write("part/part.wrl", textured_by("\"b.gif\""));
  const LoadedDesign design = read_good(
      folder.write("a.wrl", textured_by("\"gone.gif\" \"a.gif\"") + "Inline { url \"part/part.wrl\" }\n"));
  ASSERT_EQ(design.world.textures().size(), 2U);
  std::vector<std::string> contents;
  for (const auto& [id, texture] : design.world.textures()) contents.push_back(*texture.bytes);
  std::sort(contents.begin(), contents.end());
  EXPECT_EQ(contents, (std::vector<std::string>{kGifBytes, kGifBytes + "!"}));
}

TEST(VrmlReader, TakesNoOtherFilesAsPictures) {
  const ScratchFolder folder;
  folder.write("secret.gif", "the password is swordfish");
  const auto secret = folder.write("other.gif", kGifBytes);
  for (const std::string& url :
       {std::string("secret.gif"), std::string("../../../../../../../../etc/passwd"), secret.string(),
        "file://" + secret.string(), std::string("/etc/passwd"), std::string("http://127.0.0.1/a.gif")}) {
    const LoadedDesign design = read_good(folder.write("a.wrl", textured_by("\"" + url + "\"")));
    EXPECT_TRUE(design.world.textures().empty()) << url;
    EXPECT_TRUE(has_remark(design, "is left out")) << url;
    for (const Remark& remark : design.remarks)
      EXPECT_EQ(remark.text.find("swordfish"), std::string::npos) << remark.text;
  }
}

TEST(VrmlReader, TellsWhatInlinedFilesHold) {
  const ScratchFolder folder;
  folder.write("part.wrl", kVrmlHead + "\nFog {}\n" + kRedBall);
  folder.write("bare.wrl", "DEF bare Group { children [\nSound {} ] }\n");
  const LoadedDesign design = read_good(folder.write(
      "a.wrl", kVrmlHead + "Inline { url \"part.wrl\" } Inline { url \"bare.wrl\" }\nSound {}\n"));
  const auto at = [&](const std::string& file, int line, const std::string& text) {
    return std::any_of(design.remarks.begin(), design.remarks.end(), [&](const Remark& it) {
      return std::filesystem::path(it.file).filename() == file && it.line == line && it.text == text;
    });
  };
  EXPECT_TRUE(at("", 3, "A Sound is left out."));
  EXPECT_TRUE(at("part.wrl", 3, "A Fog is left out."));
  EXPECT_TRUE(at("bare.wrl", 2, "A Sound is left out."));
  EXPECT_EQ(design.remarks.size(), 3U);
}

/// ISO/IEC 14772-1, 6.47: from the text's origin on, once for each height of a letter.
TEST(VrmlReader, PicturesLieOnTextByTheHeightOfItsLetters) {
  const ScratchFolder folder;
  for (const auto& [style, height] : {std::pair("", 1.0), {"fontStyle FontStyle { size 2 }", 2.0}}) {
    const LoadedDesign design = read_good(folder.write(
        "a.wrl",
        fmt::format("{}Shape {{ geometry Text {{ string [ \"Ab\", \"c\" ] {} }} }}\n", kVrmlHead, style)));
    ASSERT_EQ(design.world.geometries().size(), 1U);
    const auto& letters =
        dynamic_cast<const world::MeshGeometry&>(*design.world.geometries().begin()->second.shape);
    ASSERT_EQ(letters.texture_coordinates.size(), letters.mesh.triangles.size());
    for (std::size_t t = 0; t < letters.texture_coordinates.size(); ++t) {
      for (int k = 0; k < 3; ++k)
        EXPECT_LT(
            (height * letters.texture_coordinates[t][std::size_t(k)] - letters.mesh.corner(t, k).head<2>())
                .norm(),
            1e-5);
    }
  }
}

TEST(VrmlReader, AnImageThatDoesNotFitItsSizeIsLeftOutAndTheRestRead) {
  const struct {
    std::string image;
    std::string told;
  } cases[] = {{"40000 2 3 0xff0000", "its size is 40000 x 2 with 3 components"},
               {"2 2 5 0 0 0 0", "its size is 2 x 2 with 5 components"},
               {"-1 2 3 0 0", "its size is -1 x 2 with 3 components"},
               {"2 2 3 0 0xff", "of its 2 x 2 pixels there are 2."},
               {"1 1 1 0 0 0", "of its 1 x 1 pixels there are 3."},
               {"32000 32000 4 1", "of its 32000 x 32000 pixels there are 1."}};
  for (const auto& it : cases) {
    const ScratchFolder folder;
    const LoadedDesign design = read_good(folder.write(
        "a.wrl", kVrmlHead + "Shape { geometry Box {} appearance Appearance { texture PixelTexture { image " +
                     it.image + " repeatS FALSE } } }\n" + kRedBall));
    EXPECT_EQ(design.world.objects().size(), 2U) << it.image;
    std::string told;
    for (const Remark& remark : design.remarks)
      told += std::to_string(remark.line) + ": " + remark.text + "\n";
    EXPECT_NE(told.find("2: The image of a PixelTexture is left out: " + it.told), std::string::npos)
        << it.image << "\n"
        << told;
  }
}

TEST(VrmlReader, KeepsScriptsOfTheFile) {
  const ScratchFolder folder;
  const LoadedDesign design = read_good(folder.write(
      "a.wrl", kVrmlHead + kRedBall + "DEF mind Script { eventIn SFBool go url \"javascript: 1\" }"));
  EXPECT_EQ(design.world.objects().size(), 2U);
  const auto& inert = std::get<world::Inert>(*design.world.find(design.world.roots()[1])->fixture);
  EXPECT_EQ(inert.source, "DEF mind Script { eventIn SFBool go url \"javascript: 1\" }");
}

}  // namespace
}  // namespace icome::files
