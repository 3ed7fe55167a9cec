// Motions of objects in VRML 2.0 and glTF files, read and written.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "files/design_files.h"
#include "files/design_maker.h"
#include "files/sample_files.h"
#include "io/file_bytes.h"
#include "world/every_edit.h"
#include "world/motion.h"

namespace icome::files {
namespace {

using namespace world;
namespace fs = std::filesystem;

LoadedDesign design_of(const fs::path& path) {
  auto design = read_design(path);
  if (!design) throw std::runtime_error(design.error().message);
  return std::move(*design);
}

LoadedDesign vrml_design(const std::string& text) {
  const ScratchFolder folder;
  return design_of(folder.write("a.wrl", "#VRML V2.0 utf8\n" + text));
}

std::vector<std::string> sentences(const LoadedDesign& design) {
  std::vector<std::string> result;
  for (const Remark& remark : design.remarks) result.push_back(remark.text);
  return result;
}

const PhysicalObject& called(const World& world, const std::string& name) {
  for (const auto& [id, object] : world.objects())
    if (object.name == name) return object;
  throw std::runtime_error("no object is called " + name);
}

Affine3 place_of(const World& world, const std::string& name, double time) {
  const PhysicalObject& object = called(world, name);
  if (!object.motion) throw std::runtime_error(name + " does not move");
  return place_at(*object.motion, object.parent_from_object, time);
}

void expect_place(const Affine3& found, const Affine3& expected, double most = 1e-7) {
  EXPECT_LT((found.matrix() - expected.matrix()).cwiseAbs().maxCoeff(), most) << found.matrix() << "\n\n"
                                                                              << expected.matrix();
}

const std::string kMill = R"(DEF mill Transform { translation 1 0 0 center 0 1 0 scale 2 2 2 children [
  DEF wing Transform { rotation 0 0 1 0.5 children Shape { geometry Box {} } } ] }
DEF clock TimeSensor { cycleInterval 4 loop TRUE }
DEF once TimeSensor { cycleInterval 2 }
DEF path PositionInterpolator { key [ 0 0.5 1 ] keyValue [ 1 0 0 1 2 0 1 0 0 ] }
DEF spin OrientationInterpolator { key [ 0 1 ] keyValue [ 0 0 1 0 0 0 1 2 ] }
DEF grow ScalarInterpolator { key [ 0 1 ] keyValue [ 1 3 ] }
ROUTE clock.fraction_changed TO path.set_fraction
ROUTE clock.fraction_changed TO spin.set_fraction
ROUTE once.fraction_changed TO grow.set_fraction
ROUTE path.value_changed TO mill.set_translation
ROUTE spin.value_changed TO wing.rotation
ROUTE grow.value_changed TO wing.set_scale
)";

void expect_mill(const World& world, double most = 1e-7) {
  const Affine3 lifted = at(1.0, 0.5, 0.0) * at(0.0, 1.0, 0.0) * Eigen::Scaling(2.0) * at(0.0, -1.0, 0.0);
  expect_place(place_of(world, "mill", 0.5), lifted, most);
  const Affine3 turned = Affine3(Eigen::AngleAxisd(0.5, Vector3::UnitZ())) * Eigen::Scaling(2.0);
  expect_place(place_of(world, "wing", 1.0), turned, most);
  // The clock of its size has ended.
  const Affine3 later = Affine3(Eigen::AngleAxisd(1.5, Vector3::UnitZ())) * Eigen::Scaling(3.0);
  expect_place(place_of(world, "wing", 3.0), later, most);
}

TEST(VrmlMotions, MoveTransforms) {
  const LoadedDesign design = vrml_design(kMill);
  EXPECT_EQ(sentences(design), std::vector<std::string>{"Shapes without a Material are lit here: \"wing\"."});
  expect_mill(design.world);
  // At rest they are as the file has them.
  expect_place(called(design.world, "wing").parent_from_object,
               Affine3(Eigen::AngleAxisd(0.5, Vector3::UnitZ())));
}

