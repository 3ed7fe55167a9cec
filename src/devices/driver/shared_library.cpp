#include "devices/driver/shared_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace icome::devices {
namespace {

// All functions are resolved at once, so that none is looked for while the device is in a hand.
constexpr int kLoading = RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE;

std::string joined(std::span<const char* const> names) {
  std::string text;
  for (const char* name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

/// The message of dlopen, if it says more than that there is no such file.
std::string trouble_with(const char* file) {
  const char* said = dlerror();
  if (said == nullptr) return {};
  const bool is_absent = std::strncmp(said, file, std::strlen(file)) == 0 &&
                         std::strstr(said, "cannot open shared object file: No such file") != nullptr;
  return is_absent ? std::string() : std::string(said);
}

/// Would opening it wait for somebody, or never end?
bool is_pipe_or_device(const char* name) {
  std::error_code error;
  const auto status = std::filesystem::status(name, error);
  return std::filesystem::is_other(status);
}

}  // namespace

base::Result<SharedLibrary> SharedLibrary::open(const LibrarySought& sought) {
  const char* chosen = std::getenv(sought.variable);
  const bool is_chosen = chosen != nullptr && *chosen != '\0';
  const std::span<const char* const> names = is_chosen ? std::span(&chosen, 1) : sought.file_names;
  std::string trouble;
  for (const char* name : names) {
    if (is_chosen && is_pipe_or_device(name)) {
      trouble = "it is a pipe or a device";
      continue;
    }
    if (void* handle = dlopen(name, kLoading)) return SharedLibrary(handle, name, sought.what);
    if (trouble.empty()) trouble = trouble_with(name);
  }
  if (!trouble.empty() && is_chosen)
    return base::fail(
        fmt::format("{} is set to {}, which cannot be loaded as the library of {} ({}); correct or "
                    "unset it",
                    sought.variable, chosen, sought.what, trouble));
  if (!trouble.empty())
    return base::fail(fmt::format("the library of {} is there, but cannot be loaded ({}); {}", sought.what,
                                  trouble, sought.advice));
  if (is_chosen)
    return base::fail(fmt::format("{} is set to {}, where there is no library of {}; correct or unset it",
                                  sought.variable, chosen, sought.what));
  return base::fail(fmt::format(
      "the library of {} is not on this system: there is no {} in LD_LIBRARY_PATH, the folders of "
      "/etc/ld.so.conf, /lib or /usr/lib; {}, or set {} to the path of the library",
      sought.what, joined(sought.file_names), sought.advice, sought.variable));
}

void* SharedLibrary::find(const char* name) const { return dlsym(handle_, name); }

tl::unexpected<base::Error> SharedLibrary::lacks(const char* name) const {
  return base::fail(
      fmt::format("{} has no function {}, so it is no library of {} that can be used; install a "
                  "newer one",
                  file_, name, what_));
}

}  // namespace icome::devices
