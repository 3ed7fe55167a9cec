#pragma once
#include <fmt/format.h>
#include <sys/types.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/result.h"
#include "collab/protocol/address.h"

namespace icome::benchmarks {

/// The value, or the end of the program.
template <typename T>
T demand(base::Result<T> result) {
  if (!result) {
    fmt::print(stderr, "{}\n", result.error().message);
    std::exit(1);
  }
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

/// A folder of its own below another one, removed with the object.
class BenchFolder {
 public:
  explicit BenchFolder(const std::filesystem::path& within);
  BenchFolder(const BenchFolder&) = delete;
  BenchFolder& operator=(const BenchFolder&) = delete;
  ~BenchFolder();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// icome-server as a process of its own, with the store of a folder. Ends with the object.
class ServerProcess {
 public:
  /// Port 0: one that is free.
  ServerProcess(std::filesystem::path program, std::filesystem::path store, int port = 0);
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;
  ~ServerProcess();

  /// The address of a design, which is made where there is none, for an owner.
  collab::DesignAddress invite(const std::string& design) const;
  /// Kills it, as a fault of the machine would.
  void kill();

  /// Processor time so far, s.
  double used() const;
  /// Memory, kB.
  double memory() const;

 private:
  std::filesystem::path store_;
  pid_t process_ = -1;
};

}  // namespace icome::benchmarks
