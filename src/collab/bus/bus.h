#pragma once
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"

namespace icome::collab {

/// Messages between servers, by NATS: each goes once at most to who listens to its subject at that moment, in
/// the order in which one server published them; some may be lost. Connects again by itself. Publishing never
/// waits, and messages of a time without a connection are kept only for a while. One thread uses it.
class Bus {
 public:
  /// `heard` gets the messages on threads of the bus. Fails with a sentence that names the address, without a
  /// password.
  static base::Result<std::unique_ptr<Bus>> connect(const std::string& address,
                                                    std::function<void(std::string bytes)> heard);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  base::Result<void> listen(const std::string& subject);
  void publish(const std::string& subject, std::string_view bytes);

 private:
  struct Parts;
  explicit Bus(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::collab
