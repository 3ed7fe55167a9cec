#pragma once
#include <chrono>
#include <optional>

#include "world/edit/changes.h"

namespace icome::session {

/// A form of a world for one purpose, such as being felt or being seen, kept up to date as the world is
/// edited. Derive from it to add one (collisions, colleagues): nothing else changes. A Follower calls it, on
/// one thread of its own; its work may take as long as it takes.
class Representation {
 public:
  virtual ~Representation() = default;

  /// Takes another world: nothing that was made of the last one is of use.
  virtual void open(const world::World& world, world::SceneId shown) = 0;
  /// Shows another scene (none: the whole world) of the same world.
  virtual void show(const world::World& world, world::SceneId shown) = 0;
  /// Follows edits of the world that may have changed this.
  virtual void follow(const world::World& world, const world::Changes& changes) = 0;
  /// Plays the motions of the world's objects since this moment (s, of session_seconds), or none any
  /// more: everything is at rest again. Another world is at rest.
  virtual void play(const world::World& /*world*/, std::optional<double> /*since*/) {}
  /// The longest wait until it goes on by itself, as it shows time; none: it waits for edits
  /// alone.
  virtual std::optional<std::chrono::nanoseconds> pause(const world::World& /*world*/) const { return {}; }
  /// Goes on with the same world as time has passed: called after each pause, and perhaps sooner.
  virtual void go_on(const world::World& /*world*/) {}
};

}  // namespace icome::session
