#include "apps/serving/serve_command.h"

#include <fmt/format.h>
#include <malloc.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/interrupt.h"
#include "apps/serving/invite_command.h"
#include "apps/terminal.h"
#include "collab/server/design_server.h"
#include "collab/storage/store.h"
#include "io/host_port.h"

namespace icome::apps {
namespace {

constexpr const char* kFirstDesign = "design";  // in a store that has none

std::string place_text(const collab::Endpoint& endpoint) {
  const bool is_ipv6 = endpoint.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", is_ipv6 ? "[" : "", endpoint.host, is_ipv6 ? "]" : "", endpoint.port);
}

base::Result<collab::Endpoint> endpoint_from(const std::string& text, std::uint16_t usual_port) {
  const auto place = io::parse_host_port(text, {"127.0.0.1", usual_port});
  if (!place) return tl::unexpected(place.error());
  return collab::Endpoint{place->host, std::uint16_t(place->port)};
}

base::Result<collab::ServeSettings> understood_serve(const ServingOptions& options) {
  collab::ServeSettings settings;
  settings.store = options.store;
  settings.files = options.files;
  settings.bus = options.bus;
  settings.certificate = options.certificate;
  settings.key = options.key;
  settings.insecure = options.insecure;
  settings.origins = options.origins;
  settings.most_links_an_address = std::size_t(options.links_an_address);
  const auto listen = endpoint_from(options.listen, collab::kUsualPort);
  if (!listen) return base::fail("--listen: " + listen.error().message);
  settings.listen = *listen;
  if (options.health.empty()) return settings;
  const auto health = endpoint_from(options.health, 0);
  if (!health) return base::fail("--health: " + health.error().message);
  settings.health = *health;
  return settings;
}

/// A link to paste for somebody who begins, or how to get one.
base::Result<std::string> first_words(const ServingOptions& options) {
  const auto store = collab::Store::open(options.store);
  if (!store) return tl::unexpected(store.error());
  const auto log = store->log();
  if (!log) return tl::unexpected(log.error());
  const auto designs = (*log)->designs();
  if (!designs) return tl::unexpected(designs.error());
  if (designs->size() > 1)
    return fmt::format("{} designs; icome invite NAME --role edit prints a link to one of them.\n",
                       designs->size());
  ServingOptions invited;
  invited.store = options.store;
  invited.design = designs->empty() ? kFirstDesign : designs->front().name;
  invited.role = "own";
  const auto link = invitation_link(invited);
  if (!link) return tl::unexpected(link.error());
  return fmt::format("Open this link, which lasts for {}:\n\n  icome '{}'\n\n", invited.lasts, *link);
}

base::Result<void> say_where(const collab::DesignServer& server, const ServingOptions& options) {
  if (options.json) {
    nlohmann::ordered_json said{{"listening", place_text(server.endpoint())},
                                {"fingerprint", server.fingerprint()},
                                {"store", server.store()}};
    if (const auto health = server.health_endpoint()) said["health"] = place_text(*health);
    print(said.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  } else {
    const auto words = first_words(options);
    if (!words) return tl::unexpected(words.error());
    print(fmt::format("Serving {} at {}{}\n{}Ctrl-C ends it.\n", server.store(),
                      place_text(server.endpoint()),
                      server.fingerprint().empty() ? ", without encryption" : "", *words));
  }
  if (std::fflush(stdout) != 0) return base::fail("standard output cannot be written.");
  return {};
}

}  // namespace

int run_serve_designs(const ServingOptions& options) {
  catch_interrupts();
  // Frames of some ten kB come and go all the time: memory that is given back to the system in between costs
  // more than all else.
  ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
  const auto settings = understood_serve(options);
  if (!settings) return tell(settings.error().message), kFailed;
  auto server = collab::DesignServer::create(*settings);
  if (!server) return tell(server.error().message), kFailed;
  if (const auto said = say_where(**server, options); !said) return tell(said.error().message), kFailed;
  if (const auto served = (*server)->run(interrupted); !served) return tell(served.error().message), kFailed;
  return 0;
}

}  // namespace icome::apps
