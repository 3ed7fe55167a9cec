#include "devices/haply/inverse_service.h"

#include <fmt/format.h>

#include <utility>

#include "base/clock.h"
#include "base/shown_text.h"
#include "base/terminal_text.h"
#include "devices/driver/driver_link.h"

namespace icome::devices {
namespace {

constexpr std::int64_t kGoodbye = 50'000'000;  // ns
constexpr int kMostWaiting = 4;                // messages that are taken beside an answer
constexpr int kGreetings = 2;                  // the picture that each new client gets, and the answer
constexpr int kFullAnswers = 3;                // answers after a request for a full one, of which one is full
constexpr std::string_view kInstall =
    "install it from haply.co/support and start it, and name its place in ICOME_HAPLY=HOST:PORT where that "
    "is "
    "another one";

std::int64_t whole_nanoseconds(double seconds) { return std::int64_t(1e9 * seconds); }

std::string service_name(const HaplySettings& settings) {
  return "Haply's Inverse Service at " + shown_address(settings.service);
}

}  // namespace

base::Result<std::unique_ptr<InverseService>> InverseService::connect(const HaplySettings& settings,
                                                                      const std::atomic<bool>* stop) {
  // A service without this page speaks the WebSocket all the same.
  const auto answer = get_by_http(settings.service, "/version", settings.connect_patience, stop);
  auto socket = WebSocket::connect(settings.service, settings.connect_patience, stop);
  if (!socket)
    return base::fail(fmt::format("{}: {}; {}", service_name(settings), socket.error().message, kInstall));
  ServiceVersion version = answer ? read_service_version(*answer) : ServiceVersion{};
  std::unique_ptr<InverseService> service(
      new InverseService(settings, std::move(version), std::move(*socket)));
  if (const auto greeted = service->greet(); !greeted) return tl::unexpected(greeted.error());
  return service;
}

InverseService::InverseService(const HaplySettings& settings, ServiceVersion version,
                               std::unique_ptr<WebSocket> socket)
    : settings_(settings), version_(std::move(version)), socket_(std::move(socket)) {
  socket_->while_waiting([this](bool last) { look_after_force(last); });
}

InverseService::~InverseService() { socket_->close(base::steady_nanoseconds() + kGoodbye); }

std::string InverseService::name() const { return service_name(settings_); }

/// Waits for a message that makes sense: the picture that each new client gets, or the answer.
base::Result<void> InverseService::greet() {
  const std::int64_t deadline = base::steady_nanoseconds() + whole_nanoseconds(settings_.connect_patience);
  bool fine = socket_->send(greeting_message(), deadline);
  while (fine && state_.taken() == 0 && state_.refused() < kGreetings) {
    fine = socket_->receive(deadline);
    if (fine) state_.take(socket_->text());
  }
  if (state_.taken() > 0) return {};
  if (state_.refused() > 0)
    return base::fail(name() + " answers with what makes no sense; is it an Inverse Service of version 3?");
  if (!fine) return base::fail(name() + ": " + socket_->why() + "; restart it");
  return {};
}

std::string_view InverseService::force_field() const {
  if (settings_.force_field == ForceField::Values) return "values";
  if (settings_.force_field == ForceField::Vector) return "vector";
  return version_.major == 3 && version_.minor < 5 ? "values" : "vector";
}

base::Result<std::string> InverseService::choose(std::string_view id) {
  const auto arms = state_.arms();
  if (arms.empty())
    return base::fail(name() + " runs, but no Inverse3 is connected: plug one in and switch it on");
  std::string known;
  for (chosen_ = 0; chosen_ < arms.size(); ++chosen_) {
    const ServiceArm& arm = arms[chosen_];
    if (id.empty() || arm.id.is(id)) {
      command_.emplace(arm.id.text(), force_field());
      understood_ = told_time_ = base::steady_nanoseconds();
      last_told_ = arm.told;
      return std::string(arm.id.text());
    }
    known += fmt::format("{}{}", known.empty() ? "" : ", ", arm.id.text());
  }
  chosen_ = 0;
  return base::fail(fmt::format("{} knows no Inverse3 \"{}\"; there is {}", name(),
                                base::terminal_text(base::shown_text(id)), known));
}

void InverseService::stop_by(const std::atomic<bool>* stop) { socket_->stop_by(stop); }

InverseService::Answer InverseService::exchange(const ForceNow& force) {
  const bool doubting = doubted_ && !full_asked_;
  took_away_ = false;
  force_ = &force;
  const bool fine = take_what_waits() && ask(force, doubting);
  force_ = nullptr;
  if (!fine) return lost(socket_->why());
  const std::int64_t now = base::steady_nanoseconds();
  if (doubting) {
    full_asked_ = true;
    asked_time_ = now;
    answers_since_ = 0;
  }
  if (!state_.take(socket_->text())) {
    missed_ = true;
    if (now - understood_ > whole_nanoseconds(settings_.patience))
      return lost("it sends nothing that makes sense");
    return Answer::Refused;
  }
  understood_ = now;
  if (!is_listed(now))
    return lost(fmt::format("it no longer lists the Inverse3 {}; plug it in again", arm().id.text()));
  return arm().has_position() ? Answer::Fresh : Answer::Refused;
}

/// Sends the force, and receives the answer to it.
bool InverseService::ask(const ForceNow& force, bool full) {
  const Vector3 newtons = force();
  sent_time_ = base::steady_nanoseconds();
  const std::int64_t deadline = sent_time_ + whole_nanoseconds(settings_.patience);
  if (!socket_->send(command_->write(newtons, full || missed_), deadline)) return false;
  holds_ = !newtons.isZero(0.0);
  missed_ = false;
  const bool owed = std::exchange(owes_, false);
  if (!socket_->receive(deadline)) return false;
  owes_ = took_away_;
  if (!owed) return true;
  // That was the answer to the message that took the force away. A service that answers both by one makes
  // this late once, and owes nothing any more.
  if (!state_.take(socket_->text())) missed_ = true;
  return socket_->receive(deadline);
}

/// Takes the force away from the service where it would keep it for too long.
void InverseService::look_after_force(bool last) {
  if (force_ == nullptr || !holds_) return;
  const std::int64_t now = base::steady_nanoseconds();
  const bool is_late = now - sent_time_ >= DriverLink::kWatchdog;
  if (!last && !is_late && !(*force_)().isZero(0.0)) return;
  holds_ = false;
  took_away_ = true;
  socket_->send(command_->write(Vector3::Zero(), false), now + kGoodbye);
}

/// Takes surplus answers (each new client gets one), so that they do not make all later ones late.
bool InverseService::take_what_waits() {
  for (int i = 0; i < kMostWaiting && socket_->waiting(); ++i) {
    if (!socket_->receive(base::steady_nanoseconds() + whole_nanoseconds(settings_.patience))) return false;
    if (!state_.take(socket_->text())) missed_ = true;
    owes_ = false;
  }
  return true;
}

/// Is the arm still listed? False once full answers have not mentioned it.
bool InverseService::is_listed(std::int64_t now) {
  const std::int64_t half = whole_nanoseconds(settings_.patience) / 2;
  if (full_asked_) ++answers_since_;
  if (arm().told != last_told_) {
    last_told_ = arm().told;
    told_time_ = now;
    // Answers that were on their way when the doubt began say nothing.
    if (!full_asked_ || answers_since_ >= kFullAnswers) doubted_ = full_asked_ = false;
    return true;
  }
  if (now - told_time_ > half) doubted_ = true;
  return !(full_asked_ && answers_since_ > kFullAnswers && now - asked_time_ > half);
}

InverseService::Answer InverseService::lost(std::string why) {
  why_ = name() + ": " + std::move(why);
  return Answer::Lost;
}

void InverseService::let_go() {
  socket_->stop_by(nullptr);
  const std::int64_t deadline = base::steady_nanoseconds() + kGoodbye;
  if (command_) socket_->send(command_->write(Vector3::Zero(), false), deadline);
}

}  // namespace icome::devices
