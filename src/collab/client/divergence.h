#pragma once
#include <span>
#include <string>
#include <vector>

#include "collab/order/items.h"

namespace icome::collab {

/// A thing that was changed both here, while there was no connection, and by others meanwhile.
struct Conflict {
  Item item;
  std::string name = {};    // as it is called here, or was before it was deleted here
  bool is_gone = false;     // others have deleted it
  std::uint32_t whose = 0;  // the author who changed it last; 0: nobody is known
};

/// A person's wish for a thing in conflict.
enum class Choice : std::uint8_t {
  Theirs,  // the own edits of it are given up
  Mine,    // they are done on top of the others'; not where it is gone
  Both     // theirs stays, and an object as it was made here is put beside it; of objects only
};

/// The things that own edits, made on `before`, and others' edits, which led from `before` to `now`, both
/// changed, but not by whom: the same side of a thing, or one of them its existence. In the order of the own
/// edits.
std::vector<Conflict> conflicts_of(std::span<const world::Edit> own, const world::World& before,
                                   const world::World& now);

/// The edit that puts an object of another world, with all below it and shapes of its own, into a design as a
/// new one: beside where it was, or as a root where its parent is gone. Materials that the design does not
/// have are left out. Precondition: the object is in `model`.
world::Edit copy_into(const world::World& model, world::ObjectId object, const world::World& design,
                      world::IdSource& ids);

}  // namespace icome::collab
