#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "speech/words/vocabulary.h"
#include "world/world.h"

namespace icome::speech {

using base::Bounds;
using base::Vector3;
using world::ObjectId;

/// The kind of an object's shape: as the operation create calls it ("box", "sphere", "pyramid"), or "mesh",
/// "csg", "loop", "implicit", or "group" for one that has none.
std::string shape_kind(const world::World& world, ObjectId id);

/// The diffuse colour of an object, the default one where it has no material.
world::Colour colour_of(const world::World& world, ObjectId id);

/// "#rrggbb" as three numbers; nothing for other text.
std::optional<world::Colour> colour_from_hex(const std::string& hex);

/// The meaning of the colour word that comes nearest (CIE 1976 L*a*b*).
std::string nearest_colour(const std::vector<WordMeaning>& colours, const world::Colour& colour);

/// The largest extent of an object with all below it, m, world frame; 0 where it has none.
double extent_of(const world::World& world, ObjectId id);

/// The middle of an object's bounds, or its place where it has none.
Vector3 middle_of(const world::World& world, ObjectId id);

/// The objects that sentences can mean, in the order of their ids: those with a shape, and with `top` only
/// those that lie below no other, which may be groups. Lights, viewpoints and the like are none.
std::vector<ObjectId> speakable_objects(const world::World& world, bool top);

/// "small red cone": the looks of an object in words of the vocabulary.
std::string looks_in_words(const Vocabulary& vocabulary, const world::World& world, ObjectId id);

}  // namespace icome::speech
