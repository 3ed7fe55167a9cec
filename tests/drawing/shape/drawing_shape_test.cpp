#include "drawing/shape/drawing_shape.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "drawing/shape/drawing_text.h"
#include "drawing/shape/every_kind.h"
#include "drawing/test_drawings.h"
#include "world/edit/edit.h"
#include "world/edit/edit_bytes.h"
#include "world/shape/flat_curves.h"
#include "world/shape/mesh_geometry.h"

namespace icome::drawing {
namespace {

using judges::drawing_with;
using judges::random_curve;

constexpr double kOneMm = 0.001;

std::shared_ptr<const DrawingShape> shape_with(Drawing drawing, const DrawingBody& body = {}) {
  auto shape = DrawingShape::create(std::move(drawing), body);
  if (!shape) throw std::runtime_error(shape.error().message);
  return *shape;
}

Drawing random_drawing(unsigned seed, std::size_t strokes = 5) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < strokes; ++i)
    curves.push_back(random_curve(seed * 100 + unsigned(i), 1 + i % 4, i % 2 == 1));
  return drawing_with(curves);
}

/// A straight line of 40 x 2 mm, from (20, 30) mm.
Drawing one_line(CurveEnds ends = CurveEnds::Flat) {
  Curve curve;
  curve.segments = {CubicBezier::line({20 * kOneMm, 30 * kOneMm}, {60 * kOneMm, 30 * kOneMm})};
  curve.widths = {{0.0, 2 * kOneMm, 1.0, 2 * kOneMm}};
  Drawing drawing = drawing_with({curve});
  auto stroke = std::make_shared<Stroke>(*drawing.layers[0].strokes[0]);
  stroke->ends = ends;
  stroke->fill.reset();
  drawing.layers[0].strokes[0] = stroke;
  return drawing;
}

/// A square of straight lines, 20 mm wide, closed.
Curve square(double left, double top, double side) {
  const std::array<Vector2, 4> corners = {Vector2(left, top), Vector2(left + side, top),
                                          Vector2(left + side, top + side), Vector2(left, top + side)};
  Curve curve;
  for (std::size_t i = 0; i < 4; ++i)
    curve.segments.push_back(CubicBezier::line(corners[i], corners[(i + 1) % 4]));
  curve.closed = true;
  return curve;
}

/// Does every edge have as many triangles one way as the other?
bool is_closed(const geometry::TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> ways;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = triangle[i], b = triangle[(i + 1) % 3];
      ways[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
  return std::ranges::all_of(ways, [](const auto& it) { return it.second == 0; });
}

/// The paler the less opaque it is, as a picture of the drawing has it.
TEST(DrawingShape, LinesThatAreNotOpaqueAreSeenOnTheSheet) {
  Drawing drawing = one_line();
  auto stroke = std::make_shared<Stroke>(*drawing.layers[0].strokes[0]);
  stroke->colour = {1.0F, 0.0F, 0.5F};
  stroke->opacity = 0.25;
  drawing.layers[0].strokes[0] = stroke;
  const auto colour_of_line = [&](double sheet) {
    return (*shape_with(drawing, {.heights = {}, .sheet = sheet})->triangles(0.0))->colours.back()[0];
  };
  const Colour pale = colour_of_line(0.001);
  EXPECT_FLOAT_EQ(pale[0], 1.0F);
  EXPECT_FLOAT_EQ(pale[1], 0.75F);
  EXPECT_FLOAT_EQ(pale[2], 0.875F);
  EXPECT_EQ(colour_of_line(0.0), stroke->colour) << "there is nothing below it";
}

TEST(DrawingShape, ComesBackFromItsBytesAndFromItsText) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Drawing drawing = random_drawing(seed);
    drawing.layers[0].locked = seed % 2 == 0;
    drawing.layers.push_back({drawing.next_layer_id(), "\u00dcber \"alles\"", seed % 3 != 0, false, {}});
    const auto shape = shape_with(drawing, {{0.001, 0.25}, 0.002});
    const auto bytes = shape->write();
    ASSERT_TRUE(bytes) << bytes.error().message;
    const auto back = every_kind_of_shape().read("drawing", *bytes);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ((*back)->hash(), shape->hash());
    EXPECT_EQ(drawing_in(**back)->drawing().next_id, drawing.next_id);
    EXPECT_EQ(*(*back)->write(), *bytes);
    const auto read = shape_of_svg(svg_of(*shape), std::array{0.001, 0.25, 0.002});
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(drawing_in(**read)->body(), shape->body());
    const Drawing& again = drawing_in(**read)->drawing();
    ASSERT_EQ(again.layers.size(), drawing.layers.size());
    for (std::size_t i = 0; i < drawing.layers[0].strokes.size(); ++i) {
      EXPECT_EQ(again.layers[0].strokes[i]->curve, drawing.layers[0].strokes[i]->curve);
      EXPECT_EQ(again.layers[0].strokes[i]->colour, drawing.layers[0].strokes[i]->colour);
    }
  }
}

