#include "apps/remote/keep_command.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>
#include <span>

#include "apps/interrupt.h"
#include "apps/remote/remote_design.h"
#include "apps/serving/serving_help.h"
#include "apps/terminal.h"
#include "collab/client/joining.h"
#include "collab/client/kept_design.h"
#include "collab/storage/design_state.h"

namespace icome::apps {
namespace {

constexpr const char* kKeepNotes =
    "Examples:\n"
    "  icome keep 'icome://...'                    fetch the design; again: bring the copy up to date\n"
    "  icome keep --list                           what is kept, since when, and what was not sent yet\n"
    "  icome keep 'icome://...' --forget\n"
    "\n"
    "While the server is away, icome LINK opens the copy: work on it, and what you do is sent when the "
    "server\n"
    "is back. info, shot, touch and convert read the copy then. In the window: File > Keep for Offline "
    "Work.\n"
    "The copies are in icome/kept in $XDG_DATA_HOME or ~/.local/share, for you only: they hold the links.";

std::string shown_time(std::int64_t at) {
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::localtime(std::time_t(at / 1'000)));
}

int failed(const base::Error& error) {
  tell(error.message);
  return kFailed;
}

int list_kept(const std::filesystem::path& folder, bool json) {
  nlohmann::json rows = nlohmann::json::array();
  std::string text;
  int code = 0;
  for (const std::filesystem::path& place : collab::KeptDesign::all(folder)) {
    const auto copy = collab::KeptDesign::read(place);
    if (!copy || !*copy) {
      if (!copy) code = failed(copy.error());
      continue;
    }
    const collab::KeptCopy& it = **copy;
    const std::string design = shown_name(it.link);
    rows.push_back({{"design", design},
                    {"kept", it.at},
                    {"sequence", it.sequence},
                    {"objects", it.world.objects().size()},
                    {"unsent", it.edits.size()}});
    text += fmt::format("{}  kept {}, edit {}, {} object{}, {}\n", design, shown_time(it.at), it.sequence,
                        it.world.objects().size(), it.world.objects().size() == 1 ? "" : "s",
                        it.edits.empty() ? "all sent" : fmt::format("{} not sent", it.edits.size()));
  }
  if (text.empty()) text = "No design is kept for offline work.\n";
  const int printed = print_answer(json ? nlohmann::json{{"kept", rows}}.dump() + "\n" : text);
  return code != 0 ? code : printed;
}

/// Forgets the copy and what was put aside, unless that would lose work.
int forget_kept(const std::filesystem::path& folder, const collab::DesignAddress& address) {
  std::error_code error;
  if (!std::filesystem::exists(collab::KeptDesign::place_of(folder, address), error))
    return failed({collab::shown_address(address) + ": is not kept here."});
  const auto kept = collab::KeptDesign::make(folder, address);
  if (!kept) return failed(kept.error());
  if (const auto copy = kept->read(); copy && *copy && !(*copy)->edits.empty() &&
                                      !ask(fmt::format("{} edits were not sent yet, and go with the copy. "
                                                       "Forget it all the same?",
                                                       (*copy)->edits.size())))
    return failed({"Nothing was forgotten."});
  kept->remove();
  tell(collab::shown_address(address) + ": is not kept any more.");
  return 0;
}

/// The copy that there is, if any; a damaged one is put aside. Fails where that cannot be done.
base::Result<std::optional<collab::KeptCopy>> former_copy(const collab::KeptDesign& kept) {
  auto copy = kept.read();
  if (copy) return copy;
  const auto aside = kept.put_aside();
  if (!aside) return tl::unexpected(aside.error());
  tell(fmt::format("{} It is put aside as {}.", copy.error().message, aside->string()));
  return std::nullopt;
}

/// What became of the edits that were made without the server.
struct SentEdits {
  std::size_t sent = 0;
  std::vector<collab::Dropped> dropped;
};

/// "leg, by Ann; arm, by Bob": some of the things that were changed both here and by others.
std::string conflicts_text(const collab::Conversation& talk) {
  const std::vector<collab::Conflict>& all = talk.conflicts();
  const std::size_t told = std::min<std::size_t>(5, all.size());
  std::string text;
  for (const collab::Conflict& it : std::span(all).first(told)) {
    const std::string whose = it.whose == 0 ? "others" : talk.name_of(it.whose);
    text += fmt::format("{}{}, by {}", text.empty() ? "" : "; ", it.name, whose);
  }
  return told == all.size() ? text : text + fmt::format("; and {} more", all.size() - told);
}

/// Sends what was done without the server, and tells what became of it.
base::Result<SentEdits> send_former(collab::Connection& connection, const collab::KeptCopy& former,
                                    StatusLine& status) {
  if (!connection.talk().conflicts().empty()) {
    const std::string things = conflicts_text(connection.talk());
    leave_design(connection);
    return base::fail(
        fmt::format("{}: some things were changed both here, without the server, and by others ({}). Open it "
                    "in the window (icome LINK) to choose; nothing was sent.",
                    collab::shown_address(connection.talk().address()), things));
  }
  if (const auto sent = wait_until_durable(connection, status); !sent) return tl::unexpected(sent.error());
  SentEdits edits;
  for (const collab::Seen& it : connection.talk().take_seen())
    if (const auto* const dropped = std::get_if<collab::Dropped>(&it)) {
      tell(fmt::format("\"{}\" did not come to be: {}", dropped->name, dropped->why));
      edits.dropped.push_back(*dropped);
    }
  edits.sent = former.edits.size() - std::min(former.edits.size(), edits.dropped.size());
  if (edits.sent > 0)
    tell(edits.sent == 1 ? "One edit that was made without the server was sent."
                         : fmt::format("{} edits that were made without the server were sent.", edits.sent));
  return edits;
}

/// "--json" of a design that was kept.
std::string kept_json(const std::string& shown, const collab::KeptCopy& copy, const SentEdits& edits) {
  nlohmann::json dropped = nlohmann::json::array();
  for (const collab::Dropped& it : edits.dropped) dropped.push_back({{"name", it.name}, {"why", it.why}});
  const nlohmann::json json{{"design", shown},           {"kept", copy.at},
                            {"sequence", copy.sequence}, {"objects", copy.world.objects().size()},
                            {"sent", edits.sent},        {"dropped", dropped}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

/// Fetches the design, or what is new of it, and sends what was done without the server.
int keep_design(const std::filesystem::path& folder, const collab::DesignAddress& address, bool json) {
  const auto kept = collab::KeptDesign::make(folder, address);
  if (!kept) return failed(kept.error());
  StatusLine status;
  const auto read = former_copy(*kept);
  if (!read) return failed(read.error());
  const std::optional<collab::KeptCopy>& former = *read;
  auto connection =
      former ? join_design(address, status, *kept, *former) : join_design(collab::link_text(address), status);
  if (!connection) {
    kept->remove_if_empty();
    return failed(connection.error());
  }
  SentEdits edits;
  if (former) {
    auto sent = send_former(**connection, *former, status);
    if (!sent) return failed(sent.error());
    edits = std::move(*sent);
  }
  collab::Conversation& talk = (*connection)->talk();
  auto copy = talk.keep();
  leave_design(**connection);
  if (!copy) return failed({"The design changes too fast to be kept now: try again."});
  copy->at = collab::wall_milliseconds();
  if (former && former->history != copy->history) {
    const auto aside = kept->put_aside();
    if (!aside) return failed(aside.error());
    tell(fmt::format(
        "The design was restored from an earlier state: what was here before is put aside as {}, which "
        "icome opens.",
        aside->string()));
  }
  if (const auto written = kept->write(*copy); !written) return failed(written.error());
  const std::string shown = collab::shown_address(address);
  const int printed =
      print_answer(json ? kept_json(shown, *copy, edits)
                        : fmt::format("{}: kept, with edit {}. icome opens it without its server, too.\n",
                                      shown, copy->sequence));
  return edits.dropped.empty() ? printed : kFailed;
}

}  // namespace

void add_keep(CLI::App& app, KeepOptions& options) {
  CLI::App& keep = *app.add_subcommand("keep", "Keep a design of a server on this machine, for offline work");
  keep.footer(kKeepNotes);
  auto* const address = keep.add_option("LINK", options.address, kAddressHelp)->type_name("");
  auto* const forget = keep.add_flag("--forget", options.forget, "Remove the copy")->needs(address);
  keep.add_flag("--list", options.list, "Name the designs that are kept")
      ->excludes(address)
      ->excludes(forget);
  keep.add_flag("--json", options.json,
                "As JSON: design, kept (ms since 1970), sequence, objects, sent, dropped: [{name, why}]; "
                "in a list also unsent");
  keep.callback([&options] {
    if (!options.list && options.address.empty())
      throw CLI::RequiredError("keep: give the link of a design, or --list");
  });
}

int run_keep(const KeepOptions& options) {
  catch_interrupts();
  const auto folder = collab::KeptDesign::usual_folder();
  if (!folder) return failed(folder.error());
  if (options.list) return list_kept(*folder, options.json);
  const auto address = collab::address_to_join(options.address);
  if (!address) return failed(address.error());
  return options.forget ? forget_kept(*folder, *address) : keep_design(*folder, *address, options.json);
}

}  // namespace icome::apps
