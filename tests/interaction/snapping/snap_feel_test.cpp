#include "interaction/snapping/snap_feel.h"

#include "interaction/snapping/clutter.h"

namespace icome::interaction {
namespace {

Snap snap_of(SnapKind kind) {
  Snap snap;
  snap.kind = kind;
  snap.point = {0.1, 0.2, 0.3};
  snap.direction = Vector3(1.0, 2.0, -1.0).normalized();
  snap.from = snap.point - 0.004 * snap.direction;
  snap.to = snap.point + 0.02 * snap.direction;
  return snap;
}

SnapWell well_of(SnapKind kind, const WellSettings& settings) {
  return *well_around(snap_of(kind), settings);
}

TEST(SnapWell, IsMinusTheGradientOfABoundedEnergy) {
  base::Random random(31);
  const WellSettings settings{0.8, 0.012};
  for (const SnapKind kind :
       {SnapKind::Vertex, SnapKind::Middle, SnapKind::Edge, SnapKind::Face, SnapKind::Grid}) {
    const SnapWell well = well_of(kind, settings);
    const auto effect = effect_of(well);
    double strongest = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3 there = Vector3(0.1, 0.2, 0.3) + random.uniform(0.0, 0.02) * random.direction();
      const Vector3 force = well_force(well, there);
      strongest = std::max(strongest, force.norm());
      const double energy = well_energy(well, there);
      EXPECT_LE(energy, 0.0);
      EXPECT_GE(energy, -0.583 * settings.strength * settings.radius);
      constexpr double kStep = 1e-6;
      for (int axis = 0; axis < 3; ++axis) {
        const Vector3 step = kStep * Vector3::Unit(axis);
        const double slope =
            (well_energy(well, there + step) - well_energy(well, there - step)) / (2.0 * kStep);
        EXPECT_NEAR(force[axis], -slope, 2e-4 * settings.strength);
      }
      haptics::EffectInput input;
      input.position = there;
      EXPECT_EQ(effect->force(input), force);
    }
    EXPECT_LE(strongest, settings.strength * (1.0 + 1e-12));
    EXPECT_GT(strongest, 0.99 * settings.strength);  // what the user asked for
  }
}

TEST(SnapWell, BeginsAtTheRimWithoutAJump) {
  const WellSettings settings{2.0, 0.01};
  for (const SnapKind kind : {SnapKind::Vertex, SnapKind::Edge, SnapKind::Face}) {
    const SnapWell well = well_of(kind, settings);
    const Vector3 direction = snap_of(kind).direction;
    const Vector3 out = kind == SnapKind::Face ? direction : Vector3(direction.unitOrthogonal());
    const auto force = [&](double r) { return well_force(well, Vector3(0.1, 0.2, 0.3) + r * out).norm(); };
    EXPECT_EQ(force(0.0100001), 0.0);
    EXPECT_LT(force(0.01 - 1e-6), 1e-6);
    EXPECT_NEAR(force(0.01 / std::sqrt(5.0)), 2.0, 1e-12);
    double last = 0.0;
    for (double r = 0.0; r < 0.012; r += 1e-6) {  // nowhere steeper than at the centre
      EXPECT_LT(std::abs(force(r) - last), 1.001 * 2.0 * 3.494 / 0.01 * 1e-6);
      last = force(r);
    }
  }
}

TEST(SnapWell, LetsTheHandMoveAlongWhatItSnapsTo) {
  const WellSettings settings{1.0, 0.01};
  const SnapWell edge = well_of(SnapKind::Edge, settings), face = well_of(SnapKind::Face, settings);
  const Vector3 direction = snap_of(SnapKind::Edge).direction, across = direction.unitOrthogonal();
  const Vector3 point(0.1, 0.2, 0.3);
  EXPECT_LT(well_force(edge, point + 0.01 * direction).norm(), 1e-12);
  EXPECT_LT(std::abs(well_force(edge, point + 0.003 * across + 0.01 * direction).dot(direction)), 1e-12);
  EXPECT_GT(well_force(edge, point + 0.024 * direction).norm(), 0.1);  // beyond its end
  EXPECT_LT(well_force(face, point + 5.0 * across).norm(), 1e-9);
  EXPECT_LT(well_force(face, point + 0.003 * direction).cross(direction).norm(), 1e-12);
  const Vector3 hand(0.5, -0.2, 0.0);
  EXPECT_LT((well_force(edge.moved_by(hand), point + hand + 0.003 * across) -
             well_force(edge, point + 0.003 * across))
                .norm(),
            1e-9);
}

TEST(SnapWell, RefusesWhatCannotBe) {
  for (const double bad : {double(NAN), -1.0, double(INFINITY)}) {
    EXPECT_FALSE(well_around(snap_of(SnapKind::Edge), {bad, 0.01}));
    EXPECT_FALSE(well_around(snap_of(SnapKind::Edge), {1.0, bad}));
  }
  EXPECT_FALSE(well_around(snap_of(SnapKind::Edge), {1.0, 0.0}));
  EXPECT_TRUE(
      well_force(well_of(SnapKind::Vertex, {0.0, 0.01}), {0.1, 0.2, 0.301}).isZero(0.0));  // switched off
}

TEST(ContactForce, IsASpringThatPullsBackOnly) {
  const CouplingSettings settings{300.0, 2.0, 5.0};
  const Vector3 stopped(0.0, 0.7, 0.0), wanted(0.0, 0.69, 0.0);
  const auto force = [&](const Vector3& hand, const Vector3& approach) {
    return contact_force(hand, stopped, approach, settings);
  };
  EXPECT_LT((force(wanted, Vector3::Zero()) - Vector3(0.0, 3.0, 0.0)).norm(), 1e-12);
  EXPECT_LT((force(wanted, {0.0, -0.2, 0.0}) - Vector3(0.0, 3.4, 0.0)).norm(), 1e-12);  // going in
  EXPECT_LT((force(wanted, {0.0, 0.2, 0.0}) - Vector3(0.0, 2.6, 0.0)).norm(), 1e-12);   // coming out
  EXPECT_LT((force(wanted, {7.0, 0.0, -3.0}) - Vector3(0.0, 3.0, 0.0)).norm(), 1e-12);  // along it
  EXPECT_TRUE(force(wanted, {0.0, 100.0, 0.0}).isZero(0.0));
  EXPECT_NEAR(force({0.0, -5.0, 0.0}, Vector3::Zero()).norm(), 5.0, 1e-12);
  EXPECT_TRUE(force(stopped, {0.0, -9.0, 0.0}).isZero(0.0));
  EXPECT_LT(force({0.0, 0.7 - 1e-7, 0.0}, {0.0, -9.0, 0.0}).norm(), 1e-4);  // no jump, however fast
  EXPECT_TRUE(force({NAN, 0.0, 0.0}, Vector3::Zero()).isZero(0.0));
  EXPECT_TRUE(force(wanted, {NAN, 0.0, 0.0}).isZero(0.0));
  EXPECT_TRUE(contact_force(wanted, stopped, Vector3::Zero(), {NAN, 0.0, 5.0}).isZero(0.0));
}

std::vector<Contact> contacts_of(const std::vector<Vector3>& normals) {
  std::vector<Contact> contacts;
  for (const Vector3& it : normals) contacts.push_back({{}, {}, it.normalized()});
  return contacts;
}

TEST(Holding, FindsTheFewestSidesThatAPushPressesAgainst) {
  // A floor, a wall, and what edges make of both.
  const auto contacts = contacts_of({{-1, 1, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 1, -1}});
  const auto normals = [&](const Vector3& push) {
    std::vector<Vector3> result;
    for (const Contact& it : holding(contacts, push)) result.push_back(it.normal);
    return result;
  };
  EXPECT_EQ(normals({0, -0.01, 0}), std::vector<Vector3>{Vector3::UnitY()});
  EXPECT_EQ(normals({0.01, 0, 0}), std::vector<Vector3>{-Vector3::UnitX()});
  const std::vector<Vector3> corner = normals({0.01, -0.03, 0});
  ASSERT_EQ(corner.size(), 2U);
  EXPECT_EQ(normals({0.01, -0.04, 0.02}).size(), 3U);
  EXPECT_TRUE(normals({0, 0.01, 0}).empty()) << "away from all of them";
  EXPECT_TRUE(normals(Vector3::Zero()).empty());
  EXPECT_TRUE(normals({0, NAN, 0}).empty());
  EXPECT_TRUE(holding({}, Vector3::UnitX()).empty());
  EXPECT_EQ(holding(contacts_of({{0, 1, 0}, {0, 1, 0}}), -Vector3::UnitY()).size(), 1U) << "one side twice";
}

}  // namespace
}  // namespace icome::interaction
