// Where many faces meet in a point the SCP goes on if there is any way on, judged by trying ways against
// every triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "haptics/contact_world.h"
#include "haptics/judge/contact_judge.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

constexpr double kPi = 3.141592653589793;

enum class Fold { Convex, Concave, Mixed };

/// A solid below faces that meet at the origin, closed far down. Convex: a peak; concave: a pit; mixed:
/// ridges and valleys.
TriangleMesh random_fan(Random& random, Fold fold) {
  const auto count = std::uint32_t(3 + random.index(10));
  std::vector<double> angles(count);
  // No gap of half a turn or more: every face stands over the plane as one of a height field does.
  do {
    for (double& angle : angles) angle = random.uniform(0.0, 2.0 * kPi);
    std::sort(angles.begin(), angles.end());
  } while ([&] {
    double widest = angles.front() + 2.0 * kPi - angles.back();
    double narrowest = widest;
    for (std::size_t i = 1; i < angles.size(); ++i) {
      widest = std::max(widest, angles[i] - angles[i - 1]);
      narrowest = std::min(narrowest, angles[i] - angles[i - 1]);
    }
    return widest > 0.9 * kPi || narrowest < 0.02;
  }());
  const double steep = std::pow(10.0, random.uniform(-1.5, 0.5));
  TriangleMesh mesh;
  mesh.positions.push_back(Vector3::Zero());
  for (const double angle : angles) {
    const double height = fold == Fold::Convex    ? -steep
                          : fold == Fold::Concave ? steep
                                                  : random.uniform(-steep, steep);
    mesh.positions.emplace_back(std::cos(angle), std::sin(angle), height);
  }
  mesh.positions.emplace_back(0.0, 0.0, -10.0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t here = 1 + i, next = 1 + (i + 1) % count;
    mesh.triangles.push_back({0, here, next});
    mesh.triangles.push_back({count + 1, next, here});
  }
  return mesh;
}

/// How much nearer (m) to the tip some straight free move of this length leads; of moves straight on, along
/// any face, along any edge, and anywhere.
double best_free_move(const TriangleMesh& mesh, const Vector3& scp, const Vector3& tip, double length,
                      Random& random) {
  const Vector3 pull = tip - scp;
  double best = 0.0;
  const auto attempt = [&](const Vector3& along) {
    const double norm = along.norm();
    if (norm < 1e-9) return;
    const Vector3 direction = along / norm;
    // Not closely along a face: whether that is free is for rounding to say.
    for (const double lift : {1e-4, 1e-3}) {
      const Vector3 way = length * (direction + lift * Vector3::UnitZ());
      const double nearer = pull.norm() - (pull - way).norm();
      // A way through a vertex crosses no face for sure: its end tells then.
      if (nearer > best && !brute_crosses(mesh, scp, scp + way, false) &&
          brute_winding(mesh, scp + way) < 0.5)
        best = nearer;
    }
  };
  attempt(pull);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 out = face_normal(mesh, i);
    attempt(pull - out.dot(pull) * out);
    const Vector3 edge = (mesh.corner(i, 1) - mesh.corner(i, 0)).normalized();
    attempt(edge * edge.dot(pull));
  }
  for (int i = 0; i < 20; ++i) attempt(pull.normalized() + random.direction());
  return best;
}

class Fans : public testing::TestWithParam<Fold> {};

INSTANTIATE_TEST_SUITE_P(Folds, Fans, testing::Values(Fold::Convex, Fold::Concave, Fold::Mixed),
                         [](const auto& it) {
                           return it.param == Fold::Convex    ? "Convex"
                                  : it.param == Fold::Concave ? "Concave"
                                                              : "Mixed";
                         });

struct Outcome {
  int stuck = 0;   // rests where a free way leads to the tip that friction does not hold
  int inside = 0;  // rests within the solid
};

Outcome touch_fans(Fold fold, double friction, int fans) {
  Random random(17);
  Outcome outcome;
  const double held = friction / std::hypot(1.0, friction);
  for (int i = 0; i < fans; ++i) {
    const MeshPointer mesh = shared(random_fan(random, fold));
    HapticObject touched = object(1, shape_of(mesh));
    touched.surface.static_friction = friction;
    touched.surface.dynamic_friction = 0.8 * friction;
    Toucher toucher(HapticScene::compile({touched}));
    toucher.step({0.0, 0.0, 0.3});
    toucher.step({0.0, 0.0, -1e-3});  // to the apex, or to a side of it
    Vector3 pull = random.direction();
    pull.z() = -std::abs(pull.z());
    const Vector3 tip = 0.3 * random.uniform(0.01, 1.0) * pull;
    const ScpState& state = toucher.step(tip);
    if (brute_winding(*mesh, state.scp) > 0.5) ++outcome.inside;
    if (state.scp.head<2>().norm() > 0.5 || !state.touching) continue;  // it has left the fan
    const double left = (tip - state.scp).norm();
    if (left < 1e-3) continue;
    const double length = std::min(1e-3, 0.1 * left);
    if (best_free_move(*mesh, state.scp, tip, length, random) > (held + 0.02) * length) ++outcome.stuck;
  }
  return outcome;
}

