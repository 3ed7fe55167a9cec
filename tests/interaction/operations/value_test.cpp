#include "interaction/operations/value.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "interaction/command_samples.h"

namespace icome::interaction {
namespace {

std::string error_of(std::string_view text) {
  const auto value = value_from_json(text);
  return value ? "" : value.error().message;
}

TEST(Value, IsWhatTheTextSays) {
  const Value value = json(R"({"op": "drag", "by": [0.1, -2, 3e-5], "alone": true, "to": null})");
  const Value::Fields& fields = *value.fields();
  ASSERT_EQ(fields.size(), 4U);
  EXPECT_EQ(*field(fields, "op")->text(), "drag");
  EXPECT_EQ(*field(fields, "by"), Value(Value::List{0.1, -2, 3e-5}));
  EXPECT_TRUE(*field(fields, "alone")->flag());
  EXPECT_TRUE(field(fields, "to")->is_null());
  EXPECT_EQ(field(fields, "from"), nullptr);
}

TEST(Value, ComesBackToTheLastBit) {
  base::Random random(5);
  Value::List list = {Value(),
                      true,
                      "a \"quoted\"\nline \xc3\xa4",
                      Value::Fields{{"b", 1}, {"a", Value::List{}}},
                      0.1,
                      1e300,
                      5e-324,
                      -0.5,
                      9007199254740993.0};
  for (int i = 0; i < 1000; ++i)
    list.emplace_back(random.uniform(-1.0, 1.0) * std::pow(10.0, random.uniform(-300, 300)));
  EXPECT_EQ(json(json_from_value(list)), Value(list));
  EXPECT_EQ(json_from_value(Value::Fields{{"b", 2}, {"a", 0.5}}), R"({"b":2,"a":0.5})") << "in their order";
  EXPECT_EQ(json_from_value(std::numeric_limits<double>::quiet_NaN()), "null");
}

TEST(Value, SaysWhatIsWrong) {
  EXPECT_EQ(error_of(R"({"a": 1, "a": 2})"), "'a' is named twice");
  EXPECT_EQ(error_of("[1e999]"), "the number that ends at character 6 is too large");
  EXPECT_EQ(error_of(R"({"op": "drag")"), "this is no JSON at character 14");
  for (const char* text : {"", "{", "nan", "{'a': 1}", "[1,]", "{} {}", "\"\xff\""})
    EXPECT_NE(error_of(text).find("this is no JSON"), std::string::npos) << text;
  EXPECT_EQ(error_of(std::string(100, '[') + std::string(100, ']')), "");
  EXPECT_EQ(error_of(std::string(101, '[') + std::string(101, ']')), "it nests more than 100 deep");
  EXPECT_EQ(error_of(std::string(5'000'000, '[')), "it nests more than 100 deep");
  EXPECT_EQ(error_of(std::string(kLongestValue + 1, ' ')), "it is longer than 64 MiB");
}

TEST(Value, NamesSoManyThingsThatAllCanBeCompared) {
  const auto object = [](int fields) {
    std::string text = "{\"0\": 0";
    for (int i = 1; i < fields; ++i) text += fmt::format(", \"{}\": 0", i);
    return text + "}";
  };
  EXPECT_EQ(error_of(object(256)), "");
  EXPECT_EQ(error_of(object(257)), "it names more than 256 things");
  EXPECT_EQ(error_of("[" + object(200) + ", " + object(200) + "]"), "") << "of one object";
}

}  // namespace
}  // namespace icome::interaction
