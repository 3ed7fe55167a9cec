#include "apps/remote/remote_design.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "apps/interrupt.h"
#include "apps/terminal.h"
#include "collab/client/integration.h"
#include "collab/client/joining.h"
#include "interaction/operations/arguments.h"
#include "world/edit/edit_bytes.h"

namespace icome::apps {
namespace {

constexpr std::chrono::milliseconds kJoinPatience{3'000};  // with a server that is not to be reached

/// Works until `done`; an interruption is a failure.
base::Result<void> work(collab::Connection& connection, const std::function<bool()>& done,
                        const std::function<void()>& show, std::chrono::milliseconds patience) {
  const auto stops = [&] {
    show();
    return interrupted();
  };
  const auto worked = connection.work_until(done, stops, patience);
  if (!worked) return tl::unexpected(worked.error());
  if (!*worked) return base::fail("interrupted");
  return {};
}

base::Result<std::unique_ptr<collab::Connection>> wait_until_live(
    std::unique_ptr<collab::Connection> connection, StatusLine& status) {
  const collab::Conversation& talk = connection->talk();
  status.say("Connecting to " + collab::shown_address(talk.address()));
  const auto show = [&] {
    if (talk.progress() > 0.0) status.progress("Reading", std::round(100.0 * talk.progress()), 100.0, "%");
  };
  const auto is_live = [&] { return talk.state() == collab::ConversationState::Live; };
  const auto joined = work(*connection, is_live, show, kJoinPatience);
  status.clear();
  if (!joined) return tl::unexpected(joined.error());
  return connection;
}

/// The design as it is kept here, with what was done to it without the server; nothing: it is not kept.
std::optional<files::LoadedDesign> kept_design(const std::string& text, const base::Error& why) {
  const auto address = collab::address_to_join(text);
  const auto folder = collab::KeptDesign::usual_folder();
  if (!address || !folder || interrupted()) return std::nullopt;
  const auto kept = collab::KeptDesign::find(*folder, *address);
  if (!kept || !*kept) return std::nullopt;
  const auto copy = (*kept)->read();
  if (!copy || !*copy) return std::nullopt;
  collab::Replica replica;
  replica.resume(**copy);
  tell(fmt::format("{} Read instead: the copy that is kept here.", why.message));
  files::LoadedDesign design;
  design.world = replica.world();
  design.format = "kept for offline work";
  return design;
}

}  // namespace

bool is_remote(const std::filesystem::path& design) { return collab::is_design_address(design.string()); }

std::string shown_name(const std::filesystem::path& design) {
  if (!is_remote(design)) return design.string();
  const auto address = collab::design_address(design.string());
  return address ? collab::shown_address(*address) : "icome://...";
}

base::Result<std::unique_ptr<collab::Connection>> join_design(const std::string& text, StatusLine& status,
                                                              bool only_reads) {
  const auto address = collab::address_to_join(text);
  if (!address) return tl::unexpected(address.error());
  auto identity = collab::new_identity();
  if (!identity) return tl::unexpected(identity.error());
  identity->only_reads = only_reads;
  auto connection =
      collab::Connection::create(*address, std::move(*identity), collab::FolderContents::of_user());
  return connection ? wait_until_live(std::move(*connection), status) : std::move(connection);
}

base::Result<std::unique_ptr<collab::Connection>> join_design(const collab::DesignAddress& address,
                                                              StatusLine& status,
                                                              const collab::KeptDesign& kept) {
  const auto copy = kept.read();
  if (!copy) return tl::unexpected(copy.error());
  auto identity = collab::new_identity();
  if (!identity) return tl::unexpected(identity.error());
  if (*copy) identity->key = (*copy)->key;
  auto connection =
      collab::Connection::create(address, std::move(*identity), collab::FolderContents::of_user());
  if (connection && *copy) (*connection)->talk().resume(**copy);
  return connection ? wait_until_live(std::move(*connection), status) : std::move(connection);
}

base::Result<files::LoadedDesign> fetch_design(const std::string& text, StatusLine& status) {
  auto connection = join_design(text, status, true);
  if (!connection) {
    auto kept = kept_design(text, connection.error());
    return kept ? base::Result<files::LoadedDesign>(std::move(*kept)) : tl::unexpected(connection.error());
  }
  files::LoadedDesign design;
  design.world = (*connection)->talk().replica().world();
  design.format = "ICOME server";
  leave_design(**connection);
  return design;
}

base::Result<SentModel> send_model(const world::World& model, const std::string& text,
                                   const std::string& parent, StatusLine& status) {
  auto connection = join_design(text, status);
  if (!connection) return tl::unexpected(connection.error());
  collab::Conversation& talk = (*connection)->talk();
  const world::World& design = talk.replica().world();
  base::Result<world::ObjectId> above = world::ObjectId{};
  if (!parent.empty()) above = interaction::named_object(design, parent);
  if (!above) return base::fail("--into: " + above.error().message);
  world::IdSource ids(talk.replica().author(), design.next_number(talk.replica().author()));
  const world::Edit edit = collab::integration_of(model, design, *above, ids);
  const auto bytes = world::to_bytes(edit);
  if (!bytes) return tl::unexpected(bytes.error());
  const auto number = talk.perform(edit, "Integrate");
  if (!number) return tl::unexpected(number.error());
  if (const auto done = wait_until_durable(**connection, status); !done) return tl::unexpected(done.error());
  SentModel sent{0, model.objects().size(), bytes->size()};
  for (const collab::Seen& seen : talk.take_seen()) {
    if (const auto* const dropped = std::get_if<collab::Dropped>(&seen)) return base::fail(dropped->why);
    if (const auto* const made = std::get_if<collab::SeenEdit>(&seen); made && made->number == *number)
      sent.sequence = made->sequence;
  }
  leave_design(**connection);
  return sent;
}

base::Result<void> wait_until_durable(collab::Connection& connection, StatusLine& status) {
  const collab::Conversation& talk = connection.talk();
  const double all = double(talk.replica().unacknowledged());
  const auto show = [&] {
    status.progress("Saving", all - double(talk.replica().unacknowledged()), all, "edits");
  };
  const auto done = work(
      connection, [&] { return talk.replica().unacknowledged() == 0; }, show, kServerPatience);
  status.clear();
  return done;
}

void leave_design(collab::Connection& connection) {
  constexpr std::chrono::milliseconds kMostLeaving{2'000};
  collab::Conversation& talk = connection.talk();
  talk.leave();
  const auto begin = std::chrono::steady_clock::now();
  const auto is_late = [&] { return std::chrono::steady_clock::now() - begin > kMostLeaving; };
  // Whether the server hears of it or not: its lease ends.
  (void)connection.work_until([&] { return talk.state() != collab::ConversationState::Live; }, is_late,
                              kMostLeaving);
}

}  // namespace icome::apps
