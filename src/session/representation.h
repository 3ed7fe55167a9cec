#pragma once
#include <chrono>
#include <optional>

#include "world/edit/changes.h"

namespace icome::session {

/// What is made of a world for one purpose, such as being felt or being seen, kept up to date as the world is
/// edited. Derive from it to add one (collisions, colleagues): nothing else changes. A Follower calls it, on
/// one thread of its own; making may take as long as it takes.
class Representation {
 public:
  virtual ~Representation() = default;

  /// Another world from now on: nothing that was made of the last one is of use.
  virtual void open(const world::World& world, world::SceneId shown) = 0;
  /// Another scene (none: the whole world) of the same world is shown.
  virtual void show(const world::World& world, world::SceneId shown) = 0;
  /// The world has been through edits that may have changed this.
  virtual void follow(const world::World& world, const world::Changes& changes) = 0;
  /// Since this moment (s, of session_seconds) the motions of the world's objects are played, or they are
  /// not: everything is at rest again. Another world is at rest.
  virtual void play(const world::World& /*world*/, std::optional<double> /*since*/) {}
  /// How long it waits, at most, until it goes on by itself, as it shows time; none: it waits for edits
  /// alone.
  virtual std::optional<std::chrono::nanoseconds> pause(const world::World& /*world*/) const { return {}; }
  /// The world is the same, and time has passed: called after each pause, and perhaps sooner.
  virtual void go_on(const world::World& /*world*/) {}
};

}  // namespace icome::session
