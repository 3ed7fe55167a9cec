#pragma once
#include <string>

#include "base/result.h"
#include "collab/link/link_loop.h"

namespace icome::collab {

/// A socket that listens, not blocking, for its taker to close.
struct ListeningSocket {
  int descriptor = -1;
  bool is_v6 = false;
  Endpoint endpoint = {};  // as a number, with the port that it got
};

/// Who may reach an address that is listened at.
enum class Reach { Anybody, ThisComputerOnly };

/// Listens at an endpoint, a name waiting to be resolved. Fails with a sentence that names it; by
/// `ThisComputerOnly` also for an address that is not on the loopback.
base::Result<ListeningSocket> listen_at(const Endpoint& endpoint, Reach reach);

/// "host:port" as people write it, IPv6 in brackets.
std::string shown_endpoint(const Endpoint& endpoint);

}  // namespace icome::collab
