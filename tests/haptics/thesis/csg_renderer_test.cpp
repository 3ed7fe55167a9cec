// Algorithms 5.1 to 5.4 of the thesis on its spheres and cubes (figures 5.7 to 5.11), worked out by hand, and
// slides over its example tree (figure 5.6) against the constrained nearest point.
#include "haptics/thesis/csg_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "geometry/csg_trees.h"
#include "haptics/contact_world.h"
#include "haptics/csg_world.h"

namespace icome::haptics {
namespace {

using geometry::Affine3;
using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::Primitive;
using geometry::SurfacePoint;

CsgTree combined(CsgOperator op, const Primitive& left, const Affine3& at_left, const Primitive& right,
                 const Affine3& at_right) {
  CsgTree tree;
  const CsgTree::Index one = tree.add_leaf(left, at_left);
  const CsgTree::Index two = tree.add_leaf(right, at_right);
  tree.add(op, one, two);
  return tree;
}

const Primitive kCube = geometry::Box{{1.0, 1.0, 1.0}};
const Primitive kBall = geometry::Sphere{1.0};

/// A renderer and what it remembers.
struct Touch {
  explicit Touch(const CsgTree& tree) : renderer(*CsgRenderer::create(tree)) {}

  std::optional<SurfacePoint> operator()(const Vector3& pointer) {
    const auto answer = renderer.scp(pointer, memory, space);
    if (!answer) return std::nullopt;
    return answer->place;
  }
  /// The answer when the last SCP and pointer were these.
  std::optional<SurfacePoint> after(const Vector3& scp, const Vector3& last, const Vector3& pointer) {
    memory = {{scp, Vector3::UnitZ()}, last, true};
    return (*this)(pointer);
  }

