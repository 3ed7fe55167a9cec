#include "geometry/deform/free_form_deformation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace icome::geometry {
namespace {

using base::Affine3;
using Cells = std::array<int, 3>;

Affine3 askew_box() {
  Affine3 box = Affine3::Identity();
  box.translate(Vector3(0.3, -0.2, 1.0));
  box.rotate(Eigen::AngleAxisd(0.7, Vector3(1.0, 2.0, 3.0).normalized()));
  box.scale(Vector3(0.2, 0.5, 0.1));
  return box;
}

std::vector<Vector3> places_in(const Affine3& box, int count, base::Random& random) {
  std::vector<Vector3> places;
  for (int i = 0; i < count; ++i)
    places.push_back(box * Vector3(random.uniform(), random.uniform(), random.uniform()));
  return places;
}

double binomial(int n, int k) { return std::tgamma(n + 1) / (std::tgamma(k + 1) * std::tgamma(n - k + 1)); }

/// Equation 2 of Sederberg and Parry, word for word.
Vector3 by_the_paper(const FfdLattice& lattice, const Vector3& place) {
  const Vector3 stu = lattice.space_from_box.inverse() * place;
  const auto [l, m, n] = lattice.cells;
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i <= l; ++i) {
    for (int j = 0; j <= m; ++j) {
      for (int k = 0; k <= n; ++k) {
        const double share = binomial(l, i) * std::pow(1.0 - stu.x(), l - i) * std::pow(stu.x(), i) *
                             binomial(m, j) * std::pow(1.0 - stu.y(), m - j) * std::pow(stu.y(), j) *
                             binomial(n, k) * std::pow(1.0 - stu.z(), n - k) * std::pow(stu.z(), k);
        sum += share * lattice.points[lattice.index({i, j, k})];
      }
    }
  }
  return sum;
}

TEST(FreeFormDeformation, LeavesEveryVertexWhereItWasWhenNoPointIsMoved) {
  base::Random random(1);
  for (const Cells& cells : {Cells{1, 1, 1}, Cells{3, 2, 5}, Cells{12, 1, 9}}) {
    const auto lattice = make_ffd_lattice(askew_box(), cells);
    ASSERT_TRUE(lattice) << lattice.error().message;
    const auto places = places_in(askew_box(), 200, random);
    const FfdBinding binding(places, *lattice);
    EXPECT_EQ(binding.vertices().size(), places.size());
    EXPECT_EQ(binding.deformed(*lattice), places);  // bit for bit
  }
}

TEST(FreeFormDeformation, MovesEveryVertexByTheAffineMapOfAllPoints) {
  base::Random random(2);
  auto lattice = *make_ffd_lattice(askew_box(), {3, 4, 2});
  const auto places = places_in(askew_box(), 500, random);
  const FfdBinding binding(places, lattice);
  Affine3 map;
  map.linear() << 1.3, 0.4, -0.2, 0.1, 0.6, 0.9, -0.7, 0.2, 1.1;
  map.translation() = Vector3(3.0, -2.0, 0.5);
  map.makeAffine();
  for (Vector3& point : lattice.points) point = map * point;
  const auto moved = binding.deformed(lattice);
  for (std::size_t i = 0; i < places.size(); ++i) EXPECT_LT((moved[i] - map * places[i]).norm(), 1e-14);
}

TEST(FreeFormDeformation, DoesWhatThePaperSays) {
  base::Random random(3);
  auto lattice = *make_ffd_lattice(askew_box(), {4, 3, 6});
  const auto places = places_in(askew_box(), 300, random);
  const FfdBinding binding(places, lattice);
  for (Vector3& point : lattice.points) point += 0.3 * random.direction();
  const auto moved = binding.deformed(lattice);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_LT((moved[i] - by_the_paper(lattice, places[i])).norm(), 1e-13);
}

