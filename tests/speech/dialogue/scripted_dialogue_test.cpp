// The talks of dialogues.txt, each with the world that it must lead to.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "base/decompositions.h"
#include "places.h"
#include "speech/dialogue/dialogue.h"

namespace icome::speech {
namespace {

class ScriptedStage final : public Stage {
 public:
  std::optional<Pointer> hand;
  std::vector<ObjectId> selected;

  std::optional<Pointer> pointer(double) const override { return hand; }
  std::vector<ObjectId> selection() const override { return selected; }
  void select(const std::vector<ObjectId>& objects) override { selected = objects; }
};

struct Line {
  std::size_t number;
  std::string text;
};

struct ScriptedTalk {
  std::string name;
  std::vector<Line> lines;
};

std::vector<ScriptedTalk> talks_of_file() {
  std::ifstream file(places::project_folder() / "tests/speech/dialogue/dialogues.txt");
  std::vector<ScriptedTalk> talks;
  std::string text;
  for (std::size_t number = 1; std::getline(file, text); ++number) {
    if (text.empty() || text.front() == '#') continue;
    if (text.starts_with("talk "))
      talks.push_back({text.substr(5), {}});
    else
      talks.back().lines.push_back({number, text});
  }
  return talks;
}

std::vector<std::string> parts_of(const std::string& text, char between) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  std::string part;
  while (std::getline(stream, part, between)) {
    part.erase(0, part.find_first_not_of(' '));
    parts.push_back(part);
  }
  return parts;
}

std::vector<double> numbers_of(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : parts_of(text, ',')) numbers.push_back(std::stod(part));
  return numbers;
}

/// Runs one talk and holds each answer and the world against what is expected.
class TalkRunner {
 public:
  void run(const ScriptedTalk& talk) {
    for (const Line& line : talk.lines) {
      SCOPED_TRACE(fmt::format("dialogues.txt:{}: {}  (heard '{}', reply '{}')", line.number, line.text,
                               answer_.heard, answer_.reply));
      run_line(line.text);
    }
  }

 private:
  void run_line(const std::string& text) {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::string word = text.substr(0, blank);
    const std::string rest = blank < text.size() ? text.substr(blank + 1) : "";
    if (word == ">") return hear(rest);
    if (word == "hand") return put_hand(numbers_of(rest));
    if (word == "wait") {
      now_ += std::stod(rest);
      return;
    }
    expect(word, rest);
  }

  void hear(const std::string& sentence) {
    const std::uint64_t before = world::hash(design_.world());
    answer_ = dialogue_.hear(sentence, {.now = now_});
    const bool must_stay = !answer_.accepted();
    EXPECT_TRUE(!must_stay || world::hash(design_.world()) == before) << sentence << ": " << answer_.reply;
  }

  void put_hand(const std::vector<double>& at) {
    Pointer pointer;
    pointer.world_from_pointer.translation() = Vector3(at[0], at[1], at[2]);
    if (at.size() == 6) {
      const Vector3 way(at[3], at[4], at[5]);
      pointer.world_from_pointer.linear() =
          base::rotation_between(-Vector3::UnitZ(), way.normalized()).toRotationMatrix();
    }
    stage_.hand = pointer;
  }

  void expect(const std::string& word, const std::string& rest) {
    static const std::map<std::string, Answer::State> kStates{
        {"done", Answer::State::Done}, {"asked", Answer::State::Asked}, {"refused", Answer::State::Refused}};
    if (const auto state = kStates.find(word); state != kStates.end()) {
      EXPECT_EQ(answer_.state, state->second);
      EXPECT_NE(answer_.reply.find(rest), std::string::npos);
    } else if (word == "op") {
      ASSERT_FALSE(answer_.intent.empty());
      EXPECT_EQ(*answer_.intent.front().second.text(), rest);
    } else if (word == "means") {
      EXPECT_EQ(names_of(answer_.objects), parts_of(rest, ','));
    } else if (word == "selected") {
      EXPECT_EQ(names_of(stage_.selected), parts_of(rest, ','));
    } else if (word == "objects") {
      EXPECT_EQ(design_.world().objects().size(), std::stoul(rest));
    } else if (word == "gone") {
      EXPECT_FALSE(find(rest));
    } else if (word == "is") {
      expect_object(rest);
    } else {
      FAIL() << "a line that says nothing";
    }
  }

  std::vector<std::string> names_of(const std::vector<ObjectId>& objects) const {
    std::vector<std::string> names;
    for (const ObjectId id : objects) names.push_back(design_.world().find(id)->name);
    return names;
  }

  std::optional<ObjectId> find(const std::string& name) const {
    for (const auto& [id, object] : design_.world().objects())
      if (object.name == name) return id;
    return std::nullopt;
  }

  /// "left leg kind=box at=0,0,0"
  void expect_object(const std::string& rest) {
    std::vector<std::string> name, attributes;
    for (const std::string& part : parts_of(rest, ' '))
      (part.find('=') == std::string::npos ? name : attributes).push_back(part);
    const auto id = find(fmt::format("{}", fmt::join(name, " ")));
    ASSERT_TRUE(id) << rest;
    for (const std::string& attribute : attributes) {
      const std::size_t sign = attribute.find('=');
      expect_attribute(*id, attribute.substr(0, sign), attribute.substr(sign + 1));
    }
  }

  void expect_attribute(ObjectId id, const std::string& attribute, const std::string& value) {
    const world::World& world = design_.world();
    if (attribute == "kind") {
      EXPECT_EQ(shape_kind(world, id), value);
    } else if (attribute == "colour") {
      const auto* material = world.find(world.find(id)->material);
      const world::Colour own = material ? material->diffuse : world::Material().diffuse;
      std::string hex = "#";
      for (const float part : own) hex += fmt::format("{:02x}", std::lround(255.0F * part));
      EXPECT_EQ(hex, value);
    } else if (attribute == "extent") {
      EXPECT_NEAR(world::bounds(world, id).sizes().maxCoeff(), std::stod(value), 1e-9);
    } else {
      const auto at = numbers_of(value);
      const Vector3 middle = world::bounds(world, id).center();
      EXPECT_NEAR((middle - Vector3(at[0], at[1], at[2])).norm(), 0.0, 1e-9) << middle.transpose();
    }
  }

  interaction::OperationRunner design_{world::World()};
  ScriptedStage stage_;
  OwnWords own_words_;
  Dialogue dialogue_{*built_in_vocabulary(), design_, stage_, own_words_};
  Answer answer_;
  double now_ = 0.0;
};

class ScriptedDialogue : public testing::TestWithParam<ScriptedTalk> {};

TEST_P(ScriptedDialogue, LeadsToTheExpectedWorld) { TalkRunner().run(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, ScriptedDialogue, testing::ValuesIn(talks_of_file()), [](const auto& talk) {
  std::string name;
  for (const char letter : talk.param.name)
    name += std::isalnum(static_cast<unsigned char>(letter)) ? letter : '_';
  return name;
});

}  // namespace
}  // namespace icome::speech
