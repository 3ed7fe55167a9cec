#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/touch/tick_row.h"
#include "apps/touch/trace_file.h"
#include "haptics/judge/contact_judge.h"
#include "render/pictures/touch_picture.h"

namespace icome::apps {

/// Keeps the results of a run: trace, verdicts, tick times, and samples for the picture. It is fed
/// outside the timed part of the ticks and belongs to one thread. Owns neither trace nor judge.
class TickLog {
 public:
  /// Trace and judge may be null: then there is none. The judge gets forces only where they are those of
  /// surfaces: effects and textures may push in any way.
  TickLog(TraceFile* trace, haptics::ContactJudge* judge, bool forces_of_surfaces, bool keep_samples)
      : trace_(trace), judge_(judge), forces_of_surfaces_(forces_of_surfaces), keep_samples_(keep_samples) {}

  /// Takes memory for this many rows, so that adding them is quick.
  void reserve(std::size_t rows) { tick_ns_.reserve(rows); }

  /// Adds the row of the next tick.
  void add(const TickRow& row);

  const haptics::ContactJudge* judge() const { return judge_; }  // may be null
  std::uint64_t ticks() const { return tick_ns_.size(); }
  std::uint64_t touching_ticks() const { return touching_; }
  double max_force() const { return max_force_; }  // N
  /// Time of every tick, ns, in order.
  const std::vector<std::uint32_t>& tick_ns() const { return tick_ns_; }
  /// For the picture: every tick, or of a long run every 2nd, 4th and so on.
  const std::vector<render::TouchSample>& samples() const { return samples_; }

 private:
  void keep_sample(const TickRow& row);

  TraceFile* trace_;
  haptics::ContactJudge* judge_;
  bool forces_of_surfaces_;
  bool keep_samples_;
  std::uint64_t touching_ = 0;
  double max_force_ = 0.0;
  std::vector<std::uint32_t> tick_ns_;
  std::vector<render::TouchSample> samples_;
  std::size_t stride_ = 1;  // ticks a sample
};

}  // namespace icome::apps
