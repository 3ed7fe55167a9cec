#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "haptics/contact/haptic_scene.h"
#include "haptics/servo/effect_feed.h"
#include "measure.h"
#include "table.h"

namespace icome::benchmarks {

using base::Vector3;

/// A servo run along a path: its cost, and the places of the surface contact point (SCP).
struct TouchRun {
  BestRun tick;               // from device input to output: by how much the force is late
  Quantiles solver_us;        // of the same run: the contact stage alone
  Quantiles load_us;          // of the same run: all that Servo::tick does except device input and output
  std::vector<Vector3> scps;  // by tick, m, of the tip's centre; the tip's own place without contact
  double touching = 0.0;      // share of the ticks
};

/// A scene of one object at the origin that does not move.
std::shared_ptr<const haptics::HapticScene> scene_of(std::shared_ptr<const haptics::Shape> shape);

/// Runs the servo at 1 kHz ticks, as fast as it goes, along `tips` (m), `repeats` times anew.
TouchRun touch(const std::shared_ptr<const haptics::HapticScene>& scene, double tip_radius,
               const std::vector<Vector3>& tips, int repeats,
               const std::vector<haptics::PlacedEffect>& effects = {});

/// The line of the table for a run.
Row touch_row(const std::string& figure, const TouchRun& run, const std::optional<Faults>& faults);

}  // namespace icome::benchmarks