TEST(VrmlMotions, MoveWhatIsInlinedAndUsedAgain) {
  const ScratchFolder folder;
  folder.write("part.wrl", "#VRML V2.0 utf8\n" + kMill);
  const LoadedDesign design =
      design_of(folder.write("a.wrl",
                             "#VRML V2.0 utf8\nInline { url \"part.wrl\" }\n"
                             "DEF ball Transform { children Shape { geometry Sphere {} } }\n"
                             "Transform { translation 5 0 0 children USE ball }\n"
                             "DEF t TimeSensor {} DEF p PositionInterpolator { key [ 0 1 ]\n"
                             " keyValue [ 0 0 0 1 0 0 ] } ROUTE p.value_changed TO ball.translation\n"
                             "ROUTE t.fraction_changed TO p.set_fraction\n"));
  expect_mill(design.world);
  EXPECT_EQ(moving_objects(design.world).size(), 4U);
  for (const std::string& sentence : sentences(design))
    EXPECT_EQ(sentence.find("left out"), std::string::npos) << sentence;
}

TEST(VrmlMotions, ThatAreNotTakenAreTold) {
  const LoadedDesign design = vrml_design(R"(DEF t Transform { children [ Shape { geometry Box {} }
  DEF eye Viewpoint {} ] }
DEF clock TimeSensor { }
DEF hues ColorInterpolator { key [ 0 1 ] keyValue [ 1 0 0 0 1 0 ] }
DEF bend CoordinateInterpolator { key [ 0 1 ] keyValue [ 1 0 0 0 1 0 ] }
DEF way PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0 1 0 0 ] }
ROUTE clock.fraction_changed TO hues.set_fraction
ROUTE clock.fraction_changed TO way.set_fraction
ROUTE way.value_changed TO eye.set_position
)");
  EXPECT_TRUE(moving_objects(design.world).empty());
  const std::vector<std::string> told = sentences(design);
  for (const char* sentence : {"A TimeSensor is left out.", "A ColorInterpolator is left out.",
                               "A CoordinateInterpolator is left out.", "A PositionInterpolator is left out.",
                               "3 ROUTEs are left out, the first at line 8."})
    EXPECT_NE(std::find(told.begin(), told.end(), sentence), told.end()) << sentence;
}

/// A design whose one interpolator has these fields.
LoadedDesign moved_by(const std::string& type, const std::string& fields, const std::string& to,
                      const std::string& clock = "cycleInterval 1 loop TRUE") {
  return vrml_design(
      "DEF t Transform { children Shape { geometry Box {} appearance Appearance { material Material "
      "{} } } }\nDEF c TimeSensor { " +
      clock + " }\nDEF i " + type + " { " + fields +
      " }\nROUTE c.fraction_changed TO i.set_fraction\nROUTE i.value_changed TO t." + to);
}

TEST(VrmlMotions, OfKeysThatMakeNoSenseAreTold) {
  const auto refused = [](const LoadedDesign& design, const std::string& why) {
    EXPECT_TRUE(moving_objects(design.world).empty()) << why;
    const std::vector<std::string> told = sentences(design);
    EXPECT_NE(std::find(told.begin(), told.end(), why), told.end()) << why << testing::PrintToString(told);
  };
  const std::string position = "PositionInterpolator";
  refused(moved_by(position, "key [ 0 1 ] keyValue [ 0 0 0 ]", "set_translation"),
          "'i' moves nothing: it has 2 keys and 1 values.");
  refused(moved_by(position, "", "set_translation"), "'i' moves nothing: it has no keys.");
  refused(moved_by(position, "key [ 0 1 0.5 ] keyValue [ 0 0 0 1 1 1 2 2 2 ]", "set_translation"),
          "'i' moves nothing: its keys go back.");
  refused(moved_by(position, "key [ -1 1 ] keyValue [ 0 0 0 1 1 1 ]", "set_translation"),
          "'i' moves nothing: its keys begin before 0.");
  refused(moved_by(position, "key [ 0 3e38 ] keyValue [ 0 0 0 1 1 1 ]", "set_translation",
                   "cycleInterval 1e300 loop TRUE"),
          "'i' moves nothing: it has numbers that are not finite.");
  refused(moved_by(position, "key [ 0 1 ] keyValue [ 0 0 0 1 1 1 ]", "set_translation", "cycleInterval 0"),
          "'c' moves nothing: its cycleInterval is not above 0.");
  // What is no place, or of another kind, is a route that is left out.
  refused(moved_by(position, "key [ 0 1 ] keyValue [ 0 0 0 1 1 1 ]", "set_rotation"),
          "2 ROUTEs are left out, the first at line 5.");
  refused(moved_by(position, "key [ 0 1 ] keyValue [ 0 0 0 1 1 1 ]", "set_center"),
          "2 ROUTEs are left out, the first at line 5.");
  const LoadedDesign off =
      moved_by(position, "key [ 0 1 ] keyValue [ 0 0 0 1 1 1 ]", "set_translation", "enabled FALSE");
  EXPECT_EQ(moving_objects(off.world).size(), 1U);
  EXPECT_EQ(sentences(off),
            std::vector<std::string>{"'c' is switched off in the file; what it moves moves here."});
}

