#include "apps/remote/remote_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>

#include "apps/design/design_work.h"
#include "apps/design/edit_script.h"
#include "apps/interrupt.h"
#include "apps/remote/remote_design.h"
#include "apps/remote/watched_design.h"
#include "apps/terminal.h"
#include "interaction/operations/operation_runner.h"
#include "session/storage/picture_file.h"

namespace icome::apps {
namespace {

using Json = nlohmann::ordered_json;
using interaction::Value;

/// A line of a script that did not come to be.
struct RefusedLine {
  std::size_t line;  // from 1
  std::string why;   // a sentence
};

/// A design on a server as the target of operations. Refers to the connection.
class RemoteTarget final : public interaction::OperationTarget {
 public:
  explicit RemoteTarget(collab::Conversation& talk)
      : talk_(talk),
        ids_(talk.replica().author(), talk.replica().world().next_number(talk.replica().author())) {}

  const world::World& world() const override { return talk_.replica().world(); }
  world::IdSource& ids() override { return ids_; }
  base::Result<void> act(const world::Edit& edit, const std::string& title) override {
    return keep(talk_.perform(edit, title));
  }
  base::Result<void> undo() override { return keep(talk_.undo()); }
  base::Result<void> redo() override { return keep(talk_.redo()); }

  /// The number of the last edit that was made.
  std::uint64_t last_number() const { return last_number_; }

 private:
  base::Result<void> keep(const base::Result<std::uint64_t>& number) {
    if (!number) return tl::unexpected(number.error());
    last_number_ = *number;
    return {};
  }

  collab::Conversation& talk_;
  world::IdSource ids_;
  std::uint64_t last_number_ = 0;
};

/// Performs a script on a shared design and keeps count of what becomes of its lines.
class RemoteScript {
 public:
  RemoteScript(collab::Connection& connection, const EditOptions& options)
      : connection_(connection), talk_(connection.talk()), target_(talk_), options_(options) {}

  base::Result<void> run(std::string_view text, StatusLine& status) {
    const auto goes_on = [&](double part) {
      status.progress("Editing", 100.0 * part, 100.0, "%");
      return !interrupted();
    };
    const auto perform = [this](const Value& command, std::size_t line) {
      return perform_one(command, line);
    };
    const EditOutcome outcome = perform_script(perform, text, true, goes_on);
    for (const EditError& error : outcome.errors) refused_.push_back({error.line, error.message});
    base::Result<void> done = base::fail("interrupted");
    if (!outcome.stopped) done = wait_until_durable(connection_, status);
    if (!done) hear_the_rest();
    note(talk_.take_seen());
    unknown_ = talk_.replica().unacknowledged();
    if (sequence_ == 0) sequence_ = durable_;
    std::ranges::sort(refused_, {}, &RefusedLine::line);
    return done;
  }

  /// Takes what has happened into account; it stays to be told.
  void note(std::vector<collab::Seen> seen) {
    for (collab::Seen& it : seen) {
      if (const auto* const durable = std::get_if<collab::SeenDurable>(&it)) {
        applied_ += durable->own.size();
        durable_ = std::max(durable_, durable->sequence);
        for (const std::uint64_t number : durable->own)
          if (const auto own = ordered_.extract(number)) sequence_ = std::max(sequence_, own.mapped());
      } else if (const auto* const edit = std::get_if<collab::SeenEdit>(&it); edit && edit->number > 0) {
        ordered_[edit->number] = edit->sequence;
      } else if (const auto* const dropped = std::get_if<collab::Dropped>(&it)) {
        const auto line = lines_.find(dropped->number);
        refused_.push_back({line == lines_.end() ? 0 : line->second, dropped->why});
      }
      seen_.push_back(std::move(it));
    }
  }

  std::size_t applied() const { return applied_; }
  /// Edits of which nobody here knows what became of them.
  std::size_t unknown() const { return unknown_; }
  std::uint64_t sequence() const { return sequence_; }
  const std::vector<RefusedLine>& refused() const { return refused_; }
  std::vector<collab::Seen> take_seen() { return std::exchange(seen_, {}); }

