#include "haptics/effects/parameter_text.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "haptics/effects/effect_text.h"
#include "haptics/effects/texture_text.h"

namespace icome::haptics {
namespace {

constexpr std::array kTwoNumbers = {Parameter{"ONE", "m", -1e3, 1e3}, Parameter{"TWO", "", -1e3, 1e3, 7.0}};

TEST(ParameterText, TakesNumbersAsPeopleWriteThem) {
  EXPECT_EQ(read_parameters("+200, -1e-3", kTwoNumbers).value(), (std::vector<double>{200.0, -1e-3}));
  EXPECT_EQ(read_parameters(" 3 ", kTwoNumbers).value(), (std::vector<double>{3.0, 7.0}));
  for (const char* const text :
       {"+", "+-1", "++1", "-+1", "1 2", "0x10", "1e", "nan", "inf", "1,2,3", "", ",1"})
    EXPECT_FALSE(read_parameters(text, kTwoNumbers)) << text;
}

TEST(ParameterText, EchoesLongTextsShortened) {
  const std::string all(100'000, 'x');
  const std::string cut = std::string(60, 'x') + "...";
  EXPECT_EQ(read_parameters(all, kTwoNumbers).error().message,
            "number 1 (ONE m) is \"" + cut + "\", which is no number.");
  EXPECT_NE(make_effect(all).error().message.find("no effect \"" + cut + '"'), std::string::npos);
  EXPECT_NE(make_texture(all).error().message.find("no texture \"" + cut + '"'), std::string::npos);
  std::string umlauts;
  for (int i = 0; i < 70; ++i) umlauts += "\u00e4";
  EXPECT_NE(make_effect(umlauts).error().message.find('"' + umlauts.substr(0, 120) + "...\""),
            std::string::npos)
      << "cut between letters";
}

TEST(ParameterText, AQuestionEndsInAQuestionMark) {
  EXPECT_EQ(make_effect("wel:1").error().message, "there is no effect \"wel\"; did you mean 'well'?");
  EXPECT_TRUE(make_texture("sand").error().message.ends_with(".")) << make_texture("sand").error().message;
}

}  // namespace
}  // namespace icome::haptics
