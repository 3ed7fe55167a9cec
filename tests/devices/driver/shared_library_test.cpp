#include "devices/driver/shared_library.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "devices/fakes/loaded_fake.h"

namespace icome::devices {
namespace {

constexpr const char* kVariable = "ICOME_TEST_LIBRARY";
constexpr std::array<const char*, 2> kAbsent = {"libicome-none.so", "libicome-none.so.2"};
constexpr std::array<const char*, 2> kMathematics = {"libicome-none.so", "libm.so.6"};

LibrarySought sought(std::span<const char* const> names) {
  return {"Somebody", kVariable, names, "install the package somebody"};
}

TEST(SharedLibrary, IsTheFirstThatThereIs) {
  const auto library = SharedLibrary::open(sought(kMathematics));
  ASSERT_TRUE(library) << library.error().message;
  double (*cube_root)(double) = nullptr;
  ASSERT_TRUE(library->get("cbrt", cube_root));
  EXPECT_NEAR(cube_root(27.0), 3.0, 1e-9);
}

TEST(SharedLibrary, MissingFunctionIsNamed) {
  const auto library = SharedLibrary::open(sought(kMathematics));
  ASSERT_TRUE(library);
  void (*function)() = nullptr;
  const auto got = library->get("icome_no_such_function", function);
  ASSERT_FALSE(got);
  EXPECT_EQ(
      got.error().message,
      "libm.so.6 has no function icome_no_such_function, so it is no library of Somebody that can be used; "
      "install a newer one");
  library->get_if_there("icome_no_such_function", function);
  EXPECT_EQ(function, nullptr);
}

TEST(SharedLibrary, AbsentOneIsToldWithWhereItWasLookedFor) {
  const auto library = SharedLibrary::open(sought(kAbsent));
  ASSERT_FALSE(library);
  EXPECT_EQ(
      library.error().message,
      "the library of Somebody is not on this system: there is no libicome-none.so, libicome-none.so.2 in "
      "LD_LIBRARY_PATH, the folders of /etc/ld.so.conf, /lib or /usr/lib; install the package somebody, or "
      "set ICOME_TEST_LIBRARY to the path of the library");
}

TEST(SharedLibrary, VariableNamesTheOnlyOneThatIsTried) {
  const fakes::EnvironmentValue variable(kVariable, "/nowhere/lib.so");
  const auto library = SharedLibrary::open(sought(kMathematics));
  ASSERT_FALSE(library);
  EXPECT_EQ(
      library.error().message,
      "ICOME_TEST_LIBRARY is set to /nowhere/lib.so, where there is no library of Somebody; correct or unset "
      "it");
}

TEST(SharedLibrary, FileThatIsNoLibraryIsToldAsSuch) {
  const std::string path =
      std::filesystem::temp_directory_path() / ("icome-no-library-" + std::to_string(getpid()));
  std::ofstream(path) << "text";
  const fakes::EnvironmentValue variable(kVariable, path);
  const auto library = SharedLibrary::open(sought(kMathematics));
  std::filesystem::remove(path);
  ASSERT_FALSE(library);
  const std::string& why = library.error().message;
  EXPECT_EQ(why.find("ICOME_TEST_LIBRARY is set to " + path +
                     ", which cannot be loaded as the library of Somebody"),
            0u)
      << why;
  EXPECT_TRUE(why.ends_with("correct or unset it")) << why;
}

}  // namespace
}  // namespace icome::devices