  CsgRenderer renderer;
  CsgWorkspace space;
  DirectMemory memory;
};

void expect_place(const std::optional<SurfacePoint>& found, const Vector3& point, const Vector3& normal) {
  ASSERT_TRUE(found);
  EXPECT_LT((found->point - point).norm(), 1e-12) << found->point.transpose();
  EXPECT_LT((found->normal - normal).norm(), 1e-12) << found->normal.transpose();
}

// ---- Algorithm 5.1, figure 5.8 ----

TEST(ThesisIntersection, TakesTheNearerSurface) {
  Touch touch(combined(CsgOperator::Intersection, kCube, moved(0, 0, 0), kBall, moved(1, 1, 0)));
  expect_place(touch({0.9, 0.8, 0.0}), {1.0, 0.8, 0.0}, Vector3::UnitX());
  const Vector3 in = Vector3(-0.6, -0.5, 0.0).normalized();
  touch.memory = DirectMemory::free_at({0.2, 0.3, 0.0});
  expect_place(touch({0.4, 0.5, 0.0}), Vector3(1.0, 1.0, 0.0) + in, in);
}

TEST(ThesisIntersection, IsFreeOutsideEither) {
  Touch touch(combined(CsgOperator::Intersection, kCube, moved(0, 0, 0), kBall, moved(1, 1, 0)));
  EXPECT_FALSE(touch({-0.5, 0.0, 0.0}));
  EXPECT_FALSE(touch({1.2, 1.0, 0.0}));
  EXPECT_FALSE(touch.memory.touching);
  EXPECT_EQ(touch.memory.scp.point, Vector3(1.2, 1.0, 0.0));
}

TEST(ThesisIntersection, StaysFrom50TimesAsFar) {
  Touch touch(combined(CsgOperator::Intersection, kCube, moved(0, 0, 0), kBall, moved(1, 1, 0)));
  const Vector3 pointer(0.9, 0.8, 0.0), on_cube(1.0, 0.8, 0.0);
  const Vector3 on_ball = Vector3(1, 1, 0) + Vector3(-0.1, -0.2, 0.0).normalized();
  const Vector3 away = (on_ball - on_cube).normalized();
  const double apart = (on_ball - on_cube).norm();
  // The previous SCP lies `way` beyond the ball's, so (apart + way) / way is the ratio.
  const auto after_ratio = [&](double ratio) {
    return touch.after(on_ball + apart / (ratio - 1.0) * away, pointer, pointer);
  };
  expect_place(after_ratio(49.0), on_cube, Vector3::UnitX());
  ASSERT_TRUE(after_ratio(51.0));
  EXPECT_LT((after_ratio(51.0)->point - on_ball).norm(), 1e-12);
  EXPECT_LT((touch.after(on_ball, pointer, pointer)->point - on_ball).norm(), 1e-12);  // infinitely far
  EXPECT_LT((touch.after(on_cube, pointer, pointer)->point - on_cube).norm(), 1e-12);
}

TEST(ThesisIntersection, BothScpsMayBeThePreviousOne) {
  Touch touch(combined(CsgOperator::Intersection, kCube, moved(0, 0, 0), kCube, moved(0, 0, 0)));
  const Vector3 pointer(0.0, 0.3, 0.9);
  for (int i = 0; i < 3; ++i) expect_place(touch(pointer), {0.0, 0.3, 1.0}, Vector3::UnitZ());
}

// ---- Algorithms 5.2 and 5.3, figures 5.9 and 5.10 ----

TEST(ThesisDifference, TakesTheScpNearerToThePrevious) {
  Touch touch(combined(CsgOperator::Difference, kBall, moved(0, 0, 0), kCube, moved(1, 1, 0)));
  const Vector3 pointer(-0.1, 0.3, 0.0);
  // The cube's face is felt from its inside: its normal points into the hollow.
  expect_place(touch.after({0.0, 0.35, 0.0}, pointer, pointer), {0.0, 0.3, 0.0}, Vector3::UnitX());
  const Vector3 out = pointer.normalized();
  expect_place(touch.after({-0.3, 0.95, 0.0}, pointer, pointer), out, out);
  EXPECT_FALSE(touch({0.1, 0.3, 0.0}));
}

TEST(ThesisDifference, FeelsTheInsideOfACubeBySegments) {
  const Primitive ball = geometry::Sphere{10.0};
  Touch touch(combined(CsgOperator::Difference, ball, moved(0, 0, 0), kCube, moved(0, 0, 0)));
  const auto from_hollow = [&](const Vector3& pointer) { return touch.after({0, 0, 0}, pointer, pointer); };
  expect_place(from_hollow({1.3, 0.2, -0.4}), {1.0, 0.2, -0.4}, -Vector3::UnitX());
  expect_place(from_hollow({1.3, -1.4, 0.5}), {1.0, -1.0, 0.5}, Vector3(-0.6, 0.8, 0.0));
  expect_place(from_hollow({-1.1, 1.2, 1.2}), {-1.0, 1.0, 1.0}, Vector3(1.0, -2.0, -2.0) / 3.0);
}

// ---- Algorithm 5.4, figure 5.11: a ball half sunk into the top of a cube ----

CsgTree ball_on_cube() {
  return combined(CsgOperator::Union, kCube, moved(0, 0, 0), Primitive(geometry::Sphere{0.8}),
                  moved(0, 1, 0));
}

TEST(ThesisUnion, TakesTheOperandThatHoldsThePointer) {
  Touch touch(ball_on_cube());
  expect_place(touch({-0.9, 0.0, 0.0}), {-1.0, 0.0, 0.0}, -Vector3::UnitX());
  touch.memory = DirectMemory::free_at({0.0, 2.0, 0.0});
  expect_place(touch({0.0, 1.7, 0.0}), {0.0, 1.8, 0.0}, Vector3::UnitY());
  EXPECT_FALSE(touch({0.9, 1.1, 0.0}));
}

TEST(ThesisUnion, TakesTheScpNearerToThePreviousWhereBothHoldThePointer) {
  CsgTree tree = combined(CsgOperator::Union, kCube, moved(0, 0, 0), kCube, moved(0.9, 0, 0.5));
  Touch touch(tree);
  const Vector3 pointer(0.0, 0.0, -0.45);  // in both; the cubes' nearest faces are z = -1 and z = -0.5
  expect_place(touch.after({0.0, 0.0, -0.9}, pointer, pointer), {0.0, 0.0, -1.0}, -Vector3::UnitZ());
  // Nearer to the other, which is buried; then the previous SCP is the candidate, in the first cube only.
  expect_place(touch.after({0.0, 0.0, -0.6}, pointer, pointer), {0.0, 0.0, -1.0}, -Vector3::UnitZ());
}

TEST(ThesisUnion, MovesThePreviousScpWhereBothAreBuried) {
  Touch touch(ball_on_cube());
  const Vector3 pointer(0.78, 0.97, 0.0);  // both SCPs, (0.78, 1, 0) and (0.799, 0.969, 0), lie in the other
  // The candidate (0.81, 0.99, 0) is in the cube only, and the cube's SCP for it is free.
  expect_place(touch.after({0.83, 1.0, 0.0}, {0.80, 0.98, 0.0}, pointer), {0.81, 1.0, 0.0}, Vector3::UnitY());
  EXPECT_EQ(touch.memory.pointer, pointer);
}

TEST(ThesisUnion, KeepsThePreviousScpWhereTheCandidateFailsToo) {
  Touch touch(ball_on_cube());
  const Vector3 pointer(0.78, 0.97, 0.0);
  // The candidate (0.79, 0.99, 0) is as buried as the pointer.
  expect_place(touch.after({0.81, 1.0, 0.0}, {0.80, 0.98, 0.0}, pointer), {0.81, 1.0, 0.0}, Vector3::UnitZ());
  // The candidate (0.81, 1.03, 0) is in neither.
  expect_place(touch.after({0.83, 1.0, 0.0}, {0.80, 0.94, 0.0}, pointer), {0.83, 1.0, 0.0}, Vector3::UnitZ());
}

TEST(ThesisUnion, PushesTowardsThePreviousScpWhenThatWasFree) {
  Touch touch(ball_on_cube());
  touch.memory = DirectMemory::free_at({0.82, 1.02, 0.0});
  const auto found = touch({0.78, 0.97, 0.0});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->point, Vector3(0.82, 1.02, 0.0));
  EXPECT_LT((found->normal - Vector3(0.04, 0.05, 0.0).normalized()).norm(), 1e-12);
}

TEST(ThesisUnion, ASharedFaceIsInNeither) {
  const Primitive plate = geometry::Box{{1.0, 1.0, 0.1}};
  Touch touch(combined(CsgOperator::Union, plate, moved(0, 0, 0), plate, moved(1, 0, 0)));
  for (const double x : {-0.5, 0.0, 0.3, 0.7, 1.0, 1.5}) {
    touch.memory = DirectMemory::free_at({x, 0.0, 0.2});
    expect_place(touch({x, 0.0, 0.07}), {x, 0.0, 0.1}, Vector3::UnitZ());
  }
}

// ---- Trees ----

/// A ball that counts what it is asked, and answers nothing but the three questions.
class CountingBall final : public geometry::CsgPrimitive {
 public:
  bool inside(const Vector3& p) const override { return ++asked, p.norm() <= 1.0; }
  SurfacePoint scp_from_inside(const Vector3& p) const override {
    return ++asked, SurfacePoint{p.normalized(), p.normalized()};
  }
  SurfacePoint scp_from_outside(const Vector3& p) const override { return scp_from_inside(p); }
  base::Bounds bounds() const override { return {Vector3::Constant(-1.0), Vector3::Constant(1.0)}; }
  TriangleMesh tessellate(double) const override { return {}; }
  std::string name() const override { return "counting ball"; }

