// What the mouse drags of shapes with the Shape tool.
#include "ui/tools/shape_tool.h"

#include <QComboBox>
#include <QLabel>
#include <QSpinBox>
#include <cmath>

#include "ui/desktop_test.h"
#include "ui/forms/quantity_field.h"
#include "ui/tools/scene_tools.h"
#include "ui/tools/shape_options.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::ui {
namespace {

using base::Vector3;
using interaction::ShapingTarget;

/// An upright sheet of 0.4 m with nine vertices, the one in its middle (4) at the origin; the eye 2 m before
/// it.
class ShapeToolTest : public DesktopTest {
 protected:
  ShapeToolTest() : tools_(session(), {.refused = [this](const std::string& why) { refused_ += why; }}) {
    sheet_ = add("sheet", upright_sheet(), 0.0);
    interaction::View view;
    view.world_from_eye.translation() = Vector3(0.0, 0.0, 2.0);
    view.distance = 2.0;
    session().view().set(view);
    tools_.resize({800.0, 600.0});
    session().settle();
    session().update();
    tools_.choose(Tool::Shape);
  }

  static world::GeometryPointer upright_sheet() {
    geometry::TriangleMesh mesh;
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) mesh.positions.emplace_back(0.2 * i, 0.2 * j, 0.0);
    }
    mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}, {4, 5, 8}, {4, 8, 7}};
    return std::make_shared<world::MeshGeometry>(std::move(mesh));
  }
  world::ObjectId add(const char* name, const world::GeometryPointer& made, double x) {
    const auto shape = session().ids().next<world::GeometryId>();
    const auto id = session().ids().next<world::ObjectId>();
    world::PhysicalObject object{.name = name, .geometry = shape};
    object.parent_from_object.translation().x() = x;
    perform(world::EditGroup{{world::CreateGeometry{shape, made}, world::CreateObject{id, 0, object}}});
    return id;
  }
  void set(const interaction::ShapingSettings& settings) { tools_.shape_tool().set(settings); }
  const std::vector<Vector3>& vertices() {
    return interaction::draggable_mesh(*world().find(world().find(sheet_)->geometry)->shape)->positions;
  }

  SceneInput input_at(const Vector3& point, Qt::MouseButton button = Qt::NoButton) {
    const interaction::View& view = session().view().now();
    const Vector3 seen = view.world_from_eye.inverse() * point;
    const double scale = 300.0 / (std::tan(0.5 * view.field) * -seen.z());
    SceneInput input;
    input.at = {400.0 + scale * seen.x(), 300.0 - scale * seen.y()};
    input.size = {800.0, 600.0};
    input.button = button;
    return input;
  }
  void tick() {
    tools_.tick();
    session().update();
  }
  void press(const Vector3& at) {
    tools_.press(input_at(at, Qt::LeftButton));
    tick();
  }
  void move(const Vector3& to) {
    tools_.move(input_at(to));
    tick();
  }
  void drag(const Vector3& from, const Vector3& to) {
    press(from);
    for (int i = 1; i <= 5; ++i) move(from + 0.2 * i * (to - from));
    tools_.release(input_at(to, Qt::LeftButton));
    session().settle();
    session().update();
  }

  std::string refused_;
  SceneTools tools_;
  world::ObjectId sheet_;
};

TEST_F(ShapeToolTest, AVertexFollowsTheMouseAsOneAction) {
  const std::uint64_t before = hash(world());
  const std::vector<Vector3> rest = vertices();
  drag({0.0, 0.0, 0.0}, {0.05, 0.08, 0.0});
  EXPECT_LT((vertices()[4] - Vector3(0.05, 0.08, 0.0)).norm(), 1e-9);
  for (std::size_t v = 0; v < rest.size(); ++v) EXPECT_TRUE(v == 4 || vertices()[v] == rest[v]) << v;
  EXPECT_EQ(session().history().undo_name(), "Drag vertex of sheet");
  drag({0.05, 0.08, 0.0}, {0.0, 0.1, 0.0});
  EXPECT_LT((vertices()[4] - Vector3(0.0, 0.1, 0.0)).norm(), 1e-9) << "it is found where it is now";
  ASSERT_TRUE(session().history().undo());
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(hash(world()), before);
  EXPECT_EQ(refused_, "");
}

TEST_F(ShapeToolTest, EdgesAndFacesAndWhatIsRoundThemFollow) {
  set({.target = ShapingTarget::Edge});
  drag({0.1, 0.0, 0.0}, {0.1, 0.05, 0.0});
  EXPECT_NEAR(vertices()[4].y(), 0.05, 1e-9);
  EXPECT_NEAR(vertices()[5].y(), 0.05, 1e-9);
  EXPECT_EQ(vertices()[3].y(), 0.0);
  ASSERT_TRUE(session().history().undo());
  session().settle();
  session().update();
  set({.target = ShapingTarget::Face, .soft = {.radius = 0.25, .falloff = geometry::Falloff::Linear}});
  drag({0.12, 0.05, 0.0}, {0.12, 0.15, 0.0});
  for (const int v : {4, 5, 8}) EXPECT_NEAR(vertices()[v].y(), (v == 8 ? 0.2 : 0.0) + 0.1, 1e-9) << v;
  EXPECT_NEAR(vertices()[3].y(), 0.1 * (1.0 - 0.2 / 0.25), 1e-9);
  EXPECT_EQ(session().history().undo_name(), "Drag face of sheet");
}

