#include "session/sharing/recent_addresses.h"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "collab/protocol/address.h"
#include "collab/storage/private_file.h"

namespace icome::session {
namespace {

bool is_same_design(const std::string& one, const std::string& other) {
  const auto a = collab::design_address(one), b = collab::design_address(other);
  return a && b && a->host == b->host && a->port == b->port && a->design == b->design;
}

}  // namespace

RecentAddresses::RecentAddresses(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty() || !collab::demand_private(file_)) return;
  std::ifstream in(file_);
  for (std::string line; links_.size() < kMost && std::getline(in, line);)
    if (collab::design_address(line)) links_.push_back(line);
}

void RecentAddresses::add(const std::string& link) {
  std::erase_if(links_, [&](const std::string& it) { return is_same_design(it, link); });
  links_.insert(links_.begin(), link);
  if (links_.size() > kMost) links_.pop_back();
  keep();
}

void RecentAddresses::remove(const std::string& link) {
  if (std::erase(links_, link) > 0) keep();
}

/// A disk without room only costs the list.
void RecentAddresses::keep() const {
  if (file_.empty()) return;
  std::string text;
  for (const std::string& link : links_) text += link + "\n";
  std::filesystem::path fresh = file_;
  fresh += ".new";
  std::error_code ignored;
  std::filesystem::create_directories(file_.parent_path(), ignored);
  std::filesystem::remove(fresh, ignored);
  const auto made = collab::make_private_file(fresh, text);
  if (made && *made) std::filesystem::rename(fresh, file_, ignored);
}

}  // namespace icome::session
