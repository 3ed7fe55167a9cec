#include "io/url_policy.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

namespace icome::io {
namespace {

namespace fs = std::filesystem;

class UrlPolicy : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "design/parts");
    write("design/main.wrl", "main");
    write("design/parts/a b.png", "picture");
    write("shared.png", "shared");
  }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  base::Result<std::string> fetch(std::string_view url, std::uint64_t limit = 100) const {
    UrlReach reach(folder_ / "design/main.wrl");
    return fetch_beside(folder_ / "design/main.wrl", url, limit, reach);
  }

  const fs::path folder_ =
      fs::path(testing::TempDir()) /
      (std::string("url_policy_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(UrlPolicy, FollowsRelativeUrlsHoweverTheyAreWritten) {
  for (const char* url : {"parts/a b.png", "parts/a%20b.png", "parts\\a b.png", "parts%5Ca%20b.png",
                          "./parts/../parts/a b.png", "file:parts/a b.png", "parts/a b.png#Name"}) {
    const auto bytes = fetch(url);
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(*bytes, "picture") << url;
  }
}

TEST_F(UrlPolicy, LeadsNowhereAboveTheDesignUnlessToldTo) {
  fs::create_directory_symlink("..", folder_ / "design/up");
  fs::create_symlink("../shared.png", folder_ / "design/link.png");
  write("design/parts/own.wrl", "own");
  const fs::path main = folder_ / "design/main.wrl", part = folder_ / "design/parts/own.wrl";
  UrlReach near(main);
  for (const char* url :
       {"../shared.png", "%2e%2e/shared.png", "..\\shared.png", "parts/../../shared.png",
        "file:../shared.png", "up/shared.png", "link.png", "../gone.png", "../../../etc/passwd"}) {
    const auto found = find_beside(main, url, near);
    ASSERT_FALSE(found) << url;
    EXPECT_NE(found.error().message.find("it leads above the folder of the design"), std::string::npos)
        << found.error().message;
  }
  EXPECT_FALSE(find_beside(part, "../../shared.png", near));
  EXPECT_EQ(find_beside(part, "../main.wrl", near).value(), fs::canonical(main))
      << "below the design's folder";
  EXPECT_EQ(near.sentences(), std::vector<std::string>());

  UrlReach far(main, true);
  const fs::path shared = fs::canonical(folder_) / "shared.png";
  EXPECT_EQ(find_beside(main, "../shared.png", far).value(), shared);
  EXPECT_EQ(find_beside(part, "../../shared.png", far).value(), shared);
  EXPECT_EQ(find_beside(main, "link.png", far).value(), shared);
  EXPECT_TRUE(find_beside(main, "parts/own.wrl", far));
  EXPECT_EQ(
      far.sentences(),
      std::vector<std::string>{
          shared.string() + " lies above the design's folder: it is taken in, and goes into what is saved."});
}

TEST_F(UrlPolicy, TakesADesignThatIsALinkForOneOfBothFolders) {
  fs::create_symlink("../main.wrl", folder_ / "design/parts/main.wrl");
  write("design/parts/beside.png", "beside");
  write("design/far.png", "far");
  UrlReach reach(folder_ / "design/parts/main.wrl");
  EXPECT_TRUE(find_beside(folder_ / "design/parts/main.wrl", "beside.png", reach));
  EXPECT_TRUE(find_beside(folder_ / "design/main.wrl", "far.png", reach));
}

TEST_F(UrlPolicy, TakesANameLiterallyBeforeItTakesItAsAUrl) {
  write("design/100%25.png", "literal");
  write("design/100%.png", "decoded");
  EXPECT_EQ(fetch("100%25.png").value(), "literal");
  EXPECT_EQ(fetch("100%.png").value(), "decoded");
}

TEST_F(UrlPolicy, RefusesWhatDoesNotCountFromTheFile) {
  const std::string inside = (folder_ / "shared.png").string();
  for (const std::string& url : {std::string("http://example.org/a.png"),
                                 std::string("FTP:a.png"),
                                 std::string("urn:inet:a"),
                                 std::string("data:image/png;base64,AAAA"),
                                 std::string("javascript:a()"),
                                 std::string("C:\\a.png"),
                                 std::string("\\\\host\\a.png"),
                                 std::string("//host/a.png"),
                                 std::string("/etc/passwd"),
                                 inside,
                                 "file://" + inside,
                                 "file:" + inside,
                                 "file:///" + inside,
                                 std::string("%2Fetc/passwd"),
                                 std::string("%5C%5Chost/a"),
                                 std::string("htt%70:a"),
                                 std::string("file:http:a"),
                                 std::string(),
                                 std::string("file:"),
                                 std::string("#Name"),
                                 std::string("a%00.png"),
                                 std::string("a\0.png", 6)}) {
    const auto bytes = fetch(url);
    ASSERT_FALSE(bytes) << url;
    EXPECT_NE(bytes.error().message.find("is not fetched: "), std::string::npos) << bytes.error().message;
    EXPECT_EQ(bytes.error().message.find("no such file"), std::string::npos) << bytes.error().message;
  }
}

TEST_F(UrlPolicy, RefusesWhatIsNoRegularFile) {
  ASSERT_EQ(::mkfifo((folder_ / "design/pipe").c_str(), 0600), 0);
  for (const char* url :
       {"parts", ".", "..", "pipe", "missing.png", "parts/a b.png/x", "../../../../../dev/zero"})
    EXPECT_FALSE(fetch(url)) << url;
  EXPECT_FALSE(fetch(std::string(100'000, 'x')));
  EXPECT_FALSE(fetch("parts/a b.png", 6)) << "larger than the limit";
}

TEST_F(UrlPolicy, ResolvesLinks) {
  fs::create_symlink("parts/a b.png", folder_ / "design/link.png");
  fs::create_symlink("loop.png", folder_ / "design/loop.png");
  UrlReach reach(folder_ / "design/main.wrl");
  EXPECT_EQ(find_beside(folder_ / "design/main.wrl", "link.png", reach).value(),
            fs::canonical(folder_ / "design/parts/a b.png"));
  EXPECT_FALSE(fetch("loop.png"));
}

TEST_F(UrlPolicy, FindsWhatPackagesInstalled) {
  const fs::path installed = fs::canonical(folder_) / "installed";
  fs::create_directories(installed / "models");
  write("installed/models/a b.obj", "mesh");
  write("installedtoo.obj", "secret");
  fs::create_symlink("a b.obj", installed / "models/link.obj");
  fs::create_symlink("../shared.png", installed / "out.obj");
  fs::create_directory_symlink("..", installed / "up");
  const auto find = [&](const std::string& url) {
    UrlReach reach(folder_ / "design/main.wrl");
    return find_installed_or_beside(folder_ / "design/main.wrl", url, installed, reach);
  };
  const std::string there = installed.string();
  for (const std::string& url :
       {there + "/models/a b.obj", there + "/models/a%20b.obj", "file://" + there + "/models/a%20b.obj",
        "file:" + there + "/models/a b.obj", "file://localhost" + there + "/models/a b.obj",
        there + "/models/.//a b.obj", there + "/models/link.obj"}) {
    const auto found = find(url);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(*found, installed / "models/a b.obj") << url;
  }
  EXPECT_EQ(find("parts/a b.png").value(), fs::canonical(folder_ / "design/parts/a b.png"))
      << "below, as ever";
  EXPECT_FALSE(find("../shared.png"));
  for (const std::string& url :
       {there, there + "/models", there + "/gone.obj", there + "/out.obj", there + "/up/shared.png",
        there + "/../shared.png", there + "/%2e%2e/shared.png", there + "too.obj", std::string("/etc/passwd"),
        "//host" + there + "/models/a b.obj", "file://host" + there + "/models/a b.obj",
        "http://" + there + "/models/a b.obj", there + "/models/a b.obj%00", std::string("file:///"),
        there + std::string("/models/a b.obj\0", 16)})
    EXPECT_FALSE(find(url)) << url;
  // Behind a link `..` leads elsewhere than the text says, so no such name is looked for.
  for (const char* name : {"/models/../models/a b.obj", "/up/../design/main.wrl", "/up/../design/gone.wrl",
                           "/up/%2e%2e/design/main.wrl", "/up/%2e%2e/design/gone.wrl"}) {
    const auto found = find(there + name);
    ASSERT_FALSE(found) << name;
    EXPECT_TRUE(found.error().message.ends_with("only names without \"..\" are")) << found.error().message;
  }
  // Nothing is learnt of what lies elsewhere.
  EXPECT_EQ(find("/etc/passwd").error().message.find("no such"), std::string::npos);
  EXPECT_EQ(find("/etc/passwd").error().message.substr(15), find("/etc/nosuch").error().message.substr(15));
}

TEST_F(UrlPolicy, ErrorsAreOneShortLine) {
  const auto bytes = fetch("data:\n" + std::string(1'000'000, 'A'));
  ASSERT_FALSE(bytes);
  EXPECT_LT(bytes.error().message.size(), 300U);
  EXPECT_EQ(bytes.error().message.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace icome::io
