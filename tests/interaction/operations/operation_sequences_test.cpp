// What must hold for any sequence of operations: there and back again by undo, and once more from the
// commands.
#include <map>

#include "interaction/command_samples.h"
#include "interaction/random_commands.h"
#include "world/complaints.h"

namespace icome::interaction {
namespace {

#if defined(ICOME_ADDRESS_SANITIZER) || defined(ICOME_THREAD_SANITIZER)
constexpr int kCommands = 300;
#else
constexpr int kCommands = 10'000;
#endif
constexpr std::size_t kMostObjects = 40;
constexpr std::size_t kMostBytes = 100'000;  // of shapes; refining a mesh once makes four times as many
constexpr int kFewestDone = kCommands / 5'000;

std::size_t bytes_of(const world::World& world) {
  std::size_t bytes = 0;
  for (const auto& [id, geometry] : world.geometries()) bytes += geometry.shape->bytes();
  return bytes;
}

/// Takes everything away, so that designs stay of a size at which 10,000 commands take seconds.
Value clearing(const world::World& world) {
  Value::List names;
  std::vector<world::ObjectId> roots = world.roots();
  for (const world::ObjectId id : roots) names.emplace_back(std::string(1, '#') + std::to_string(id.value));
  return Value::Fields{{"op", "delete"}, {"objects", names}};
}

/// A person who tries everything.
class Session {
 public:
  void go_on() {
    const world::World& world = runner_.world();
    const bool full = world.objects().size() > kMostObjects || bytes_of(world) > kMostBytes;
    const bool empty = world.objects().size() < 3;
    const Operation& operation = empty ? *find_operation("create").value() : next_operation();
    say(full ? clearing(world) : commands_.next(operation, world));
  }
  void say(const Value& command) {
    const std::uint64_t before = random_.index(20) == 0 ? hash(runner_.world()) : 0;
    const auto done = runner_.perform(command);
    said_.push_back(json_from_value(command));
    done_.push_back(done.has_value());
    const std::string& name = *field(*command.fields(), "op")->text();
    if (done) {
      ++counts_[name];
      return;
    }
    refusals_[name] = done.error().message;
    ASSERT_FALSE(done.error().message.empty()) << said_.back();
    if (before != 0) {
      ASSERT_EQ(hash(runner_.world()), before) << said_.back();
    }
  }

  OperationRunner& runner() { return runner_; }
  const std::vector<std::string>& said() const { return said_; }
  const std::vector<bool>& done() const { return done_; }
  int count(const std::string& operation) const {
    const auto found = counts_.find(operation);
    return found == counts_.end() ? 0 : found->second;
  }
  /// Why it was refused last.
  std::string refusal_of(const std::string& operation) const {
    const auto found = refusals_.find(operation);
    return found == refusals_.end() ? "" : found->second;
  }

 private:
  /// Of some the one that came about least often: some need much that others must have made.
  const Operation& next_operation() {
    const Operation* rarest = nullptr;
    for (int i = 0; i < 5; ++i) {
      const Operation& one = operations()[random_.index(operations().size())];
      if (!rarest || count(one.name) < count(rarest->name)) rarest = &one;
    }
    return *rarest;
  }

  OperationRunner runner_{{}, sample_picture};
  base::Random random_{77};
  RandomCommands commands_{78};
  std::vector<std::string> said_;
  std::vector<bool> done_;
  std::map<std::string, int> counts_;
  std::map<std::string, std::string> refusals_;
};

TEST(OperationSequences, GoThereAndBackAgainAndOnceMore) {
  Session session;
  for (int i = 0; i < kCommands && !HasFatalFailure(); ++i) session.go_on();
  for (const Operation& operation : operations())
    EXPECT_GE(session.count(operation.name), kFewestDone)
        << operation.name << ": " << session.refusal_of(operation.name);

  EXPECT_EQ(world::complaints(session.runner().world()), "");
  const std::uint64_t last = hash(session.runner().world());
  OperationRunner again({}, sample_picture);
  for (std::size_t i = 0; i < session.said().size(); ++i)
    ASSERT_EQ(again.perform(json(session.said()[i])).has_value(), session.done()[i]) << session.said()[i];
  EXPECT_EQ(hash(again.world()), last);

  std::size_t undone = 0;
  for (; session.runner().history().can_undo(); ++undone) performed(session.runner(), R"({"op": "undo"})");
  EXPECT_EQ(hash(session.runner().world()), hash(world::World()));
  // No more than that: the last commands may have been undone themselves.
  for (; undone > 0; --undone) performed(session.runner(), R"({"op": "redo"})");
  EXPECT_EQ(hash(session.runner().world()), last);
}

}  // namespace
}  // namespace icome::interaction
