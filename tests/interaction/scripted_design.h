#pragma once
#include <fmt/format.h>

#include <array>
#include <vector>

#include "base/random.h"
#include "interaction/command_samples.h"
#include "world/sample_world.h"

namespace icome::interaction {

/// A design that is made by commands. At the end of every test all of them are undone and performed once
/// more, which must give the same designs.
class ScriptedDesign : public ::testing::Test {
 protected:
  void TearDown() override {
    const std::uint64_t last = hash(runner_.world());
    OperationRunner again(start_);
    for (const std::string& command : commands_) performed(again, command);
    EXPECT_EQ(hash(again.world()), last) << "performed once more";
    while (runner_.history().can_undo()) {
      EXPECT_EQ(hash(runner_.world()), before_.back()) << "undone: " << runner_.history().undo_name();
      before_.pop_back();
      performed(runner_, R"({"op": "undo"})");
    }
    EXPECT_EQ(hash(runner_.world()), hash(start_)) << "undone to the start";
  }

  /// Begins with a world that operations cannot make.
  void begin(const world::World& world) {
    start_ = world;
    runner_ = OperationRunner(world);
  }
  Performed run(const std::string& command) {
    Performed done = performed(runner_, command);
    commands_.push_back(command);
    before_.push_back(hash(runner_.world()));
    return done;
  }
  /// A cube of one metre.
  void box(const std::string& name, const Vector3& at) {
    run(fmt::format(R"({{"op": "create", "shape": "box", "size": [1, 1, 1], "name": "{}", "at": {}}})", name,
                    text_of(at)));
  }
  static std::string text_of(const Vector3& at) {
    return json_from_value(Value::List{at.x(), at.y(), at.z()});
  }

  using Refusal = std::array<const char*, 2>;  // a command, and words of the sentence that refuses it
  void expect_refused(const std::vector<Refusal>& refusals) {
    for (const auto& [command, words] : refusals) {
      const std::string sentence = refusal(runner_, command);
      EXPECT_NE(sentence.find(words), std::string::npos) << command << "\n" << sentence;
    }
  }

  const world::World& design() const { return runner_.world(); }
  world::ObjectId id(std::string_view name) const { return named_object(design(), name).value(); }
  const world::PhysicalObject& find(std::string_view name) const { return *design().find(id(name)); }
  base::Affine3 place(std::string_view name) const { return world::world_from_object(design(), id(name)); }
  Vector3 at(std::string_view name) const { return place(name).translation(); }
  base::Bounds bounds(std::string_view name) const { return world::bounds(design(), id(name)); }
  const world::Material& material(std::string_view name) const { return *design().find(find(name).material); }
  const world::Geometry& shape(std::string_view name) const {
    return *design().find(find(name).geometry)->shape;
  }

 private:
  world::World start_;
  OperationRunner runner_{{}};
  std::vector<std::string> commands_;
  std::vector<std::uint64_t> before_;  // hashes after each command
};

}  // namespace icome::interaction