TEST(VrmlMotions, OfPlacesThatAreNoneLeaveTheFileReadable) {
  const LoadedDesign design = vrml_design(
      "DEF t Transform { center 1e39 0 0 children Shape { geometry Box {} } }\n"
      "DEF c TimeSensor {} DEF i PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0 1 0 0 ] }\n"
      "ROUTE c.fraction_changed TO i.set_fraction\nROUTE i.value_changed TO t.translation\n");
  // Coin reads such a number as infinite, so that nothing moves, or as 0.
  for (const world::ObjectId id : moving_objects(design.world))
    EXPECT_TRUE(world::check_motion(*design.world.find(id)->motion));
}

TEST(VrmlMotions, AreTakenFromTheFileAsItWasRead) {
  const ScratchFolder folder;
  const fs::path path = folder.write("a.wrl", "#VRML V2.0 utf8\n" + kMill);
  DesignReadOptions options;
  options.progress = [&](double part) {
    if (part >= 0.1) fs::remove(path);  // it has been read
    return true;
  };
  const auto design = read_design(path, options);
  ASSERT_TRUE(design.has_value()) << design.error().message;
  EXPECT_FALSE(fs::exists(path));
  for (const std::string& sentence : sentences(*design))
    EXPECT_EQ(sentence.find("left out"), std::string::npos) << sentence;
}

std::string bytes_saved(const World& world, const fs::path& path) {
  const auto written = write_design(path, world);
  if (!written) throw std::runtime_error(written.error().message);
  return io::read_bytes(path, 1U << 30U).value();
}

/// What a file of this kind keeps of a world's motions; saving it again gives the same bytes.
World kept_in(const World& world, const std::string& name) {
  const ScratchFolder folder;
  const fs::path path = folder.path() / name;
  bytes_saved(world, path);
  World once = design_of(path).world;
  const std::string bytes = bytes_saved(once, path);
  EXPECT_EQ(bytes_saved(design_of(path).world, path), bytes) << name;
  return once;
}

/// Steps, straight ways, splines; at rest elsewhere than where it begins; moved by hand since.
DesignMaker parade() {
  DesignMaker design;
  const auto add = [&](const std::string& name, Motion motion, const Affine3& by = Affine3::Identity()) {
    const ObjectId id = design.add(name, box(1.0), {}, by * affine(motion.rest));
    applied(design.world, ChangeMotion{id, std::make_shared<const Motion>(std::move(motion))});
  };
  add("steps", {.translation = {.interpolation = Interpolation::Step,
                                .times = {0.0, 0.5, 1.25},
                                .values = {0, 0, 0, 1, 0, 0, 2, 0.1, 0},
                                .cycle = 2.0}});
  const Eigen::AngleAxisd half(0.5 * std::numbers::pi, Vector3::UnitY());
  std::vector<double> turns{0, 0, 0, 1};
  const base::Quaternion end(half);
  turns.insert(turns.end(), end.coeffs().begin(), end.coeffs().end());
  add("", {.rest = {.translation = {0.0, 2.0, 0.0}},
           .rotation = {.times = {0.0, 4.0}, .values = turns, .cycle = 4.0, .loops = false}});
  add("moved",
      {.rest = {.translation = {0.0, 1.0, 0.0}, .scale = {1.0, 2.0, 1.0}},
       .translation = {.times = {0.0, 1.0}, .values = {0, 1, 0, 3, 1, 0}, .cycle = 1.0},
       .scale = {.times = {0.0, 1.0}, .values = {1, 2, 1, 2, 2, 2}, .cycle = 1.0}},
      at(5.0, 0.0, 0.0) * Eigen::AngleAxisd(0.25, Vector3::UnitX()) * Eigen::Scaling(1.5));
  add("bent", {.translation = {.interpolation = Interpolation::CubicSpline,
                               .times = {0.0, 1.0},
                               .values = {0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0},
                               .cycle = 1.0}});
  return design;
}

