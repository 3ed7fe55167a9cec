#pragma once
#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace icome::devices::fakes {

/// An environment variable with a value, or without one (null), for as long as this lives.
class EnvironmentValue {
 public:
  EnvironmentValue(const char* name, const char* value) : name_(name) {
    if (value != nullptr)
      setenv(name, value, 1);
    else
      unsetenv(name);
  }
  EnvironmentValue(const char* name, const std::string& value) : EnvironmentValue(name, value.c_str()) {}
  ~EnvironmentValue() { unsetenv(name_); }
  EnvironmentValue(const EnvironmentValue&) = delete;
  EnvironmentValue& operator=(const EnvironmentValue&) = delete;

 private:
  const char* name_;
};

/// Path of the fake library of that name, beside the program.
inline std::string fake_path(const std::string& name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "fakes" / ("lib" + name + ".so");
}

/// A fake library, loaded, that the back-end finds by its environment variable for as long as this lives.
template <typename Fake>
class LoadedFake {
 public:
  /// `name`: of the fake, "fake_dhd"; `variable`: that the back-end looks at.
  LoadedFake(const std::string& name, const char* variable) : variable_(variable, fake_path(name)) {
    handle_ = dlopen(fake_path(name).c_str(), RTLD_NOW | RTLD_NODELETE);
    if (handle_ == nullptr) std::abort();
    fake_ = function<Fake*()>(name.c_str())();
  }

  Fake* operator->() const { return fake_; }
  Fake& operator*() const { return *fake_; }
  /// A function that the library exports.
  template <typename Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(dlsym(handle_, name));
  }

 private:
  EnvironmentValue variable_;
  void* handle_ = nullptr;
  Fake* fake_ = nullptr;
};

}  // namespace icome::devices::fakes
