#pragma once
#include <unordered_map>
#include <utility>
#include <vector>

#include "files/findings.h"
#include "files/journal/journal_format.h"
#include "world/edit/permit.h"

namespace icome::files {

/// Applies to a world as much as possible of edits that build on things lost by a damage: an object whose
/// parent is lost becomes a root, one whose shape or material is lost has none. Notes what is missing, for
/// people. World and permit outlive it.
class JournalMending {
 public:
  JournalMending(world::World& world, const world::Permit& permit) : world_(world), permit_(permit) {}

  /// Performs each edit of a group by itself. Nothing where all of it could be done, else why the first that
  /// was left out could not.
  std::optional<base::Error> perform(const world::Edit& edit);

  /// Takes the names of what should be there now; notes what is missing.
  void compare(const JournalNames& names);
  /// Sentences on what is missing.
  std::vector<Remark> remarks() const;

 private:
  struct LostParent {
    std::string child;
    world::ObjectId parent;
  };

  base::Result<void> perform_one(const world::Edit& edit);
  world::Edit mended(world::CreateObject edit);
  world::Edit mended(world::MoveObject edit);
  world::Edit mended(world::EnterScene edit) const;
  world::Edit mended(world::CreateMaterial edit);
  world::Edit mended(world::ChangeMaterial edit);
  template <typename Kind>
  world::Edit mended(const Kind& edit) const {
    return edit;
  }
  void drop_lost_parent(world::ObjectId& parent, const std::string& child);
  void drop_lost_texture(world::Material& material);
  std::size_t siblings(world::ObjectId parent) const;

  world::World& world_;
  const world::Permit& permit_;
  Findings findings_;
  std::vector<LostParent> lost_parents_;
  std::unordered_map<world::ObjectId, std::string> missing_;  // named by the table, but missing
};

}  // namespace icome::files
