#pragma once
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "collab/content/outline.h"

namespace icome::collab {

/// The contents of the edits and snapshots of a design, each once. They are there for as long as somebody has
/// them. One thread.
class ContentShelf {
 public:
  /// Shapes and pictures of at least so many bytes are contents.
  explicit ContentShelf(std::size_t least_bytes) : least_bytes_(least_bytes) {}

  /// Bytes whose contents are on the shelf.
  struct Shelved {
    ContentPointer outline = {};  // to_bytes(Outline)
    std::vector<ContentPointer> contents = {};
    std::size_t bytes = 0;  // of the contents
  };
  /// Takes an edit (world::to_bytes). One without contents gets no outline.
  Shelved take_edit(std::string_view edit);
  /// A world whose outline is a content itself, of this name.
  struct ShelvedWorld {
    ContentHash hash = {};
    Shelved shelved = {};
  };
  /// Takes a world (world_to_bytes).
  ShelvedWorld take_world(std::string_view world);

  /// Null: it is not here (any more).
  ContentPointer find(const ContentHash& hash) const;

 private:
  Shelved shelve(std::string_view whole, const std::vector<world::ByteRange>& parts);

  std::size_t least_bytes_;
  std::unordered_map<ContentHash, std::weak_ptr<const std::string>> contents_;
};

}  // namespace icome::collab
