#include "apps/serving/invite_command.h"

#include <fmt/format.h>

#include <optional>

#include "apps/terminal.h"
#include "base/parse_number.h"
#include "collab/link/certificate.h"
#include "collab/protocol/address.h"
#include "collab/server/token.h"
#include "collab/storage/design_state.h"
#include "collab/storage/store.h"
#include "io/host_port.h"

namespace icome::apps {
namespace {

/// "90s", "30m", "8h" or "7d" in ms.
base::Result<std::int64_t> duration_of(std::string_view text) {
  const auto number = base::number_at_front<double>(text);
  double seconds = 0.0;
  if (number.good() && number.rest == "s") seconds = 1.0;
  if (number.good() && number.rest == "m") seconds = 60.0;
  if (number.good() && number.rest == "h") seconds = 3'600.0;
  if (number.good() && number.rest == "d") seconds = 86'400.0;
  constexpr double kLongest = 10.0 * 366.0 * 86'400.0;
  const double all = seconds * number.value;
  if (!(all > 0.0 && all <= kLongest))
    return base::fail(
        fmt::format("--for is \"{}\"; it takes a time such as 90s, 30m, 8h or 7d, ten years at most.", text));
  return std::int64_t(1e3 * all);
}

collab::Role role_of(const std::string& word) {
  if (word == "view") return collab::Role::View;
  return word == "own" ? collab::Role::Own : collab::Role::Edit;
}

/// Host, port and fingerprint of the address.
base::Result<collab::DesignAddress> place_of(const ServingOptions& options, const collab::Store& store) {
  const auto served = store.address();
  if (!served) return tl::unexpected(served.error());
  collab::DesignAddress address;
  if (*served) {
    address.host = (*served)->host;
    address.port = (*served)->port;
    address.fingerprint =
        (*served)->fingerprint.empty() ? std::string(collab::kNoTls) : (*served)->fingerprint;
  }
  if (!options.server.empty()) {
    const auto place = io::parse_host_port(options.server, {address.host, collab::kUsualPort});
    if (!place) return base::fail("--server: " + place.error().message);
    address.host = place->host;
    address.port = std::uint16_t(place->port);
  }
  if (address.host.empty() || address.port == 0)
    return base::fail(store.shown() +
                      ": nobody has served this store yet: start icome serve, or say --server HOST:PORT.");
  if (!address.fingerprint.empty() || store.folder() == nullptr) return address;
  auto fingerprint = collab::fingerprint_of(store.folder()->certificate());
  if (!fingerprint) return tl::unexpected(fingerprint.error());
  address.fingerprint = std::move(*fingerprint);
  return address;
}

/// A design that is there, or is made for its owner.
base::Result<void> ensure_design(const collab::Store& store, const std::string& design, bool may_make) {
  const auto log = store.log();
  if (!log) return tl::unexpected(log.error());
  const auto found = (*log)->find(design);
  if (!found) return tl::unexpected(found.error());
  if (*found) return {};
  if (!may_make)
    return base::fail(
        fmt::format("{}: there is no design \"{}\"; --role own makes one.", store.shown(), design));
  return (*log)->create(design);
}

}  // namespace

base::Result<std::string> invitation_link(const ServingOptions& options) {
  if (const auto good = collab::check_design_name(options.design); !good) return tl::unexpected(good.error());
  const auto lasts = duration_of(options.lasts);
  if (!lasts) return tl::unexpected(lasts.error());
  const auto store = collab::Store::open(options.store);
  if (!store) return tl::unexpected(store.error());
  auto address = place_of(options, *store);
  if (!address) return tl::unexpected(address.error());
  const collab::Role role = role_of(options.role);
  if (const auto there = ensure_design(*store, options.design, role == collab::Role::Own); !there)
    return tl::unexpected(there.error());
  auto id = collab::make_invitation_id();
  if (!id) return tl::unexpected(id.error());
  const auto signer = store->signer();
  if (!signer) return tl::unexpected(signer.error());
  auto token = signer->sign({std::move(*id), options.design, role, collab::wall_milliseconds() + *lasts});
  if (!token) return tl::unexpected(token.error());
  address->design = options.design;
  address->token = std::move(*token);
  return collab::link_text(*address);
}

int run_invite(const ServingOptions& options) {
  const auto link = invitation_link(options);
  if (!link) return tell(link.error().message), kFailed;
  return print_answer(*link + "\n");
}

int run_revoke(const ServingOptions& options) {
  const auto failed = [](const base::Error& error) { return tell(error.message), kFailed; };
  const auto store = collab::Store::open(options.store);
  if (!store) return failed(store.error());
  std::string id = options.link;
  if (collab::is_design_address(options.link)) {
    const auto address = collab::design_address(options.link);
    if (!address) return failed(address.error());
    const auto signer = store->signer();
    if (!signer) return failed(signer.error());
    // Whether it has expired does not matter here.
    const auto invitation = signer->check(address->token, address->design, 0);
    if (!invitation) return failed({"The link was not made for a design of this store, or is damaged."});
    id = invitation->id;
  } else if (id.size() != 32 || id.find_first_not_of("0123456789abcdef") != std::string::npos) {
    return failed(
        {fmt::format("\"{}\" is neither a link nor the id of an invitation (32 hexadecimal digits).", id)});
  }
  const auto log = store->log();
  if (!log) return failed(log.error());
  if (const auto done = (*log)->revoke(id); !done) return failed(done.error());
  tell(
      collab::is_design_address(options.link)
          ? "the link lets nobody in any more; a server that runs sends those away who came by it."
          : "no link of this invitation lets anybody in any more, if there was one; a server that runs sends "
            "those away who came by it.");
  return 0;
}

}  // namespace icome::apps