  mutable int asked = 0;
};

TEST(CsgRenderer, AsksAPrimitiveOfYourOwnOnlyWhereItIs) {
  const auto near = std::make_shared<CountingBall>(), far = std::make_shared<CountingBall>(),
             cut = std::make_shared<CountingBall>();
  CsgTree tree;
  CsgTree::Index all = tree.add_leaf(geometry::CsgShape(near));
  all = tree.add(CsgOperator::Difference, all, tree.add_leaf(geometry::CsgShape(cut), moved(0, 1.5, 0)));
  tree.add(CsgOperator::Union, all, tree.add_leaf(geometry::CsgShape(far), moved(5, 0, 0)));
  Touch touch(tree);
  touch.memory = DirectMemory::free_at({0.0, -1.1, 0.0});
  const int asked_before = far->asked;
  expect_place(touch({0.0, -0.9, 0.0}), {0.0, -1.0, 0.0}, -Vector3::UnitY());
  EXPECT_EQ(far->asked, asked_before);
  EXPECT_EQ(near->asked, 2);  // inside, and its SCP
  touch.memory = DirectMemory::free_at({0.0, 0.6, 0.0});
  expect_place(touch({0.0, 0.4, 0.0}), {0.0, 0.5, 0.0}, Vector3::UnitY());
}

TEST(CsgRenderer, RendersAnyFormOfTree) {
  // X - (Y u Z) and X - (Y - Z) are not in sub-normal form.
  for (const CsgOperator op : {CsgOperator::Union, CsgOperator::Difference, CsgOperator::Intersection}) {
    CsgTree tree;
    const CsgTree::Index x = tree.add_leaf(Primitive(geometry::Box{{3, 3, 3}}));
    const CsgTree::Index y = tree.add_leaf(kCube);
    const CsgTree::Index z = tree.add_leaf(kBall, moved(1, 0, 0));
    tree.add(CsgOperator::Difference, x, tree.add(op, y, z));
    Touch touch(tree);
    Random random(1);
    for (int i = 0; i < 2000; ++i) {
      const Vector3 p(random.uniform(-3.2, 3.2), random.uniform(-3.2, 3.2), random.uniform(-3.2, 3.2));
      EXPECT_EQ(touch.renderer.inside(p), geometry::inside(tree, p));
      EXPECT_EQ(touch(p).has_value(), geometry::inside(tree, p));
    }
  }
}

TEST(CsgRenderer, IsInsideWhereTheTreeIsOnRandomTrees) {
  Random random(7);
  for (int i = 0; i < repeats(60); ++i) {
    const CsgTree tree = geometry::random_tree(random, {.leaves = 2 + random.index(12)});
    const auto renderer = CsgRenderer::create(tree);
    ASSERT_TRUE(renderer) << renderer.error().message;
    CsgWorkspace space;
    for (int k = 0; k < 100; ++k) {
      const Vector3 p(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5));
      EXPECT_EQ(renderer->inside(p), geometry::inside(tree, p));
      DirectMemory memory = DirectMemory::free_at(p + 0.01 * random.direction());
      const auto answer = renderer->scp(p, memory, space);
      ASSERT_EQ(answer.has_value(), renderer->inside(p));
      if (!answer) continue;
      EXPECT_TRUE(answer->place.point.allFinite());
      EXPECT_NEAR(answer->place.normal.norm(), 1.0, 1e-9);
      EXPECT_FALSE(answer->exhausted);
    }
  }
}

