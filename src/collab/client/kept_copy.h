#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "collab/protocol/message.h"
#include "drawing/shape/every_kind.h"
#include "world/edit/edit.h"
#include "world/shape/geometry_factory.h"
#include "world/world.h"

namespace icome::collab {

/// An own edit that a server may not have yet.
struct KeptEdit {
  std::uint64_t number = 0;
  std::string name = {};  // of the action
  std::uint64_t base = 0;
  std::vector<std::uint64_t> fences = {};
  world::Edit edit;
};

/// A copy of a design as a program leaves it for the next one, which goes on where this one ended: with what
/// is durable on the server, and the own edits behind that.
struct KeptCopy {
  std::string link = {};  // whole: a secret
  std::string key = {};   // ClientIdentity::key
  std::int64_t at = 0;    // when it was kept, ms since 1970
  std::uint64_t history = 0;
  std::uint64_t sequence = 0;  // of the world's last edit
  std::uint32_t author = 0;
  std::uint64_t last_number = 0;  // of own edits
  std::uint64_t lives = 0;        // programs that went on from a copy before this one
  Role role = Role::View;
  world::World world = {};
  std::vector<KeptEdit> edits = {};
};

base::Result<std::string> to_bytes(const KeptCopy& copy);
/// Fails for bytes that are no such copy.
base::Result<KeptCopy> kept_copy_from_bytes(
    std::string_view bytes, const world::GeometryFactory& factory = drawing::every_kind_of_shape());

}  // namespace icome::collab