TEST_F(ShapeToolTest, KeepsToAnAxisAndEscapeBringsItBack) {
  const std::uint64_t before = hash(world());
  press({0.0, 0.0, 0.0});
  tools_.key_press(Qt::Key_X, {}, false);
  move({0.1, 0.07, 0.0});
  EXPECT_NEAR(vertices()[4].x(), 0.1, 1e-3);
  EXPECT_EQ(vertices()[4].y(), 0.0);
  tools_.key_release(Qt::Key_X);
  move({0.1, 0.08, 0.0});
  EXPECT_NEAR(vertices()[4].y(), 0.08, 1e-9);
  EXPECT_TRUE(tools_.dragging());
  tools_.key_press(Qt::Key_Escape, {}, false);
  EXPECT_EQ(hash(world()), before);
  EXPECT_EQ(session().history().undo_name(), "Edit");
  EXPECT_FALSE(tools_.dragging());
  EXPECT_EQ(tools_.tool(), Tool::Shape) << "the next one leaves the tool";
}

TEST_F(ShapeToolTest, PointsOfTheLatticeDeformTheSelection) {
  set({.target = ShapingTarget::Lattice, .cells = {2, 2, 1}});
  session().update();
  EXPECT_FALSE(session().hands().shaping()->cage()) << "nothing is selected";
  drag({0.1, 0.05, 0.0}, {0.1, 0.05, 0.0});  // a click
  EXPECT_EQ(session().selection(), std::vector{sheet_});
  ASSERT_TRUE(session().hands().shaping()->cage());
  const std::uint64_t before = hash(world());
  const std::vector<Vector3> rest = session().hands().shaping()->cage()->lattice().points;
  // The near face of the box is nearest to the eye: its middle point is (1, 1, 1).
  const std::size_t middle = session().hands().shaping()->cage()->lattice().index({1, 1, 1});
  drag(rest[middle], rest[middle] + Vector3(0.1, 0.0, 0.0));
  EXPECT_NEAR(vertices()[4].x(), 0.1 * 0.25 * 0.5, 1e-9) << "B(1,2)^2 B(1,1) in the middle";
  EXPECT_EQ(vertices()[0], Vector3(-0.2, -0.2, 0.0));
  EXPECT_EQ(session().history().undo_name(), "Deform sheet");
  EXPECT_NEAR(session().hands().shaping()->cage()->lattice().points[middle].x(), 0.1, 1e-9);
  ASSERT_TRUE(session().history().undo());
  EXPECT_EQ(hash(world()), before);
  session().update();
  EXPECT_EQ(session().hands().shaping()->cage()->lattice().points, rest) << "at rest again";
}

TEST_F(ShapeToolTest, WhatHasNoVerticesSaysWhatToDo) {
  const auto box =
      add("box", std::make_shared<world::PrimitiveGeometry>(geometry::Box{Vector3::Constant(0.1)}), 1.0);
  session().select({box});
  ShapeOptions options(session(), tools_.shape_tool(), nullptr);
  auto* target = options.findChild<QComboBox*>("shape.target");
  target->setCurrentIndex(3);
  session().update();
  options.tick();
  const QString why = options.findChild<QLabel*>("shape.complaint")->text();
  EXPECT_TRUE(why.contains("'box' is an exact shape")) << why.toStdString();
  session().select({sheet_});
  session().update();
  options.tick();
  EXPECT_EQ(options.findChild<QLabel*>("shape.complaint")->text(), "");
}

TEST_F(ShapeToolTest, TheRowOfOptionsSetsWhatIsDragged) {
  ShapeOptions options(session(), tools_.shape_tool(), nullptr);
  auto* radius = options.findChild<QuantityField*>("shape.radius");
  radius->setText("25");
  emit radius->textEdited("25");
  EXPECT_TRUE(options.finish_typing());
  EXPECT_NEAR(tools_.shape_tool().settings().soft.radius, 0.025, 1e-12);
  radius->setText("-3");
  emit radius->textEdited("-3");
  EXPECT_FALSE(options.finish_typing());
  EXPECT_NEAR(tools_.shape_tool().settings().soft.radius, 0.025, 1e-12);
  options.findChild<QComboBox*>("shape.target")->setCurrentIndex(3);
  EXPECT_TRUE(radius->isHidden());
  options.findChild<QSpinBox*>("shape.cells.1")->setValue(4);
  EXPECT_EQ(tools_.shape_tool().settings().cells, (std::array{2, 4, 2}));
  EXPECT_EQ(session().hands().shaping()->settings().target, ShapingTarget::Lattice);
}

TEST_F(ShapeToolTest, LeavingTheToolGivesObjectsBack) {
  press({0.0, 0.0, 0.0});
  move({0.0, 0.05, 0.0});
  tools_.choose(Tool::Select);
  EXPECT_FALSE(session().hands().shaping());
  EXPECT_NEAR(vertices()[4].y(), 0.05, 1e-9) << "it stays where it is";
  EXPECT_EQ(session().history().undo_name(), "Drag vertex of sheet");
}

}  // namespace
}  // namespace icome::ui
