#include "devices/fakes/fake_inverse_service.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/uuid/detail/sha1.hpp>
#include <cerrno>
#include <deque>
#include <list>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <string_view>

#include "base/clock.h"
#include "realtime/this_thread.h"

namespace icome::devices::fakes {
namespace {

using Json = nlohmann::json;

constexpr double kHold = 0.05;         // s, that a force is held without another message
constexpr double kLongestStep = 0.02;  // s, that an arm's time goes on at once
constexpr std::int64_t kWait = 5e6;    // ns, between two looks at whether to stop

std::string base64(const std::array<unsigned char, 20>& bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t at) { return at < bytes.size() ? unsigned(bytes[at]) : 0U; };
    const unsigned three = byte(i) << 16U | byte(i + 1) << 8U | byte(i + 2);
    for (const unsigned shift : {18U, 12U, 6U, 0U}) text += kLetters[three >> shift & 63U];
  }
  text.back() = '=';  // 20 bytes are one less than seven threes
  return text;
}

/// The text by which a server proves that it speaks WebSocket (RFC 6455, 1.3).
std::string accept_of(const std::string& key) {
  boost::uuids::detail::sha1 sum;
  const std::string text = key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11";
  sum.process_bytes(text.data(), text.size());
  unsigned int words[5] = {};
  sum.get_digest(words);
  std::array<unsigned char, 20> bytes = {};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = (words[i / 4] >> (24 - 8 * (i % 4))) & 255U;
  return base64(bytes);
}

std::string web_frame(std::string_view text, unsigned kind = 1) {
  std::string bytes(1, char(0x80U | kind));
  const auto append_size = [&](int count) {
    for (int i = count - 1; i >= 0; --i) bytes += char(text.size() >> unsigned(8 * i) & 255U);
  };
  if (text.size() < 126) {
    bytes += char(text.size());
  } else if (text.size() < 65536) {
    bytes += char(126);
    append_size(2);
  } else {
    bytes += char(127);
    append_size(8);
  }
  return bytes.append(text);
}

std::string header_of(const std::string& request, std::string_view name) {
  const auto same = [](char left, char right) { return std::tolower(left) == std::tolower(right); };
  const std::string wanted = "\r\n" + std::string(name) + ":";
  const auto found = std::search(request.begin(), request.end(), wanted.begin(), wanted.end(), same);
  if (found == request.end()) return {};
  const std::size_t begin =
      request.find_first_not_of(' ', std::size_t(found - request.begin()) + wanted.size());
  return request.substr(begin, request.find("\r\n", begin) - begin);
}

std::string http(std::string_view status, const std::string& body) {
  return "HTTP/1.1 " + std::string(status) +
         "\r\nContent-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) +
         "\r\nConnection: close\r\n\r\n" + body;
}

int listen_at(std::uint16_t& port) {
  const int listener = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(listener, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  sockaddr_in place = {};
  place.sin_family = AF_INET;
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  place.sin_port = htons(port);
  socklen_t size = sizeof(place);
  const bool fine = bind(listener, reinterpret_cast<const sockaddr*>(&place), size) == 0 &&
                    listen(listener, 16) == 0 &&
                    getsockname(listener, reinterpret_cast<sockaddr*>(&place), &size) == 0;
  if (!fine) {
    close(listener);
    return -1;
  }
  port = ntohs(place.sin_port);
  return listener;
}

Json coordinates(const Vector3& v) { return {{"x", v.x()}, {"y", v.y()}, {"z", v.z()}}; }
Json coordinates(const Quaternion& q) { return {{"w", q.w()}, {"x", q.x()}, {"y", q.y()}, {"z", q.z()}}; }

double coordinate(const Json& vector, const char* name) {
  const auto found = vector.find(name);
  return found != vector.end() && found->is_number() ? found->get<double>() : std::nan("");
}

/// Has a part been told as it is? One with NaN, which JSON writes as null, is told each time.
bool is_told(const Json& told, const std::string& name, const Json& part) {
  return told.contains(name) && told[name] == part && part.dump().find("null") == std::string::npos;
}

/// The parts of an entry that a client has not been told: fields of its state and whole other fields.
Json news_of(const Json& entry, const Json& told, bool named) {
  Json news = Json::object();
  for (const auto& [key, value] : entry.items()) {
    if (key == "device_id") {
      if (named || !told.contains(key)) news[key] = value;
    } else if (key == "state" && told.contains(key)) {
      for (const auto& [name, part] : value.items()) {
        if (!is_told(told[key], name, part)) news[key][name] = part;
      }
    } else if (!told.contains(key) || told[key] != value) {
      news[key] = value;
    }
  }
  return news;
}

void numbers_as_texts(Json& json) {
  if (json.is_number()) json = json.dump();
  if (!json.is_structured()) return;
  for (Json& part : json) numbers_as_texts(part);
}

}  // namespace