TEST(CsgRenderer, AnEmptyTreeIsNothing) {
  Touch touch(CsgTree{});
  EXPECT_FALSE(touch({0.0, 0.0, 0.0}));
  EXPECT_FALSE(touch.renderer.inside({0.0, 0.0, 0.0}));
  EXPECT_TRUE(touch.renderer.bounds().isEmpty());
}

CsgTree chain(int leaves, double step) {
  CsgTree tree;
  CsgTree::Index all = tree.add_leaf(kBall);
  for (int i = 1; i < leaves; ++i) {
    const CsgTree::Index next = tree.add_leaf(kBall, moved(i * step, 0, 0));
    all = tree.add(CsgOperator::Union, all, next);
  }
  return tree;
}

TEST(CsgRenderer, RefusesATreeThatIsTooLarge) {
  const auto renderer = CsgRenderer::create(chain(17'000, 1e-3));
  ASSERT_FALSE(renderer);
  EXPECT_NE(renderer.error().message.find("33999"), std::string::npos) << renderer.error().message;
}

TEST(CsgRenderer, ADeepTreeKeepsToItsBudget) {
  // Every ball holds the pointer and buries the others' SCPs: each pair would have to be asked.
  Touch touch(chain(15'000, 1e-6));
  touch.memory = DirectMemory::free_at({-0.98, 0.0, 0.0});
  const auto answer = touch.renderer.scp({0.02, 0.0, 0.0}, touch.memory, touch.space);
  ASSERT_TRUE(answer);
  EXPECT_TRUE(answer->place.point.allFinite());
  EXPECT_TRUE(!answer->exhausted || answer->place.point == Vector3(-0.98, 0.0, 0.0));
}

// ---- The tree of figure 5.6, figure_5_6() ----

constexpr double kHalf = 0.05, kRadius = 0.065, kHole = 0.025;  // m

/// Its solid by its definition.
struct Figure {
  static bool inside(const Vector3& p) {
    return p.cwiseAbs().maxCoeff() <= kHalf && p.norm() <= kRadius && p.head<2>().norm() > kHole;
  }
  /// The nearest free place: all edges are convex, so that it is one of three.
  static Vector3 nearest_free(const Vector3& p) {
    int axis;
    p.cwiseAbs().maxCoeff(&axis);
    Vector3 best = p;
    best[axis] = std::copysign(kHalf, p[axis]);
    const double hole = kHole / p.head<2>().norm();
    for (const Vector3& q : {Vector3(p * (kRadius / p.norm())), Vector3(hole * p.x(), hole * p.y(), p.z())})
      if ((q - p).norm() < (best - p).norm()) best = q;
    return best;
  }
  /// The constrained nearest place: from `place` towards the pointer by small steps, each put back to the
  /// nearest free place.
  static Vector3 constrained(Vector3 place, const Vector3& pointer) {
    constexpr double kStep = 2e-5;  // m: cannot hop over what is farther than this
    for (int i = 0; i < 1000; ++i) {
      const Vector3 way = pointer - place;
      if (way.isZero(0.0)) return place;
      const Vector3 next = place + std::min(1.0, kStep / way.norm()) * way;
      place = inside(next) ? nearest_free(next) : next;
    }
    return place;
  }
};

struct SlideErrors {
  std::vector<double> constrained, nearest;  // m, of every tick in touch

  void print(const char* title) {
    for (auto* errors : {&constrained, &nearest}) {
      std::sort(errors->begin(), errors->end());
      const auto at = [&](double share) {
        return 1e6 * (*errors)[std::size_t(share * double(errors->size() - 1))];
      };
      std::printf(
          "          %s, to the %s point: %zu ticks, median %.2g um, 99 %% %.2g, 99.9 %% %.3g, max %.4g um\n",
          title, errors == &constrained ? "constrained" : "nearest", errors->size(), at(0.5), at(0.99),
          at(0.999), at(1.0));
    }
  }
};

/// Presses straight in, then slides sideways, from random places of the surface.
SlideErrors slide(double press, double step, int slides) {
  SlideErrors errors;
  Touch touch(figure_5_6(1.0));
  Random random(3);
  for (int i = 0; i < slides; ++i) {
    Vector3 in;
    do {
      in = kHalf * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    } while (!Figure::inside(in));
    const Vector3 on = Figure::nearest_free(in), normal = (on - in).normalized();
    const Vector3 side = normal.cross(random.direction()).normalized();
    Vector3 p = on + 0.3 * step * normal, truth = p;
    touch.memory = DirectMemory::free_at(p);
    const int press_ticks = int(press / step) + 1;
    for (int tick = 0; tick < press_ticks + int(0.03 / step); ++tick) {
      p += step * (tick < press_ticks ? Vector3(-normal) : side);
      const auto found = touch(p);
      EXPECT_EQ(found.has_value(), Figure::inside(p));
      if (!found) break;
      truth = Figure::constrained(truth, p);
      if ((truth - p).norm() > 2.0 * press) break;  // into the depth of another side
      errors.constrained.push_back((found->point - truth).norm());
      errors.nearest.push_back((found->point - Figure::nearest_free(p)).norm());
    }
  }
  return errors;
}

TEST(CsgRenderer, SlidesOverTheTreeOfFigure56) {
  for (const double press : {3e-4, 1e-3}) {
    SlideErrors errors = slide(press, 2e-4, repeats(100));
    errors.print(press < 5e-4 ? "pressed 0.3 mm" : "pressed 1 mm");
    ASSERT_GE(errors.constrained.size(), std::size_t(repeats(5000)));
    const auto share_above = [](const std::vector<double>& sorted, double limit) {
      return double(sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), limit)) /
             double(sorted.size());
    };
    // On faces it is exact. Near an edge the nearer face wins before the pointer has gone round: then the SCP
    // is off by as much as it is pressed in, for a few ticks.
    EXPECT_LT(share_above(errors.constrained, 1e-7), 0.02);
    EXPECT_LT(share_above(errors.constrained, 3e-5), 0.02);
    EXPECT_LT(errors.constrained.back(), 1.5 * press);
  }
}

TEST(CsgRenderer, DoesNotDependOnSize) {
  Touch one(figure_5_6(1.0)), other(figure_5_6(1024.0));
  Random random(4);
  Vector3 p(0.0, 0.0, 0.06);
  one.memory = DirectMemory::free_at(p);
  other.memory = DirectMemory::free_at(1024.0 * p);
  Vector3 goal = p;
  for (int i = 0; i < 20'000; ++i) {
    if ((goal - p).norm() < 1e-3) goal = 0.06 * random.direction();
    p += 2e-4 * (goal - p).normalized();
    const auto a = one(p), b = other(1024.0 * p);
    ASSERT_EQ(a.has_value(), b.has_value());
    ASSERT_TRUE(!a || (1024.0 * a->point - b->point).norm() < 1e-9);
  }
}

}  // namespace
}  // namespace icome::haptics