TEST(FreeFormDeformation, SharesOfAllPointsAddUpToOne) {
  base::Random random(4);
  const auto lattice = *make_ffd_lattice(askew_box(), {5, 2, 3});
  const FfdBinding binding(places_in(askew_box(), 100, random), lattice);
  std::vector<double> sums(100, 0.0);
  for (int i = 0; i <= 5; ++i) {
    for (int j = 0; j <= 2; ++j) {
      for (int k = 0; k <= 3; ++k) {
        const auto shares = binding.shares({i, j, k});
        for (std::size_t v = 0; v < shares.size(); ++v) {
          EXPECT_GE(shares[v], 0.0);
          sums[v] += shares[v];
        }
      }
    }
  }
  for (const double sum : sums) EXPECT_NEAR(sum, 1.0, 1e-14);
}

TEST(FreeFormDeformation, ADraggedPointTakesVerticesAlongByTheirShares) {
  base::Random random(5);
  auto lattice = *make_ffd_lattice(askew_box(), {3, 3, 3});
  const auto places = places_in(askew_box(), 100, random);
  const FfdBinding binding(places, lattice);
  const auto shares = binding.shares({1, 3, 0});
  const Vector3 way(0.1, 0.2, -0.3);
  lattice.points[lattice.index({1, 3, 0})] += way;
  const auto moved = binding.deformed(lattice);
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_LT((moved[i] - (places[i] + shares[i] * way)).norm(), 1e-15);
}

TEST(FreeFormDeformation, ACornerPointTakesTheCornerAlong) {
  auto lattice = *make_ffd_lattice(Affine3::Identity(), {2, 2, 2});
  const std::vector<Vector3> places = {Vector3::Ones(), Vector3::Constant(0.5)};
  const FfdBinding binding(places, lattice);
  lattice.points.back() += Vector3(0.0, 0.0, 1.0);
  const auto moved = binding.deformed(lattice);
  EXPECT_EQ(moved[0], Vector3(1.0, 1.0, 2.0));
  EXPECT_DOUBLE_EQ(moved[1].z(), 0.5 + 1.0 / 64.0);  // (1/4)^3
}

TEST(FreeFormDeformation, TakesWhatIsInTheBoxAndItsFacesOnly) {
  const Affine3 box = askew_box();
  const auto lattice = *make_ffd_lattice(box, {1, 1, 1});
  const std::vector<Vector3> places = {box * Vector3(0.5, 0.5, 0.5), box * Vector3(1.001, 0.5, 0.5),
                                       box * Vector3(0.0, 1.0, 0.3), box * Vector3(0.5, 0.5, -0.001),
                                       Vector3::Constant(std::numeric_limits<double>::quiet_NaN())};
  EXPECT_EQ(FfdBinding(places, lattice).vertices(), (std::vector<std::uint32_t>{0, 2}));
  const std::vector<std::uint32_t> chosen = {2, 1, 99};
  EXPECT_EQ(FfdBinding(places, chosen, lattice).vertices(), (std::vector<std::uint32_t>{2}));
}

TEST(FreeFormDeformation, RefusesLatticesThatCannotBe) {
  EXPECT_FALSE(make_ffd_lattice(Affine3::Identity(), {0, 1, 1}));
  EXPECT_FALSE(make_ffd_lattice(Affine3::Identity(), {1, -5, 1}));
  EXPECT_FALSE(make_ffd_lattice(Affine3::Identity(), {100, 100, 100}));
  EXPECT_FALSE(make_ffd_lattice(Affine3::Identity(), {2147483647, 2147483647, 2147483647}));
  EXPECT_FALSE(make_ffd_lattice(Affine3(Eigen::Scaling(1.0, 1.0, 0.0)), {1, 1, 1}));
  EXPECT_FALSE(make_ffd_lattice(Affine3(Eigen::Scaling(1.0, 1.0, HUGE_VAL)), {1, 1, 1}));
  EXPECT_TRUE(make_ffd_lattice(Affine3(Eigen::Scaling(1e-9, 2e-9, 1e-8)), {31, 31, 31}));
  auto lattice = *make_ffd_lattice(Affine3::Identity(), {1, 1, 1});
  lattice.points.pop_back();
  EXPECT_FALSE(check(lattice));
  lattice.points.emplace_back(0.0, std::nan(""), 0.0);
  EXPECT_FALSE(check(lattice));
}

}  // namespace
}  // namespace icome::geometry