struct FakeInverseService::State {
  struct Client {
    int socket = -1;
    bool of_events = false;
    bool speaks = false;  // the WebSocket is open
    bool leaving = false;
    std::string in;
    std::string out;
    std::deque<std::pair<std::int64_t, std::string>> answers;  // with the times when they are due, ns
    Json told = Json::object();
    bool greeted = false;  // has sent a message
  };
  struct Arm {
    FakeArm arm;
    std::int64_t seen = base::steady_nanoseconds();
    double time = 0.0;        // s, of its own clock
    double commanded = -1.0;  // s, of the last command; < 0: it was let go
  };

  explicit State(const FakeServiceSettings& wanted) : settings(wanted) {
    for (std::size_t i = 0; i < settings.devices.size(); ++i) arms.push_back({FakeArm(settings.arm)});
  }

  /// Lets an arm's time go on, more slowly where the machine does not keep up; a force that nobody repeats is
  /// let go.
  FakeArm::Reading read(Arm& arm) {
    const std::int64_t now = base::steady_nanoseconds();
    arm.time += std::min(1e-9 * double(now - arm.seen), kLongestStep);
    arm.seen = now;
    if (arm.commanded >= 0.0 && arm.time > arm.commanded + kHold) {
      arm.arm.read(arm.commanded + kHold);
      arm.arm.push(Vector3::Zero(), arm.commanded + kHold);
      arm.commanded = -1.0;
    }
    return arm.arm.read(arm.time);
  }

  void accept_at(int at, bool of_events) {
    const int socket = accept4(at, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket < 0) return;
    const int on = 1;
    setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
    clients.emplace_back();
    clients.back().socket = socket;
    clients.back().of_events = of_events;
  }

  void read_from(Client& client) {
    std::array<char, 65536> bytes;
    const ssize_t got = recv(client.socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) {
      client.leaving = true;
      client.out.clear();
    }
    if (got <= 0) return;
    client.in.append(bytes.data(), std::size_t(got));
    if (!client.speaks) greet(client);
    while (client.speaks && take_frame(client)) {
    }
  }

  void greet(Client& client) {
    const std::size_t end = client.in.find("\r\n\r\n");
    if (end == std::string::npos || fault == ServiceFault::Deaf) return;
    const std::string request = client.in.substr(0, end + 2);
    client.in.erase(0, end + 4);
    const std::string key = header_of(request, "Sec-WebSocket-Key");
    if (key.empty()) {
      client.out += page(request.substr(0, request.find("\r\n")));
      client.leaving = true;
      return;
    }
    client.out +=
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Accept: " +
        accept_of(key) + "\r\n\r\n";
    client.speaks = true;
    if (!client.of_events) answer(client, true);
  }

  std::string page(const std::string& request) {
    if (request.starts_with("GET /version ") && !settings.version.empty()) {
      const Json version = {{"project_version", settings.version + "-fake"},
                            {"git_tag", "v" + settings.version},
                            {"name", "ICOME's fake of the Inverse Service"}};
      return http("200 OK", version.dump());
    }
    if (request.starts_with("GET /devices ")) return http("200 OK", everything().dump());
    return http("404 Not Found", R"({"error":"no such page"})");
  }

  /// False when there is no whole frame. Clients mask what they send.
  bool take_frame(Client& client) {
    const auto byte = [&](std::size_t i) { return std::uint64_t(static_cast<unsigned char>(client.in[i])); };
    if (client.in.size() < 2) return false;
    std::size_t at = 2;
    std::uint64_t size = byte(1) & 127U;
    const std::size_t more = size == 126 ? 2 : size == 127 ? 8 : 0;
    if (client.in.size() < at + more) return false;
    if (more > 0) size = 0;
    for (std::size_t i = 0; i < more; ++i) size = size << 8U | byte(at + i);
    at += more;
    if (client.in.size() < at + 4 + size) return false;
    std::string text = client.in.substr(at + 4, size);
    for (std::size_t i = 0; i < text.size(); ++i) text[i] = char(text[i] ^ client.in[at + i % 4]);
    const unsigned kind = byte(0) & 15U;
    client.in.erase(0, at + 4 + size);
    if (kind == 8) {
      client.out += web_frame(text, 8);
      client.leaving = true;
      return false;
    }
    if (kind == 9) client.out += web_frame(text, 10);
    if (kind == 1 && !client.of_events) take_message(client, text);
    return true;
  }