void expect_parade(const World& before, const World& after, double bent) {
  ASSERT_EQ(moving_objects(after).size(), moving_objects(before).size());
  for (const char* name : {"steps", "", "moved", "bent"}) {
    for (const double time : {0.0, 0.2, 0.49, 0.6, 1.3, 1.9, 3.5, 5.0})
      expect_place(place_of(after, name, time), place_of(before, name, time),
                   std::string(name) == "bent" ? bent : 3e-6);
    EXPECT_EQ(loops(*called(after, name).motion), loops(*called(before, name).motion));
    EXPECT_EQ(duration(*called(after, name).motion), duration(*called(before, name).motion));
  }
}

TEST(MotionsInFiles, AreKeptByGltf) {
  const DesignMaker design = parade();
  expect_parade(design.world, kept_in(design.world, "a.glb"), 3e-6);
  expect_parade(design.world, kept_in(design.world, "a.gltf"), 3e-6);
}

TEST(MotionsInFiles, AreKeptByVrmlInStraightPieces) {
  const DesignMaker design = parade();
  expect_parade(design.world, kept_in(design.world, "a.wrl"), 0.01);
  const ScratchFolder folder;
  const auto remarks = write_design(folder.path() / "a.wrl", design.world);
  ASSERT_TRUE(remarks.has_value());
  EXPECT_EQ(remarks->front().text, "1 motion is written in straight pieces: VRML 2.0 knows no splines.");
}

TEST(MotionsInFiles, AreKeptByJournalsToTheLastBit) {
  World world = parade().world;
  applied(world, ChangeMotion{moving_objects(world).front(), spinning()});
  const ScratchFolder folder;
  const fs::path path = folder.path() / "a.icome";
  ASSERT_TRUE(write_design(path, world).has_value());
  EXPECT_EQ(hash(design_of(path).world), hash(world));
}

TEST(MotionsInFiles, OfVrmlAreKeptByVrmlAndMoveAlikeInGltf) {
  const World mill = vrml_design(kMill).world;
  expect_mill(kept_in(mill, "a.wrl"), 1e-6);
  expect_mill(kept_in(mill, "a.glb"), 1e-6);
}

TEST(MotionsInFiles, AreSampledWhereGltfKnowsNoCentre) {
  DesignMaker design;
  const ObjectId id = design.add("door", box(1.0), {}, at(2.0, 0.0, 0.0));
  Motion swing{.rest = {.translation = {2.0, 0.0, 0.0}, .centre = {0.5, 0.0, 0.0}}};
  const base::Quaternion open(Eigen::AngleAxisd(1.5, Vector3::UnitY()));
  swing.rotation = {.times = {0.0, 1.0}, .values = {0, 0, 0, 1, open.x(), open.y(), open.z(), open.w()}};
  applied(design.world, ChangeMotion{id, std::make_shared<const Motion>(swing)});
  const World kept = kept_in(design.world, "a.glb");
  for (const double time : {0.0, 0.3, 0.77, 1.0})
    expect_place(place_of(kept, "door", time), place_of(design.world, "door", time), 1e-3);
  expect_place(place_of(kept_in(design.world, "a.wrl"), "door", 0.77), place_of(design.world, "door", 0.77),
               1e-6);
}

/// A door of one metre that turns about its edge by these key frames.
World swinging_door(KeyFrames rotation) {
  DesignMaker design;
  const ObjectId id = design.add("door", box(1.0), {}, at(2.0, 0.0, 0.0));
  Motion swing{.rest = {.translation = {2.0, 0.0, 0.0}, .centre = {0.5, 0.0, 0.0}},
               .rotation = std::move(rotation)};
  applied(design.world, ChangeMotion{id, std::make_shared<const Motion>(std::move(swing))});
  return design.world;
}

std::vector<double> turns_about_y(const std::vector<double>& angles) {
  std::vector<double> values;
  for (const double angle : angles) {
    const base::Quaternion turn(Eigen::AngleAxisd(angle, Vector3::UnitY()));
    values.insert(values.end(), turn.coeffs().begin(), turn.coeffs().end());
  }
  return values;
}

void expect_door_kept(const World& world, const std::vector<double>& moments) {
  const World kept = kept_in(world, "a.glb");
  for (const double time : moments) {
    SCOPED_TRACE(time);
    expect_place(place_of(kept, "door", time), place_of(world, "door", time), 2e-3);
  }
}

