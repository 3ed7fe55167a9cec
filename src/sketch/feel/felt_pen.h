#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/result.h"
#include "devices/pointer_device.h"
#include "haptics/servo/servo.h"
#include "realtime/loop.h"
#include "realtime/message_pipe.h"
#include "sketch/feel/paper.h"
#include "sketch/feel/resistance.h"

namespace icome::sketch {

/// A reading of a pen that pushes back, as a canvas follows it.
struct PenReading {
  double time = 0.0;                ///< s, from any start
  Vector2 place = Vector2::Zero();  ///< m, on the paper: below the tip, or where it touches
  double height = 0.0;              ///< m, above the paper; 0 on it
  double pressure = 0.0;            ///< 0 to 1; above 0 the pen is down, and draws
  std::uint32_t buttons = 0;        ///< bit i: button i is down
};

/// A force-feedback device as a pen on paper (thesis 4.5): a thread of its own renders the paper, and how the
/// drawing resists what the pen does to it. The paper lies flat in the device's workspace: the device's y is
/// up from it, its x to the right, its z down the page. Paper that is larger than the workspace, or very
/// small, is drawn on at a scale. All but step() is called by one thread, the main one.
class FeltPen {
 public:
  /// A sheet of that size (m). Call start(), or step() in its place.
  FeltPen(std::unique_ptr<devices::PointerDevice> device, const Paper& paper, const Vector2& sheet);
  ~FeltPen();
  FeltPen(const FeltPen&) = delete;
  FeltPen& operator=(const FeltPen&) = delete;

  /// Starts the thread, once. Fails as LoopRunner does.
  base::Result<void> start();
  /// One turn of the servo, `dt` seconds after the last. Real-time safe.
  void step(double dt);
  static constexpr double kRate = 1000.0;  // Hz

  const devices::DeviceInfo& info() const { return device_->info(); }
  /// Sentences about the device that people should know now, such as that it is lost; empty: nothing.
  std::string condition() const;
  /// The force (N) at full pressure: kFullPressure, or what the device's motors hold for long.
  double full_pressure() const;
  const Paper& paper() const { return paper_; }
  /// m on the paper for each metre of the hand: 1, unless the paper is larger than the workspace or very
  /// small.
  double scale() const { return scale_; }

  /// Lays paper of another kind below the pen.
  void lay(const Paper& paper);
  /// Gives the paper another size (m).
  void resize(const Vector2& sheet);
  /// Lets the other end of the pen, the eraser, rub on the paper, which it does harder, or its tip again.
  void turn_around(bool eraser);
  /// Sets what the pen holds of the drawing from now on, in m on the paper; a grip that is none lets go.
  void hold(const ToolGrip& grip);
  /// The readings since the last call, oldest first; where nobody has called for seconds, the newest are not
  /// among them.
  std::vector<PenReading> take();
  bool is_simulated() const;
  /// Moves the hand of a simulated device to a place of the paper, pressing so hard (0 to 1), or lifted where
  /// that is 0. Without effect on others.
  void aim(const Vector2& place, double pressure);

 private:
  /// A tick, in the frame of the paper's middle as the hand has it: z up, y away.
  struct Tick {
    double time;
    base::Vector3 tip;
    bool touching;
    base::Vector3 scp;
    double pressing;  // N
    std::uint32_t buttons;
  };

  void publish_paper();
  base::Vector2 in_hand(const Vector2& place) const;
  PenReading reading_of(const Tick& tick);

  std::unique_ptr<devices::PointerDevice> device_;
  haptics::Servo servo_;
  Paper paper_;
  Vector2 sheet_;
  double scale_ = 1.0;
  bool eraser_ = false;
  ToolGrip grip_;
  bool is_down_ = false;      // as it was read last
  bool is_pressing_ = false;  // a simulated hand, on its way down or there
  double time_ = 0.0;         // s; the servo's
  realtime::MessagePipe<Tick> ticks_;
  std::atomic<bool> is_lost_ = false;
  std::unique_ptr<realtime::LoopRunner> loop_;  // last: stops before the rest goes
};

}  // namespace icome::sketch
