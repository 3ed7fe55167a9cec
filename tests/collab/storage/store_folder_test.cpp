#include "collab/storage/store_folder.h"

#include "collab/storage/private_file.h"
#include "collab/storage/sample_log.h"
#include "files/sample_files.h"
#include "memory_place.h"

namespace icome::collab {
namespace {

namespace fs = std::filesystem;

const std::string kPrint = "sha256:" + std::string(60, '0') + "9abf";

class StoreFolderTest : public testing::Test {
 protected:
  files::ScratchFolder scratch_{memory_place()};
  StoreFolder folder_ = good(StoreFolder::make(scratch_.path() / "data" / "store"));
};

TEST_F(StoreFolderTest, IsItsOwnersOnly) {
  EXPECT_EQ(fs::status(folder_.path()).permissions(), fs::perms(0700));
  EXPECT_EQ(folder_.designs(), folder_.path() / "designs.sqlite");
  EXPECT_TRUE(StoreFolder::make(folder_.path())) << "it is there";
  EXPECT_TRUE(StoreFolder::open(folder_.path()));
  EXPECT_EQ(good(StoreFolder::make(scratch_.path() / "other" / "")).path(), scratch_.path() / "other");
  EXPECT_EQ(fs::status(scratch_.path() / "other").permissions(), fs::perms(0700));
}

TEST_F(StoreFolderTest, IsNoneWhereOthersMayWrite) {
  fs::permissions(folder_.path(), fs::perms(0770));
  EXPECT_EQ(sentence_of(StoreFolder::open(folder_.path())),
            folder_.path().string() +
                ": others may write to this folder. Choose another one, or take away their "
                "right: chmod go-w " +
                folder_.path().string());
  EXPECT_FALSE(StoreFolder::open(scratch_.path() / "missing"));
  EXPECT_FALSE(StoreFolder::open(scratch_.write("file", "")));
  EXPECT_FALSE(StoreFolder::make(scratch_.path() / "file"));
  EXPECT_FALSE(StoreFolder::make(scratch_.path() / "file" / "store"));
}

TEST_F(StoreFolderTest, LiesWhereTheSystemKeepsData) {
  ::setenv("XDG_DATA_HOME", "/data", 1);
  EXPECT_EQ(good(StoreFolder::default_path()), "/data/icome/store");
  ::setenv("XDG_DATA_HOME", "relative", 1);
  ::setenv("HOME", "/home/ann", 1);
  EXPECT_EQ(good(StoreFolder::default_path()), "/home/ann/.local/share/icome/store");
  ::unsetenv("XDG_DATA_HOME");
  ::unsetenv("HOME");
  EXPECT_FALSE(StoreFolder::default_path());
}

TEST_F(StoreFolderTest, IsServedByOne) {
  {
    const auto first = good(folder_.lock());
    EXPECT_EQ(sentence_of(folder_.lock()),
              folder_.path().string() +
                  ": a server serves this store already. End it first, or name another store.");
  }
  EXPECT_TRUE(folder_.lock());
}

TEST_F(StoreFolderTest, RemembersWhereItIsServed) {
  EXPECT_FALSE(good(folder_.address()));
  for (const ServedAddress& address :
       {ServedAddress{"127.0.0.1", 40123, kPrint}, ServedAddress{"::1", 1, kPrint},
        ServedAddress{"localhost", 65535, ""}}) {
    good(folder_.write_address(address));
    EXPECT_EQ(good(folder_.address()), address);
  }
  for (const ServedAddress& none :
       {ServedAddress{"", 1, ""}, ServedAddress{"a b", 1, ""}, ServedAddress{"a\nport: 2", 1, ""},
        ServedAddress{"a", 0, ""}, ServedAddress{"a", 1, "md5:1"},
        ServedAddress{std::string(256, 'a'), 1, ""}})
    EXPECT_FALSE(folder_.write_address(none)) << none.host;
  EXPECT_EQ(good(folder_.address())->host, "localhost");
}

TEST_F(StoreFolderTest, TakesNoOtherTextForAnAddress) {
  const std::string whole = "host: a\nport: 7\nfingerprint: " + kPrint + "\n";
  const auto reads = [&](const std::string& text) {
    std::ofstream(folder_.path() / "address") << text;
    return folder_.address().has_value();
  };
  EXPECT_TRUE(reads(whole));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(reads(whole.substr(0, length))) << length;
  EXPECT_FALSE(reads(whole + "\n"));
  EXPECT_FALSE(reads("host: a\nport: 70000\nfingerprint: \n"));
  EXPECT_FALSE(reads("host: a\nport: 0\nfingerprint: \n"));
  EXPECT_FALSE(reads("host: a\nport: 7 \nfingerprint: \n"));
  EXPECT_FALSE(reads("port: 7\nhost: a\nfingerprint: \n"));
  EXPECT_FALSE(reads(std::string(100'000, 'a')));
}

TEST_F(StoreFolderTest, MakesPrivateFilesOnce) {
  const fs::path path = scratch_.path() / "secret";
  EXPECT_TRUE(good(make_private_file(path, "one")));
  EXPECT_FALSE(good(make_private_file(path, "two")));
  EXPECT_EQ(bytes_in(path), "one");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms(0600));
  EXPECT_TRUE(demand_private(path));
  fs::permissions(path, fs::perms(0640));
  EXPECT_FALSE(demand_private(path));
  EXPECT_FALSE(make_private_file(scratch_.path() / "missing" / "secret", ""));
}

}  // namespace
}  // namespace icome::collab
