#include "files/csg/csg_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "files/packed_xz.h"
#include "files/sample_files.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::files {
namespace {

using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::MeshSolid;
using geometry::Primitive;
using geometry::Vector3;

LoadedCsg parsed(std::string_view text) {
  auto loaded = parse_csg(text, "a.csg");
  EXPECT_TRUE(loaded) << text << ": " << loaded.error().message;
  return loaded ? std::move(*loaded) : LoadedCsg{};
}

std::string error_of_csg(std::string_view text) {
  const auto loaded = parse_csg(text, "a.csg");
  return loaded ? "it was read" : loaded.error().message;
}

/// Is the point, in mm as in the file, in the solid?
bool holds(const CsgTree& tree, double x, double y, double z) {
  return geometry::inside(tree, Vector3(x, y, z) / 1000.0);
}

const geometry::TriangleMesh& mesh_of(const LoadedCsg& loaded) {
  return std::get<std::shared_ptr<const MeshSolid>>(*loaded.tree.node(loaded.tree.root()).shape)->mesh;
}

/// The box of the solid in mm: its two corners.
std::pair<Vector3, Vector3> box_of(const LoadedCsg& loaded) {
  const geometry::Bounds box = geometry::bounds(loaded.tree);
  return {box.min() * 1000.0, box.max() * 1000.0};
}

void expect_box(std::string_view text, const Vector3& low, const Vector3& high) {
  const auto [min, max] = box_of(parsed(text));
  EXPECT_LT((min - low).norm() + (max - high).norm(), 1e-9)
      << text << ": " << min.transpose() << " to " << max.transpose();
}

std::string notes_of(std::string_view text) {
  std::string joined;
  for (const std::string& note : parsed(text).notes) joined += (joined.empty() ? "" : "; ") + note;
  return joined;
}

/// "U(I(.,.),.)": the tree with a dot for every leaf.
std::string shape_of_tree(const CsgTree& tree, CsgTree::Index index) {
  const CsgTree::Node& node = tree.node(index);
  if (node.is_leaf) return ".";
  std::string text(1, "UID"[static_cast<int>(node.op)]);
  text += '(';
  text += shape_of_tree(tree, node.left);
  text += ',';
  text += shape_of_tree(tree, node.right);
  return text += ')';
}
std::string shape_of_csg(std::string_view text) {
  const LoadedCsg loaded = parsed(text);
  return loaded.tree.empty() ? "" : shape_of_tree(loaded.tree, loaded.tree.root());
}

// ---- Grammar --------------------------------------------------------------------------------------

TEST(CsgReader, SpaceCommentsAndLineEndsMayStandAnywhere) {
  const LoadedCsg loaded = parsed(
      "\xef\xbb\xbf// a comment; cube(9);\r\ngroup /* one */ ( ) {/* two\n lines */\r\n\tcube ( size = [ 1 , "
      "2.5e0,\n"
      " +.3E1 ,] , center=false ) ; ; }\n;// the end");
  EXPECT_TRUE(holds(loaded.tree, 0.5, 2.4, 2.9));
  EXPECT_EQ(loaded.tree.size(), 1U);
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(CsgReader, ArgumentsGoByNameOrByPosition) {
  expect_box("cube([2, 4, 6], true);", {-1, -2, -3}, {1, 2, 3});
  expect_box("cube(center = true, size = [2, 4, 6]);", {-1, -2, -3}, {1, 2, 3});
  expect_box("cube(3);", {0, 0, 0}, {3, 3, 3});
  expect_box("cylinder(4, 3, 1, true);", {-3, -3, -2}, {3, 3, 2});
  expect_box("cylinder(d = 6, h = 4, $fa = 12, $fs = 2);", {-3, -3, 0}, {3, 3, 4});
  expect_box("cylinder(h = 4, r1 = 1, d2 = 6);", {-3, -3, 0}, {3, 3, 4});
  expect_box("sphere(2, $fn = 0, $fe = 0.1);", {-2, -2, -2}, {2, 2, 2});
  expect_box("sphere(r = 7, d = 4);", {-2, -2, -2}, {2, 2, 2});
}

TEST(CsgReader, WhatIsNotGivenIsAsInOpenScad) {
  expect_box("cube();", {0, 0, 0}, {1, 1, 1});
  expect_box("cube(size = undef, center = undef);", {0, 0, 0}, {1, 1, 1});
  expect_box("sphere();", {-1, -1, -1}, {1, 1, 1});
  expect_box("cylinder();", {-1, -1, 0}, {1, 1, 1});
  expect_box("cylinder(h = 2, r1 = 3);", {-3, -3, 0}, {3, 3, 2});
  EXPECT_FALSE(holds(parsed("cylinder(h = 2, r1 = 3);").tree, 2.0, 0.0, 1.5)) << "the top's radius is 1";
}

struct Wrong {
  const char* text;
  const char* error;
};

TEST(CsgReader, ErrorsOfGrammarSayWhereAndWhatWasExpected) {
  for (const Wrong& wrong : {
           Wrong{"cube(1)", "1:8: '{' or ';' is expected, but the file ends: it may be cut short"},
           Wrong{"cube(1", "1:7: ',' or ')' is expected, but the file ends: it may be cut short"},
           Wrong{"cube", "1:5: '(' after 'cube' is expected, but the file ends: it may be cut short"},
           Wrong{"cube(1) sphere(2);", "1:9: '{' or ';' is expected, but there is 'sphere'"},
           Wrong{"\n\tcube 1;", "2:7: '(' after 'cube' is expected, but there is '1'"},
           Wrong{"cube(1;", "1:7: ',' or ')' is expected, but there is ';'"},
           Wrong{"cube(1,);", "1:8: a value is expected, but there is ')'"},
           Wrong{"cube(size = );", "1:13: a value is expected, but there is ')'"},
           Wrong{"cube([1, 2);", "1:11: ',' or ']' is expected, but there is ')'"},
           Wrong{"cube([1 2]);", "1:9: ',' or ']' is expected, but there is '2'"},
           Wrong{"cube([,]);", "1:7: a value is expected, but there is ','"},
           Wrong{"cube([1, 2", "1:11: ',' or ']' is expected, but the file ends: it may be cut short"},
           Wrong{"cube(1 + 2);", "1:8: ',' or ')' is expected, but there is '+'"},
           Wrong{"cube(x);",
                 "1:6: a value (a number, true, false, undef, \"text\" or [...]) is expected, but there is "
                 "'x'"},
           Wrong{"cube(1.2.3);", "1:6: a number is expected, but there is '1.2.3'"},
           Wrong{"cube(12mm);", "1:6: a number is expected, but there is '12mm'"},
           Wrong{"cube(1e);", "1:6: a number is expected, but there is '1e'"},
           Wrong{"cube(-);", "1:6: a number is expected, but there is '-'"},
           Wrong{"cube(--1);", "1:6: a number is expected, but there is '-'"},
           Wrong{"cube(.);", "1:6: a number is expected, but there is '.'"},
           Wrong{"cube(inf);", "1:6: 'inf' is not a finite number"},
           Wrong{"cube(-inf);", "1:6: '-inf' is not a finite number"},
           Wrong{"cube([1, nan, 2]);", "1:10: 'nan' is not a finite number"},
           Wrong{"cube(1e999);", "1:6: '1e999' is out of range"},
           Wrong{"group() { cube(1);\n",
                 "2:1: '}' is expected, for the '{' of group in line 1, but the file ends: it "
                 "may be cut short"},
           Wrong{"cube(1);\n }", "2:2: this '}' closes nothing: a statement or the end is expected"},
           Wrong{"cube(1); /* no end", "1:10: the comment that begins here with /* has no */"},
           Wrong{"cube(1 /*", "1:8: the comment that begins here with /* has no */"},
           Wrong{"color(\"red) { cube(1); }", "1:7: the string that begins here has no closing '\"'"},
           Wrong{"color(\"\\", "1:7: the string that begins here has no closing '\"'"},
           Wrong{"{ cube(1); }", "1:1: a statement such as cube(...); is expected, but there is '{'"},
           Wrong{"#%;", "1:3: a statement such as cube(...); is expected, but there is ';'"},
           Wrong{"$fn = 3;", "1:5: '(' after '$fn' is expected, but there is '='"},
           Wrong{"/* \xc3\xa4\xc3\xb6 */ \xff",
                 "1:10: a statement such as cube(...); is expected, but there is '?'"},
       })
    EXPECT_EQ(error_of_csg(wrong.text), std::string("a.csg:") + wrong.error) << wrong.text;
  EXPECT_EQ(error_of_csg(std::string_view("cube(1);\0", 9)),
            "a.csg:1:9: a statement such as cube(...); is expected, but there is '?'");
  EXPECT_EQ(error_of_csg(std::string(300, 'a') + "();"),
            "a.csg:1:1: the name 'aaaaaaaaaaaaaaaaaaaaaaaa...' is longer than 255 characters");
}

TEST(CsgReader, ErrorsOfArgumentsSayWhereAndWhatWasExpected) {
  for (const Wrong& wrong : {
           Wrong{"cube(sise = 1);", "1:6: cube takes size, center, not 'sise'"},
           Wrong{"cube(1, true, 3);", "1:15: cube takes size, center and nothing more"},
           Wrong{"cube(1, size = 2);", "1:16: size of cube is given twice"},
           Wrong{"sphere($fn = 3, $fn = 4);", "1:23: $fn of sphere is given twice"},
           Wrong{"cube([1, 2]);",
                 "1:6: the size of a cube is expected, a vector of 3 numbers, but this one has 2"},
           Wrong{"cube([1, 2, 3, [4, 5]]);",
                 "1:6: the size of a cube is expected, a vector of 3 numbers, but this one has 4"},
           Wrong{"cube([1, true, 3]);",
                 "1:10: the size of a cube is expected, a vector of 3 numbers, but there is true or false"},
           Wrong{"cube(\"big\");",
                 "1:6: a number or a vector of 3 is expected for the size of a cube, but there is a string"},
           Wrong{"cube(1, center = 1);",
                 "1:18: true or false is expected for center of cube, but there is a number"},
           Wrong{"sphere(r = [1]);", "1:12: a number is expected for r of sphere, but there is a vector"},
           Wrong{"sphere(1, $fn = true);",
                 "1:17: a number is expected for $fn of sphere, but there is true or false"},
           Wrong{"multmatrix() { cube(1); }", "1:1: multmatrix needs a matrix, 4 rows of 4 numbers"},
           Wrong{"multmatrix(1) { cube(1); }", "1:12: a matrix is expected, 4 rows of 4 numbers"},
           Wrong{"multmatrix([[1, 0, 0, 0]]);", "1:12: a matrix is expected, 4 rows of 4 numbers"},
           Wrong{"multmatrix([[1,0,0,0],[0,1,0],[0,0,1,0],[0,0,0,1]]);",
                 "1:23: a row of the matrix is expected, a vector of 4 numbers, but this one has 3"},
           Wrong{"multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0.1,1]]);",
                 "1:43: [0, 0, 0, 1] is expected, for the last row of an affine matrix is always that"},
           Wrong{"multmatrix([[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]);",
                 "1:43: [0, 0, 0, 1] is expected, for the last row of an affine matrix is always that"},
           Wrong{"color(1) { cube(1); }",
                 "1:7: a colour is expected, a vector of 3 or 4 numbers or a name, but there is a number"},
           Wrong{"color([1, 0]) { cube(1); }",
                 "1:7: a colour is expected, a vector of 4 numbers, but this one has 2"},
           Wrong{"cube(1) { sphere(1); }", "1:11: '}' is expected: cube takes nothing between braces"},
       })
    EXPECT_EQ(error_of_csg(wrong.text), std::string("a.csg:") + wrong.error) << wrong.text;
}

TEST(CsgReader, SizesAndPlacesThatCannotBeTouchedAreRefused) {
  const std::string far = "multmatrix([[1,0,0,2e9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {\n cube(1); }";
  const std::string huge = "multmatrix([[1e200,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { ";
  for (const Wrong& wrong : {
           Wrong{"sphere(2e9);", "1:1: sphere has a size of 2e+09 mm; it must be from 1e-06 to 1e+09 mm"},
           Wrong{"cube([1, 1, 1e-7]);",
                 "1:1: cube has a size of 1e-07 mm; it must be from 1e-06 to 1e+09 mm"},
           Wrong{"cylinder(1, 1e300, 0);",
                 "1:1: cylinder has a size of 1e+300 mm; it must be from 1e-06 to 1e+09 mm"},
           Wrong{far.c_str(),
                 "2:2: cube reaches 2e+09 mm from the origin; 1e+09 mm is as far as can be touched"},
           Wrong{"multmatrix([[1e-9,0,0,2],[0,1e-9,0,0],[0,0,1e-9,0],[0,0,0,1]]) { sphere(1); }",
                 "1:66: sphere is 2e-09 mm large where it stands; 1e-06 mm is the least"},
       })
    EXPECT_EQ(error_of_csg(wrong.text), std::string("a.csg:") + wrong.error) << wrong.text;
  EXPECT_EQ(error_of_csg(huge + huge + "cube(1); } }"),
            "a.csg:1:61: this matrix and those around it multiply to numbers that are too large");
  EXPECT_EQ(parse_csg("cube(1); cube(2); cube(3);", "a.csg", {.max_primitives = 2}).error().message,
            "a.csg:1:19: there are more than 2 primitives: use a simpler model");
}

TEST(CsgReader, WhatHasNoExactFormIsRefusedByNameEvenWhenEmpty) {
  for (const std::string name :
       {"hull", "minkowski", "resize", "linear_extrude", "rotate_extrude", "projection", "text", "square",
        "circle", "polygon", "offset", "surface", "import", "fill", "roof"}) {
    const std::string start = "a.csg:2:3: " + name + " has no exact form as a solid";
    EXPECT_TRUE(error_of_csg("difference() { cube(1);\n  " + name + "(); }").starts_with(start)) << name;
    EXPECT_TRUE(
        error_of_csg("intersection() { group();\n  " + name + "(1) { cube(1); } }").starts_with(start));
  }
  EXPECT_EQ(
      error_of_csg("cube(1);\ntranslate([1, 2, 3]) { cube(1); }"),
      "a.csg:2:1: 'translate' is not known here: a .csg file, as openscad -o MODEL.csg MODEL.scad writes it, "
      "is expected");
}

// ---- What statements mean -------------------------------------------------------------------------

TEST(CsgReader, ChildrenBecomeChainsFromTheLeft) {
  EXPECT_EQ(shape_of_csg("cube(1);"), ".");
  EXPECT_EQ(shape_of_csg("group() { render() { union() { cube(1); } } }"), ".");
  EXPECT_EQ(shape_of_csg("cube(1); cube(2); cube(3);"), "U(U(.,.),.)");
  EXPECT_EQ(shape_of_csg("intersection() { cube(1); cube(2); cube(3); }"), "I(I(.,.),.)");
  EXPECT_EQ(shape_of_csg("difference() { group() { cube(1); cube(2); } cube(3); cube(4); }"),
            "D(D(U(.,.),.),.)");
  EXPECT_EQ(
      shape_of_csg("difference() { cube(1); group() { cube(2); intersection() { cube(3); cube(4); } } }"),
      "D(.,U(.,I(.,.)))");
}

// Checked against openscad 2021.01, which gives the same solids.
TEST(CsgReader, EmptyOperandsMakeWhatTheyMakeInOpenScad) {
  EXPECT_EQ(shape_of_csg("union() { cube(0); group(); cube(3); }"), ".");
  EXPECT_EQ(shape_of_csg("difference() { cube(5); group(); cube([1, 2, 0]); sphere(-1); }"), ".");
  EXPECT_EQ(shape_of_csg("difference() { cube(5); difference() { group(); cube(3); } cube(4); }"), "D(.,.)");
  for (const char* empty :
       {"difference() { group(); cube(5); }", "difference() { sphere(r = 0); cube(5); cube(2); }",
        "intersection() { group(); cube(5); }", "intersection() { cube(5); cube(0); cube(3); }", "union();",
        "cylinder(h = -2, r1 = 1, r2 = 1);", "cylinder(h = 2, r1 = -1, r2 = 1);",
        "cylinder(h = 2, r1 = 0, r2 = 0);", "cylinder(h = 0);", "cube([-1, 2, 3]);",
        "polyhedron(points = undef, faces = undef);", "polyhedron(points = [], faces = []);", "",
        "// nothing"}) {
    EXPECT_TRUE(error_of_csg(empty).starts_with("a.csg: holds no solid")) << empty << error_of_csg(empty);
    EXPECT_EQ(shape_of_csg(std::string("cube(9);") + empty), ".") << empty;
  }
  EXPECT_EQ(error_of_csg("\ngroup() { cube(0); }"),
            "a.csg: holds no solid: cube in line 2 has no volume: it is empty");
}

TEST(CsgReader, ModifiersLeaveOutAndTheRootCountsAlone) {
  EXPECT_EQ(shape_of_csg("intersection() { cube(5); %cube(1); *cube(1); #cube(2); }"), "I(.,.)");
  expect_box("difference() { %cube(5); *cube(4); cube(3); cube(1); }", {0, 0, 0}, {3, 3, 3});
  EXPECT_EQ(notes_of("cube(1);\n%cube(2);\n*hull();\n%#group() { cube(2); }"),
            "hull in line 3 is left out, for it is disabled by '*'; "
            "2 parts are left out, for '%' makes them background: the first is cube in line 2");
  // The root stands alone: what is around it, even a transform, does not count.
  const char* rooted =
      "multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {\n !cube(3); cube(1); }\n!cube(7);\nhull();";
  expect_box(rooted, {0, 0, 0}, {3, 3, 3});
  EXPECT_EQ(notes_of(rooted), "only cube in line 2 counts, for it is marked '!'");
  expect_box("!%cube(3); cube(1);", {0, 0, 0}, {3, 3, 3});
  expect_box("%group() { !cube(3); } cube(1);", {0, 0, 0}, {3, 3, 3});
  expect_box("*group() { !cube(3); } cube(1);", {0, 0, 0}, {1, 1, 1});
}

TEST(CsgReader, TransformsNestStretchShearAndMirror) {
  expect_box(
      "multmatrix([[1,0,0,10],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { "
      "multmatrix([[2,0,0,0],[0,3,0,0],[0,0,4,5],[0,0,0,1]]) "
      "{ cube(1); } }",
      {10, 0, 5}, {12, 3, 9});
  const CsgTree sheared =
      parsed("multmatrix([[1,0,1,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(2); sphere(1, $fn = 4); }").tree;
  EXPECT_TRUE(holds(sheared, 3.5, 1.0, 1.9));
  EXPECT_FALSE(holds(sheared, 0.5, 1.5, 1.9));
  const CsgTree mirrored =
      parsed("multmatrix([[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cylinder(4, 3, 3, $fn = 3); }").tree;
  EXPECT_TRUE(holds(mirrored, -2.9, 0.0, 1.0));
  EXPECT_FALSE(holds(mirrored, 2.9, 0.0, 1.0));
}

TEST(CsgReader, TransformsWithoutVolumeMakeEmptySolids) {
  const std::string flat = "multmatrix([[1,2,3,0],[4,5,6,0],[7,8,9,0],[0,0,0,1]]) {";
  EXPECT_EQ(shape_of_csg("difference() { cube(5); " + flat + " cube(1); } }"), ".");
  EXPECT_EQ(notes_of("cube(5);\n" + flat + flat + " cube(1); }}"),
            "multmatrix in line 2 leaves no volume: what is in it is empty");
  EXPECT_EQ(error_of_csg("multmatrix([[2,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,0,1]]) { cube(1); }"),
            "a.csg: holds no solid: multmatrix in line 1 leaves no volume: what is in it is empty");
  // Thin is not flat, whatever the unit.
  EXPECT_EQ(shape_of_csg("multmatrix([[1e3,0,0,0],[0,1e3,0,0],[0,0,1e-9,0],[0,0,0,1]]) { cube(1); }"), ".");
}

TEST(CsgReader, TheOutermostColourThatCountsIsTheLeafs) {
  const auto colours = [](std::string_view text) {
    const LoadedCsg loaded = parsed(text);
    return loaded.tree.node(0).colour;
  };
  using Colour = CsgTree::Colour;
  EXPECT_EQ(colours("cube(1);"), std::nullopt);
  EXPECT_EQ(colours("color([1, 0, 0.5, 0.25]) { color([0, 0, 1, 1]) { cube(1); } }"),
            (Colour{1, 0, 0.5F, 0.25F}));
  EXPECT_EQ(colours("color([-1, -1, -1, 0.5]) { color([0, 0, 1]) { cube(1); } }"), (Colour{0, 0, 1, 1}));
  EXPECT_EQ(colours("color([-1, -1, -1, -1]) { cube(1); }"), std::nullopt);
  EXPECT_EQ(colours("color(\"Lime\", 0.5) { cube(1); }"), (Colour{0, 1, 0, 0.5F}));
  EXPECT_EQ(colours("color(c = \"#F0f\") { cube(1); }"), (Colour{1, 0, 1, 1}));
  EXPECT_EQ(colours("color(\"#00ff0033\") { cube(1); }"), (Colour{0, 1, 0, 0.2F}));
  EXPECT_EQ(colours("color(\"n\\o\\\"such\") { cube(1); }"), std::nullopt);
  EXPECT_EQ(notes_of("color(\"#12\") { cube(1); }"),
            "color in line 1 has a name that is not known: it does not count");
  EXPECT_EQ(colours("color([2, 0, 1e300]) { cube(1); }"), (Colour{1, 0, 1, 1}));
  EXPECT_EQ(notes_of("color([2, 0, 0]) { cube(1); }"), "color in line 1 goes beyond 1: it is cut to it");
  const LoadedCsg two = parsed("color([1, 0, 0]) { cube(1); } cube(2);");
  EXPECT_EQ(two.tree.node(1).colour, std::nullopt) << "a colour ends with its braces";
}

// ---- Round and faceted shapes ---------------------------------------------------------------------

TEST(CsgReader, FacetsAreWantedFromThreeToSixteen) {
  const auto is_round = [](const std::string& fn) {
    const LoadedCsg loaded = parsed("sphere(r = 2, $fn = " + fn + ");");
    return std::holds_alternative<Primitive>(*loaded.tree.node(0).shape);
  };
  for (const char* fn : {"0", "1", "2", "2.9", "-5", "0.1", "16.5", "17", "100", "undef"})
    EXPECT_TRUE(is_round(fn)) << fn;
  for (const char* fn : {"3", "3.7", "5", "16"}) EXPECT_FALSE(is_round(fn)) << fn;
  const LoadedCsg twice = parsed("cylinder(2, 1, 3, $fn = 5); cylinder(h = 2, r1 = 1, r2 = 3, $fn = 5.9);");
  EXPECT_EQ(std::get<std::shared_ptr<const MeshSolid>>(*twice.tree.node(0).shape),
            std::get<std::shared_ptr<const MeshSolid>>(*twice.tree.node(1).shape));
}

/// A polygon of `sides` corners on a circle.
double polygon_area(double radius, int sides) {
  return 0.5 * sides * radius * radius * std::sin(2.0 * std::numbers::pi / sides);
}
double frustum_volume(double a, double b, double height, int sides) {
  const double bottom = polygon_area(a, sides), top = polygon_area(b, sides);
  return height / 3.0 * (bottom + std::sqrt(bottom * top) + top);
}

void expect_closed(const LoadedCsg& loaded, double cubic_millimetres) {
  const auto report = geometry::analyse_topology(mesh_of(loaded)).report;
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.inconsistent_edges, 0U);
  EXPECT_NEAR(geometry::signed_volume(mesh_of(loaded)) * 1e9, cubic_millimetres, 1e-12 * cubic_millimetres);
}

TEST(CsgReader, FacetedShapesHaveTheCornersOfOpenScad) {
  for (int sides = 3; sides <= 16; ++sides) {
    const std::string fn = ", $fn = " + std::to_string(sides) + ");";
    const LoadedCsg prism = parsed("cylinder(5, 2, 2, true" + fn);
    EXPECT_EQ(mesh_of(prism).positions.size(), 2U * sides);
    expect_closed(prism, frustum_volume(2, 2, 5, sides));
    expect_closed(parsed("cylinder(5, 2, 1" + fn), frustum_volume(2, 1, 5, sides));
    expect_closed(parsed("cylinder(5, 2, 0" + fn), frustum_volume(2, 0, 5, sides));
    expect_closed(parsed("cylinder(5, 0, 2" + fn), frustum_volume(0, 2, 5, sides));
    const LoadedCsg ball = parsed("sphere(2" + fn);
    const int rings = (sides + 1) / 2;
    EXPECT_EQ(mesh_of(ball).positions.size(), static_cast<std::size_t>(rings * sides));
    double volume = 0.0;
    const auto polar = [&](int ring) { return std::numbers::pi * (ring + 0.5) / rings; };
    for (int i = 0; i + 1 < rings; ++i)
      volume += frustum_volume(2 * std::sin(polar(i)), 2 * std::sin(polar(i + 1)),
                               2 * (std::cos(polar(i)) - std::cos(polar(i + 1))), sides);
    expect_closed(ball, volume);
  }
  // The first corner is on the x axis: openscad's box of sphere(2, $fn = 3) has these numbers.
  const auto [low, high] = box_of(parsed("sphere(2, $fn = 3);"));
  EXPECT_LT((low - Vector3(-std::sqrt(0.5), -std::sqrt(1.5), -std::sqrt(2.0))).norm(), 1e-12);
  EXPECT_LT((high - Vector3(std::sqrt(2.0), std::sqrt(1.5), std::sqrt(2.0))).norm(), 1e-12);
}

// ---- polyhedron -----------------------------------------------------------------------------------

constexpr const char* kTetrahedronPoints = "polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], ";

TEST(CsgReader, PolyhedraFaceOut) {
  // Clockwise seen from outside.
  for (const char* faces :
       {"faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);", "triangles = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);",
        "convexity = 3, faces = [[0,1,2,2],[0,3,1,0],[0,2,3],[1,3,2]]);"}) {
    const LoadedCsg right = parsed(std::string(kTetrahedronPoints) + faces);
    expect_closed(right, 1.0 / 6.0);
    EXPECT_TRUE(right.notes.empty()) << faces << right.notes.front();
  }
  const LoadedCsg turned =
      parsed(std::string("\n") + kTetrahedronPoints + "faces = [[2,1,0],[1,3,0],[3,2,0],[2,3,1]]);");
  expect_closed(turned, 1.0 / 6.0);
  EXPECT_EQ(turned.notes,
            std::vector<std::string>{"the polyhedron in line 2 was put right: 1 inside-out part turned"});
  EXPECT_EQ(notes_of(std::string(kTetrahedronPoints) + "faces = [[0,1,2],[1,3,0],[0,2,3],[1,3,2]]);"),
            "the polyhedron in line 1 was put right: 1 face turned to agree with the neighbours");
}

TEST(CsgReader, PolyhedraOfPolygonsAndOfSoupAreClosed) {
  expect_closed(parsed("polyhedron([[0,0,0],[2,0,0],[2,2,0],[0,2,0],[0,0,2],[2,0,2],[2,2,2],[0,2,2]],"
                       "[[0,1,2,3],[4,5,1,0],[7,6,5,4],[5,6,2,1],[6,7,3,2],[7,4,0,3]]);"),
                8.0);
  const char* soup =
      "polyhedron([[0,0,0],[1,0,0],[0,1,0],[0,0,0],[0,0,1],[1,0,0],[0,0,0],[0,1,0],[0,0,1],[1,0,0],[0,0,1],["
      "0,1,0]],"
      "[[0,1,2],[3,4,5],[6,7,8],[9,10,11]]);";
  expect_closed(parsed(soup), 1.0 / 6.0);
  EXPECT_EQ(mesh_of(parsed(soup)).positions.size(), 4U);
  EXPECT_TRUE(parsed(soup).notes.empty()) << "soup is welded without a word";
}

TEST(CsgReader, PolyhedraThatEncloseNothingAreRefusedOrEmpty) {
  const std::string points = kTetrahedronPoints;
  for (const auto& [text, error] : {
           std::pair<std::string, std::string>{
               points + "faces = [[0,1,2],[0,3,1],[0,2,3]]);",
               "1:1: this polyhedron is open: 3 of its edges belong to one face only"},
           {points + "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,4]]);",
            "1:94: face refers to point 4; the 4 points are numbered from 0"},
           {points + "faces = [[0,1,2],[0,3,-1]]);",
            "1:78: face refers to point -1; the 4 points are numbered from 0"},
           {points + "faces = [[0,1,2],[0,3,1.5]]);",
            "1:78: face refers to point 1.5; the 4 points are numbered from 0"},
           {points + "faces = [[0,1,2],7]);",
            "1:73: a face is expected, a vector of numbers of points, but there is a number"},
           {points + "faces = [[0,1,[2]]]);",
            "1:70: the number of a point is expected, but there is a vector"},
           {points + "faces = 3);",
            "1:64: a vector is expected for faces of polyhedron, but there is a number"},
           {"polyhedron([[1,2]], []);",
            "1:13: a point is expected, a vector of 3 numbers, but this one has 2"},
           {"polyhedron([[1,2,3e9]], []);", "1:13: this point is farther than 1e+09 mm from the origin"},
       })
    EXPECT_EQ(error_of_csg(text), "a.csg:" + error);
  // Two tetrahedra on one edge.
  EXPECT_EQ(
      error_of_csg(
          "polyhedron([[0,0,0],[0,0,1],[1,0,0],[0,1,0],[-1,0,0],[0,-1,0]], [[0,3,2],[0,2,1],[1,2,3],[0,1,3],"
          "[0,5,4],[0,4,1],[1,4,5],[0,1,5]]);"),
      "a.csg:1:1: this polyhedron is not manifold: 1 of its edges belong to more than two faces");
  EXPECT_EQ(error_of_csg(points + "faces = [[0,1,2],[2,1,0]]);"),
            "a.csg: holds no solid: polyhedron in line 1 has no volume: it is empty");
}

// ---- Files ----------------------------------------------------------------------------------------

TEST(CsgReader, FilesAreReadPackedOrNot) {
  const ScratchFolder folder;
  const std::string text = "cube(2);";
  EXPECT_TRUE(read_csg(folder.write("a.csg", text)));
  const std::string packed = packed_xz(text);
  const auto loaded = read_csg(folder.write("a.csg.XZ", packed));
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_GT(loaded->read_seconds, 0.0);
  const std::string prefix = folder.path().string() + "/";
  EXPECT_EQ(read_csg(folder.path() / "none.csg").error().message,
            prefix + "none.csg: cannot be read: No such file or directory");
  EXPECT_EQ(read_csg(folder.write("empty.csg", "")).error().message, prefix + "empty.csg: the file is empty");
  EXPECT_EQ(read_csg(folder.write("a.csg", "\ncube(;")).error().message,
            prefix + "a.csg:2:6: a value is expected, but there is ';'");
  EXPECT_EQ(read_csg(folder.write("large.csg", std::string(2048, ' ')), {.size_limit = 1024}).error().message,
            prefix + "large.csg: is larger than the limit of 0.000976562 MiB");
}

// ---- Hostile texts --------------------------------------------------------------------------------

TEST(CsgReader, DeepNestingIsReadWithoutRecursion) {
  constexpr int kDepth = 1'000'000;
  const std::string open = repeated("group(){", kDepth);
  EXPECT_EQ(shape_of_csg(open + "cube(1);" + std::string(kDepth, '}')), ".");
  EXPECT_EQ(error_of_csg(open + "cube(1);"),
            "a.csg:1:8000009: '}' is expected, for the '{' of group in line 1, but the "
            "file ends: it may be cut short");
  EXPECT_EQ(error_of_csg("cube(" + std::string(kDepth, '[') + std::string(kDepth, ']') + ");"),
            "a.csg:1:7: the size of a cube is expected, a vector of 3 numbers, but there is a vector");
  const LoadedCsg chain =
      parsed(repeated("difference(){cube(2);", kDepth / 10) + "cube(1);" + std::string(kDepth / 10, '}'));
  EXPECT_EQ(geometry::count(chain.tree).depth, kDepth / 10 + 1U);
}

TEST(CsgReader, ManySpecialVariablesTakeLinearTime) {
  std::string text = "sphere(r = 1";
  for (int i = 0; i < 200'000; ++i) text += ", $a" + std::to_string(i) + " = 1";
  EXPECT_EQ(shape_of_csg(text + ");"), ".");
}

}  // namespace
}  // namespace icome::files
