#include "collab/server/hub.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "collab/order/world_bytes.h"
#include "collab/protocol/message_bytes.h"
#include "collab/protocol/plain_line.h"

namespace icome::collab {
namespace {

constexpr std::int64_t kRevokedGap = 250;    // ms between two looks for links that were revoked
constexpr std::size_t kMostNameBytes = 100;  // of a person
constexpr double kMessagesAtOnce = 5.0;      // s at the allowed rate

SharedBytes frame_of(const ServerMessage& message) {
  std::string frame;
  add_to_frame(frame, to_bytes(message));
  return std::make_shared<const std::string>(std::move(frame));
}

/// A design as it was opened on the log's thread, or why it was not.
struct Opening {
  std::unique_ptr<Room> room;
  std::uint64_t fence = 0;
  std::uint64_t snapshot_sequence = 0;
  std::uint64_t logged_bytes = 0;
  std::string why;
  Parting code = Parting::Other;
  std::string holder;         // another server has the design
  std::string store_trouble;  // the whole store cannot be used; empty: it can
};

Opening open_from(OpLog& log, const std::string& design, const HubSettings& settings,
                  const world::GeometryFactory& factory) {
  Opening opening;
  const auto failed = [&](const base::Error& error, Parting code) {
    opening.why = error.message;
    opening.code = code;
    return std::move(opening);
  };
  const auto store_failed = [&](const base::Error& error) {
    opening.store_trouble = error.message;
    return failed(error, Parting::Other);
  };
  const auto found = log.find(design);
  if (!found) return store_failed(found.error());
  if (!*found) return failed({fmt::format("There is no design \"{}\" here.", design)}, Parting::NoDesign);
  // A lease that an earlier life of this server left behind is not carried on: its holds are gone, and their
  // fences must not be given again.
  (void)log.release(design, settings.holder);
  const auto lease = log.lease(design, settings.holder, settings.design_lease);
  if (!lease) {
    const auto now = log.find(design);
    if (!now || !*now || (*now)->holder == settings.holder) return store_failed(lease.error());
    opening.holder = (*now)->holder;
    return failed({"Another server has this design, and does not answer: wait some seconds."},
                  Parting::ServerStops);
  }
  const auto start = read_start(log, **found, lease->fence);
  if (!start) return failed(start.error(), Parting::Other);
  auto room = Room::open(*start, settings.room, factory);
  if (!room) return failed(room.error(), Parting::Other);
  opening.room = std::move(*room);
  opening.fence = lease->fence;
  opening.snapshot_sequence = start->snapshot ? start->snapshot->sequence : 0;
  for (const LogEntry& entry : start->entries) opening.logged_bytes += entry.edit.size();
  return opening;
}

}  // namespace

Hub::Hub(HubSettings settings, TokenSigner signer, const world::GeometryFactory& factory, Audit audit,
         PassOn pass_on)
    : settings_(std::move(settings)),
      signer_(std::move(signer)),
      factory_(factory),
      audit_(std::move(audit)),
      pass_on_(std::move(pass_on)) {
  ask_for_revoked();  // before anybody comes in
}

void Hub::note_trouble(const std::string& why) {
  constexpr std::int64_t kTroubleTime = 10'000;  // ms
  trouble_ = why;
  trouble_until_ = now_ + kTroubleTime;
}

const std::string& Hub::trouble() const {
  static const std::string kNone;
  return now_ < trouble_until_ ? trouble_ : kNone;
}

void Hub::note(const std::string& what, const Link& link, const std::string& detail) {
  if (!audit_) return;
  audit_({at_, what, link.address, link.asks_for, link.name, link.invitation.id, link.author, detail});
}

// ---- connections

void Hub::opened(LinkId link, const std::string& address, std::int64_t now) {
  now_ = now;
  Link& made = links_[link];
  made.address = address;
  made.hello_until = now + settings_.hello_time;
  made.messages_at = now;
  counters_.links = links_.size();
}

void Hub::received(LinkId id, std::string_view frame, std::int64_t now, std::int64_t at) {
  now_ = now;
  at_ = at;
  const auto found = links_.find(id);
  if (found == links_.end()) return;
  Link& link = found->second;
  if (!link.is_checked && frame.size() > settings_.most_hello_bytes)
    return refuse(id, link, "The first message is a short hello.", Parting::Broken);
  while (!frame.empty() && !link.parting) {
    const auto bytes = next_in_frame(frame);
    auto message = bytes ? client_message(*bytes) : tl::unexpected(bytes.error());
    if (!message) return refuse(id, link, message.error().message, Parting::Broken);
    ++counters_.messages;
    if (spends_too_much(link))
      return refuse(id, link, "The client says too much at a time.", Parting::Broken);
    if (auto* const hello = std::get_if<Hello>(&*message); hello && !link.is_checked) {
      take_hello(id, link, std::move(*hello));
    } else if (!link.is_checked) {
      return refuse(id, link, "The first message is a hello.", Parting::Broken);
    } else if (const auto over = end_of_invitation(link)) {
      return refuse(id, link, *over, Parting::NotAllowed);
    } else if (link.design && link.design->room) {
      Room& room = *link.design->room;
      const std::uint64_t sequence = room.sequence(), refused = room.refused();
      room.receive(id, std::move(*message), now, at);
      counters_.accepted_edits += room.sequence() - sequence;
      counters_.refused_edits += room.refused() - refused;
      counters_.deliveries += link.design->links.size();
      stir(link.design);
    }
  }
}

bool Hub::spends_too_much(Link& link) const {
  const double regained = double(now_ - link.messages_at) * 1e-3 * settings_.most_messages;
  link.messages_at = now_;
  link.messages = std::max(0.0, link.messages - regained) + 1.0;
  return link.messages > kMessagesAtOnce * settings_.most_messages;
}

void Hub::closed(LinkId id, std::int64_t now) {
  now_ = now;
  const auto found = links_.find(id);
  if (found == links_.end()) return;
  const OpenDesignPointer design = found->second.design;
  if (design && design->room && design->room->has(id)) {
    note("leave", found->second);
    design->room->leave(id);
    design->links.erase(id);
    stir(design);
  }
  links_.erase(found);
  stirred_.erase(id);
  counters_.links = links_.size();
}

/// Ends a connection; what it would still have heard of its room is left out.
void Hub::refuse(LinkId id, Link& link, const std::string& why, Parting code) {
  if (link.parting) return;
  if (!link.design) ++counters_.refused_hellos;
  note("refused", link, why);
  link.last_frame = link.design ? frame_of(Goodbye{why, code}) : frame_of(Refused{why, code});
  link.parting = why;
  stirred_.insert(id);
}

void Hub::take_hello(LinkId id, Link& link, Hello hello) {
  link.is_checked = true;
  link.asks_for = plain_line(hello.design, kMostNameBytes);
  link.name = hello.name = plain_line(hello.name, kMostNameBytes);
  hello.program = plain_line(hello.program, kMostNameBytes);
  if (stops_) return refuse(id, link, "The server stops.", Parting::ServerStops);
  if (hello.least_version > kProtocolVersion || hello.most_version < kProtocolVersion)
    return refuse(
        id, link,
        fmt::format("This server speaks version {} of the protocol, the program {} to {}: bring the older "
                    "one up to date.",
                    kProtocolVersion, hello.least_version, hello.most_version),
        Parting::Version);
  if (hello.client_key.empty() || hello.client_key.size() > kMostNameBytes)
    return refuse(id, link, "A client has a key of its own.", Parting::Broken);
  auto invitation = signer_.check(hello.token, hello.design, at_);
  if (!invitation) return refuse(id, link, invitation.error().message, Parting::NotAllowed);
  link.invitation = *invitation;
  if (const auto over = end_of_invitation(link)) return refuse(id, link, *over, Parting::NotAllowed);
  const std::string design = hello.design;
  const auto open_one = rooms_.find(design);
  ask_to_join(open_one == rooms_.end() ? open(design) : open_one->second,
              {id, std::move(hello), *invitation});
}

std::optional<std::string> Hub::end_of_invitation(const Link& link) const {
  if (link.invitation.expires != 0 && at_ >= link.invitation.expires)
    return "The invitation to this design has expired: ask for a new one.";
  if (revoked_.contains(link.invitation.id)) return "The invitation to this design was revoked.";
  return std::nullopt;
}

// ---- rooms

Hub::OpenDesignPointer Hub::open(const std::string& name) {
  const auto design = std::make_shared<OpenDesign>();
  design->name = name;
  design->lease_asked = design->idle_since = now_;
  rooms_[name] = design;
  counters_.rooms = rooms_.size();
  work_.push_back({[this, design](OpLog& log) {
    const auto opening = std::make_shared<Opening>(open_from(log, design->name, settings_, factory_));
    return [this, design, opening] {
      if (!opening->store_trouble.empty()) note_trouble(opening->store_trouble);
      if (!opening->room) return give_up(design, opening->why, opening->code, opening->holder);
      design->room = std::move(opening->room);
      design->fence = opening->fence;
      design->snapshot_sequence = opening->snapshot_sequence;
      design->logged_bytes = opening->logged_bytes;
      for (const Joining& joining : std::exchange(design->joining, {})) ask_to_join(design, joining);
    };
  }});
  return design;
}

void Hub::ask_to_join(const OpenDesignPointer& design, const Joining& joining) {
  if (!design->room) {
    design->joining.push_back(joining);
    return;
  }
  // Who only reads leaves nothing in the store.
  if (joining.hello.only_reads) return join(design, joining, {next_guest_++, 0});
  work_.push_back({[this, design, joining](OpLog& log) {
    const auto author =
        log.author(design->name, joining.hello.client_key, plain_line(joining.hello.name, kMostPersonBytes));
    return [this, design, joining, author] {
      if (!author) note_trouble(author.error().message);
      if (author) return join(design, joining, *author);
      if (const auto found = links_.find(joining.link); found != links_.end())
        refuse(joining.link, found->second, author.error().message, Parting::Other);
    };
  }});
}

void Hub::join(const OpenDesignPointer& design, const Joining& joining, const AuthorRow& author) {
  const auto found = links_.find(joining.link);
  if (found == links_.end() || found->second.parting) return;
  Link& link = found->second;
  if (const auto over = end_of_invitation(link))
    return refuse(joining.link, link, *over, Parting::NotAllowed);
  const auto current = rooms_.find(design->name);
  if (current == rooms_.end() || current->second != design)  // closed meanwhile
    return ask_to_join(current == rooms_.end() ? open(design->name) : current->second, joining);
  link.design = design;
  design->links.insert(joining.link);
  link.author = author.author;
  const Hello& hello = joining.hello;
  design->room->join(
      joining.link,
      {author.author, author.last_number, hello.only_reads ? Role::View : joining.invitation.role, hello.name,
       hello.colour, hello.has_world, hello.have, hello.history, hello.first_pending},
      now_);
  note("join", link, hello.program);
  stir(design);
}

/// Nobody can work on the design here any more; those who come again have it opened anew.
void Hub::give_up(const OpenDesignPointer& design, const std::string& why, Parting code,
                  const std::string& holder) {
  const auto current = rooms_.find(design->name);
  if (current != rooms_.end() && current->second == design) rooms_.erase(current);
  counters_.rooms = rooms_.size();
  for (const Joining& joining : std::exchange(design->joining, {}))
    if (const auto link = links_.find(joining.link); link != links_.end() && !has_passed_on(joining, holder))
      refuse(joining.link, link->second, why, code);
  if (!design->room) return;
  design->room->end(why, code);
  stir(design);
}

/// Is the connection another server's from now on?
bool Hub::has_passed_on(const Joining& joining, const std::string& holder) {
  if (holder.empty() || !pass_on_) return false;
  std::string frame;
  add_to_frame(frame, to_bytes(ClientMessage(joining.hello)));
  const auto found = links_.find(joining.link);
  if (found->second.parting || !pass_on_(joining.link, holder, frame)) return false;
  note("passed on", found->second, holder);
  links_.erase(joining.link);
  stirred_.erase(joining.link);
  counters_.links = links_.size();
  return true;
}

void Hub::stir(const OpenDesignPointer& design) {
  if (design->is_stirred) return;
  design->is_stirred = true;
  stirred_designs_.push_back(design);
}

const Room* Hub::room(const std::string& design) const {
  const auto found = rooms_.find(design);
  return found == rooms_.end() ? nullptr : found->second->room.get();
}

std::set<LinkId> Hub::take_stirred() {
  for (const OpenDesignPointer& design : std::exchange(stirred_designs_, {})) {
    design->is_stirred = false;
    stirred_.insert(design->links.begin(), design->links.end());
  }
  return std::exchange(stirred_, {});
}

SharedBytes Hub::next_frame(LinkId id, std::int64_t now) {
  const auto found = links_.find(id);
  if (found == links_.end()) return nullptr;
  Link& link = found->second;
  SharedBytes frame;
  if (link.parting) {
    frame = std::exchange(link.last_frame, nullptr);
  } else if (link.design && link.design->room) {
    frame = link.design->room->next_frame(id, now);
  }
  if (frame) {
    ++counters_.frames;
    counters_.frame_bytes += frame->size();
  }
  return frame;
}

bool Hub::has_answer(LinkId id) const {
  const auto found = links_.find(id);
  return found != links_.end() && found->second.design && found->second.design->room &&
         found->second.design->room->has_answer(id);
}

std::optional<std::string> Hub::parting(LinkId id) const {
  const auto found = links_.find(id);
  if (found == links_.end()) return std::nullopt;
  const Link& link = found->second;
  if (link.parting) return link.last_frame ? std::nullopt : link.parting;
  return link.design && link.design->room ? link.design->room->parting(id) : std::nullopt;
}

// ---- the log

StorageWork Hub::next_work(bool may_append) {
  const bool may_work = !work_.empty() && work_.front().after_appends <= appends_;
  const bool appends = may_append && has_entries() && !(may_work && appended_last_);
  StorageWork work;
  if (appends) {
    work = append_work();
  } else if (may_work) {
    work = std::move(work_.front().work);
    work_.pop_front();
  } else {
    return nullptr;
  }
  appended_last_ = appends;
  work_runs_ = true;
  return [this, work = std::move(work)](OpLog& log) {
    return [this, then = work(log)] {
      work_runs_ = false;
      then();
    };
  };
}

bool Hub::has_entries() const {
  return std::ranges::any_of(
      rooms_, [](const auto& it) { return it.second->room && it.second->room->has_entries(); });
}

StorageWork Hub::append_work() {
  auto designs = std::make_shared<std::vector<OpenDesignPointer>>();
  auto batches = std::make_shared<std::vector<Append>>();
  for (const auto& [name, design] : rooms_) {
    if (!design->room || !design->room->has_entries()) continue;
    std::vector<LogEntry> entries = design->room->take_entries();
    designs->push_back(design);
    batches->push_back({name, entries.front().sequence - 1, design->fence, std::move(entries)});
  }
  return [this, designs, batches](OpLog& log) {
    auto errors = log.append(*batches);
    return [this, designs, batches, errors = std::move(errors)] { appended(*designs, *batches, errors); };
  };
}

void Hub::appended(const std::vector<OpenDesignPointer>& designs, const std::vector<Append>& batches,
                   const std::vector<std::optional<AppendError>>& errors) {
  ++appends_;
  ++counters_.commits;
  trouble_until_ = now_;
  for (std::size_t i = 0; i < designs.size(); ++i) {
    const OpenDesignPointer& design = designs[i];
    if (i < errors.size() && errors[i]) {
      ++counters_.failed_commits;
      const bool is_taken = errors[i]->problem == AppendProblem::Fenced;
      if (!is_taken) note_trouble(errors[i]->message);
      if (!is_taken && audit_) audit_({at_, "commit failed", {}, design->name, {}, {}, 0, trouble_});
      give_up(design,
              is_taken ? "Another server has taken this design over."
                       : "The server could not save the last edits: " + errors[i]->message,
              is_taken ? Parting::ServerStops : Parting::Other);
      continue;
    }
    counters_.committed_edits += batches[i].batch.size();
    for (const LogEntry& entry : batches[i].batch) design->logged_bytes += entry.edit.size();
    design->logged_edits += batches[i].batch.size();
    design->room->committed(batches[i].batch.back().sequence);
    stir(design);
    save_snapshot_if_due(design);
  }
}

void Hub::save_snapshot_if_due(const OpenDesignPointer& design) {
  const bool is_due =
      design->logged_bytes >= settings_.snapshot_bytes || design->logged_edits >= settings_.snapshot_edits;
  if (!is_due || design->is_saving) return;
  design->is_saving = true;
  const std::uint64_t sequence = design->room->sequence();
  const std::uint64_t wait_for = appends_ + (design->room->has_entries() ? 1 : 0);
  // The edits behind the snapshot before stay, for clients that come back.
  const std::uint64_t keep_after = design->snapshot_sequence;
  work_.push_back({[design, sequence, keep_after, world = design->room->world()](OpLog& log) {
                     const auto bytes = world_to_bytes(world);
                     const bool saved = bytes && log.save_snapshot(design->name, design->fence,
                                                                   {sequence, *bytes}, keep_after);
                     return [design, sequence, saved] {
                       design->is_saving = false;
                       design->logged_bytes = design->logged_edits = 0;
                       if (saved) design->snapshot_sequence = sequence;
                     };
                   },
                   wait_for});
}

// ---- time

void Hub::tick(std::int64_t now, std::int64_t at) {
  now_ = now;
  at_ = at;
  for (auto& [id, link] : links_)
    if (!link.is_checked && !link.parting && now > link.hello_until)
      refuse(id, link, "No hello came in time.", Parting::Broken);
  end_invitations();
  const auto designs = rooms_;
  for (const auto& [name, design] : designs) {
    if (!design->room) continue;
    design->room->tick(now);
    stir(design);
    keep_lease(design);
  }
  close_rooms();
  ask_for_revoked();
}

void Hub::end_invitations() {
  for (auto& [id, link] : links_) {
    if (!link.design || link.parting) continue;
    const auto over = end_of_invitation(link);
    if (!over) continue;
    note("revoked", link, *over);
    link.design->room->set_role(id, std::nullopt);
    stir(link.design);
  }
}

void Hub::keep_lease(const OpenDesignPointer& design) {
  if (now_ - design->lease_asked < settings_.design_lease / 3) return;
  design->lease_asked = now_;
  work_.push_back({[this, design](OpLog& log) {
    const auto lease = log.lease(design->name, settings_.holder, settings_.design_lease);
    // A log that fails for a while is no other server: appends are fenced, whatever happens.
    const auto row = lease ? base::Result<std::optional<DesignRow>>() : log.find(design->name);
    const bool is_anothers = !lease && row && *row && (*row)->holder != settings_.holder;
    const bool is_lost = lease ? lease->fence != design->fence : is_anothers;
    return [this, design, is_lost] {
      if (is_lost) give_up(design, "Another server has taken this design over.", Parting::ServerStops);
    };
  }});
}

bool Hub::is_over(const OpenDesign& design) const {
  if (!design.room || !design.room->is_idle() || design.is_saving) return false;
  return stops_ || now_ - design.idle_since > settings_.idle_time;
}

void Hub::close_rooms() {
  for (auto it = rooms_.begin(); it != rooms_.end();) {
    const OpenDesignPointer design = it->second;
    if (design->room && !design->room->is_idle()) design->idle_since = now_;
    if (!is_over(*design)) {
      ++it;
      continue;
    }
    work_.push_back({[this, name = design->name](OpLog& log) {
      (void)log.release(name, settings_.holder);  // it ends by itself where that fails
      return [] {};
    }});
    it = rooms_.erase(it);
  }
  counters_.rooms = rooms_.size();
}

void Hub::ask_for_revoked() {
  if (asks_for_revoked_ || now_ - asked_for_revoked_ < kRevokedGap) return;
  asks_for_revoked_ = true;
  asked_for_revoked_ = now_;
  work_.push_back({[this, known = revoked_version_](OpLog& log) {
    const auto version = log.revoked_version();
    const bool is_new = version && *version != known;
    const auto ids = is_new ? log.revoked() : base::Result<std::vector<std::string>>();
    return [this, is_new, version, ids] {
      asks_for_revoked_ = false;
      if (!is_new || !ids) return;
      revoked_version_ = *version;
      revoked_ = {ids->begin(), ids->end()};
      end_invitations();
    };
  }});
}

void Hub::stop(std::int64_t now) {
  now_ = now;
  stops_ = true;
  for (const auto& [name, design] : rooms_) {
    if (!design->room) continue;
    design->room->end("The server stops.", Parting::ServerStops);
    stir(design);
  }
  for (auto& [id, link] : links_)
    if (!link.design) refuse(id, link, "The server stops.", Parting::ServerStops);
}

}  // namespace icome::collab
