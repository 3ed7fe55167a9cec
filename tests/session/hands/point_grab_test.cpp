// Points of shapes that are taken hold of by a device with a button, and what the hand feels of them.
#include "session/hands/point_grab.h"

#include "render/live_renderer.h"
#include "session/hands/one_hand.h"
#include "session/sessions.h"

namespace icome::session {
namespace {

using base::Vector3;
using interaction::ShapingTarget;

/// A level sheet of 1 m with a vertex every 0.25 m, number 12 in its middle, at the origin.
world::GeometryPointer level_sheet() {
  geometry::TriangleMesh mesh;
  for (int j = 0; j <= 4; ++j) {
    for (int i = 0; i <= 4; ++i) mesh.positions.emplace_back(0.25 * i - 0.5, 0.0, 0.5 - 0.25 * j);
  }
  for (std::uint32_t j = 0; j < 4; ++j) {
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t at = 5 * j + i;
      mesh.triangles.push_back({at, at + 1, at + 6});
      mesh.triangles.push_back({at, at + 6, at + 5});
    }
  }
  return std::make_shared<world::MeshGeometry>(std::move(mesh));
}

/// A session with one device, the tip of which is 3 mm above the middle of a sheet that is selected.
class PointGrabTest : public OneHandTest {
 protected:
  void SetUp() override {
    start_with_hand();
    sheet_ = add_shape(*session_, level_sheet(), world::at(0.0, 0.0, 0.0), "sheet");
    session_->select({sheet_});
    settle();
    put(Vector3(0.0, 0.003, 0.0));
  }

  void shape(const interaction::ShapingSettings& settings) {
    const auto done = session_->hands().set_shaping(settings);
    ASSERT_TRUE(done) << done.error().message;
    for (int i = 0; i < 3; ++i) session_->update();
  }
  const std::vector<Vector3>& vertices() const {
    const world::World& world = session_->world();
    return interaction::draggable_mesh(*world.find(world.find(sheet_)->geometry)->shape)->positions;
  }