TEST(MotionsInFiles, AboutACentreEndWithTheirCycleInGltf) {
  expect_door_kept(swinging_door({.times = {0.0, 2.0}, .values = turns_about_y({0.0, 1.5}), .cycle = 1.25}),
                   {0.1, 0.9, 1.2, 1.3});
  expect_door_kept(
      swinging_door(
          {.times = {0.0, 1.0, 2.0}, .values = turns_about_y({0.0, 0.5, 1.5}), .cycle = 1.5, .loops = false}),
      {0.9, 1.2, 1.45, 3.0});
}

TEST(MotionsInFiles, AboutACentreJumpAtOnceInGltf) {
  expect_door_kept(
      swinging_door(
          {.times = {0.0, 1.0, 1.0, 2.0}, .values = turns_about_y({0.0, 0.5, 1.5, 2.0}), .cycle = 2.0}),
      {0.5, 0.97, 0.999, 1.001, 1.5});
  expect_door_kept(swinging_door({.interpolation = Interpolation::Step,
                                  .times = {0.0, 0.3, 1.0},
                                  .values = turns_about_y({0.0, 0.5, 1.5}),
                                  .cycle = 2.0}),
                   {0.1, 0.299, 0.301, 0.7, 0.999, 1.001, 1.9});
}

TEST(MotionsInFiles, OfSplinesThatJumpDoSoInVrml) {
  DesignMaker design;
  const ObjectId id = design.add("bent", box(1.0));
  KeyFrames way{.interpolation = Interpolation::CubicSpline, .times = {0.0, 1.0, 1.0, 2.0}, .cycle = 2.0};
  for (const double x : {0.0, 1.0, 5.0, 6.0})
    way.values.insert(way.values.end(), {0.0, 0.0, 0.0, x, 0.0, 0.0, 0.0, 0.0, 0.0});
  applied(design.world, ChangeMotion{id, std::make_shared<const Motion>(Motion{.translation = way})});
  const World kept = kept_in(design.world, "a.wrl");
  for (const double time : {0.5, 0.97, 0.999, 1.001, 1.5}) {
    SCOPED_TRACE(time);
    expect_place(place_of(kept, "bent", time), place_of(design.world, "bent", time), 0.02);
  }
}

std::string told_by_glb(const World& world) {
  const ScratchFolder folder;
  const auto remarks = write_design(folder.path() / "a.glb", world);
  if (!remarks) throw std::runtime_error(remarks.error().message);
  std::string all;
  for (const Remark& remark : *remarks) all += remark.text + "\n";
  return all;
}

TEST(MotionsInFiles, ThatGltfCannotHoldAreToldByTheirReasons) {
  World world = swinging_door({.times = {0.0, 1.0}, .values = turns_about_y({0.0, 1.5})});
  const ObjectId id = moving_objects(world).front();
  Motion motion = *world.find(id)->motion;
  motion.translation = {.times = {0.0}, .values = {2.0, 0.0, 0.0}, .cycle = 3.0};
  applied(world, ChangeMotion{id, std::make_shared<const Motion>(motion)});
  EXPECT_NE(
      told_by_glb(world).find("1 motion is left out: glTF knows no turns about a centre in several cycles."),
      std::string::npos);
  const std::string too_large = "1 motion is left out: numbers of it are too large for single precision.";
  for (const KeyFrames& way : {KeyFrames{.times = {0.0, 1.0}, .values = {2, 0, 0, 1e39, 0, 0}},
                               KeyFrames{.times = {0.0, 1e39}, .values = {2, 0, 0, 3, 0, 0}}}) {
    motion = Motion{.rest = {.translation = {2.0, 0.0, 0.0}}, .translation = way};
    applied(world, ChangeMotion{id, std::make_shared<const Motion>(motion)});
    EXPECT_NE(told_by_glb(world).find(too_large), std::string::npos);
  }
}

TEST(MotionsInFiles, ThatNoFormatKnowsAreTold) {
  DesignMaker design;
  const ObjectId id = design.add("a", box(1.0), {}, Affine3(Eigen::Scaling(1.0, 2.0, 1.0)));
  applied(design.world, ChangeMotion{id, std::make_shared<const Motion>(
                                             Motion{.rotation = {.times = {0.0}, .values = {0, 0, 0, 1}}})});
  const auto told = [&](const std::string& name) {
    const ScratchFolder folder;
    const auto remarks = write_design(folder.path() / name, design.world);
    std::string all;
    for (const Remark& remark : remarks.value()) all += remark.text + "\n";
    return all;
  };
  EXPECT_NE(told("a.wrl").find("1 motion is left out: what moves was stretched unevenly"), std::string::npos);
  EXPECT_NE(told("a.glb").find("1 motion is left out: glTF knows no such stretching."), std::string::npos);
  EXPECT_NE(told("a.obj").find("This format knows no motions: 1 is left out."), std::string::npos);
}

