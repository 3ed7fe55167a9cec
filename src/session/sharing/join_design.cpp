#include "session/sharing/join_design.h"

#include <fmt/format.h>

#include <functional>
#include <thread>
#include <utility>

#include "collab/client/joining.h"
#include "collab/content/content_cache.h"

namespace icome::session {
namespace {

constexpr std::chrono::milliseconds kJoinPatience{3'000};  // with a server that is not to be reached
constexpr std::chrono::milliseconds kLook{50};

/// The copy that is kept here; nothing where there is none that can be read, or another program has it. This
/// one may still be leaving the design, so it is waited for.
std::optional<collab::KeptCopy> kept_copy(const collab::DesignAddress& address,
                                          const std::filesystem::path& folder, JoinedDesign& joined,
                                          const std::function<bool()>& stops) {
  if (folder.empty()) return std::nullopt;
  const auto begin = std::chrono::steady_clock::now();
  auto kept = collab::KeptDesign::find(folder, address);
  while (kept && !*kept && std::chrono::steady_clock::now() - begin < kJoinPatience && !stops()) {
    std::this_thread::sleep_for(kLook);
    kept = collab::KeptDesign::find(folder, address);
  }
  if (!kept || !*kept) return std::nullopt;
  joined.kept = std::make_shared<const collab::KeptDesign>(std::move(**kept));
  auto copy = joined.kept->read();
  if (copy) return std::move(*copy);
  joined.damage = copy.error().message;
  if (const auto aside = joined.kept->put_aside()) joined.damage += " It stays as " + aside->string() + ".";
  return std::nullopt;
}

}  // namespace

std::filesystem::path default_kept_folder() {
  return collab::KeptDesign::usual_folder().value_or(std::filesystem::path());
}

base::Result<files::LoadedDesign> join_design(const collab::DesignAddress& address, const std::string& name,
                                              const std::filesystem::path& kept_folder, JoinedDesign& joined,
                                              const files::DesignReadOptions& options) {
  auto identity = collab::new_identity(name);
  if (!identity) return tl::unexpected(identity.error());
  const auto copy =
      kept_copy(address, kept_folder, joined, [&] { return options.progress && !options.progress(0.0); });
  if (copy) identity->key = copy->key;
  auto connection =
      collab::Connection::create(address, std::move(*identity), collab::FolderContents::of_user());
  if (!connection) return tl::unexpected(connection.error());
  collab::Conversation& talk = (*connection)->talk();
  talk.ask_for_choices();
  if (copy)
    if (const auto resumed = joined.kept->resume(talk, *copy); !resumed)
      return tl::unexpected(resumed.error());
  const auto is_live = [&] { return talk.state() == collab::ConversationState::Live; };
  const auto stops = [&] { return options.progress && !options.progress(talk.progress()); };
  const auto done = (*connection)->work_until(is_live, stops, kJoinPatience);
  if (done && !*done) return base::fail("interrupted");
  if (!done && !copy) return tl::unexpected(done.error());
  const auto now = talk.keep();
  if (copy && now && now->history != copy->history)
    if (const auto aside = joined.kept->put_aside())
      joined.damage = "The design was restored from an earlier state. What was here before stays as " +
                      aside->string() + ", which icome opens.";
  files::LoadedDesign design;
  design.world = talk.replica().world();
  if (!done) {
    joined.kept_at = copy->at;
    joined.why_away = done.error().message;
    design.format = "the copy that is kept here";
  } else {
    design.format = fmt::format("on {}:{}", address.host, address.port);
  }
  if (talk.state() != collab::ConversationState::Ended) joined.connection = std::move(*connection);
  return design;
}

}  // namespace icome::session
