#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "devices/haply/force_command.h"
#include "devices/haply/haply_settings.h"
#include "devices/haply/wire/service_state.h"
#include "devices/haply/wire/web_socket.h"

namespace icome::devices {

/// A connection to Haply's Inverse Service, on which each message of ours gets one answer, and the state that
/// it has told. One thread uses it.
class InverseService {
 public:
  /// Connects, asks for the version and for everything that there is; takes three times the settings'
  /// connect_patience at most, beside what looking up the host's name takes. Ends within 10 ms, but for that
  /// look-up, once `stop` is set, which is as in stop_by(). The error is a sentence or two that name the
  /// service and what to do.
  static base::Result<std::unique_ptr<InverseService>> connect(const HaplySettings& settings,
                                                               const std::atomic<bool>* stop = nullptr);
  /// Says goodbye, within 50 ms.
  ~InverseService();

  const ServiceState& state() const { return state_; }
  const ServiceVersion& version() const { return version_; }
  /// "Haply's Inverse Service at localhost:10001", which begins a sentence.
  std::string name() const;

  /// Chooses the Inverse3 of that id, or the first one, for exchanges; gives its id. The error is a sentence.
  base::Result<std::string> choose(std::string_view id);
  const ServiceArm& arm() const { return state_.arms()[chosen_]; }
  /// The VerseGrip that belongs to the arm; null without one. Real-time safe.
  const ServiceGrip* grip() const { return state_.grip_of(chosen_, settings_.grip); }

  enum class Answer : std::uint8_t {
    Fresh,    // the answer tells the place of the arm
    Refused,  // the answer makes no sense
    Lost,     // why() tells the reason
  };
  using ForceNow = std::function<Vector3()>;  // N, service's axes
  /// Sends the force and waits for the answer, settings' patience at most, or until `stop` is set. Meanwhile
  /// the service would keep the force: it is told to give none once there is none to give any more, once the
  /// answer is 10 ms late, and before the wait is given up. Real-time safe but for that wait, unless Lost.
  Answer exchange(const ForceNow& force);
  /// Was the force taken away in the last exchange, before its answer came?
  bool took_force_away() const { return took_away_; }
  /// A flag that ends every wait once it is set; null: none. It must live as long as it is used.
  void stop_by(const std::atomic<bool>* stop);
  /// Sends the last message, one without force, if there is a way.
  void let_go();
  /// Doubts that the arm is still there: the next answers shall tell.
  void doubt() { full_asked_ = false, doubted_ = true; }
  const std::string& why() const { return why_; }

 private:
  InverseService(const HaplySettings& settings, ServiceVersion version, std::unique_ptr<WebSocket> socket);
  base::Result<void> greet();
  bool ask(const ForceNow& force, bool full);
  void look_after_force(bool last);
  Answer lost(std::string why);
  bool take_what_waits();
  bool is_listed(std::int64_t now);
  std::string_view force_field() const;

  HaplySettings settings_;
  ServiceVersion version_;
  std::unique_ptr<WebSocket> socket_;  // never null
  ServiceState state_;
  std::size_t chosen_ = 0;  // of state_.arms()
  std::optional<ForceCommand> command_;
  const ForceNow* force_ = nullptr;  // during an exchange
  bool holds_ = false;               // the service holds a force of ours
  std::int64_t sent_time_ = 0;       // ns, of the last force
  bool took_away_ = false;
  bool owes_ = false;            // the service owes an answer to a message that took the force away
  std::int64_t understood_ = 0;  // ns, when a message last made sense
  // An arm that is not mentioned stands still, or is gone: everything is asked for then.
  std::uint64_t last_told_ = 0;  // ServiceArm::told of the arm
  std::int64_t told_time_ = 0;   // ns
  bool missed_ = false;          // a message was refused; its news will not be told again unasked
  bool doubted_ = false;
  bool full_asked_ = false;
  std::int64_t asked_time_ = 0;  // ns
  int answers_since_ = 0;
  std::string why_;
};

}  // namespace icome::devices
