// What must hold for any sequence of edits: there and back again by undo, and once more from the bytes.
#include "world/complaints.h"
#include "world/edit/edit_bytes.h"
#include "world/edit/history.h"
#include "world/random_edits.h"

namespace icome::world {
namespace {

#ifdef ICOME_ADDRESS_SANITIZER
constexpr int kSequences = 500;
constexpr int kLongSequences = 1;
#else
constexpr int kSequences = 10'000;
constexpr int kLongSequences = 3;
#endif

/// A person at work: performs edits as actions, some of several edits, and what a journal would keep.
class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : random_(seed ^ 0x5eed), edits_(seed) {}

  void edit(int count) {
    for (int i = 0; i < count; ++i) {
      const Edit edit = edits_.next(world_);
      const bool more = history_.can_undo() && random_.index(4) == 0;
      if (more ? history_.extend(world_, edit) : history_.perform(world_, edit, "edit")) keep(edit);
    }
  }

  void turn_back() { turn(&History::undo); }
  void go_on() { turn(&History::redo); }

  const World& world() const { return world_; }

  /// The world that the kept bytes make.
  World replayed() const {
    World world;
    const GeometryFactory factory;
    for (const std::string& bytes : bytes_) {
      const auto edit = edit_from_bytes(bytes, factory);
      if (!edit) throw std::runtime_error(edit.error().message);
      applied(world, *edit);
    }
    return world;
  }

 private:
  void keep(const Edit& edit) {
    auto bytes = to_bytes(edit);
    if (!bytes) throw std::runtime_error(bytes.error().message);
    bytes_.push_back(std::move(*bytes));
  }
  void turn(base::Result<Edit> (History::*way)(const EditSink&)) {
    while (way == &History::undo ? history_.can_undo() : history_.can_redo()) {
      const auto edit = (history_.*way)(world_);
      if (!edit) throw std::runtime_error(edit.error().message);
      keep(*edit);
    }
  }

  base::Random random_;
  RandomEdits edits_;
  World world_;
  History history_;
  std::vector<std::string> bytes_;
};

void expect_there_and_back(std::uint64_t seed, int length) {
  const std::uint64_t first = hash(World());
  Sequence sequence(seed);
  sequence.edit(length);
  const std::uint64_t last = hash(sequence.world());
  ASSERT_EQ(complaints(sequence.world()), "") << seed;
  sequence.turn_back();
  ASSERT_EQ(hash(sequence.world()), first) << seed;
  ASSERT_EQ(complaints(sequence.world()), "") << seed;
  sequence.go_on();
  ASSERT_EQ(hash(sequence.world()), last) << seed;
  const World replayed = sequence.replayed();
  ASSERT_EQ(hash(replayed), last) << seed;
  ASSERT_EQ(complaints(replayed), "") << seed;
}

TEST(EditSequences, GoThereAndBackAgain) {
  for (int seed = 0; seed < kSequences && !HasFatalFailure(); ++seed)
    expect_there_and_back(std::uint64_t(seed), 10 + seed % 91);
}

TEST(EditSequences, GoThereAndBackAgainWhenTheyAreLong) {
  for (int seed = 0; seed < kLongSequences && !HasFatalFailure(); ++seed)
    expect_there_and_back(1'000'000 + std::uint64_t(seed), 2'000);
}

}  // namespace
}  // namespace icome::world
