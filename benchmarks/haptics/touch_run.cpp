#include "touch_run.h"

#include <utility>

#include "haptics/servo/servo.h"
#include "tip_paths.h"

namespace icome::benchmarks {
namespace {

/// A device whose tip follows a list of positions, one for each read.
class ListDevice final : public devices::PointerDevice {
 public:
  explicit ListDevice(const std::vector<Vector3>& tips) : tips_(tips) {}
  const devices::DeviceInfo& info() const override { return info_; }
  devices::DeviceStatus read(devices::PointerState& state) override {
    state.velocity = next_ == 0 ? Vector3::Zero() : Vector3((tips_[next_] - tips_[next_ - 1]) / kTick);
    state.position = tips_[next_++];
    return devices::DeviceStatus::Ok;
  }
  devices::DeviceStatus write(const Vector3& /*force*/) override { return devices::DeviceStatus::Ok; }

 private:
  const std::vector<Vector3>& tips_;
  std::size_t next_ = 0;
  devices::DeviceInfo info_;
};

}  // namespace

std::shared_ptr<const haptics::HapticScene> scene_of(std::shared_ptr<const haptics::Shape> shape) {
  haptics::HapticObject object;
  object.shape = std::move(shape);
  return haptics::HapticScene::compile({std::move(object)});
}

TouchRun touch(const std::shared_ptr<const haptics::HapticScene>& scene, double tip_radius,
               const std::vector<Vector3>& tips, int repeats,
               const std::vector<haptics::PlacedEffect>& effects) {
  TouchRun result;
  std::vector<std::vector<std::int32_t>> delay(repeats);
  std::vector<std::vector<std::int32_t>> solver(repeats);
  std::vector<std::vector<std::int32_t>> load(repeats);
  for (int run = 0; run < repeats; ++run) {
    ListDevice device(tips);
    haptics::ServoSettings settings;
    settings.scp.tip_radius = tip_radius;
    haptics::Servo servo(device, settings);
    servo.publish(scene);
    if (!effects.empty()) servo.publish_effects(effects);
    delay[run].resize(tips.size());
    solver[run].resize(tips.size());
    load[run].resize(tips.size());
    result.scps.resize(tips.size());
    std::size_t touching = 0;
    for (std::size_t i = 0; i < tips.size(); ++i) {
      const haptics::TickReport& report = servo.tick(kTick);
      delay[run][i] = std::int32_t(report.delay_ns());
      load[run][i] = std::int32_t(report.own_ns());
      solver[run][i] = std::int32_t(report.stage_ns[std::size_t(haptics::Stage::Contact)]);
      result.scps[i] = report.contact.scp;
      touching += report.contact.touching;
    }
    result.touching = double(touching) / double(tips.size());
  }
  result.tick = best_run(delay);
  result.solver_us = quantiles_us(std::move(solver[result.tick.index]));
  result.load_us = quantiles_us(std::move(load[result.tick.index]));
  return result;
}

Row touch_row(const std::string& figure, const TouchRun& run, const std::optional<Faults>& faults) {
  Row row{.figure = figure};
  row.median = run.tick.us.median;
  row.p999 = run.tick.us.p999;
  row.solver = run.solver_us;
  row.load = run.load_us;
  row.noise = run.tick.noise;
  row.faults = faults;
  return row;
}

}  // namespace icome::benchmarks