  void take_message(Client& client, const std::string& text) {
    if (!client.greeted) first_message = text;
    client.greeted = true;
    const Json message = Json::parse(text, nullptr, false);
    if (message.is_discarded() || !message.is_object()) {
      ++misunderstood;
      return;
    }
    ++messages;
    if (const auto all = message.find("inverse3"); all != message.end()) {
      for (const Json& entry : *all) command(entry);
    }
    if (fault == ServiceFault::Silent) return;
    const auto session = message.find("session");
    answer(client, session != message.end() && session->contains("force_render_full_state"));
  }

  void command(const Json& entry) {
    const auto named =
        std::find(settings.devices.begin(), settings.devices.end(), entry.value("device_id", ""));
    const auto commands = entry.find("commands");
    if (named == settings.devices.end() || commands == entry.end()) {
      ++misunderstood;
      return;
    }
    const std::size_t index = std::size_t(named - settings.devices.begin());
    if (index == 0 && !plugged) return;
    const auto force = commands->find("set_cursor_force");
    if (force == commands->end()) return;
    const bool by_vector = force->contains("vector");
    if (!by_vector && !force->contains("values")) {
      ++misunderstood;
      return;
    }
    ++(by_vector ? vectors : values);
    const Json& given = (*force)[by_vector ? "vector" : "values"];
    const Vector3 newtons(coordinate(given, "x"), coordinate(given, "y"), coordinate(given, "z"));
    if (index == 0 && newtons.allFinite())
      strongest_component = std::max(strongest_component, newtons.cwiseAbs().maxCoeff());
    read(arms[index]);
    arms[index].commanded = arms[index].time;
    if (index == 0) trace.add(newtons.norm(), base::steady_nanoseconds());
    if (index == 0 && newtons != commanded) {
      commanded = newtons;
      commanded_since = base::steady_nanoseconds();
    }
    arms[index].arm.push(newtons, arms[index].commanded);
  }

  Json arm_entry(std::size_t index) {
    FakeArm::Reading reading = read(arms[index]);
    if (index == 0 && pinned) reading = {*pinned - settings.middle, Vector3::Zero()};
    return {{"device_id", settings.devices[index]},
            {"config", {{"type", "inverse3"}, {"handedness", "right"}}},
            {"state",
             {{"cursor_position", coordinates(Vector3(reading.position + settings.middle))},
              {"cursor_velocity", coordinates(reading.velocity)},
              {"body_orientation", coordinates(Quaternion::Identity())},
              {"current_cursor_force", coordinates(arms[index].arm.held())},
              {"control_mode", arms[index].commanded >= 0.0 ? "cursor_force" : "idle"}}},
            {"status",
             {{"calibrated", calibrated},
              {"in_use", arms[index].commanded >= 0.0},
              {"power_supply", powered},
              {"ready", ready},
              {"started", true}}}};
  }

  Json everything() {
    Json all = {{"session_id", 7}, {"inverse3", Json::array()}};
    for (std::size_t i = plugged ? 0 : 1; i < arms.size(); ++i) all["inverse3"].push_back(arm_entry(i));
    if (settings.wired_grip)
      all["verse_grip"] = {{{"device_id", "61576"},
                            {"state",
                             {{"button", (buttons & 1U) != 0},
                              {"hall", int(buttons >> 1U & 1U)},
                              {"orientation", coordinates(orientation)}}}}};
    if (settings.wireless_grip)
      all["wireless_verse_grip"] = {
          {{"device_id", "8A21"},
           {"state",
            {{"buttons",
              {{"a", (buttons & 1U) != 0}, {"b", (buttons & 2U) != 0}, {"c", (buttons & 4U) != 0}}},
             {"orientation", coordinates(orientation)}}}}};
    return all;
  }

  void answer(Client& client, bool full) {
    Json all = everything();
    Json text = all;
    if (!full) {
      text.erase("session_id");
      for (const char* const kind : {"inverse3", "verse_grip", "wireless_verse_grip"}) {
        if (!all.contains(kind)) continue;
        for (std::size_t i = 0; i < all[kind].size(); ++i) {
          const bool same_place = client.told.contains(kind) && i < client.told[kind].size() &&
                                  client.told[kind][i]["device_id"] == all[kind][i]["device_id"];
          text[kind][i] = news_of(all[kind][i], same_place ? client.told[kind][i] : Json::object(),
                                  settings.names_devices);
        }
      }
    }
    client.told = std::move(all);
    if (fault == ServiceFault::WrongTypes) numbers_as_texts(text);
    queue(client, spoilt(text.dump()));
  }

