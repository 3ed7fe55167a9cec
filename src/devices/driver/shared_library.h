#pragma once
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::devices {

/// A library of a device's maker that is found when it is needed, not when the program is built.
struct LibrarySought {
  std::string_view what;                    // for people: "OpenHaptics of 3D Systems"
  const char* variable;                     // environment variable that names another library, or its path
  std::span<const char* const> file_names;  // tried in this order where the variable is not set
  std::string_view advice;                  // a sentence: what to install
};

/// A shared library that has been loaded. It stays loaded for the rest of the program, as makers' libraries
/// leave threads behind.
class SharedLibrary {
 public:
  /// Loads the first library that there is. The error tells people the library, the places, and what to do.
  /// Main's and a driver's thread's.
  static base::Result<SharedLibrary> open(const LibrarySought& sought);

  /// Sets `function` to the function of that name; the error names it and the library.
  template <typename Function>
  base::Result<void> get(const char* name, Function*& function) const {
    void* address = find(name);
    if (address == nullptr) return lacks(name);
    function = reinterpret_cast<Function*>(address);
    return {};
  }
  /// As get(), for a function that only newer libraries have: null where it is missing.
  template <typename Function>
  void get_if_there(const char* name, Function*& function) const {
    function = reinterpret_cast<Function*>(find(name));
  }

 private:
  SharedLibrary(void* handle, std::string file, std::string_view what)
      : handle_(handle), file_(std::move(file)), what_(what) {}
  void* find(const char* name) const;
  tl::unexpected<base::Error> lacks(const char* name) const;

  void* handle_;  // of dlopen
  std::string file_;
  std::string what_;
};

}  // namespace icome::devices