TEST(DrawingShape, DamagedBytesAreRefusedOrAreASoundDrawing) {
  std::mt19937 random(7);
  const std::string bytes = *shape_with(random_drawing(3))->write();
  std::size_t refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string damaged = bytes.substr(0, i % 5 == 0 ? random() % bytes.size() : bytes.size());
    for (int k = 0; k < 3 && !damaged.empty(); ++k) damaged[random() % damaged.size()] = char(random());
    const auto read = every_kind_of_shape().read("drawing", damaged);
    if (!read) ++refused;
    if (read) {
      EXPECT_TRUE(check_drawing(drawing_in(**read)->drawing()));
      EXPECT_TRUE((*read)->bounds().isEmpty() || (*read)->bounds().min().allFinite());
    }
  }
  EXPECT_GT(refused, 500U);
  EXPECT_LT(refused, 3000U) << "some damage only changes a number";
}

TEST(DrawingShape, RefusesDrawingsThatNoEditsMake) {
  const auto refused = [](const Drawing& drawing, const std::string& why) {
    const auto shape = DrawingShape::create(drawing, {});
    ASSERT_FALSE(shape) << why;
    EXPECT_NE(shape.error().message.find(why), std::string::npos) << shape.error().message;
  };
  const auto with_stroke = [](const std::function<void(Stroke&)>& change) {
    Drawing drawing = one_line();
    auto stroke = std::make_shared<Stroke>(*drawing.layers[0].strokes[0]);
    change(*stroke);
    drawing.layers[0].strokes[0] = stroke;
    return drawing;
  };
  refused(with_stroke([](Stroke& it) { it.id = {}; }), "id");
  refused(with_stroke([](Stroke& it) { it.id = StrokeId{1}; }), "number 1");
  refused(with_stroke([](Stroke& it) { it.curve.segments.clear(); }), "segment");
  refused(with_stroke([](Stroke& it) { it.curve.segments[0].points[1].x() = std::nan(""); }), "not finite");
  refused(with_stroke([](Stroke& it) { it.curve.segments[0].points[1].x() = 1e9; }), "farther than 10 km");
  refused(with_stroke([](Stroke& it) { it.curve.widths[0].from_width = -1.0; }), "width is from 0");
  refused(with_stroke([](Stroke& it) { it.curve.widths[0].to = 0.5; }), "reach");
  refused(with_stroke([](Stroke& it) {
            it.curve.segments.push_back(CubicBezier::line({0.1, 0.1}, {0.2, 0.1}));
            it.curve.widths[0].to = 2.0;
          }),
          "do not join");
  refused(with_stroke([](Stroke& it) { it.opacity = 2.0; }), "opacity");
  Drawing spent = one_line();
  spent.next_id = 1;
  refused(spent, "number");
  EXPECT_FALSE(DrawingShape::create(one_line(), {{0.5, 0.0}, 0.001}));
  EXPECT_FALSE(DrawingShape::create(one_line(), {{0.001, 0.0}, -0.001}));
}

TEST(DrawingShape, ALineIsARidgeOfItsAreaAndHeightOnItsSheet) {
  const double height = 0.5 * kOneMm, sheet = 1.0 * kOneMm;
  const auto shape = shape_with(one_line(), {{height, 0.0}, sheet});
  const auto made = shape->triangles(0.001);
  ASSERT_TRUE(made) << made.error().message;
  const world::MeshGeometry& mesh = **made;
  EXPECT_TRUE(is_closed(mesh.mesh));
  EXPECT_EQ(mesh.colours.size(), mesh.mesh.triangles.size());
  const double paper = 0.297 * 0.210 * sheet;
  EXPECT_NEAR(geometry::signed_volume(mesh.mesh), paper + 40e-3 * 2e-3 * height, 1e-12);
  const base::Bounds box = geometry::bounds(mesh.mesh);
  EXPECT_NEAR(box.max().z(), height, 1e-12);
  EXPECT_NEAR(box.min().z(), -sheet, 1e-12);
  EXPECT_TRUE(shape->bounds().contains(box));
  // Right of the paper's left edge, below its upper one: x = 20 ... 60 mm, y = 30 mm.
  double left = 1.0, top = -1.0;
  for (const base::Vector3& at : mesh.mesh.positions) {
    if (at.z() < 0.4 * height) continue;
    left = std::min(left, at.x());
    top = std::max(top, at.y());
  }
  EXPECT_NEAR(left, -0.5 * 0.297 + 20e-3, 1e-8);
  EXPECT_NEAR(top, 0.5 * 0.210 - 29e-3, 1e-8);
}