  world::ObjectId sheet_;
};

TEST_F(PointGrabTest, AVertexGoesAlongWithTheHandAsOneAction) {
  shape({});
  const std::uint64_t before = hash(session_->world());
  const std::vector<Vector3> rest = vertices();
  grab();
  const Vector3 from = tip();
  aim(Vector3(0.05, 0.15, -0.02));
  run_until(*session_, [&] { return tip().y() > 0.1; });
  ASSERT_TRUE(session_->hands().holds(0));
  EXPECT_LT((vertices()[12] - rest[12] - (tip() - from)).norm(), 2e-3) << "it is where the hand is";
  EXPECT_EQ(vertices()[13], rest[13]);
  EXPECT_EQ(session_->history().undo_name(), "Drag vertex of sheet");
  let_go();
  const std::vector<Vector3> left = vertices();
  aim(Vector3(0.0, 0.5, 0.0));
  run_until(*session_, [&] { return tip().y() > 0.4; });
  EXPECT_EQ(vertices(), left) << "it stays where it was left";
  ASSERT_TRUE(session_->history().undo());
  EXPECT_EQ(hash(session_->world()), before);
  EXPECT_EQ(session_->history().undo_name(), "Add sheet");
}

TEST_F(PointGrabTest, PullsBackTheMoreTheFartherItWasTaken) {
  shape({.soft = {.radius = 0.3}});
  grab();
  const Vector3 from = tip();
  double last = 0.0;
  for (const double way : {0.02, 0.05, 0.12}) {
    aim(from + Vector3(0.0, way, 0.0));
    run_until(*session_, [&] {
      const double taken = (tip() - from).norm();
      const double wanted = haptics::pull_back(haptics::GripFeel{}, taken);
      return taken > 0.6 * way && std::abs(-session_->hands().pointer(0).force.y() - wanted) < 0.02;
    });
    EXPECT_GT(-session_->hands().pointer(0).force.y(), last + 0.05) << way;
    last = -session_->hands().pointer(0).force.y();
  }
  let_go();
  run_until(*session_, [&] { return session_->hands().pointer(0).force.norm() < 0.02; });
}

TEST_F(PointGrabTest, PullsNothingBackWhereThatIsNotWanted) {
  session_->hands().set_grab({.pull_back = false});
  shape({});
  grab();
  aim(Vector3(0.0, 0.1, 0.0));
  run_until(*session_, [&] { return tip().y() > 0.08; });
  EXPECT_LT(session_->hands().pointer(0).force.norm(), 0.02);
}

TEST_F(PointGrabTest, AFaceMovesAsItIsWithOthersRoundIt) {
  shape({.target = ShapingTarget::Face, .soft = {.radius = 0.3}});
  const std::vector<Vector3> rest = vertices();
  put(Vector3(0.16, 0.003, -0.08));  // over the triangle of 12, 13 and 18
  grab();
  aim(Vector3(0.16, 0.12, -0.08));
  run_until(*session_, [&] { return tip().y() > 0.1; });
  let_go();
  const double up = vertices()[12].y();
  EXPECT_GT(up, 0.08);
  for (const std::uint32_t corner : {12U, 13U, 18U}) EXPECT_NEAR(vertices()[corner].y(), up, 1e-12);
  EXPECT_GT(vertices()[7].y(), 0.0) << "0.25 m off";
  EXPECT_LT(vertices()[7].y(), up);
  EXPECT_EQ(vertices()[0], rest[0]);
}

TEST_F(PointGrabTest, APointOfTheLatticeDeformsTheSelection) {
  shape({.target = ShapingTarget::Lattice, .cells = {1, 1, 1}});
  const std::uint64_t before = hash(session_->world());
  ASSERT_TRUE(session_->hands().shaping()->cage());
  const Vector3 corner = session_->hands().shaping()->cage()->lattice().points[7];
  put(corner + Vector3(0.002, 0.0, 0.0));
  grab();
  const Vector3 from = tip();
  aim(corner + Vector3(0.0, 0.2, 0.0));
  run_until(*session_, [&] { return tip().y() > corner.y() + 0.15; });
  EXPECT_EQ(session_->history().undo_name(), "Deform sheet");
  const Vector3 moved = session_->hands().shaping()->cage()->lattice().points[7];
  EXPECT_LT((moved - corner - (tip() - from)).norm(), 2e-3);
  // The sheet is in the middle of a box that was made thick.
  EXPECT_NEAR(vertices()[4].y(), 0.5 * (moved - corner).y(), 1e-9);
  EXPECT_NEAR(vertices()[0].y(), 0.0, 1e-12);
  let_go();
  ASSERT_TRUE(session_->history().undo());
  EXPECT_EQ(hash(session_->world()), before);
  session_->update();
  EXPECT_LT((session_->hands().shaping()->cage()->lattice().points[7] - corner).norm(), 1e-12);
}

TEST_F(PointGrabTest, LetsGoWhenTheWorldIsChangedByOthersAndWhenShapingEnds) {
  shape({});
  const std::vector<Vector3> rest = vertices();
  grab();
  aim(Vector3(0.0, 0.1, 0.0));
  run_until(*session_, [&] { return vertices()[12].y() > 0.05; });
  ASSERT_TRUE(session_->history().undo());
  run_until(*session_, [&] { return !session_->hands().holds(0); });
  for (int i = 0; i < 20; ++i) session_->update();
  EXPECT_EQ(vertices(), rest) << "the button is still down, but nothing is held";
  hand_->hold_buttons(0);
  put(Vector3(0.0, 0.003, 0.0));
  grab();
  ASSERT_TRUE(session_->hands().set_shaping(std::nullopt));
  EXPECT_FALSE(session_->hands().holds(0));
  EXPECT_FALSE(session_->hands().shaping());
}

TEST_F(PointGrabTest, SettingsThatMeanNothingChangeNothing) {
  EXPECT_FALSE(session_->hands().set_shaping(interaction::ShapingSettings{.soft = {.radius = -1.0}}));
  EXPECT_FALSE(session_->hands().shaping());
  shape({.target = ShapingTarget::Edge});
  EXPECT_FALSE(session_->hands().set_shaping(interaction::ShapingSettings{.cells = {0, 1, 1}}));
  ASSERT_TRUE(session_->hands().shaping());
  EXPECT_EQ(session_->hands().shaping()->settings().target, ShapingTarget::Edge);
}

TEST_F(PointGrabTest, HandlesAreSeen) {
  if (!render::Offscreen::create()) GTEST_SKIP() << "there is no OpenGL without a window here";
  interaction::View view;
  view.world_from_eye = base::Pose(Eigen::AngleAxisd(-0.5, Vector3::UnitX()));
  view.world_from_eye.translation() = view.world_from_eye.linear() * Vector3(0.0, 0.0, 2.5);
  view.distance = 2.5;
  const auto pixels_of_marks = [&] {
    session_->view().set(view);
    DisplayWish look;
    look.look = render::plain_look();
    look.pointers = false;
    session_->view().set_look(look);
    session_->settle();
    session_->update();
    render::LiveRenderer live;
    EXPECT_TRUE(session_->view().display().draw(live.renderer(), live.target()));
    std::vector<std::uint8_t> rgba(4U * std::size_t(live.target().width) * std::size_t(live.target().height));
    glBindFramebuffer(GL_FRAMEBUFFER, live.target().frame);
    glReadPixels(0, 0, live.target().width, live.target().height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
    std::pair<int, int> count;  // blue, orange
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
      count.first += rgba[i + 2] > 120 && rgba[i] < rgba[i + 2] / 2 ? 1 : 0;
      count.second += rgba[i] > 150 && rgba[i + 2] < rgba[i] / 2 ? 1 : 0;
    }
    return count;
  };
  put(Vector3(0.0, 0.8, 0.0));
  const auto none = pixels_of_marks();
  shape({});
  const auto dots = pixels_of_marks();
  session_->stage().mark_handle(interaction::MarkedHandle{
      .handle = {.object = sheet_, .part = {.kind = interaction::PartKind::Vertex, .vertices = {12}}}});
  const auto marked = pixels_of_marks();
  EXPECT_GT(dots.first, none.first + 25 * 10) << "a dot for each vertex";
  EXPECT_GT(marked.second, dots.second + 20) << "what the mouse is over";
  session_->stage().mark_handle(std::nullopt);
}

}  // namespace
}  // namespace icome::session
