// What the solver makes ready when the force is out: it takes work out of the way between tip and force.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

constexpr double kBumpyRadius = 0.05;  // m

/// A mesh that counts how often it was asked for what is near.
class CountingShape final : public Shape {
 public:
  explicit CountingShape(const MeshPointer& mesh) : shape_(shape_of(mesh)) {}

  Bounds bounds() const override { return shape_->bounds(); }
  void gather(const GatherRequest& request, ElementSink& sink) const override {
    ++gathers;
    shape_->gather(request, sink);
  }
  void expand(std::uint32_t piece, double tip, TouchableSides sides, PieceElements& elements) const override {
    shape_->expand(piece, tip, sides, elements);
  }
  std::optional<geometry::SurfacePoint> way_out(const Vector3& position, double time) const override {
    return shape_->way_out(position, time);
  }
  std::optional<ShapeHit> cast(const Vector3& start, const Vector3& step, double time) const override {
    return shape_->cast(start, step, time);
  }
  std::size_t bytes() const override { return shape_->bytes(); }

  mutable int gathers = 0;

 private:
  std::shared_ptr<const Shape> shape_;
};

/// Two runs along the same spiral 2 mm deep in a bumpy sphere.
struct Slides {
  int gathered_in_steps = 0;  // by the solver that looks ahead
  int gathered_without = 0;   // in the steps of the one that does not
  int apart = 0;              // ticks in which the two SCPs are, by more than 1 um
};

Slides slide(double speed, int ticks) {
  const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(60, kBumpyRadius, 0.04, 9));
  const auto ahead_shape = std::make_shared<CountingShape>(mesh);
  const auto plain_shape = std::make_shared<CountingShape>(mesh);
  Toucher ahead(HapticScene::compile({object(1, ahead_shape)}));
  Toucher plain(HapticScene::compile({object(1, plain_shape)}));
  Slides result;
  for (int i = 0; i < ticks; ++i) {
    const double turn = speed * i / kBumpyRadius;
    const double polar = 1.5 + 0.3 * std::sin(0.23 * turn);
    const Vector3 out(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar));
    const double depth = std::min(0.002, 2e-5 * i - 0.003);  // m, once it has come down
    const Vector3 tip = (kBumpyRadius - depth) * out;
    const int before = ahead_shape->gathers;
    const Vector3 one = ahead.step(tip).scp;
    result.gathered_in_steps += ahead_shape->gathers - before;
    ahead.solver.look_ahead();
    if ((one - plain.step(tip).scp).norm() > 1e-6) ++result.apart;
  }
  result.gathered_without = plain_shape->gathers;
  return result;
}

// Where the SCP comes free of a hollow by either of two ways, a region that ends elsewhere may lead it by the
// other one.
TEST(ScpLookAhead, TakesGatheringOutOfTheSteps) {
  constexpr int kTicks = 4000;
  for (const double speed : {0.0001, 0.0005}) {  // m a tick
    const Slides slides = slide(speed, kTicks);
    EXPECT_GT(slides.gathered_without, kTicks / 20);
    EXPECT_LT(slides.gathered_in_steps, 0.4 * slides.gathered_without);
    EXPECT_LT(slides.apart, kTicks / 50);
  }
}

TEST(ScpLookAhead, WaitsForAStartAndForAScene) {
  ScpSolver solver;
  solver.look_ahead();
  const ScenePointer scene = HapticScene::compile({object(1, shape_of(primitive("box:1x1x1")))});
  solver.adopt(*scene, {});
  solver.look_ahead();
  solver.step({0.0, 0.0, 0.6}, 0.0);
  solver.look_ahead();
  EXPECT_NEAR(solver.step({0.0, 0.0, 0.4}, 0.0).scp.z(), 0.5, 1e-6);
  const ScenePointer empty = HapticScene::compile({});
  solver.adopt(*empty, {});
  solver.look_ahead();
  EXPECT_FALSE(solver.step({0.0, 0.0, 0.3}, 0.0).touching);
}

TEST(ContactRegion, TellsHowMuchOfAStepStaysWithin) {
  Random random(5);
  const ScenePointer scene = HapticScene::compile({});
  ContactRegion region;
  const auto anywhere = [&](double size) { return Vector3(size * random.uniform() * random.direction()); };
  for (int i = 0; i < 10'000; ++i) {
    const Vector3 a = anywhere(1.0);
    const Vector3 b = i % 10 == 0 ? a : Vector3(a + anywhere(2.0));
    const double reach = random.uniform(0.01, 1.0);
    region.start(*scene, {Vector3::Zero()}, a, b, reach);
    const Vector3 from = a + random.uniform() * (b - a) + anywhere(0.999 * reach);
    const Vector3 step = i % 7 == 0 ? Vector3(3.0 * (b - a)) : anywhere(4.0);
    if (step.isZero(0.0)) continue;
    const double share = region.share_within(from, step);
    ASSERT_GE(share, 0.0);
    ASSERT_LE(share, 1.0);
    ASSERT_GE(region.clearance(from + share * step), 0.0) << i;
    if (share < 1.0 && share > 0.0) {
      ASSERT_LT(region.clearance(from + 1.0011 * share * step), 1e-12) << i;
    }
    if (share == 0.0) {
      ASSERT_LT(region.clearance(from + 1e-6 * step), 0.0) << i;
    }
  }
}

