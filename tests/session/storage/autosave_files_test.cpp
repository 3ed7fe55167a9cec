#include "session/storage/autosave_files.h"

#include <sys/stat.h>

#include <cstdlib>

#include "session/autosave_samples.h"

namespace icome::session {
namespace {

namespace fs = std::filesystem;

/// An environment variable that is set, or not there, meanwhile.
class OtherVariable {
 public:
  OtherVariable(const char* name, const char* value) : name_(name) {
    if (const char* const old = std::getenv(name)) old_ = old;
    put(value);
  }
  OtherVariable(const OtherVariable&) = delete;
  OtherVariable& operator=(const OtherVariable&) = delete;
  ~OtherVariable() { put(old_ ? old_->c_str() : nullptr); }

 private:
  void put(const char* value) { value ? ::setenv(name_, value, 1) : ::unsetenv(name_); }

  const char* name_;
  std::optional<std::string> old_;
};

TEST(AutosaveFiles, LieWhereProgramsKeepTheirState) {
  const OtherVariable home("HOME", "/home/me");
  {
    const OtherVariable state("XDG_STATE_HOME", "/state");
    EXPECT_EQ(default_autosave_folder(), "/state/icome/autosave");
  }
  for (const char* const none : {static_cast<const char*>(nullptr), "", "relative/state"}) {
    const OtherVariable state("XDG_STATE_HOME", none);
    EXPECT_EQ(default_autosave_folder(), "/home/me/.local/state/icome/autosave");
    const OtherVariable no_home("HOME", none);
    EXPECT_EQ(default_autosave_folder(), fs::path());
  }
}

TEST(AutosaveFiles, AreForTheirOwnerOnly) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "icome" / "autosave";
  ASSERT_TRUE(make_autosave_folder(folder));
  struct stat status {};
  ASSERT_EQ(::stat(folder.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777U, 0700U);
  EXPECT_TRUE(make_autosave_folder(folder));
  const auto under_a_file = make_autosave_folder(scratch.write("file", "") / "autosave");
  ASSERT_FALSE(under_a_file);
  EXPECT_NE(under_a_file.error().message.find("cannot be made (Not a directory)"), std::string::npos);
}

TEST(AutosaveFiles, TellWhichDesignTheyAreOf) {
  const ScratchFolder folder;
  const fs::path journal = new_autosave_journal(folder.path());
  EXPECT_TRUE(is_autosave_journal(journal));
  EXPECT_EQ(read_design_of(journal), fs::path()) << "nothing is noted";
  // Whatever a file may be called.
  for (const char* const name :
       {"", "/designs/a b.wrl", "/designs/line\nbreak\r\n.wrl", "/designs/\xff\xfe.wrl"}) {
    ASSERT_TRUE(write_design_of(journal, name));
    EXPECT_EQ(read_design_of(journal), fs::path(name));
  }
  ASSERT_TRUE(write_design_of(journal, "here.wrl"));
  EXPECT_EQ(read_design_of(journal), fs::current_path() / "here.wrl");
  const fs::path note = fs::path(journal).replace_extension(".of");
  for (const std::string& damaged : {std::string(), std::string("ICOME"), std::string(300000, 'x'),
                                     std::string("ICOME autosave, work on:\n/a\0b", 29)}) {
    std::ofstream(note, std::ios::binary) << damaged;
    EXPECT_EQ(read_design_of(journal), fs::path());
  }
}

TEST(AutosaveFiles, AreNamedAnewEachTime) {
  const ScratchFolder folder;
  EXPECT_NE(new_autosave_journal(folder.path()), new_autosave_journal(folder.path()));
}

TEST(AutosaveFiles, GoWithAllThatBelongsToThemAndNothingElse) {
  const ScratchFolder folder;
  const std::vector<std::string> strange = {"autosave-1.icome.bak", "autosave-1.icome.part-x",
                                            "autosave-1.off",       "autosave-10.icome",
                                            "autosave-10.of",       "notes.of",
                                            "plan.icome",           "plan.icome.part-7"};
  for (const std::string& name : strange) folder.write(name, "");
  for (const char* const name :
       {"autosave-1.icome", "autosave-1.of", "autosave-1.icome.part-123", "autosave-1.of.part-4"})
    folder.write(name, "");
  remove_autosave(folder.path() / "autosave-1.icome");
  EXPECT_EQ(names_in(folder.path()), strange);
}

TEST(AutosaveFiles, AreSweptOfWhatWasLeftHalfDone) {
  const ScratchFolder folder;
  std::vector<std::string> kept = {"autosave-1.icome", "autosave-1.icome.part-5", "autosave-1.of", "plan.of"};
  for (const std::string& name : kept) folder.write(name, "");
  for (const char* const name : {"autosave-2.of", "autosave-3.icome.part-5", "autosave-3.of.part-5001"})
    folder.write(name, "");
  sweep_autosave_folder(folder.path());
  EXPECT_EQ(names_in(folder.path()), kept);
  sweep_autosave_folder(folder.path() / "gone");
}

}  // namespace
}  // namespace icome::session
