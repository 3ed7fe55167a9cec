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

/// `is_away`: it failed as the server is not to be reached.
base::Result<std::unique_ptr<collab::Connection>> wait_until_live(
    std::unique_ptr<collab::Connection> connection, StatusLine& status, bool* is_away = nullptr) {
  const collab::Conversation& talk = connection->talk();
  status.say("Connecting to " + collab::shown_address(talk.address()));
  const auto show = [&] {
    if (talk.progress() > 0.0) status.progress("Reading", std::round(100.0 * talk.progress()), 100.0, "%");
  };
  const auto is_live = [&] { return talk.state() == collab::ConversationState::Live; };
  const auto joined = work(*connection, is_live, show, kJoinPatience);
  status.clear();
  if (is_away != nullptr)
    *is_away = !joined && talk.state() == collab::ConversationState::Away && !connection->is_distrusted() &&
               !interrupted();
  if (!joined) return tl::unexpected(joined.error());
  return connection;
}

/// The design as it is kept here, with what was done to it without the server, which is away for a reason.
base::Result<files::LoadedDesign> kept_design(const collab::DesignAddress& address, const base::Error& why) {
  const auto folder = collab::KeptDesign::usual_folder();
  if (!folder) return tl::unexpected(why);
  const auto copy = collab::KeptDesign::read(collab::KeptDesign::place_of(*folder, address));
  if (!copy) return base::fail(why.message + " " + copy.error().message);
  if (!*copy) return tl::unexpected(why);
  collab::Replica replica;
  replica.resume(**copy);
  tell(fmt::format("{} Read instead: the copy that is kept here.", why.message));
  files::LoadedDesign design;
  design.world = replica.world();
  design.format = "kept for offline work";
  return design;
}

/// Connects without a copy.
base::Result<std::unique_ptr<collab::Connection>> join_as_it_is(const collab::DesignAddress& address,
                                                                StatusLine& status, bool only_reads,
                                                                bool* is_away = nullptr) {
  auto identity = collab::new_identity();
  if (!identity) return tl::unexpected(identity.error());
  identity->only_reads = only_reads;
  auto connection =
      collab::Connection::create(address, std::move(*identity), collab::FolderContents::of_user());
  return connection ? wait_until_live(std::move(*connection), status, is_away) : std::move(connection);
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
  return join_as_it_is(*address, status, only_reads);
}

base::Result<std::unique_ptr<collab::Connection>> join_design(const collab::DesignAddress& address,
                                                              StatusLine& status,
                                                              const collab::KeptDesign& kept,
                                                              const collab::KeptCopy& copy) {
  auto identity = collab::new_identity();
  if (!identity) return tl::unexpected(identity.error());
  identity->key = copy.key;
  auto connection =
      collab::Connection::create(address, std::move(*identity), collab::FolderContents::of_user());
  if (!connection) return connection;
  (*connection)->talk().ask_for_choices();
  if (const auto resumed = kept.resume((*connection)->talk(), copy); !resumed)
    return tl::unexpected(resumed.error());
  return wait_until_live(std::move(*connection), status);
}

base::Result<files::LoadedDesign> fetch_design(const std::string& text, StatusLine& status) {
  const auto address = collab::address_to_join(text);
  if (!address) return tl::unexpected(address.error());
  bool is_away = false;
  auto connection = join_as_it_is(*address, status, true, &is_away);
  if (!connection && is_away) return kept_design(*address, connection.error());
  if (!connection) return tl::unexpected(connection.error());
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
  SentModel sent{0, model.objects().size(), bytes->size(), design.objects().size()};
  const auto number = talk.perform(edit, "Integrate");
  if (!number) return tl::unexpected(number.error());
  if (const auto done = wait_until_durable(**connection, status); !done) return tl::unexpected(done.error());
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