/// A glTF file of one node that is moved by the sampler, whose numbers come first in the buffer.
class GltfFile {
 public:
  GltfFile() {
    json_ = nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
      "nodes": [{"name": "arm", "translation": [1, 0, 0]}, {"name": "other"}],
      "accessors": [], "bufferViews": [], "animations": []})");
  }
  int add(const std::vector<float>& numbers, const std::string& type, std::size_t size) {
    nlohmann::json view = nlohmann::json::parse(R"({"buffer": 0})");
    view["byteOffset"] = bytes_.size();
    view["byteLength"] = 4 * numbers.size();
    json_["bufferViews"].push_back(std::move(view));
    bytes_.append(reinterpret_cast<const char*>(numbers.data()), 4 * numbers.size());
    add_accessor(type, numbers.size() / size)["bufferView"] = json_["bufferViews"].size() - 1;
    return int(json_["accessors"].size()) - 1;
  }
  nlohmann::json& add_accessor(const std::string& type, std::size_t count) {
    nlohmann::json accessor = nlohmann::json::parse(R"({"componentType": 5126})");
    accessor["type"] = type;
    accessor["count"] = count;
    json_["accessors"].push_back(std::move(accessor));
    return json_["accessors"].back();
  }
  void animate(const std::string& name, const std::string& path, int input, int output,
               const std::string& interpolation = "LINEAR") {
    nlohmann::json animation =
        nlohmann::json::parse(R"({"samplers": [{}], "channels": [{"sampler": 0, "target": {"node": 0}}]})");
    animation["name"] = name;
    animation["samplers"][0]["input"] = input;
    animation["samplers"][0]["output"] = output;
    animation["samplers"][0]["interpolation"] = interpolation;
    animation["channels"][0]["target"]["path"] = path;
    json_["animations"].push_back(std::move(animation));
  }
  nlohmann::json& json() { return json_; }
  base::Result<LoadedDesign> read(const DesignReadOptions& options = {}) {
    const ScratchFolder folder;
    json_["buffers"] = nlohmann::json::parse(R"([{"uri": "a.bin"}])");
    json_["buffers"][0]["byteLength"] = bytes_.size();
    folder.write("a.bin", bytes_);
    return read_design(folder.write("a.gltf", json_.dump()), options);
  }
  LoadedDesign design() {
    auto design = read();
    if (!design) throw std::runtime_error(design.error().message);
    return std::move(*design);
  }

 private:
  nlohmann::json json_;
  std::string bytes_;
};

TEST(GltfMotions, MoveNodes) {
  GltfFile file;
  const int times = file.add({0.0F, 2.0F}, "SCALAR", 1);
  const float half = std::sqrt(0.5F);
  file.animate("turn", "rotation", times, file.add({0, 0, 0, 1, 0, half, 0, half}, "VEC4", 4));
  file.animate("grow", "scale", times, file.add({1, 1, 1, 3, 1, 1}, "VEC3", 3), "STEP");
  const LoadedDesign design = file.design();
  const Affine3 expected = at(1.0, 0.0, 0.0) * Eigen::AngleAxisd(0.25 * std::numbers::pi, Vector3::UnitY());
  expect_place(place_of(design.world, "arm", 1.0), expected);
  expect_place(place_of(design.world, "arm", 5.0), expected);  // it begins anew
  EXPECT_EQ(sentences(design), std::vector<std::string>{});
}

TEST(GltfMotions, OfWhatIsMovedAlreadyAreOtherClips) {
  GltfFile file;
  const int times = file.add({0.0F, 1.0F}, "SCALAR", 1);
  const int ways = file.add({0, 0, 0, 1, 0, 0}, "VEC3", 3), others = file.add({0, 0, 0, 9, 9, 9}, "VEC3", 3);
  file.animate("walk", "translation", times, ways);
  file.animate("run", "translation", times, others);
  const LoadedDesign design = file.design();
  expect_place(place_of(design.world, "arm", 0.5), at(0.5, 0.0, 0.0));
  EXPECT_EQ(sentences(design).front(), "Animations of what another one moves are left out: \"run\".");
}

