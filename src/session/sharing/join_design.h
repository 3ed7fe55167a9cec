#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "collab/client/connection.h"
#include "collab/client/kept_design.h"
#include "files/design.h"

namespace icome::session {

/// All that the thread which joined a design hands over, besides the design.
struct JoinedDesign {
  std::unique_ptr<collab::Connection> connection = nullptr;  // null: the server lets one in no more
  std::shared_ptr<const collab::KeptDesign> kept = nullptr;  // not null: kept for offline work
  std::int64_t kept_at = 0;   // ms since 1970, of the copy that one goes on with; 0: none
  std::string damage = {};    // a copy that was kept was put aside: the reason, and where it is
  std::string why_away = {};  // the copy is what there is, as the server is not to be reached: the reason
};

/// The folder of designs that are kept for offline work; empty where the system names no place for it.
std::filesystem::path default_kept_folder();

/// Joins a design, and waits until it is here. A design that is kept below `kept_folder` (empty: none are)
/// goes on where it was left, and is there without its server, too.
base::Result<files::LoadedDesign> join_design(const collab::DesignAddress& address, const std::string& name,
                                              const std::filesystem::path& kept_folder, JoinedDesign& joined,
                                              const files::DesignReadOptions& options);

}  // namespace icome::session
