#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace icome::session {

/// The addresses of designs on servers that were joined last, the newest first, in a file that only its owner
/// may read, as each is a key to its design.
class RecentAddresses {
 public:
  static constexpr std::size_t kMost = 8;

  /// Empty: nothing is kept. A file that cannot be read counts as none.
  explicit RecentAddresses(std::filesystem::path file);

  const std::vector<std::string>& links() const { return links_; }
  /// Another address of the same design on the same server goes.
  void add(const std::string& link);
  void remove(const std::string& link);

 private:
  void keep() const;

  std::filesystem::path file_;
  std::vector<std::string> links_;
};

}  // namespace icome::session
