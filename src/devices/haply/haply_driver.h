#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "devices/driver/device_claim.h"
#include "devices/driver/driver.h"
#include "devices/haply/haply_frame.h"
#include "devices/haply/haply_settings.h"
#include "devices/haply/inverse_service.h"
#include "devices/haply/service_events.h"

namespace icome::devices {

/// A Haply Inverse3, and the VerseGrip that belongs to it, by Haply's Inverse Service.
class HaplyDriver final : public Driver {
 public:
  /// The Inverse3 of that id; empty: the first that this program does not use, and once found only that one.
  explicit HaplyDriver(const HaplySettings& settings, std::string device_id = {});
  ~HaplyDriver() override;

  base::Result<DeviceInfo> open() override;
  /// `stop` outlives the driver: it also ends a later open().
  std::string run(DriverLink& link, const std::atomic<bool>& stop) override;
  void close() override;
  std::string identity() const override { return "haply:" + device_id_; }

  /// One exchange with the service: sends the link's force and passes the reading on; false when the device
  /// is lost. After open(). Real-time safe but for waiting, unless there is something to tell people.
  bool exchange(DriverLink& link);

 private:
  base::Result<std::string> choose_arm(InverseService& service) const;
  void tell(DriverLink& link, std::int64_t now);
  void withhold(DriverLink& link);
  std::string why_withheld() const;

  const HaplySettings settings_;
  const HaplyFrame frame_;
  std::string device_id_;
  const std::atomic<bool>* stop_ = nullptr;  // of the last run
  std::unique_ptr<InverseService> service_;  // while open
  std::optional<ServiceEvents> events_;      // while running, where they are wanted
  DeviceClaim claim_;                        // of the device, from the first open() on
  // The state that the link and people were told last.
  struct Shown {
    bool calibrated = true;
    bool powered = true;
    bool ready = true;
    std::uint64_t events = 0;  // ServiceEvents::version()
    bool is_news = false;      // the events' sentence is no old one
    bool operator==(const Shown&) const = default;
  };
  Shown shown_;
  // The state that the link withholds forces for.
  struct Withheld {
    bool stopped = false;  // by its safety stop
    bool powered = true;
    bool calibrated = true;
    bool ready = true;
    bool operator==(const Withheld&) const = default;
  };
  Withheld withheld_;
  std::uint64_t disconnections_ = 0;  // those that have been dealt with
  std::uint64_t heard_ = 0;           // version of the events' sentence
  std::int64_t heard_time_ = 0;       // ns, of the last change of that version
};

}  // namespace icome::devices
