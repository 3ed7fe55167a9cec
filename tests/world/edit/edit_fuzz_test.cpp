// Whatever bytes come from a stranger or a broken disk: an edit or a refusal, in bounded memory, and a
// world that took it holds together.

#include "world/complaints.h"
#include "world/edit/edit_bytes.h"
#include "world/every_edit.h"
#include "world/random_edits.h"

namespace icome::world {
namespace {

#ifdef ICOME_ADDRESS_SANITIZER
constexpr int kRounds = 3'000;
#else
constexpr int kRounds = 30'000;
#endif

/// Bytes for which a world can be asked whether it holds together.
std::vector<std::string> every_edit_as_bytes() {
  std::vector<std::string> all;
  for (const Edit& edit : every_edit()) all.push_back(to_bytes(edit).value());
  return all;
}

/// Overwrites a word by a number that readers stumble over.
void set_word(std::string& bytes, base::Random& random) {
  constexpr std::uint64_t kNumbers[] = {0,
                                        1,
                                        0x7fffffff,
                                        0x80000000,
                                        0xffffffff,
                                        0xfffffff8,
                                        0x7ff0000000000000,
                                        0xfff8000000000000,
                                        ~std::uint64_t{0}};
  const std::uint64_t number = kNumbers[random.index(std::size(kNumbers))];
  const std::size_t width = std::size_t{1} << random.index(4);
  if (bytes.size() < width) return;
  const std::size_t at = random.index(bytes.size() - width + 1);
  for (std::size_t i = 0; i < width; ++i) bytes[at + i] = char(number >> (8 * i));
}

void mutate(std::string& bytes, const std::string& other, base::Random& random) {
  const std::size_t at = random.index(bytes.size() + 1);
  switch (random.index(6)) {
    case 0:
      if (at < bytes.size()) bytes[at] ^= char(1 << random.index(8));
      break;
    case 1:
    case 2:
      set_word(bytes, random);
      break;
    case 3:
      bytes.erase(at, 1 + random.index(16));
      break;
    case 4:
      bytes.insert(at, other.substr(random.index(other.size()), 1 + random.index(64)));
      break;
    default:  // half of one, half of another
      bytes = bytes.substr(0, at) + other.substr(random.index(other.size()));
  }
}

std::string mutated(const std::vector<std::string>& all, base::Random& random) {
  std::string bytes = all[random.index(all.size())];
  for (std::uint64_t times = 1 + random.index(4); times > 0 && !bytes.empty(); --times)
    mutate(bytes, all[random.index(all.size())], random);
  return bytes;
}

/// A world that has something of everything, so that strange edits find what they name.
World furnished() {
  World world;
  for (const Edit& edit : every_edit()) (void)apply(world, edit);
  RandomEdits edits(7);
  for (int i = 0; i < 100; ++i) (void)apply(world, edits.next(world));
  return world;
}

TEST(EditFuzz, LeavesWorldsThatHoldTogether) {
  const std::vector<std::string> all = every_edit_as_bytes();
  const World before = furnished();
  ASSERT_EQ(complaints(before), "");
  const std::uint64_t number = hash(before);
  base::Random random(11);
  int accepted = 0;
  for (int round = 0; round < kRounds; ++round) {
    const auto edit = edit_from_bytes(mutated(all, random), GeometryFactory());
    if (!edit) {
      ASSERT_FALSE(edit.error().message.empty());
      continue;
    }
    World world = before;
    const auto inverse = apply(world, *edit);
    ASSERT_EQ(complaints(world), "") << "round " << round;
    if (!inverse) continue;
    ++accepted;
    const auto back = apply(world, *inverse);
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(hash(world), number) << "round " << round;
  }
  EXPECT_GT(accepted, kRounds / 200);  // else nothing was tested
}

TEST(EditFuzz, OfEditsAfterEachOtherLeavesWorldsThatHoldTogether) {
  const std::vector<std::string> all = every_edit_as_bytes();
  base::Random random(12);
  for (int sequence = 0; sequence < kRounds / 300; ++sequence) {
    World world;
    for (int i = 0; i < 100; ++i) {
      const bool whole = random.index(2) == 0;
      const auto edit =
          edit_from_bytes(whole ? all[random.index(all.size())] : mutated(all, random), GeometryFactory());
      if (edit) (void)apply(world, *edit);
    }
    ASSERT_EQ(complaints(world), "") << "sequence " << sequence;
  }
}

TEST(EditFuzz, HoldsMemoryInProportionToTheBytes) {
  std::vector<std::string> all;
  for (const Edit& edit : every_edit()) {
    const auto* made = std::get_if<CreateGeometry>(&edit.what);
    if (made) all.push_back(to_bytes(edit).value());
  }
  base::Random random(13);
  for (int round = 0; round < kRounds; ++round) {
    const std::string bytes = mutated(all, random);
    const auto edit = edit_from_bytes(bytes, GeometryFactory());
    const auto* made = edit ? std::get_if<CreateGeometry>(&edit->what) : nullptr;
    // What a formula needs follows from the formula, not from the bytes.
    if (!made || !made->shape || made->shape->kind() == "implicit") continue;
    EXPECT_LE(made->shape->bytes(), 4096 + 64 * bytes.size()) << "round " << round;
  }
}

}  // namespace
}  // namespace icome::world