  std::string spoilt(std::string text) {
    if (enormous > 0) text = "{\"session_id\":\"" + std::string(std::exchange(enormous, 0), 'x') + "\"}";
    if (fault == ServiceFault::Truncated) text.resize(text.size() / 2);
    if (fault == ServiceFault::Garbage) {
      // Letters, as other bytes would end the connection.
      for (char& letter : text) letter = char(32 + random() % 95);
    }
    return text;
  }

  void queue(Client& client, const std::string& text) {
    const std::int64_t due = base::steady_nanoseconds() + std::int64_t(1e9 * settings.latency);
    client.answers.emplace_back(due, web_frame(text));
  }

  void write_to(Client& client) {
    while (!client.answers.empty() && fault != ServiceFault::Frozen &&
           client.answers.front().first <= base::steady_nanoseconds()) {
      client.out += client.answers.front().second;
      client.answers.pop_front();
    }
    if (client.out.empty()) return;
    const ssize_t sent =
        send(client.socket, client.out.data(), client.out.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent > 0) client.out.erase(0, std::size_t(sent));
    if (sent < 0 && errno != EAGAIN && errno != EINTR) {
      client.leaving = true;
      client.out.clear();
    }
  }

  void say(const std::string& text) {
    for (Client& client : clients) {
      if (client.of_events && client.speaks) queue(client, text);
    }
  }

  void drop_who_leaves(bool all) {
    clients.remove_if([&](const Client& client) {
      const bool goes = all || (client.leaving && client.out.empty());
      if (goes) close(client.socket);
      return goes;
    });
  }

  /// Time until an answer is due, ns, kWait at most.
  std::int64_t free_time() const {
    std::int64_t time = kWait;
    for (const Client& client : clients) {
      if (!client.answers.empty() && fault != ServiceFault::Frozen)
        time = std::min(time, client.answers.front().first - base::steady_nanoseconds());
    }
    return std::max<std::int64_t>(0, time);
  }

  const FakeServiceSettings settings;
  int listener = -1;
  int events_listener = -1;
  std::vector<Arm> arms;
  std::list<Client> clients;
  ServiceFault fault = ServiceFault::None;
  bool hang_up = false;
  std::size_t enormous = 0;
  bool plugged = true;
  bool calibrated = true;
  bool powered = true;
  bool ready = true;
  Quaternion orientation = Quaternion::Identity();
  std::uint32_t buttons = 0;
  std::optional<Vector3> pinned;  // m from the mounting plate
  Vector3 commanded = Vector3::Zero();
  std::int64_t commanded_since = 0;
  double strongest_component = 0.0;
  ForceTrace trace;
  std::uint64_t messages = 0;
  std::uint64_t vectors = 0;
  std::uint64_t values = 0;
  std::uint64_t misunderstood = 0;
  std::string first_message;
  std::minstd_rand random;
};

FakeInverseService::FakeInverseService(const FakeServiceSettings& settings)
    : state_(std::make_unique<State>(settings)), port_(settings.port), events_port_(settings.events_port) {
  start();
}

FakeInverseService::~FakeInverseService() { stop(); }

void FakeInverseService::start() {
  state_->listener = listen_at(port_);
  if (state_->settings.events) state_->events_listener = listen_at(events_port_);
  stop_ = false;
  thread_ = std::thread([this] { serve(); });
}

void FakeInverseService::stop() {
  stop_ = true;
  if (thread_.joinable()) thread_.join();
}

