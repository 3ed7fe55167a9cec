#include "io/gzip_bytes.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "io/gzip_sample.h"

namespace icome::io {
namespace {

std::string gzip_failure(const std::string& packed, std::uint64_t limit = 1 << 30) {
  const auto result = unpack_gzip(packed, limit, "a.wrz");
  return result ? "none" : result.error().message;
}

TEST(GzipBytes, GoThereAndBack) {
  base::Random random(3);
  for (const std::size_t size : {0UL, 1UL, 1000UL, 1048576UL, 1048577UL, 5000000UL}) {
    std::string text(size, ' ');
    for (char& c : text) c = char('a' + random.index(20));
    const auto result = unpack_gzip(gzipped(text), size, "x");
    ASSERT_TRUE(result.has_value()) << size << result.error().message;
    EXPECT_EQ(*result, text);
  }
}

TEST(GzipBytes, JoinMembersAndPassOverPadding) {
  const auto result = unpack_gzip(gzipped("ab") + gzipped("cd") + std::string(10, '\0'), 100, "x");
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(*result, "abcd");
}

TEST(GzipBytes, AreKnownByTheirHead) {
  EXPECT_TRUE(is_gzip(gzipped("")));
  EXPECT_FALSE(is_gzip("#VRML"));
  EXPECT_FALSE(is_gzip(""));
}

TEST(GzipBytes, RefuseBombs) {
  std::string zeros;
  zeros.resize(50'000'000, '0');
  const std::string bomb = gzipped(zeros);
  EXPECT_LT(bomb.size(), 100'000U);
  EXPECT_EQ(gzip_failure(bomb, 1 << 20), "a.wrz: unpacks to more than the limit of 1 MiB");
  EXPECT_EQ(gzip_failure(bomb, 49'999'999), "a.wrz: unpacks to more than the limit of 47.6837 MiB");
}

TEST(GzipBytes, RefuseWhatIsDamagedOrCutShort) {
  base::Random random(1);
  std::string text(10'000, ' ');
  for (char& c : text) c = char('a' + random.index(20));
  const std::string good = gzipped(text);
  for (std::size_t size = 0; size < good.size(); ++size)
    ASSERT_EQ(gzip_failure(good.substr(0, size)), "a.wrz: the gzip data is cut short") << size;
  for (std::size_t i = 10; i < good.size(); i += 7) {
    std::string bad = good;
    bad[i] = char(bad[i] ^ 0x10);
    ASSERT_NE(gzip_failure(bad), "none") << i;
  }
  EXPECT_EQ(gzip_failure("\x1f\x8b nonsense"), "a.wrz: the gzip data is damaged");
}

}  // namespace
}  // namespace icome::io
