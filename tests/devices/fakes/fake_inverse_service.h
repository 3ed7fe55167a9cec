#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "devices/fakes/fake_arm.h"

namespace icome::devices::fakes {

using base::Quaternion;
using base::Vector3;

struct FakeServiceSettings {
  std::uint16_t port = 0;         // 0: a free one
  std::uint16_t events_port = 0;  // 0: a free one
  bool events = true;
  std::string version = "3.5.0";  // of /version; empty: it answers 404
  std::vector<std::string> devices = {"049D"};
  ArmSettings arm;                  // each device has one
  Vector3 middle{0.0, -0.14, 0.2};  // m from the mounting plate, where the arms' origin is
  double latency = 0.0;             // s, from a message to its answer
  bool wired_grip = false;          // a VerseGrip "61576"
  bool wireless_grip = false;       // a wireless VerseGrip "8A21"
  bool names_devices = false;       // each answer, not only full ones, has ids
};

/// Faults of the service's answers.
enum class ServiceFault : std::uint8_t {
  None,
  Silent,     // takes messages and says nothing
  Frozen,     // takes messages; the answers come all at once when this is over
  Deaf,       // new connections get no answer at all
  Garbage,    // bytes at random
  Truncated,  // half of each answer
  WrongTypes  // numbers are texts
};

/// A stand-in for Haply's Inverse Service, written from what is known of its protocol: HTTP and WebSocket on
/// a port of this machine, events on another one, and a model of each arm behind them. It answers each
/// message of a client by one, tells everything to a client that connects or asks for it, and only changes
/// after that. A force is held for 50 ms without another message. It calls itself a fake in /version. All
/// methods may be called from any thread; it works on a thread of its own, which it owns.
class FakeInverseService {
 public:
  explicit FakeInverseService(const FakeServiceSettings& settings = {});
  ~FakeInverseService();
  FakeInverseService(const FakeInverseService&) = delete;
  FakeInverseService& operator=(const FakeInverseService&) = delete;

  std::uint16_t port() const { return port_; }
  std::uint16_t events_port() const { return events_port_; }

  /// Ends, as when the service is stopped; its arms stay where they are.
  void stop();
  /// Begins again on the same ports.
  void start();

  void set_fault(ServiceFault fault);
  /// Closes all connections, without a word.
  void hang_up();
  /// Sends the next client that writes an answer that is this long.
  void answer_by(std::size_t bytes);
  /// Sends a text as an event.
  void say_event(const std::string& text);
  /// The first device is unplugged, or plugged in again; it is told as an event.
  void plug(bool in);
  void set_status(bool calibrated, bool powered, bool ready);
  void hold_grips(const Quaternion& orientation, std::uint32_t buttons);

  // The first device; service's axes.
  /// The place that its hand aims for, m from the mounting plate.
  void aim(const Vector3& place);
  /// Holds it at a place, m from the mounting plate, whatever pulls.
  void pin(const Vector3& place);
  void fail(ArmFault fault);
  double strongest() const;            // N, that was ever commanded
  double strongest_component() const;  // N, in one coordinate
  Vector3 held() const;                // N, now
  double given() const;                // J
  /// Marks of the forces that were commanded since watch().
  void watch();
  ForceTrace::Marks marks() const;
  /// The force that was commanded last, N, and the time of its last change, ns on the steady clock.
  Vector3 commanded() const;
  std::int64_t commanded_since() const;

  /// Messages of clients that were understood, that named the force `vector`, and `values`.
  std::uint64_t messages() const;
  std::uint64_t vectors() const;
  std::uint64_t values() const;
  /// Messages that were no JSON, or had commands that the service does not know.
  std::uint64_t misunderstood() const;
  /// The first message of the newest session.
  std::string first_message() const;

 private:
  struct State;
  void serve();
  std::unique_ptr<State> state_;
  mutable std::mutex guard_;  // of state_
  std::atomic<bool> stop_ = false;
  std::uint16_t port_ = 0;
  std::uint16_t events_port_ = 0;
  std::thread thread_;
};

}  // namespace icome::devices::fakes
