#pragma once
#include <vector>

#include "devices/pointer_device.h"
#include "sketch/feel/paper.h"
#include "sketch/fit/pen_sample.h"

namespace icome::sketch {

/// A simulated pen in a simulated hand (devices/simulated).
struct SimulatedPen {
  devices::DeviceInfo device = {.name = "simulated"};
  double rate_hz = 1000.0;  ///< of the servo, 500 to 10,000
  bool eraser = false;
};

/// One tick of a pen on paper, in the device's frame: z up from the paper, the stroke's middle at the origin.
struct PenTick {
  double time = 0.0;                               ///< s
  base::Vector3 tip = base::Vector3::Zero();       ///< m
  base::Vector3 velocity = base::Vector3::Zero();  ///< m/s
  base::Vector3 force = base::Vector3::Zero();     ///< N, of the device on the pen
  double pressure = 0.0;                           ///< 0 to 1; 0 above the paper
};

/// The outcome of a stroke that was drawn with a pen that pushes back.
struct FeltStroke {
  std::vector<PenTick> ticks;
  PenStroke drawn;             ///< samples of where the pen was on the paper, one a tick
  double greatest = 0.0;       ///< N, of the force
  double greatest_step = 0.0;  ///< N, by which the force changed from one tick to the next
  double rubbing = 0.0;        ///< N, mean of the force along the paper while the pen was on it
  double work = 0.0;           ///< J, of the device on the pen: above 0, it gave energy
};

/// Draws a stroke with a simulated pen: a hand aims along the samples, as fast as they were made, and presses
/// so that the paper pushes back with their pressure times kFullPressure, while the servo renders the paper
/// as it would for a person. The hand comes down and lifts the pen at the ends. What is drawn is where the
/// pen was, not where the hand aimed. Preconditions: one sample or more; times do not go back.
FeltStroke felt_stroke(const PenStroke& stroke, const Paper& paper, const SimulatedPen& pen);

}  // namespace icome::sketch