TEST_P(Fans, LetTheScpGoOnWhereThereIsAWay) {
  const int fans = kSanitizerShare > 1 ? 500 : 35'000;
  const Outcome outcome = touch_fans(GetParam(), 0.0, fans);
  // Between faces that are folded back onto each other the SCP may lie too deep for a way's length to tell.
  EXPECT_LE(outcome.stuck, fans / 10'000) << "of " << fans;
  EXPECT_EQ(outcome.inside, 0) << "of " << fans;
}

TEST_P(Fans, LetFrictionHoldWithinItsConeOnly) {
  const int fans = repeats(5'000);
  const Outcome outcome = touch_fans(GetParam(), 0.4, fans);
  EXPECT_EQ(outcome.stuck, 0) << "of " << fans;
  EXPECT_EQ(outcome.inside, 0) << "of " << fans;
}

/// A narrow valley that bends at the origin: the walls are of two and of four faces.
TriangleMesh bent_valley() {
  TriangleMesh mesh;
  mesh.positions = {{0.0, 0.0, 0.0},
                    {-0.0500, 0.2562, 0.9653},
                    {-0.2664, -0.6081, 0.7478},
                    {0.2508, 0.4394, -0.8626},
                    {0.7208, -0.6519, -0.2355},
                    {0.6994, -0.7107, 0.0762},
                    {0.6219, -0.6020, 0.5008},
                    {0.8, 2.8, 0.2}};
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t here = 1 + i, next = 1 + (i + 1) % 6;
    mesh.triangles.push_back({0, here, next});
    mesh.triangles.push_back({7, next, here});
  }
  return mesh;
}

// In the bend the SCP is held by three walls a little before the vertex, and lies below the plane of the wall
// that begins there: its way on is along that wall's edge, and above it.
TEST(Fan, LetsTheScpGoRoundABendOfAValley) {
  const MeshPointer mesh = shared(bent_valley());
  const Vector3 crease = mesh->positions[1];
  const Vector3 pull(0.1424, 0.9550, -0.2603);
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    Toucher toucher(HapticScene::compile({object(1, shape_of(mesh))}));
    const Vector3 deep = 0.3 * (pull + 0.05 * random.direction());
    toucher.step(0.05 * crease - 0.5 * pull);
    for (int tick = -20; tick <= 20; ++tick) {
      const Vector3 tip = -0.002 * tick * crease + deep;
      const ScpState& state = toucher.step(tip);
      EXPECT_LT(best_free_move(*mesh, state.scp, tip, 1e-3, random), 0.02e-3) << i << " " << tick;
    }
  }
}

/// A disc with a sector cut out; the caps are of triangles around the corner of the notch.
TriangleMesh notched_disc(std::uint32_t count) {
  std::vector<base::Vector2> outline{{0.0, 0.0}};
  std::vector<TriangleMesh::Triangle> caps;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 0.6 + (2.0 * kPi - 1.2) * i / (count - 1);
    outline.emplace_back(0.02 * std::cos(angle), 0.02 * std::sin(angle));
    if (i > 0) caps.push_back({0, i, i + 1});
  }
  return prism(outline, caps, 0.02);
}

// At the end of the notch 26 to 46 faces meet, and the tip is level with the cap.
TEST(Fan, LetsTheScpGoWhereManyFacesMeet) {
  for (const std::uint32_t count : {24u, 30u, 45u}) {
    const MeshPointer mesh = shared(notched_disc(count));
    Toucher toucher(HapticScene::compile({object(1, shape_of(mesh))}));
    ContactJudge judge({{mesh}}, {});
    const auto feel = [&](const Vector3& tip) {
      const ScpState& state = toucher.step(tip);
      return judge.judge({tip, state.scp, state.touching});
    };
    feel({0.01, 0.0, 0.0});
    for (int tick = 0; tick < 140; ++tick) {
      const Vector3 tip(-4e-4, 1e-5 * (tick % 7), 1e-4 * std::min(tick, 100));
      const Judgement judgement = feel(tip);
      EXPECT_FALSE(judgement.pop || judgement.stick || judgement.silent) << count << " " << tick;
    }
  }
}

}  // namespace
}  // namespace icome::haptics
