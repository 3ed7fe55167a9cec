#include "collab/content/content_fetcher.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "collab/storage/random_bytes.h"
#include "own_folder.h"

namespace icome::collab {
namespace {

namespace fs = std::filesystem;

/// Answers questions as a server does that has these contents.
class ContentSource {
 public:
  ContentHash add(const std::string& bytes) {
    const ContentHash hash = hash_of_content(bytes);
    contents_[hash] = bytes;
    return hash;
  }
  /// Answers up to so many questions.
  base::Result<void> serve(ContentFetcher& fetcher, std::size_t most = 1'000) {
    for (;;) {
      const std::vector<Fetch> questions = fetcher.questions();
      if (questions.empty()) return {};
      for (const Fetch& question : questions) {
        if (most-- == 0) return {};
        ++asked;
        const std::string& bytes = contents_[question.hash];
        if (auto done =
                fetcher.take({question.hash, question.offset,
                              question.offset < bytes.size() ? bytes.substr(question.offset, question.bytes)
                                                             : std::string()});
            !done)
          return done;
      }
    }
  }
  std::size_t asked = 0;

 private:
  std::map<ContentHash, std::string> contents_;
};

std::string long_bytes(char letter, std::size_t size) {
  std::string bytes(size, letter);
  for (std::size_t i = 0; i < size; i += 97) bytes[i] = char(i);
  return bytes;
}

/// A folder of its own for each test, removed at its end.
class ContentFetcherTest : public testing::Test {
 protected:
  void SetUp() override { fs::remove_all(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  ContentCachePointer cache(std::uint64_t most = FolderContents::kMostBytes) const {
    return std::make_shared<FolderContents>(folder_, most);
  }
  fs::path folder_ = own_folder("contents");
  ContentSource source_;
  const std::string one_ = long_bytes('1', 1'000'000), other_ = long_bytes('2', 300'000);
  /// An outline with two contents, one of them twice.
  const Outline outline_ = [this] {
    source_.add(one_);
    source_.add(other_);
    return outline_of(
        "ab" + one_ + "cd" + other_ + one_,
        {{2, one_.size()}, {4 + one_.size(), other_.size()}, {4 + one_.size() + other_.size(), one_.size()}});
  }();
  const std::string whole_ = "ab" + one_ + "cd" + other_ + one_;
};

TEST_F(ContentFetcherTest, FetchesEachContentOnce) {
  ContentFetcher fetcher(nullptr);
  ASSERT_FALSE(fetcher.whole(to_bytes(outline_)).value());
  EXPECT_EQ(fetcher.bytes_to_fetch(), one_.size() + other_.size());
  ASSERT_TRUE(source_.serve(fetcher));
  EXPECT_EQ(source_.asked, 4U + 2U);
  EXPECT_EQ(fetcher.whole(to_bytes(outline_)).value(), whole_);
}

TEST_F(ContentFetcherTest, GoesOnWhereALostConnectionEnded) {
  ContentFetcher fetcher(nullptr);
  ASSERT_FALSE(fetcher.whole(to_bytes(outline_)).value());
  ASSERT_TRUE(source_.serve(fetcher, 3));
  fetcher.connection_lost();
  EXPECT_FALSE(fetcher.is_fetching());
  ASSERT_FALSE(fetcher.whole(to_bytes(outline_)).value());
  ASSERT_TRUE(source_.serve(fetcher));
  EXPECT_EQ(source_.asked, 4U + 2U) << "nothing twice";
  EXPECT_EQ(fetcher.whole(to_bytes(outline_)).value(), whole_);
}

TEST_F(ContentFetcherTest, KeepsContentsForTheNextProgram) {
  {
    ContentFetcher fetcher(cache());
    ASSERT_FALSE(fetcher.whole(to_bytes(outline_)).value());
    ASSERT_TRUE(source_.serve(fetcher));
    ASSERT_EQ(fetcher.whole(to_bytes(outline_)).value(), whole_);
  }
  ContentFetcher fetcher(cache());
  EXPECT_EQ(fetcher.whole(to_bytes(outline_)).value(), whole_);
  EXPECT_EQ(source_.asked, 4U + 2U);
  EXPECT_EQ(fs::status(folder_).permissions(), fs::perms::owner_all);
}

TEST_F(ContentFetcherTest, BelievesNoDamagedFile) {
  {
    const ContentCachePointer kept = cache();
    kept->keep(hash_of_content(one_), std::make_shared<const std::string>(one_));
  }
  const fs::path file = folder_ / hex_text(hash_of_content(one_));
  ASSERT_TRUE(fs::exists(file));
  std::ofstream(file, std::ios::in | std::ios::out) << "damaged";
  EXPECT_FALSE(cache()->find(hash_of_content(one_)));
  EXPECT_FALSE(fs::exists(file));
}

TEST_F(ContentFetcherTest, KeepsNoMoreThanItMay) {
  const std::string third = long_bytes('3', 500'000);
  {
    const ContentCachePointer kept = cache(1'400'000);
    kept->keep(hash_of_content(one_), std::make_shared<const std::string>(one_));
    kept->keep(hash_of_content(other_), std::make_shared<const std::string>(other_));
    kept->keep(hash_of_content(third), std::make_shared<const std::string>(third));
  }
  const ContentCachePointer kept = cache(1'400'000);
  EXPECT_FALSE(kept->find(hash_of_content(one_))) << "the oldest";
  EXPECT_TRUE(kept->find(hash_of_content(other_)));
  EXPECT_TRUE(kept->find(hash_of_content(third)));
}

TEST_F(ContentFetcherTest, RefusesWhatIsNotWhatItsNameSays) {
  ContentFetcher fetcher(nullptr);
  ASSERT_FALSE(fetcher.whole(to_bytes(outline_of(other_, {{0, other_.size()}}))).value());
  std::string false_bytes = other_;
  false_bytes[12] = '!';
  ASSERT_TRUE(fetcher.take({hash_of_content(other_), 0, false_bytes.substr(0, 200'000)}));
  EXPECT_FALSE(fetcher.take({hash_of_content(other_), 200'000, false_bytes.substr(200'000)}));
}

TEST_F(ContentFetcherTest, SaysWhatTheServerDoesNotHaveAnyMore) {
  ContentFetcher fetcher(nullptr);
  ASSERT_FALSE(fetcher.whole(to_bytes(outline_of(other_, {{0, other_.size()}}))).value());
  EXPECT_FALSE(fetcher.take({hash_of_content(other_), 0, ""}));
}

TEST_F(ContentFetcherTest, RefusesMoreThanWasAnnounced) {
  ContentFetcher fetcher(nullptr);
  ASSERT_FALSE(fetcher.whole(to_bytes(outline_of("12345", {{0, 5}}))).value());
  EXPECT_FALSE(fetcher.take({hash_of_content("12345"), 0, "123456"}));
}

}  // namespace
}  // namespace icome::collab