TEST(DrawingShape, HeightsFollowTheWidthAndTheSheetMayBeLeftOut) {
  const auto shape = shape_with(one_line(), {{0.5 * kOneMm, 0.25}, 0.0});
  const auto made = shape->triangles(0.001);
  ASSERT_TRUE(made);
  EXPECT_NEAR(geometry::bounds((*made)->mesh).max().z(), 1.0 * kOneMm, 1e-12);
  EXPECT_NEAR(geometry::signed_volume((*made)->mesh), 40e-3 * 2e-3 * 1e-3, 1e-12);
}

TEST(DrawingShape, WhatIsHiddenIsNeitherSeenNorSwept) {
  Drawing drawing = one_line();
  drawing.layers[0].visible = false;
  const auto shape = shape_with(drawing, {{}, 0.0});
  EXPECT_TRUE((*shape->triangles(0.001))->mesh.triangles.empty());
  EXPECT_TRUE(shape->bounds().isEmpty());
  EXPECT_TRUE(shape->flat_curves(0.001)->lines.empty());
}

TEST(DrawingShape, CurvesToSweepAreAreasWithTheirHolesAndLines) {
  Drawing drawing = drawing_with({square(0.05, 0.05, 0.04), square(0.06, 0.06, 0.01)});
  const auto nested = shape_with(drawing)->flat_curves(1e-4);
  ASSERT_TRUE(nested);
  ASSERT_EQ(nested->areas.size(), 1U) << "by the non-zero rule the inner one is covered";
  double area = 0.0;
  const auto& rim = nested->areas[0].rim;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Vector2 a = rim[i], b = rim[(i + 1) % rim.size()];
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_NEAR(area, 0.04 * 0.04, 1e-9) << "counter-clockwise";
  const auto line = shape_with(one_line())->flat_curves(1e-4);
  ASSERT_EQ(line->lines.size(), 1U);
  EXPECT_NEAR((line->lines[0].front() - Vector2(20e-3 - 0.1485, 0.105 - 30e-3)).norm(), 0.0, 1e-8);
  EXPECT_NEAR((line->lines[0].back() - Vector2(60e-3 - 0.1485, 0.105 - 30e-3)).norm(), 0.0, 1e-8);
}

TEST(DrawingShape, AStrokeThatCrossesItselfWithoutAnEndIsRefusedInTime) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.01, 0.2);
  Curve scribble;
  Vector2 at(0.1, 0.1);
  for (int i = 0; i < 800; ++i) {
    const Vector2 next(place(random), place(random));
    scribble.segments.push_back(CubicBezier::line(at, next));
    at = next;
  }
  Drawing drawing = drawing_with({scribble});
  const auto made = shape_with(drawing)->triangles(0.001);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "stroke 2: it crosses itself more than 12000 times");
}

// ---- Edits ----------------------------------------------------------------------------------------------

/// An edit at random that suits the drawing.
DrawingEdit random_edit(const Drawing& drawing, std::mt19937& random) {
  Drawing ids = drawing;
  const Layer& layer = drawing.layers[random() % drawing.layers.size()];
  const auto fresh = [&] {
    return judges::stroke_of(ids.next_stroke_id().value, random_curve(random(), 1 + random() % 3));
  };
  switch (random() % 8) {
    case 0:
      return {PutLayer{ids.next_layer_id(), random() % (drawing.layers.size() + 1), {"l", true, false}}};
    case 1:
      return edit_of(
          ChangeLayer{layer.id, {"name " + std::to_string(random() % 9), random() % 2 == 0, true}});
    case 2:
      return edit_of(MoveLayer{layer.id, random() % drawing.layers.size()});
    case 3:
      return edit_of(ResizePaper{Vector2(0.1 + 0.01 * double(random() % 9), 0.2)});
    case 4:
    case 5:
      if (layer.strokes.empty()) return edit_of(TakeLayer{layer.id});
      return edit_of(TakeStroke{layer.strokes[random() % layer.strokes.size()]->id});
    case 6:
      if (!layer.strokes.empty()) {
        auto changed = std::make_shared<Stroke>(*layer.strokes[random() % layer.strokes.size()]);
        changed->colour = {0.0F, float(random() % 100) / 100.0F, 1.0F};
        changed->ends = CurveEnds::Flat;
        return edit_of(ReplaceStroke{changed});
      }
      [[fallthrough]];
    default: {
      DrawingEdit edit = edit_of(PutStroke{layer.id, random() % (layer.strokes.size() + 1), fresh()});
      edit.push_back(PutStroke{layer.id, 0, fresh()});
      return edit;
    }
  }
}

