#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devices/head_trace.h"
#include "devices/path_player.h"
#include "interaction/elements/element_use.h"

namespace icome::apps {

/// A choice in a trial, with its moment.
struct MenuChoice {
  std::string name;
  interaction::ChosenBy by = interaction::ChosenBy::Click;
  double time = 0.0;              // s, of the path
  interaction::Value value = {};  // that it tells; null: none
  std::string opens = {};         // "menu" or "page"; empty: neither
};

/// What came of an element that a path was tried on.
struct MenuTrial {
  std::vector<MenuChoice> chosen;
  double seconds = 0.0;         // of the path
  double near_seconds = 0.0;    // s, for which the tip was near
  std::uint64_t pushes = 0;     // times that the ground was pushed in
  double max_force = 0.0;       // N
  double max_force_step = 0.0;  // N, between two ticks
  std::vector<double> tick_us;  // the servo's own time of each tick, rising
  std::string capped;           // what the device cannot render as the file asks for; empty: nothing
};

/// Looks along the motion of a head, world frame, with the button down until it ends.
MenuTrial look_at_element(interaction::ElementUse& use, const std::vector<devices::HeadSample>& motion);

/// Moves the tip along the path, a row a tick, through the servo with its limiter. A path without a button
/// clicks where it ends, and what is held there is let go. Nothing where it was interrupted.
std::optional<MenuTrial> try_element(interaction::ElementUse& use, devices::PathPlayer& path);

}  // namespace icome::apps