/// The features of the faces near a place that lie under it, ascending.
std::vector<std::uint32_t> faces_around(ContactRegion& region, const Vector3& place, double distance) {
  std::vector<Element> elements(256);
  elements.resize(std::min(elements.size(), region.around(place, distance, elements)));
  std::vector<std::uint32_t> faces;
  for (const Element& element : elements) {
    if (element.flat() && covers(element, place, region.tolerance())) faces.push_back(element.feature);
  }
  std::ranges::sort(faces);
  return faces;
}

// A mesh that is kept whole is swept through its tree, else by the pieces that were gathered.
TEST(ContactRegion, MeetsTheSameWhetherMeshesAreKeptWholeOrNot) {
  Random random(12);
  TriangleMesh rough = geometry::bumpy_geodesic_sphere(30, 0.05, 0.05, 8);
  for (Vector3& p : rough.positions) p *= 1.0 + random.uniform(-0.005, 0.005);
  const double radius = 0.003;
  HapticObject turned = object(1, shape_of(shared(rough), true, radius));
  turned.world_from_object = Pose(Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, -1.0).normalized()));
  turned.world_from_object.translation() = Vector3(0.2, 0.1, -0.3);
  HapticObject ball = object(2, shape_of(geometry::Sphere{0.01}));
  ball.world_from_object.translation() = turned.world_from_object * Vector3(0.0, 0.0, 0.055);
  const ScenePointer scene = HapticScene::compile({turned, ball});
  const ContactRegion::Frame frame{Vector3(0.19, 0.1, -0.3), radius};
  const Vector3 middle = turned.world_from_object.translation() - frame.origin;
  ContactRegion pieces, whole;
  int met = 0, kept_whole = 0;
  for (int i = 0; i < repeats(2000); ++i) {
    const Vector3 start = middle + random.uniform(0.054, 0.062) * random.direction();
    const Vector3 step = std::pow(10.0, random.uniform(-5.0, -1.7)) * random.direction();
    pieces.start(*scene, frame, start, start + step, 0.001);
    scene->gather(pieces);
    whole.start(*scene, frame, start, start + step, 0.001);
    whole.keep_whole();
    scene->gather(whole);
    kept_whole += pieces.size() > 10 && whole.size() < 3;
    const SweepHit one = pieces.sweep(start, step, {});
    const SweepHit other = whole.sweep(start, step, {});
    ASSERT_EQ(one.met, other.met) << i;
    ASSERT_EQ(one.t, other.t) << i;
    ASSERT_EQ(pieces.tolerance().gap, whole.tolerance().gap);
    met += one.met;
    if (one.met) {
      const SweepHit next = pieces.sweep(start, step, std::span(&one.contact, 1));
      ASSERT_EQ(next.t, whole.sweep(start, step, std::span(&other.contact, 1)).t) << i;
    }
    ASSERT_EQ(faces_around(pieces, start, 1e-3), faces_around(whole, start, 1e-3)) << i;
  }
  EXPECT_GT(met, repeats(2000) / 40);
  EXPECT_GT(kept_whole, repeats(2000) / 40);
}

// A sphere tip that is pulled far ahead over what will stop it at once.
TEST(ContactRegion, AsksLittleOfALongStepThatIsStoppedSoon) {
  const double radius = 0.001;
  const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(100, kBumpyRadius, 0.0, 0));
  const ScenePointer scene = HapticScene::compile({object(1, shape_of(mesh, true, radius))});
  const Vector3 start(0.0, 0.0, kBumpyRadius + 1.001 * radius);
  const Vector3 step(0.012, 0.0, -0.002);
  ContactRegion region;
  region.start(*scene, {Vector3::Zero(), radius}, start, start + step, 0.002);
  scene->gather(region);
  ASSERT_GT(region.size(), 400u);
  const std::uint64_t before = region.work();
  const SweepHit hit = region.sweep(start, step, {});
  EXPECT_TRUE(hit.met);
  EXPECT_LT(hit.t, 0.1);
  EXPECT_LT(region.work() - before, 200u);
}

}  // namespace
}  // namespace icome::haptics