void FakeInverseService::serve() {
  // Late answers are a fault that tests ask for.
  static_cast<void>(realtime::ask_for_realtime_priority(84));
  std::vector<pollfd> waiting;
  while (!stop_) {
    timespec time = {0, 0};
    {
      const std::lock_guard lock(guard_);
      waiting = {{state_->listener, POLLIN, 0}, {state_->events_listener, POLLIN, 0}};
      for (const auto& client : state_->clients) {
        const short writing = client.out.empty() ? 0 : POLLOUT;
        waiting.push_back({client.socket, short(POLLIN | writing), 0});
      }
      time.tv_nsec = state_->free_time();
    }
    ppoll(waiting.data(), waiting.size(), &time, nullptr);
    const std::lock_guard lock(guard_);
    std::size_t index = 2;
    for (auto& client : state_->clients) {
      if (index < waiting.size() && waiting[index++].revents != 0) state_->read_from(client);
      state_->write_to(client);
    }
    if (waiting[0].revents != 0) state_->accept_at(state_->listener, false);
    if (waiting[1].revents != 0) state_->accept_at(state_->events_listener, true);
    state_->drop_who_leaves(std::exchange(state_->hang_up, false));
  }
  const std::lock_guard lock(guard_);
  state_->drop_who_leaves(true);
  close(std::exchange(state_->listener, -1));
  if (state_->events_listener >= 0) close(std::exchange(state_->events_listener, -1));
}

void FakeInverseService::set_fault(ServiceFault fault) {
  const std::lock_guard lock(guard_);
  state_->fault = fault;
}
void FakeInverseService::hang_up() {
  const std::lock_guard lock(guard_);
  state_->hang_up = true;
}
void FakeInverseService::answer_by(std::size_t bytes) {
  const std::lock_guard lock(guard_);
  state_->enormous = bytes;
}
void FakeInverseService::say_event(const std::string& text) {
  const std::lock_guard lock(guard_);
  state_->say(text);
}
void FakeInverseService::plug(bool in) {
  const std::lock_guard lock(guard_);
  state_->plugged = in;
  const Json event = {
      {"name", in ? "device-connected" : "device-disconnected"},
      {"category", "device"},
      {"level", in ? "info" : "warning"},
      {"data", {{"device_family", "inverse"}, {"device_id", state_->settings.devices.front()}}},
      {"message", in ? "device connected" : "device disconnected"}};
  state_->say(event.dump());
}
void FakeInverseService::set_status(bool calibrated, bool powered, bool ready) {
  const std::lock_guard lock(guard_);
  state_->calibrated = calibrated;
  state_->powered = powered;
  state_->ready = ready;
}
void FakeInverseService::hold_grips(const Quaternion& orientation, std::uint32_t buttons) {
  const std::lock_guard lock(guard_);
  state_->orientation = orientation;
  state_->buttons = buttons;
}
void FakeInverseService::aim(const Vector3& place) {
  const std::lock_guard lock(guard_);
  state_->read(state_->arms.front());
  state_->arms.front().arm.aim(place - state_->settings.middle);
}
void FakeInverseService::pin(const Vector3& place) {
  const std::lock_guard lock(guard_);
  state_->pinned = place;
}
void FakeInverseService::fail(ArmFault fault) {
  const std::lock_guard lock(guard_);
  state_->arms.front().arm.fail(fault);
}
double FakeInverseService::strongest() const {
  const std::lock_guard lock(guard_);
  return state_->arms.front().arm.strongest();
}
double FakeInverseService::strongest_component() const {
  const std::lock_guard lock(guard_);
  return state_->strongest_component;
}
Vector3 FakeInverseService::held() const {
  const std::lock_guard lock(guard_);
  state_->read(state_->arms.front());
  return state_->arms.front().arm.held();
}
double FakeInverseService::given() const {
  const std::lock_guard lock(guard_);
  state_->read(state_->arms.front());
  return state_->arms.front().arm.given();
}
void FakeInverseService::watch() {
  const std::lock_guard lock(guard_);
  state_->trace.begin();
}
ForceTrace::Marks FakeInverseService::marks() const {
  const std::lock_guard lock(guard_);
  return state_->trace.marks();
}
Vector3 FakeInverseService::commanded() const {
  const std::lock_guard lock(guard_);
  return state_->commanded;
}
std::int64_t FakeInverseService::commanded_since() const {
  const std::lock_guard lock(guard_);
  return state_->commanded_since;
}
std::uint64_t FakeInverseService::messages() const {
  const std::lock_guard lock(guard_);
  return state_->messages;
}
std::uint64_t FakeInverseService::vectors() const {
  const std::lock_guard lock(guard_);
  return state_->vectors;
}
std::uint64_t FakeInverseService::values() const {
  const std::lock_guard lock(guard_);
  return state_->values;
}
std::uint64_t FakeInverseService::misunderstood() const {
  const std::lock_guard lock(guard_);
  return state_->misunderstood;
}
std::string FakeInverseService::first_message() const {
  const std::lock_guard lock(guard_);
  return state_->first_message;
}

}  // namespace icome::devices::fakes