 private:
  /// What is under way is heard of for a moment, so that little is unknown.
  void hear_the_rest() {
    constexpr std::chrono::milliseconds kMoment{2'000};
    const auto begin = std::chrono::steady_clock::now();
    const auto is_over = [&] { return std::chrono::steady_clock::now() - begin > kMoment; };
    (void)connection_.work_until([&] { return talk_.replica().unacknowledged() == 0; }, is_over, kMoment);
  }

  /// Waits for answers of the server only where the next line may depend on them.
  base::Result<interaction::Performed> perform_one(const Value& command, std::size_t line) {
    const Value* const name = command.fields() ? interaction::field(*command.fields(), "op") : nullptr;
    if (name && name->text() && is_of_floor(*name->text())) return hold(*command.fields(), *name->text());
    constexpr std::size_t kMostPending = 250;  // so that the server's other clients are heard, too
    const std::size_t most = talk_.replica().pending() >= kMostPending ? kMostPending / 2 : kMostPending;
    const auto has_room = [&] { return talk_.replica().pending() <= most; };
    if (const auto worked = connection_.work_until(has_room, interrupted, kServerPatience); !worked)
      return tl::unexpected(worked.error());
    const std::filesystem::path folder =
        options_.apply == "-" ? std::filesystem::path() : options_.apply.parent_path();
    auto done = interaction::perform_operation(
        target_, command, [&](const std::string& file) { return session::read_picture(folder / file); });
    if (done) lines_[target_.last_number()] = line;
    return done;
  }

  static bool is_of_floor(const std::string& operation) {
    return operation == "select" || operation == "deselect" || operation == "take-away";
  }

  /// Takes an object away, and waits until that is done.
  base::Result<interaction::Performed> take_away(collab::Item item, world::ObjectId id) {
    const auto fence = [&] {
      const auto hold = talk_.holds().find(item);
      return hold == talk_.holds().end() ? 0 : hold->second.fence;
    };
    const std::uint64_t before = fence();
    if (before != 0) talk_.take_away(item);
    const auto worked = connection_.work_until([&] { return before == 0 || fence() != before; }, interrupted,
                                               kServerPatience);
    if (!worked) return tl::unexpected(worked.error());
    if (!*worked) return base::fail("interrupted");
    return interaction::Performed{nullptr, {id}};
  }

  /// Asks for an object, and waits for the answer; or gives it back, or takes it away from another.
  base::Result<interaction::Performed> hold(const Value::Fields& fields, const std::string& operation) {
    const Value* const object = interaction::field(fields, "object");
    if (!object || !object->text())
      return base::fail("the object is missing: {\"op\": \"select\", \"object\": \"leg\"}");
    // What this script has made must be known to the server before it is asked for.
    const auto is_ordered = [&] { return talk_.replica().pending() == 0; };
    if (const auto worked = connection_.work_until(is_ordered, interrupted, kServerPatience); !worked)
      return tl::unexpected(worked.error());
    const auto id = interaction::named_object(target_.world(), *object->text());
    if (!id) return tl::unexpected(id.error());
    const collab::Item item = collab::item_of(*id);
    if (operation == "take-away" && talk_.role() < collab::Role::Own)
      return base::fail("take-away: only who has a link with the role own may take things away.");
    if (operation == "deselect") {
      talk_.deselect(item);
      return interaction::Performed{nullptr, {*id}};
    }
    if (operation == "take-away") return take_away(item, *id);
    std::optional<collab::Selected> answer;
    talk_.select(item);
    const auto is_answered = [&] {
      std::vector<collab::Seen> seen = talk_.take_seen();
      for (const collab::Seen& it : seen)
        if (const auto* const selected = std::get_if<collab::Selected>(&it);
            selected && selected->item == item)
          answer = *selected;
      note(std::move(seen));
      return answer.has_value();
    };
    const auto worked = connection_.work_until(is_answered, interrupted, kServerPatience);
    if (!worked) return tl::unexpected(worked.error());
    if (!answer) return base::fail("interrupted");
    if (!answer->granted) return base::fail("select: " + answer->why);
    return interaction::Performed{nullptr, {*id}};
  }

  collab::Connection& connection_;
  collab::Conversation& talk_;
  RemoteTarget target_;
  const EditOptions& options_;
  std::map<std::uint64_t, std::size_t> lines_;  // by the numbers of edits
  std::vector<RefusedLine> refused_;
  std::vector<collab::Seen> seen_;
  std::size_t applied_ = 0, unknown_ = 0;
  std::map<std::uint64_t, std::uint64_t> ordered_;  // places of own edits that are not durable yet, by number
  std::uint64_t sequence_ = 0;                      // of the last own edit that is durable
  std::uint64_t durable_ = 0;                       // of the last edit that is
};

std::string outcome_json(const RemoteScript& script) {
  Json json{{"applied", script.applied()}, {"refused", Json::array()}, {"sequence", script.sequence()}};
  for (const RefusedLine& it : script.refused())
    json["refused"].push_back({{"line", it.line}, {"why", it.why}});
  if (script.unknown() > 0) json["unknown"] = script.unknown();
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string outcome_text(const RemoteScript& script, const EditOptions& options) {
  std::string text =
      fmt::format("{}: {} edit{}, the last is number {} of the design\n", shown_name(options.in),
                  script.applied(), script.applied() == 1 ? "" : "s", script.sequence());
  if (script.unknown() > 0)
    text += fmt::format("  what became of {} edit{} more is not known: look into the design\n",
                        script.unknown(), script.unknown() == 1 ? "" : "s");
  for (const RefusedLine& it : script.refused())
    text += fmt::format("  {}:{}: {}\n", options.apply.string(), it.line, it.why);
  return text;
}

/// Tells what happens until it is asked to end, nobody hears it, or the server lets nobody in any more. Gives
/// the exit code.
int watch(collab::Connection& connection, const std::vector<collab::Seen>& seen, bool json,
          StatusLine& status) {
  collab::Conversation& talk = connection.talk();
  const auto tell_all = [&](const std::vector<collab::Seen>& all) {
    std::string lines;
    for (const collab::Seen& it : all)
      if (const std::string line = watched_line(it, talk, json); !line.empty()) lines += line + "\n";
    return lines.empty() ? 0 : print_answer(lines);
  };
  int code = tell_all(seen);
  std::vector<collab::Seen> held;  // before this program came
  for (const auto& [item, hold] : talk.holds()) held.emplace_back(hold);
  if (code == 0) code = tell_all(held);
  const auto tell_new = [&] {
    if (code == 0) code = tell_all(talk.take_seen());
    return code != 0;
  };
  constexpr std::chrono::hours kForEver{24 * 365};  // it comes back by itself when the server does
  const auto worked = connection.work_until(tell_new, interrupted, kForEver);
  tell_new();
  if (worked) return code;
  status.clear();
  tell(worked.error().message);
  return kDesignFailed;
}

}  // namespace

int run_remote_edit(const EditOptions& options) {
  StatusLine status;
  base::Result<std::string> text = std::string();
  if (!options.apply.empty()) text = script_text(options);
  if (!text) return end_without_result(text.error(), status);
  catch_interrupts();  // not before: Ctrl-C must end a wait for standard input
  auto connection = join_design(options.in, status);
  if (!connection) return end_without_result(connection.error(), status);
  RemoteScript script(**connection, options);
  if (!options.apply.empty()) {
    const auto done = script.run(*text, status);
    status.clear();
    const int printed = print_answer(options.json ? outcome_json(script) : outcome_text(script, options));
    if (!done) tell(interrupted() ? "interrupted: what was sent before stays done." : done.error().message);
    if (!done) return interrupted() ? kDesignInterrupted : kDesignFailed;
    if (printed != 0) return printed;
  }
  if (options.watch)
    if (const int code = watch(**connection, script.take_seen(), options.json, status); code != 0)
      return code;
  leave_design(**connection);
  return script.refused().empty() ? 0 : kDesignFailed;
}

}  // namespace icome::apps
