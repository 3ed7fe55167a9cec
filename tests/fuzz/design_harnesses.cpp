// Designs: VRML as text and as the answer of its worker, glTF, .csg and trees as text, journals and edits.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <iterator>

#include "drawing/shape/every_kind.h"
#include "files/csg/csg_reader.h"
#include "files/csg/csg_text.h"
#include "files/design_files.h"
#include "files/gltf/gltf_reader.h"
#include "files/journal/journal_replay.h"
#include "files/sample_files.h"
#include "files/vrml/read/vrml_builder.h"
#include "files/vrml/read/vrml_scanner.h"
#include "files/vrml/worker/ready_text.h"
#include "files/vrml_answers.h"
#include "fuzz/harness.h"
#include "geometry/csg/meshing/csg_mesh.h"
#include "memory_place.h"
#include "world/edit/edit_bytes.h"
#include "world/edit/edits_of.h"
#include "world/every_edit.h"

namespace icome::fuzz {
namespace {

using files::LoadedDesign;

/// Where files take no time: one for all runs of a process.
const files::ScratchFolder& memory_folder() {
  static const files::ScratchFolder kFolder(memory_place());
  return kFolder;
}

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What was read is a world like any other: it can be told in edits, and they make it again.
void require_whole(const world::World& world) {
  world::World again;
  const world::GeometryFactory factory = drawing::every_kind_of_shape();
  for (const world::Edit& edit : world::edits_of(world)) {
    const auto bytes = world::to_bytes(edit);
    require(bytes.has_value(), "what was read can be written");
    const auto back = world::edit_from_bytes(*bytes, factory);
    require(back.has_value(), "what was written can be read");
    require(world::replay(again, *back).has_value(), "what was read makes a world again");
  }
  require(world::hash(again) == world::hash(world), "it is the same world");
}

void require_good(const base::Result<LoadedDesign>& design) {
  if (!design) return require_told(design.error());
  require_whole(design->world);
}

void run_gltf(std::string_view bytes) {
  files::DesignReadOptions options;
  options.size_limit = 16ULL << 20U;
  io::MemoryBudget memory(256ULL << 20U);
  require_good(files::read_gltf_bytes(bytes, "f", options, memory));
}

void run_vrml(std::string_view bytes) {
  const auto left_out = files::scan_vrml(bytes, "f");
  if (!left_out) require_told(left_out.error());
  std::vector<std::string> names;
  const files::ReadyText ready = files::make_ready(
      bytes,
      [](const std::string& node, const std::string& field) { return (node.size() + field.size()) % 3 != 0; },
      names);
  if (!ready.error.empty()) return;
  require(ready.text.starts_with("#VRML V2.0"), "what Coin reads begins with the header");
  require(ready.text.size() <= 4 * bytes.size() + 1000, "what is made ready stays in proportion");
}

void run_vrml_answer(std::string_view bytes) {
  files::VrmlSources sources;
  sources.name = "f";
  sources.find_mesh = [](const std::string&, const std::string& url) -> base::Result<files::FoundMesh> {
    static const std::filesystem::path kSample = memory_folder().write("mesh.obj", files::sample_obj());
    return url.size() % 2 == 0 ? base::Result<files::FoundMesh>(files::FoundMesh{kSample, true})
                               : base::fail("there is none");
  };
  sources.fetch_picture = [](const std::string&, const std::string& url, std::uint64_t) {
    return url.size() % 2 == 0 ? base::Result<std::string>("GIF89a" + url) : base::fail("there is none");
  };
  io::TimeBudget time_budget(20.0, nullptr, 0.0);
  io::MemoryBudget memory;
  memory.add_file(bytes.size());
  require_good(files::build_vrml(std::string(bytes), sources, time_budget, memory));
}

void run_csg(std::string_view bytes) {
  const auto loaded = files::parse_csg(bytes, "f");
  if (!loaded) return require_told(loaded.error());
  require(!loaded->tree.empty(), "what was read holds a solid");
  (void)geometry::bounds(loaded->tree);
}

void run_csg_text(std::string_view bytes) {
  const auto tree = files::csg_from_text(bytes);
  if (!tree) return require_told(tree.error());
  const auto text = files::csg_text(*tree);
  require(text.has_value(), "a tree that was read can be written");
  const auto again = files::csg_from_text(*text);
  require(again.has_value(), "a tree that was written can be read");
  require(files::csg_text(*again).value_or("") == *text, "and is the same");
}

void run_journal(std::string_view bytes) {
  const auto path = memory_folder().write("journal.icome", bytes);
  const auto file = io::OpenFile::open(path, io::OpenFile::Use::Read);
  require(file.has_value(), "a file that was written can be opened");
  io::MemoryBudget memory;
  memory.add_file(bytes.size());
  const world::GeometryFactory factory = drawing::every_kind_of_shape();
  const auto replayed = files::replay_journal(*file, factory, {}, &memory);
  if (!replayed) return require_told(replayed.error());
  require_whole(replayed->world);
}

void run_edit(std::string_view bytes) {
  const world::GeometryFactory factory = drawing::every_kind_of_shape();
  const auto edit = world::edit_from_bytes(bytes, factory);
  if (!edit) return require_told(edit.error());
  static const world::World kFurnished = [] {
    world::World world;
    for (const world::Edit& it : world::every_edit()) (void)world::apply(world, it);
    return world;
  }();
  world::World world = kFurnished;
  const auto back = world::apply(world, *edit);
  if (!back) return require_told(back.error());
  require(world::apply(world, *back).has_value(), "an edit can be taken back");
  require(world::hash(world) == world::hash(kFurnished), "and then nothing has changed");
}

/// A design with something of everything, in the format that the name says.
std::string written_design(const std::string& name) {
  world::World world;
  for (const world::Edit& edit : world::every_edit()) (void)world::apply(world, edit);
  const auto path = memory_folder().path() / name;
  if (const auto written = files::write_design(path, world); !written)
    require(false, written.error().message.c_str());
  return content_of(path);
}

std::vector<std::string> gltf_seeds() {
  return {written_design("a.glb"), written_design("a.gltf"), files::sample_glb()};
}
std::vector<std::string> journal_seeds() { return {written_design("a.icome")}; }
std::vector<std::string> edit_seeds() {
  std::vector<std::string> all;
  for (const world::Edit& edit : world::every_edit()) all.push_back(*world::to_bytes(edit));
  return all;
}
std::vector<std::string> vrml_seeds() {
  return {written_design("a.wrl"),
          "#VRML V2.0 utf8\nPROTO P [ field SFInt32 n 3 exposedField MFString s [ \"a\" \"b\" ] ] { Group { "
          "children [ "
          "Shape { geometry DEF B Box { size 1 2 3 } } USE B ] } }\nP { n 4 } # comment\n"
          "EXTERNPROTO E [ field SFColor c ] \"e.wrl#E\"\nE { c 1 0 0 }\nDEF S Script { url \"javascript:\" "
          "eventOut SFBool o }\nROUTE S.o TO S.o\nUnknown { a [ 1 2 ] b { } }\n",
          "#VRML V2.0 utf8\nDEF T Transform { children Shape { geometry Box {} } }\nDEF C TimeSensor { "
          "cycleInterval 2 }\nDEF P PositionInterpolator { key [ 0 1 ] keyValue [ 0 0 0 1 2 3 ] }\n"
          "ROUTE C.fraction_changed TO P.set_fraction\nROUTE P.value_changed TO T.set_translation\n"};
}
std::vector<std::string> vrml_answer_seeds() {
  using files::flat::GeometryKind;
  const std::vector<float> points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5F, 0.5F, 1};
  files::AnswerGeometry faces = {.kind = GeometryKind::Faces, .name = "faces", .positions = points};
  faces.polygons = {3, 2, 1, 0, -1, 0, 1, 4, -1, 1, 2, 4, -1};
  faces.texture_coordinates = {0, 0, 1, 0, 1, 1, 0, 1, 0.5F, 0.5F};
  faces.colours = {1, 0, 0, 0, 1, 0};
  faces.colour_polygons = {0, 1, 0};
  faces.colour_per_vertex = false;
  files::AnswerGeometry loop = {.kind = GeometryKind::Loop, .positions = points, .polygons = faces.polygons};
  loop.creases = {0, 1, 1, 2};
  const files::Answer answer = {
      .nodes = {{.name = "a"},
                {.parent = 0, .geometry = 0, .appearance = 0},
                {.geometry = 1, .appearance = 1},
                {.geometry = 2},
                {.geometry = 3}},
      .geometries = {faces,
                     loop,
                     {.kind = GeometryKind::Csg, .text = "box:1x1x1\nsphere:0.6\ndifference 0 1\n"},
                     {.kind = GeometryKind::Box, .sizes = {1, 2, 3}}},
      .appearances = {{.name = "red", .diffuse = {1, 0, 0}, .stiffness = 100.0},
                      {.lit = false, .picture = 0}},
      .pictures = {{.width = 1, .height = 2, .channels = 3, .pixels = {1, 2, 3, 4, 5, 6}}},
      .notes = {{"f", 3, "text"}}};
  return {bytes_of(answer)};
}
std::vector<std::string> csg_seeds() {
  return {
      "difference() {\n  color([1, 0, 0, 1]) cube(size = [1, 2, 3], center = false);\n"
      "  multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { sphere($fn = 0, $fa = 12, $fs = 2, r = 1); "
      "}\n"
      "  cylinder($fn = 8, h = 4, r1 = 1, r2 = 0, center = true);\n}\n",
      "union() { group(); %cube(1); polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], faces = "
      "[[0,1,2],[0,3,1],[0,2,3],[1,3,2]], convexity = 1); intersection() { cube([1, 1, 1]); sphere(1); } "
      "}\n"};
}
std::vector<std::string> csg_text_seeds() {
  return {
      "box:0.1x0.2x0.3 move 0 0 0.05 colour 1 0.5 0 1\ncylinder:0.02x0.4 matrix 1 0 0 0 0 0 -1 0 0 1 0 0\n"
      "difference 0 1\nroot 2\n",
      "define mesh 0\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\ntriangle 0 2 1\ntriangle 0 1 "
      "3\n"
      "triangle 0 3 2\ntriangle 1 2 3\nmesh 0\nmesh 0 move 1 2 3\nunion 0 1 # both\n"};
}

constexpr std::array<Harness, 7> kDesign{{{"gltf", run_gltf, gltf_seeds},
                                          {"vrml", run_vrml, vrml_seeds},
                                          {"vrml-answer", run_vrml_answer, vrml_answer_seeds},
                                          {"csg", run_csg, csg_seeds},
                                          {"csg-text", run_csg_text, csg_text_seeds},
                                          {"journal", run_journal, journal_seeds},
                                          {"edit", run_edit, edit_seeds}}};

}  // namespace

std::span<const Harness> design_harnesses() { return kDesign; }

}  // namespace icome::fuzz
