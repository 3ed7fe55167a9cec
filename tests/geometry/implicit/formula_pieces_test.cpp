#include "geometry/implicit/formula_pieces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "geometry/plane_formulas.h"

namespace icome::geometry {
namespace {

using base::Vector3;

FormulaPieces taken_apart(const std::string& text) {
  auto pieces = FormulaPieces::parse(text);
  EXPECT_TRUE(pieces) << text << ": " << (pieces ? "" : pieces.error().message);
  return pieces ? *pieces : *FormulaPieces::parse("x");
}

TEST(FormulaPieces, AreTheSmoothFunctionsOfAFormula) {
  const auto count = [](const std::string& text) { return taken_apart(text).pieces.size(); };
  EXPECT_EQ(count("x^2 + y^2 + z^2 - 1"), 1U);
  EXPECT_EQ(count("z - abs(x)"), 2U);
  EXPECT_EQ(count("z - max(x, -2*x)"), 2U);
  EXPECT_EQ(count("abs(x) + abs(y) + abs(z) - 0.05"), 8U);
  EXPECT_EQ(count("max(abs(x), abs(y), abs(z)) - 0.05"), 6U);
  EXPECT_EQ(count("abs(x) + 2*abs(x)"), 2U);           // one choice, made once
  EXPECT_EQ(count("max(x, y, z, x + y, x - y)"), 5U);  // not what does not matter then
  EXPECT_EQ(count("if(x < 0, z, z + x)"), 2U);
  EXPECT_EQ(count("if(x < 0 && y < 0 || z < -1, z, z + x)"), 2U);
  EXPECT_EQ(count("z - 0.01*atan2(y, x)"), 2U);
  EXPECT_EQ(count("sin(5*atan2(y, x)) + z*cos(5*atan2(y, x))"), 2U);
  EXPECT_EQ(count("z - asin(sin(9*x))"), 2U);
  EXPECT_EQ(count("z - acos(cos(9*x)) + atan(tan(y))"), 4U);
  EXPECT_EQ(count("z - atan(y/x)"), 2U);
  EXPECT_EQ(count("z - sqrt(x^2)"), 2U);
  EXPECT_EQ(count("z - abs(x)^1.5"), 1U);        // no crease
  EXPECT_EQ(count("max(x, -0.01)"), 1U);         // a constant has no surface
  EXPECT_EQ(count("z + sqrt(min(x, -1))"), 1U);  // nor has what is never defined
}

TEST(FormulaPieces, LeavesPartsWithTooManyCombinationsAsTheyAre) {
  std::string sum = "z";
  for (int i = 1; i <= 9; ++i) sum += fmt::format(" + abs(x - {})", i);
  const FormulaPieces pieces = taken_apart(sum);
  EXPECT_EQ(pieces.pieces.size(), 1U);
  EXPECT_EQ(pieces.pieces[0].formula.value({5.5, 0.0, 1.0}, 0.0), pieces.whole.value({5.5, 0.0, 1.0}, 0.0));
}

/// Which choices take their second operand there.
FormulaPieces::ChoiceSet choices_at(const FormulaPieces& pieces, const Vector3& point) {
  FormulaPieces::ChoiceSet second = 0;
  for (std::size_t i = 0; i < pieces.choices.size(); ++i) {
    if (pieces.choices[i].value(point, 0.0) > 0.0) second |= FormulaPieces::ChoiceSet{1} << i;
  }
  return second;
}

TEST(FormulaPieces, HaveTheFormulasValueWhereTheirChoicesAreMade) {
  base::Random random(31);
  for (int i = 0; i < 200; ++i) {
    const PlaneFormula formula = random_plane_formula(random, 4, 0.5);
    const FormulaPieces pieces = taken_apart(formula.text);
    for (int k = 0; k < 20; ++k) {
      const Vector3 point = random.uniform(0.0, 1.0) * random.direction();
      const FormulaPieces::ChoiceSet second = choices_at(pieces, point);
      int made = 0;
      for (const FormulaPieces::Piece& piece : pieces.pieces) {
        for (const FormulaPieces::Case& it : piece.cases) {
          if ((it.made & (it.second ^ second)) != 0) continue;
          ++made;
          ASSERT_NEAR(piece.formula.value(point, 0.0), formula.value(point), 1e-14) << formula.text;
        }
      }
      ASSERT_EQ(made, 1) << formula.text;
    }
  }
}

/// At random places one piece has its choices made, and it has the value of the whole.
void expect_one_piece_everywhere(const std::string& text, double exactness) {
  base::Random random(32);
  const FormulaPieces pieces = taken_apart(text);
  for (int k = 0; k < 1000; ++k) {
    const Vector3 point = random.uniform(0.0, 1.0) * random.direction();
    const FormulaPieces::ChoiceSet second = choices_at(pieces, point);
    int made = 0;
    for (const FormulaPieces::Piece& piece : pieces.pieces) {
      for (const FormulaPieces::Case& it : piece.cases) {
        if ((it.made & (it.second ^ second)) != 0) continue;
        ++made;
        ASSERT_NEAR(piece.formula.value(point, 0.0), pieces.whole.value(point, 0.0), exactness) << text;
      }
    }
    ASSERT_EQ(made, 1) << text;
  }
}

TEST(FormulaPieces, AreOneAtEveryPlaceOfConditionsAndAngles) {
  for (const char* text :
       {"if(x < y, z, x)", "if(x < 0 && y < 0 || z >= 0.2, x + y, if(!(x > z), -z, 2*y))",
        "z - 0.01*atan2(y, x)", "atan2(abs(x) - 0.2, y - z) + if(atan2(x, z) < 1, x, atan2(x, z))",
        "z - atan(-2*abs(y)/x)", "x - atan(0.2/(y + z))", "z + atan(-1/x)"}) {
    expect_one_piece_everywhere(text, 1e-13);
  }
}

TEST(FormulaPieces, AreOneAtEveryPlaceOfZigzags) {
  constexpr double kNearExact = 1e-9;  // near a turn, asin(sin(x)) loses digits that the straight pieces have
  for (const char* text : {"z - asin(sin(9*x + y))", "z*acos(sin(7*x))",
                           "acos(cos(5*abs(y) - x)) - asin(cos(8*z))", "z + atan(tan(6*x - y))"}) {
    expect_one_piece_everywhere(text, kNearExact);
  }
}

TEST(FormulaPieces, GoOnSmoothlyWhereAnAngleJumps) {
  const FormulaPieces star = taken_apart("sqrt(x^2 + y^2) - 0.03 - 0.005*sin(5*atan2(y, x))");
  for (const FormulaPieces::Piece& piece : star.pieces) {
    const auto at = piece.formula.range({{{-0.04, -0.03}, {-0.001, 0.001}, {0.0, 0.0}, {0.0, 0.0}}});
    EXPECT_TRUE(at.total);
    EXPECT_LT(at.value.hi - at.value.lo, 0.02);
  }
}

/// Where a power, a zigzag or an angle ends or turns, its pieces have values, and slopes that say something.
TEST(FormulaPieces, GoOnBeyondTheirEnds) {
  struct EndAtZero {
    const char* formula;
    std::size_t pieces;
  };
  const std::vector<EndAtZero> ends{{"z - x^1.5", 1},        {"z - x^0.7", 1},
                                    {"z - sin(x^1.3)", 1},   {"z - asin(cos(x))", 2},
                                    {"z - acos(cos(x))", 2}, {"z - atan((y+1)/x)", 2}};
  for (const EndAtZero& it : ends) {
    const auto read = FormulaPieces::parse(it.formula, FormulaPieces::Ends::GoOn);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->pieces.size(), it.pieces) << it.formula;
    for (const FormulaPieces::Piece& piece : read->pieces) {
      const auto at = piece.formula.slope_range({{{-1e-3, 1e-3}, {0.1, 0.1}, {0.2, 0.2}, {0.0, 0.0}}});
      EXPECT_TRUE(at.range.total) << it.formula;
      EXPECT_LT(magnitude(at.slope[0]), 2.0) << it.formula;
    }
  }
}

TEST(FormulaPieces, KnowsWhereAFormulaMayJump) {
  const auto borders = [](const std::string& text) { return taken_apart(text).borders; };
  EXPECT_TRUE(borders("x*y - abs(z)").empty());
  for (const char* text :
       {"1/x", "z - y/x^2", "sqrt(x)", "log(3*x)", "y - x^0.3", "1/abs(x)", "1/abs(x)^1.5", "x/sqrt(x^6)"}) {
    const std::vector<Formula> both = borders(text);
    ASSERT_EQ(both.size(), 2U) << text;
    for (const double x : {-0.3, 0.0, 0.4}) {
      EXPECT_EQ(std::abs(both[0].value({x, 0.7, 0.2}, 0.0)) > 0.0, x != 0.0) << text;
      EXPECT_EQ(both[0].value({x, 0.7, 0.2}, 0.0), -both[1].value({x, 0.7, 0.2}, 0.0)) << text;
    }
    // A border has two sides, else nothing that is followed goes through it.
    EXPECT_LT(both[0].value({-0.3, 0.7, 0.2}, 0.0) * both[0].value({0.4, 0.7, 0.2}, 0.0), 0.0) << text;
  }
  EXPECT_EQ(borders("asin(x)").size(), 4U);  // at -1 and 1
  EXPECT_EQ(borders("1/(x*y)").size(), 4U);
}

}  // namespace
}  // namespace icome::geometry
