#include "ui/forms/quantity_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace icome::ui {
namespace {

double length(const char* text) {
  const auto value = read_quantity(QString::fromUtf8(text), Quantity::Length);
  return value.value_or(std::nan(""));
}

TEST(QuantityText, ReadsLengthsInTheUnitsPeopleType) {
  EXPECT_DOUBLE_EQ(length("3"), 0.003);  // mm where nothing is said
  EXPECT_DOUBLE_EQ(length("3 cm"), 0.03);
  EXPECT_DOUBLE_EQ(length("0.2m"), 0.2);
  EXPECT_DOUBLE_EQ(length("  -1,5 MM "), -0.0015);
  EXPECT_DOUBLE_EQ(length("1 in"), 0.0254);
  EXPECT_DOUBLE_EQ(length("6\""), 0.1524);
  EXPECT_DOUBLE_EQ(length("250 µm"), 250e-6);
  EXPECT_DOUBLE_EQ(length("1e2"), 0.1);
  EXPECT_DOUBLE_EQ(length(".5m"), 0.5);
  EXPECT_DOUBLE_EQ(length("−4"), -0.004);  // the minus of typesetters
}

TEST(QuantityText, RefusesWhatIsNoLengthAndSaysWhatIs) {
  for (const char* text :
       {"", "abc", "nan", "inf", "3 kg", "1.2.3", "1e400", "3 cm 4", "--3", "0x10", "1e12 m"}) {
    const auto value = read_quantity(text, Quantity::Length);
    ASSERT_FALSE(value) << text;
    EXPECT_NE(value.error().message.find("3 cm"), std::string::npos) << text;
  }
}

TEST(QuantityText, KnowsTheOtherQuantities) {
  EXPECT_NEAR(*read_quantity("90", Quantity::Angle), std::numbers::pi / 2.0, 1e-15);
  EXPECT_DOUBLE_EQ(*read_quantity("1 rad", Quantity::Angle), 1.0);
  EXPECT_DOUBLE_EQ(*read_quantity("0.8 N/mm", Quantity::Stiffness), 800.0);
  EXPECT_DOUBLE_EQ(*read_quantity("40 %", Quantity::Share), 0.4);
  EXPECT_DOUBLE_EQ(*read_quantity("0,35", Quantity::Plain), 0.35);
  EXPECT_FALSE(read_quantity("3 mm", Quantity::Plain));
}

TEST(QuantityText, WritesSixFiguresWithoutNoise) {
  EXPECT_EQ(number_text(0.0123456789, Quantity::Length), "12.3457");
  EXPECT_EQ(number_text(0.1, Quantity::Length), "100");
  EXPECT_EQ(number_text(-1e-17, Quantity::Length), "0");
  EXPECT_EQ(number_text(1.5e-6, Quantity::Length), "0.0015");
  EXPECT_EQ(number_text(1234.567891, Quantity::Length), "1234568");
  EXPECT_EQ(number_text(std::numbers::pi, Quantity::Angle), "180");
  EXPECT_EQ(number_text(0.3, Quantity::Share), "30");
  EXPECT_EQ(number_text(-0.118948, Quantity::Length, 1), "-118.9");
  EXPECT_EQ(number_text(-0.0001, Quantity::Length, 0), "0");
}

TEST(QuantityText, ReadsWhatItWrites) {
  for (const double value : {0.0, 1e-6, -0.25, 12.5, 99.9999, 1e5}) {
    for (const Quantity quantity : {Quantity::Length, Quantity::Angle, Quantity::Share, Quantity::Plain}) {
      const auto back = read_quantity(number_text(value, quantity), quantity);
      ASSERT_TRUE(back);
      EXPECT_NEAR(*back, value, 1e-5 * std::abs(value));
    }
  }
}

}  // namespace
}  // namespace icome::ui
