// Surfaces of formulas that choose, jump or are undefined in places: against dense samples.
#include "geometry/implicit/implicit_pieces.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "geometry/implicit/implicit_surface.h"
#include "geometry/implicit/plain_formula.h"
#include "geometry/plane_formulas.h"

namespace icome::geometry {
namespace {

constexpr double kPieceSlack = 2e-12;  // m, 1e-11 of the box's edge

Bounds piece_box() { return {Vector3::Constant(-0.1), Vector3::Constant(0.1)}; }

Vector3 place_in_box(base::Random& random) {
  return {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
}

/// Through whichever piece comes first.
std::optional<SurfaceHit> first_of_pieces(const ImplicitSurface& surface, const Vector3& start,
                                          const Vector3& step, bool from_behind) {
  std::optional<SurfaceHit> first;
  surface.near(start, start + step, kPieceSlack, 0.0, [&](std::uint32_t piece, const Bounds&) {
    const auto hit = surface.first_hit(piece, start, step, from_behind, 0.0, kPieceSlack);
    if (hit && (!first || hit->t < first->t)) first = hit;
    return true;
  });
  return first;
}

/// Where a way first changes from one side to the other: by samples, then by halving.
template <typename Behind>
std::optional<double> sampled_hit(const Vector3& start, const Vector3& step, Behind&& behind) {
  constexpr int kSamples = 1500;
  for (int i = 1; i <= kSamples; ++i) {
    double a = double(i - 1) / kSamples, b = double(i) / kSamples;
    if (behind(start + a * step) || !behind(start + b * step)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (a + b);
      (behind(start + middle * step) ? b : a) = middle;
    }
    return a;
  }
  return std::nullopt;
}

struct EntryCounts {
  int met = 0, earlier = 0;
};

/// Ways in and out are met where samples change sides, or earlier at a place too thin for them.
template <typename Inside>
void expect_entries_as_sampled(const std::string& text, Inside&& inside, base::Random& random, int ways,
                               EntryCounts& counts) {
  const auto made = ImplicitSurface::create(text, piece_box());
  if (!made) return;  // no surface in the box
  for (int i = 0; i < ways; ++i) {
    const Vector3 start = place_in_box(random), step = 0.999 * (place_in_box(random) - start);
    const bool from_behind = i % 2 == 1;
    const auto behind = [&](const Vector3& p) { return inside(p) != from_behind; };
    const auto expected = sampled_hit(start, step, behind);
    const auto hit = first_of_pieces(**made, start, step, from_behind);
    if (!expected) continue;
    ASSERT_TRUE(hit) << text << " way " << i;
    if (hit->t < *expected - 1e-9) {
      ++counts.earlier;
      continue;
    }
    ++counts.met;
    ASSERT_NEAR(hit->t, *expected, 1e-9) << text << " way " << i;
    const Vector3& normal = hit->place.normal;
    const Vector3& point = hit->place.point;
    ASSERT_TRUE((*made)->covers(hit->place, {}, 0.0, kPieceSlack)) << text << " way " << i;
    ASSERT_NE(inside(point - 1e-9 * normal), inside(point + 1e-9 * normal)) << text << " way " << i;
  }
}

TEST(ImplicitPieces, MeetWithoutCracksInRandomFormulasOfPlanes) {
  base::Random random(41);
  EntryCounts counts;
  for (int i = 0; i < 40; ++i) {
    const PlaneFormula formula = random_plane_formula(random, 1 + i % 4, 0.05);
    const auto inside = [&](const Vector3& p) { return formula.value(p) < 0.0; };
    expect_entries_as_sampled(formula.text, inside, random, 40, counts);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(counts.met, 200);
  EXPECT_LT(counts.earlier, counts.met / 100);
}

TEST(ImplicitPieces, MeetInEdgesAimedAt) {
  base::Random random(42);
  for (const char* text : {"max(x, z)", "min(x, z)", "z - abs(x)", "z + abs(x)", "z - max(x, -2*x)"}) {
    const auto surface = *ImplicitSurface::create(text, piece_box());
    const auto whole = *Formula::parse(text);
    int aimed = 0;
    for (int i = 0; i < 2000; ++i) {
      // To places within rounding of the edge x = z = 0.
      const Vector3 off(random.uniform(-1e-15, 1e-15), 0.0, random.uniform(-1e-15, 1e-15));
      const Vector3 edge = Vector3(0.0, random.uniform(-0.05, 0.05), 0.0) + off;
      const Vector3 way = 0.04 * random.direction();
      if (whole.value(edge - way, 0.0) < 1e-4 || whole.value(edge + way, 0.0) > -1e-4) continue;
      const auto hit = first_of_pieces(*surface, edge - way, 2.0 * way, false);
      ASSERT_TRUE(hit) << text << " " << i;
      ASSERT_NEAR(hit->t, 0.5, 1e-9) << text << " " << i;
      ++aimed;
    }
    EXPECT_GT(aimed, 100) << text;
  }
}

TEST(ImplicitPieces, EndInWallsWhereTheFormulaJumpsOrBegins) {
  base::Random random(43);
  EntryCounts counts;
  for (const char* text : {"1/x",
                           "-1/x",
                           "z - 0.001/x",
                           "z - sqrt(x)",
                           "sqrt(x) - 0.1",
                           "z - 0.01*log(30*x)",
                           "z - 0.01*tan(40*x)",
                           "asin(20*x) + z",
                           "max(z, -sqrt(x))",
                           "y/x - 0.5",
                           "1/(x*y) + 1000",
                           "x/(x^2 + y^2 + z^2) - 20",
                           "1/abs(x) - 20",
                           "-(x^0.3)",
                           "z - 0.01*atan2(y, x)",
                           "atan2(z, x) - 0.05*y",
                           "if(x < 0.02, z, z - 0.03)",
                           "if(x < 0 && y < 0, 1, z)",
                           "if(x^2 + y^2 < 0.0016 || z < -0.05, -1, 1)",
                           "if(z < 0, if(x < y, -1, 1), 1)",
                           "if(x > 0, z - sqrt(x), z + 0.02)"}) {
    const auto whole = *plain_formula(text);
    const auto inside = [&](const Vector3& p) { return whole(p, 0.0) < 0.0; };
    const int before = counts.met;
    expect_entries_as_sampled(text, inside, random, 100, counts);
    if (testing::Test::HasFatalFailure()) return;
    EXPECT_GT(counts.met, before + 4) << text;
  }
  EXPECT_LT(counts.earlier, counts.met / 50);
}

TEST(ImplicitPieces, ReachJustBeyondTheirEdges) {
  const auto surface = *ImplicitSurface::create("max(x, 100*z)", piece_box());
  for (const double z : {-0.9, 0.9}) {
    const auto hit = first_of_pieces(*surface, {0.05, 0, z * kPieceSlack}, {-0.1, 0, 0}, false);
    ASSERT_TRUE(hit) << z;
    EXPECT_NEAR(hit->t, 0.5, 1e-9);
  }
  EXPECT_FALSE(first_of_pieces(*surface, {0.05, 0, 3.0 * kPieceSlack}, {-0.1, 0, 0}, false));
}

/// A condition on planes: comparisons, put together.
std::string random_condition(base::Random& random, int comparisons) {
  if (comparisons > 1) {
    const int left = 1 + int(random.index(std::size_t(comparisons - 1)));
    const std::string a = random_condition(random, left), b = random_condition(random, comparisons - left);
    return (random.index(4) == 0 ? "!(" : "(") + a + (random.index(2) == 0 ? " && " : " || ") + b + ")";
  }
  const char* compare[] = {"<", "<=", ">", ">="};
  return fmt::format("{:.3f}*x + {:.3f}*y {} {:.3f}*z + {:.3f}", random.uniform(-1, 1), random.uniform(-1, 1),
                     compare[random.index(4)], random.uniform(-1, 1), random.uniform(-0.03, 0.03));
}

TEST(ImplicitPieces, MeetWithoutCracksWhereConditionsChoose) {
  base::Random random(45);
  EntryCounts counts;
  for (int i = 0; i < 24; ++i) {
    const std::string text = fmt::format("if({}, {}, {})", random_condition(random, 1 + i % 4),
                                         random_plane_formula(random, 1 + i % 2, 0.05).text,
                                         random_plane_formula(random, 1, 0.05).text);
    const auto value = *plain_formula(text);
    expect_entries_as_sampled(
        text, [&](const Vector3& p) { return value(p, 0.0) < 0.0; }, random, 20, counts);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(counts.met, 60);
  EXPECT_LT(counts.earlier, counts.met / 50);
}

TEST(ImplicitPieces, HaveNoEdgeWhereAnAngleJumpsUnfelt) {
  const auto star =
      *ImplicitSurface::create("sqrt(x^2 + y^2) - 0.03 - 0.005*sin(5*atan2(y, x))", piece_box());
  int met = 0;
  for (int i = 0; i < 200; ++i) {
    const double z = 1e-3 * (i % 100 - 50), off = i < 100 ? 0.0 : 1e-13;
    const auto hit = first_of_pieces(*star, {-0.06, off, z}, {0.05, 0.0, 0.0}, false);
    ASSERT_TRUE(hit) << i;
    ASSERT_NEAR(hit->place.point.x(), -0.03, 1e-11) << i;
    // Radius and angle: x falls as y grows by the star's slope.
    ASSERT_LT((hit->place.normal - Vector3(-1.0, -25.0 / 30.0, 0.0).normalized()).norm(), 1e-8) << i;
    ++met;
    ASSERT_FALSE(first_of_pieces(*star, {-0.0305, -0.001, z}, {-0.001, 0.002, 0.0}, true));
  }
  EXPECT_EQ(met, 200);
}

TEST(ImplicitPieces, HaveNoSheetsWithoutThickness) {
  for (const char* text : {"abs(z)", "max(z, -z)", "z^2", "max(min(x, z), -z)"}) {
    const auto surface = ImplicitSurface::create(text, piece_box());
    if (!surface) continue;
    const auto hit = first_of_pieces(**surface, {0.03, 0, 0.05}, {0, 0, -0.1}, false);
    EXPECT_FALSE(hit && hit->place.normal.z() != 0.0) << text;
  }
}

TEST(ImplicitPieces, LeadOutOfASolidToTheNearestFace) {
  const auto box = *ImplicitSurface::create("max(abs(x) - 0.05, abs(y) - 0.03, abs(z) - 0.02)", piece_box());
  base::Random random(44);
  for (int i = 0; i < 500; ++i) {
    const Vector3 point(random.uniform(-0.05, 0.05), random.uniform(-0.03, 0.03),
                        random.uniform(-0.02, 0.02));
    const auto out = box->way_out(point, 0.0);
    ASSERT_TRUE(out);
    const double nearest = (Vector3(0.05, 0.03, 0.02) - point.cwiseAbs()).minCoeff();
    ASSERT_NEAR((out->point - point).norm(), nearest, 1e-12) << point.transpose();
    ASSERT_NEAR(out->normal.dot((out->point - point).normalized()), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace icome::geometry
