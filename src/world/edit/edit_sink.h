#pragma once
#include <functional>
#include <utility>

#include "world/edit/edit.h"

namespace icome::world {

/// The receiver of edits: performs one and gives the edit that takes it back, or refuses it with no change,
/// as `apply` does. A world is a sink by itself; a journal or a network of colleagues stands before theirs.
/// Refers to what it was made of.
class EditSink {
 public:
  using Perform = std::function<base::Result<Edit>(const Edit&)>;

  EditSink(World& world)  // NOLINT(google-explicit-constructor)
      : perform_([&world](const Edit& edit) { return apply(world, edit); }) {}
  explicit EditSink(Perform perform) : perform_(std::move(perform)) {}

  base::Result<Edit> operator()(const Edit& edit) const { return perform_(edit); }

 private:
  Perform perform_;
};

}  // namespace icome::world