TEST(GltfMotions, ThatCannotBeTakenAreTold) {
  const auto told = [](const std::vector<float>& times, const std::string& path,
                       const std::vector<float>& values, const std::string& type, std::size_t size) {
    GltfFile file;
    const int input = file.add(times, "SCALAR", 1);
    file.animate("clip", path, input, file.add(values, type, size));
    const LoadedDesign design = file.design();
    EXPECT_TRUE(moving_objects(design.world).empty()) << path;
    return sentences(design).front();
  };
  const std::string unplayable = "Key frames that go back in time or are no numbers are left out: \"clip\".";
  EXPECT_EQ(told({1, 0}, "translation", {0, 0, 0, 1, 1, 1}, "VEC3", 3), unplayable);
  EXPECT_EQ(told({0, NAN}, "translation", {0, 0, 0, 1, 1, 1}, "VEC3", 3), unplayable);
  EXPECT_EQ(told({-1, 0}, "translation", {0, 0, 0, 1, 1, 1}, "VEC3", 3), unplayable);
  EXPECT_EQ(told({0, 1}, "translation", {0, 0, 0}, "VEC3", 3), unplayable);
  EXPECT_EQ(told({0}, "scale", {0, INFINITY, 0}, "VEC3", 3), unplayable);
  EXPECT_EQ(told({0}, "rotation", {0, 0, 0, 0}, "VEC4", 4), unplayable);
  EXPECT_EQ(told({0}, "weights", {1}, "SCALAR", 1), "Animations of morph targets are left out: \"clip\".");
  EXPECT_EQ(told({0}, "pointer", {1}, "SCALAR", 1),
            "Animations of other things than places of nodes are left out: \"clip\".");
}

TEST(GltfMotions, OfNodesWithAMatrixAreTold) {
  GltfFile file;
  file.json()["nodes"][0] =
      nlohmann::json::parse(R"({"name": "arm", "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]})");
  const int times = file.add({0.0F}, "SCALAR", 1);
  file.animate("clip", "translation", times, file.add({0, 0, 0}, "VEC3", 3));
  EXPECT_EQ(sentences(file.design()).front(),
            "Animations of nodes that have a matrix are left out: \"arm\".");
}

TEST(GltfMotions, OfWhatIsNotThereAreRefused) {
  GltfFile file;
  const int times = file.add({0.0F}, "SCALAR", 1);
  file.animate("clip", "translation", times, 77);
  const auto refused = file.read();
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("an animation refers to an accessor that is not there"),
            std::string::npos);
}

TEST(GltfMotions, OfManyKeyFramesInFewBytesAreRefusedBeforeTheyTakeMemory) {
  GltfFile file;
  // Without a buffer view all are zero: nothing in the file pays for them.
  for (const char* type : {"SCALAR", "VEC3"}) file.add_accessor(type, 4'000'000);
  file.animate("clip", "translation", 0, 1);
  file.add({0.0F}, "SCALAR", 1);
  DesignReadOptions options;
  options.memory_limit = 64'000'000;
  const auto refused = file.read(options);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("memory"), std::string::npos) << refused.error().message;
}

TEST(GltfMotions, MoveNodesWhoseTurnIsFourZeros) {
  GltfFile file;
  file.json()["nodes"][0]["rotation"] = nlohmann::json::parse("[0, 0, 0, 0]");
  const int times = file.add({0.0F, 1.0F}, "SCALAR", 1);
  file.animate("walk", "translation", times, file.add({0, 0, 0, 1, 0, 0}, "VEC3", 3));
  expect_place(place_of(file.design().world, "arm", 0.5), at(0.5, 0.0, 0.0));
}

TEST(GltfMotions, CountAsMemoryOnce) {
  GltfFile file;
  for (const char* type : {"SCALAR", "VEC3"}) file.add_accessor(type, 100'000);  // 3.2 MB of numbers
  file.animate("clip", "translation", 0, 1);
  file.add({0.0F}, "SCALAR", 1);
  DesignReadOptions options;
  options.memory_limit = 5'000'000;
  const auto design = file.read(options);
  ASSERT_TRUE(design.has_value()) << design.error().message;
  EXPECT_EQ(moving_objects(design->world).size(), 1U);
}

}  // namespace
}  // namespace icome::files