TEST(DrawingShape, EditsInAWorldDoAndTakeBackWhatTheyDoToADrawing) {
  std::mt19937 random(11);
  world::World world;
  Drawing drawing = random_drawing(1);
  const world::GeometryId id{1};
  ASSERT_TRUE(world::apply(world, world::CreateGeometry{id, shape_with(drawing)}));
  const world::GeometryFactory factory = every_kind_of_shape();
  std::vector<world::Edit> backs;
  std::vector<std::uint64_t> hashes;
  int done = 0;
  for (int i = 0; i < 400; ++i) {
    const DrawingEdit edit = random_edit(drawing, random);
    hashes.push_back(hash(world));
    Drawing expected = drawing;
    const auto plain = apply_edit(expected, edit);
    // Over the wire and back.
    const auto bytes = world::to_bytes(world::AmendGeometry{id, edit_bytes(edit)});
    ASSERT_TRUE(bytes);
    const auto read = world::edit_from_bytes(*bytes, factory);
    ASSERT_TRUE(read) << read.error().message;
    auto back = world::apply(world, *read);
    ASSERT_EQ(back.has_value(), plain.has_value());
    if (!back) {
      EXPECT_EQ(back.error().message, plain.error().message);
      EXPECT_EQ(hash(world), hashes.back()) << "a refused edit changes nothing";
      hashes.pop_back();
      continue;
    }
    ++done;
    drawing = expected;
    if (drawing.layers.empty()) break;
    backs.push_back(std::move(*back));
    EXPECT_EQ(hash_of(drawing_in(*world.find(id)->shape)->drawing()), hash_of(drawing)) << i;
  }
  EXPECT_GT(done, 200);
  while (!backs.empty()) {
    ASSERT_TRUE(world::apply(world, backs.back()));
    EXPECT_EQ(hash(world), hashes.back());
    backs.pop_back();
    hashes.pop_back();
  }
}

TEST(DrawingShape, AChangedDrawingLooksAsOneThatIsMadeAnew) {
  std::mt19937 random(5);
  auto shape = shape_with(random_drawing(2));
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(shape->triangles(0.001));
    const auto amended = shape->amended(edit_bytes(random_edit(shape->drawing(), random)));
    if (!amended) continue;
    if (drawing_in(*amended->shape)->drawing().layers.empty()) break;
    shape = std::static_pointer_cast<const DrawingShape>(amended->shape);
    const auto anew = shape_with(shape->drawing(), shape->body());
    EXPECT_EQ((*shape->triangles(0.001))->hash(), (*anew->triangles(0.001))->hash()) << i;
  }
}

TEST(DrawingShape, DamagedEditsAreRefusedAndChangeNothing) {
  std::mt19937 random(9);
  const auto shape = shape_with(random_drawing(4));
  const std::uint64_t before = shape->hash();
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = edit_bytes(random_edit(shape->drawing(), random));
    for (int k = 0; k < 3; ++k) bytes[random() % bytes.size()] = char(random());
    if (i % 7 == 0) bytes.resize(random() % bytes.size());
    const auto amended = shape->amended(bytes);
    if (amended) {
      EXPECT_TRUE(check_drawing(drawing_in(*amended->shape)->drawing()));
    }
    EXPECT_EQ(shape->hash(), before);
  }
}

TEST(DrawingShape, ShapesOfOtherKindsHaveNoStrokes) {
  world::World world;
  ASSERT_TRUE(world::apply(
      world, world::CreateGeometry{{1}, std::make_shared<world::MeshGeometry>(geometry::TriangleMesh{})}));
  const auto refused = world::apply(world, world::AmendGeometry{{1}, edit_bytes({TakeStroke{StrokeId{1}}})});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("mesh"), std::string::npos);
  EXPECT_FALSE(world::apply(world, world::AmendGeometry{{2}, ""}));
}

}  // namespace
}  // namespace icome::drawing
