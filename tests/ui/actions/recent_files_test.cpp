#include "ui/actions/recent_files.h"

#include <gtest/gtest.h>

#include <QSettings>
#include <QTemporaryDir>

namespace icome::ui {
namespace {

struct KeptSettings {
  QTemporaryDir folder;
  QSettings settings = QSettings(folder.filePath("icome.conf"), QSettings::IniFormat);
};

TEST(RecentFiles, PutsTheNewestFirstAndEachOnce) {
  KeptSettings kept;
  RecentFiles recent(kept.settings);
  recent.add("/a/one.wrl");
  recent.add("/a/two.wrl");
  recent.add("/a/b/../one.wrl");
  EXPECT_EQ(recent.paths(), (QStringList{"/a/one.wrl", "/a/two.wrl"}));
}

TEST(RecentFiles, AreKeptForTheNextTime) {
  KeptSettings kept;
  RecentFiles(kept.settings).add("/a/\u00fcber \u0434.wrl");
  kept.settings.sync();
  EXPECT_EQ(RecentFiles(kept.settings).paths(), QStringList("/a/\u00fcber \u0434.wrl"));
}

TEST(RecentFiles, ForgetTheOldest) {
  KeptSettings kept;
  RecentFiles recent(kept.settings);
  for (int i = 0; i < 15; ++i) recent.add("/a/" + std::to_string(i) + ".wrl");
  EXPECT_EQ(recent.paths().size(), RecentFiles::kMost);
  EXPECT_EQ(recent.paths().front(), "/a/14.wrl");
  EXPECT_EQ(recent.paths().back(), "/a/5.wrl");
  recent.remove("/a/./14.wrl");
  EXPECT_EQ(recent.paths().front(), "/a/13.wrl");
  recent.clear();
  EXPECT_TRUE(RecentFiles(kept.settings).paths().isEmpty());
}

TEST(RecentFiles, SurviveDamagedSettings) {
  KeptSettings kept;
  kept.settings.setValue("recent", QStringList{"", "/a/one.wrl", "/a/one.wrl"});
  EXPECT_EQ(RecentFiles(kept.settings).paths(), QStringList("/a/one.wrl"));
  kept.settings.setValue("recent", 17);
  EXPECT_LE(RecentFiles(kept.settings).paths().size(), 1);
}

TEST(RecentFiles, TellFilesOfOneNameApart) {
  KeptSettings kept;
  RecentFiles recent(kept.settings);
  recent.add("/a/one.wrl");
  recent.add("/b/one.wrl");
  recent.add("/b/two.wrl");
  EXPECT_EQ(recent.labels(), (QStringList{"two.wrl", "one.wrl  (/b)", "one.wrl  (/a)"}));
}

TEST(TextOf, GoesBothWays) {
  const std::filesystem::path path = "/a/\u00fc \u0434.wrl";
  EXPECT_EQ(path_of(text_of(path)), path);
}

}  // namespace
}  // namespace icome::ui
