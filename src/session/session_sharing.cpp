#include "session/session_sharing.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "collab/client/joining.h"
#include "collab/order/items.h"
#include "collab/storage/design_state.h"
#include "interaction/object_move.h"
#include "session/session_parts.h"
#include "world/edit/shared_edit.h"

namespace icome::session {

using collab::ConversationState;
using world::ObjectId;

namespace {

constexpr std::chrono::milliseconds kMostLeaving{2'000};
constexpr std::int64_t kPresentEvery = 33'000'000;  // ns

/// "just now", "3 minutes ago" and so on; ms.
std::string ago(std::int64_t time) {
  constexpr std::int64_t kMinute = 60'000, kHour = 60 * kMinute, kDay = 24 * kHour;
  if (time < kMinute) return "just now";
  const auto [unit, name] = time < kHour  ? std::pair(kMinute, "minute")
                            : time < kDay ? std::pair(kHour, "hour")
                                          : std::pair(kDay, "day");
  const std::int64_t count = time / unit;
  return fmt::format("{} {}{} ago", count, name, count == 1 ? "" : "s");
}

/// The edit alone where there is but one.
world::Edit simplified(world::EditGroup group) {
  if (group.edits.size() == 1) return std::move(group.edits.front());
  return world::Edit(std::move(group));
}

/// Tells of what happened in a shared design.
class SharedNews {
 public:
  explicit SharedNews(SessionParts& parts) : parts_(parts), shared_(*parts.shared), talk_(shared_.talk()) {}

  void operator()(const collab::SeenEdit&) {}
  void operator()(const collab::SeenDurable&) {}
  void operator()(const collab::SeenState& it) {
    using Kind = SessionEvent::Kind;
    const std::string where = collab::shown_address(talk_.address());
    parts_.holds_are_new = true;
    if (it.state == ConversationState::Away) {
      parts_.keep_against_crashes(true);
      shared_.keep_copy();
      parts_.tell(Kind::ServerLost,
                  fmt::format("The connection to {} is lost: {} You can go on: what you do is sent when the "
                              "server is back.",
                              where, it.why));
    } else if (it.state == ConversationState::Live) {
      shared_.note_who_left();
      parts_.tell(Kind::ServerBack, fmt::format("The connection to {} is back.", where));
      if (const std::size_t count = talk_.conflicts().size(); count > 0) parts_.tell_of_conflicts(count);
    } else if (!it.why.empty() && it.state == ConversationState::Joining) {
      parts_.tell(Kind::Notice, it.why);
    }
  }
  void operator()(const collab::Dropped& it) {
    parts_.revisions.performed();  // drags end
    shared_.goes_on = false;
    parts_.tell(SessionEvent::Kind::Dropped, fmt::format("\"{}\" did not come to be: {}", it.name, it.why));
  }
  void operator()(const collab::Selected& it) {
    parts_.holds_are_new = true;
    if (it.waits)
      parts_.tell(SessionEvent::Kind::Floor,
                  it.why + " You get it as soon as it is given back and nobody waits before you.");
    else if (it.granted && shared_.take_waited(it.item))
      parts_.tell(SessionEvent::Kind::Floor,
                  fmt::format("You have {} now.", collab::called(talk_.replica().world(), it.item)));
  }
  void operator()(const collab::FloorChanged& it) {
    parts_.holds_are_new = true;
    const bool is_taken = it.taken_by != 0 && it.taken_by != talk_.replica().author();
    const bool is_lost = is_taken && shared_.lose(it.item);
    if (it.holder == 0) shared_.ask_again(it.item);
    if (!is_lost) return;
    parts_.revisions.performed();  // drags end
    shared_.goes_on = false;
    parts_.tell(SessionEvent::Kind::Floor,
                fmt::format("{} took {} away from you.", talk_.name_of(it.taken_by),
                            collab::called(talk_.replica().world(), it.item)));
  }
  void operator()(const collab::Person& it) {
    parts_.holds_are_new = true;
    shared_.note_person(it);
  }
  void operator()(const collab::Said& it) {
    shared_.add_line({0, it.author, talk_.name_of(it.author), it.text, true});
  }

 private:
  SessionParts& parts_;
  SharedDesign& shared_;
  collab::Conversation& talk_;
};

}  // namespace

// ---- joining and leaving

bool SessionSharing::is_address(const std::string& text) { return collab::is_design_address(text); }

base::Result<std::string> SessionSharing::shown(const std::string& text) {
  const auto address = collab::design_address(text);
  if (!address) return tl::unexpected(address.error());
  return collab::shown_address(*address);
}

const std::vector<std::string>& SessionSharing::recent() const { return parts_.addresses.links(); }

void SessionSharing::forget(const std::string& address) { parts_.addresses.remove(address); }

void SessionSharing::open(const std::string& text, const std::string& name) {
  const auto address = collab::address_to_join(text);
  if (!address) {
    parts_.tell(SessionEvent::Kind::OpenFailed, address.error().message);
    return;
  }
  parts_.recovering.reset();
  parts_.joining = std::make_shared<JoinedDesign>();
  parts_.loader.start(collab::shown_address(*address),
                      [address = *address, name, kept = parts_.settings.kept_folder,
                       joined = parts_.joining](const files::DesignReadOptions& options) {
                        return join_design(address, name, kept, *joined, options);
                      });
}

void SessionParts::begin_sharing(JoinedDesign joined) {
  shared = std::make_unique<SharedDesign>(std::move(joined.connection));
  shared->kept = std::move(joined.kept);
  const bool is_away = !joined.why_away.empty();
  collab::Conversation& talk = shared->talk();
  const collab::Replica& replica = talk.replica();
  ids = world::IdSource(replica.author(), replica.first_free_number());
  keep_against_crashes(is_away);
  SharedNews news(*this);
  for (const collab::Seen& it : talk.take_seen()) {
    const auto* const person = std::get_if<collab::Person>(&it);
    const auto* const state = std::get_if<collab::SeenState>(&it);
    const bool is_note = state != nullptr && state->state == ConversationState::Joining;
    if (is_note || std::holds_alternative<collab::Dropped>(it) || (person != nullptr && person->here))
      std::visit(news, it);
  }
  if (!joined.damage.empty()) {
    tell(SessionEvent::Kind::Notice, joined.damage);
    shared->keep_copy();
  }
  if (is_away)
    tell(SessionEvent::Kind::ServerLost,
         fmt::format("{} This is the copy that was kept here {}. You can go on: what you do is sent when the "
                     "server is back.",
                     joined.why_away, ago(collab::wall_milliseconds() - joined.kept_at)));
  if (const auto conflicts = talk.conflicts().size(); conflicts > 0) tell_of_conflicts(conflicts);
  addresses.add(collab::link_text(talk.address()));
  holds_are_new = true;
}

/// The server lets one in no more: what was kept becomes a design of one's own.
void SessionParts::take_kept_copy(const JoinedDesign& joined) {
  saved_revision = 0;  // it is in no file
  tell(SessionEvent::Kind::SharingEnds,
       joined.why_away + " This is the copy that was kept here: save it to keep it.");
}

void SessionParts::tell_of_conflicts(std::size_t count) {
  tell(SessionEvent::Kind::Conflicts,
       count == 1 ? "One thing was changed both by you and by others while there was no connection."
                  : fmt::format("{} things were changed both by you and by others while there was no "
                                "connection.",
                                count));
}

/// Says goodbye on a thread of its own.
void SessionParts::leave_shared() {
  if (!shared) return;
  const std::unique_ptr<SharedDesign> left = std::move(shared);
  left->talk().replica().on_change(nullptr);
  followed.reset();
  holds_are_new = true;
  std::shared_ptr<collab::Connection> connection = left->release();
  leaving.push_back(std::make_unique<BackgroundTask<bool>>([connection,
                                                            kept = left->kept]() -> base::Result<bool> {
    const auto until = base::steady_nanoseconds() + std::chrono::nanoseconds(kMostLeaving).count();
    connection->talk().leave();
    auto done = connection->work_until([&] { return connection->talk().state() != ConversationState::Live; },
                                       [&] { return base::steady_nanoseconds() > until; }, kMostLeaving);
    // The next program sends what this one could not.
    if (kept)
      if (const auto written = write_copy(*kept, connection->talk().keep()); !written)
        return tl::unexpected(written.error());
    return done;
  }));
}

void SessionParts::close_left() {
  std::erase_if(leaving, [](const auto& it) { return it->is_done(); });
}

// ---- what others and oneself do

/// While there is no server, the journal keeps the design with all that is done to it.
void SessionParts::keep_against_crashes(bool keeps) {
  if (std::exchange(shared->is_journalled, keeps) == keeps) return;
  Edited edited;
  edited.saved = std::make_shared<const SavedWork>(
      SavedWork{.number = queue.posted() + 1, .in_part = keeps, .by_server = !keeps});
  queue.post(std::move(edited));
}

/// Takes in what came from the server, and sends what is to be said.
void SessionParts::take_shared() {
  close_left();
  if (!shared) return;
  shared->work();
  if (const auto kept = shared->keep_copy_if_due(); !kept)
    tell(SessionEvent::Kind::Notice, "The design cannot be kept for offline work: " + kept.error().message);
  mirror(false);
  SharedNews news(*this);
  for (const collab::Seen& it : shared->talk().take_seen()) std::visit(news, it);
  collab::Conversation& talk = shared->talk();
  const std::uint32_t author = talk.replica().author();
  if (author != ids.author()) ids = world::IdSource(author, talk.replica().first_free_number());
  if (talk.state() == ConversationState::Ended) {
    tell(SessionEvent::Kind::SharingEnds,
         fmt::format("{}: {} The design stays open here: save it to keep it.",
                     collab::shown_address(talk.address()), talk.why_ended()));
    open_world(world::World(world), {});
    saved_revision = 0;  // it is in no file
    return;
  }
  if (talk.state() == ConversationState::Live && talk.replica().unacknowledged() == 0)
    keep_against_crashes(false);
  present();
}

/// Leads the session's world along with the replica's, and keeps what is tried out on top of it.
void SessionParts::mirror(bool own) {
  SharedDesign::Way way = shared->take_way();
  if (way.is_another) return take_another_world();
  if (way.edits.empty()) return;
  world::EditGroup group;
  const bool trying = history.trying();
  if (trying) {
    if (!take_back()) return take_another_world();
    group.edits.push_back(*std::exchange(performed, std::nullopt)->for_replicas);
  }
  for (world::Edit& edit : way.edits) {
    if (!world::apply(world, edit)) return take_another_world();
    group.edits.push_back(std::move(edit));
  }
  if (trying) {
    const auto tried = history.try_out(sink(), shared->tried->edit, shared->tried->name);
    if (tried) {
      revisions.tried();
      group.edits.push_back(*std::exchange(performed, std::nullopt)->for_replicas);
    } else {
      tell(SessionEvent::Kind::Notice, fmt::format("\"{}\" was given up, as the design has changed: {}",
                                                   shared->tried->name, tried.error().message));
      shared->tried.reset();
    }
  }
  post_mirrored(std::move(group), own);
}

void SessionParts::post_mirrored(world::EditGroup group, bool own) {
  Edited edited;
  edited.edit = edited.for_replicas = std::make_shared<const world::Edit>(simplified(std::move(group)));
  const std::shared_ptr<const world::Edit> edit = edited.edit;
  queue.post(std::move(edited));
  const world::Changes changes = world::changes_of(*edit);
  follows_others = !own;
  tell_change(&changes);
  follows_others = false;
}

/// The design came anew from the server.
void SessionParts::take_another_world() {
  (void)shared->take_way();
  world = shared->talk().replica().world();
  history = {};
  shared->tried.reset();
  shared->goes_on = false;
  revisions.performed();
  Edited edited;
  edited.whole = std::make_shared<const world::World>(world);
  edited.saved =
      std::make_shared<const SavedWork>(SavedWork{.number = queue.posted() + 1, .by_server = true});
  queue.post(std::move(edited));
  marked_part.reset();
  outline_is_new = look_is_new = true;
  if (const world::SceneId scene = std::exchange(shown_scene, {}); world.find(scene)) show(scene);
  follows_others = true;
  tell_change(nullptr);
  follows_others = false;
}

base::Result<void> SessionParts::perform_for_all(const world::Edit& edit, const std::string& name,
                                                 bool goes_on) {
  if (!queue.has_room())
    return base::fail("The program is too far behind with your edits: wait a moment, then do it again.");
  if (const auto kept = submit_tried(); !kept) return kept;
  const auto number = shared->talk().perform(edit, name, goes_on);
  if (!number) return tl::unexpected(number.error());
  // Who changes a shape or a material has it alone, until something else is selected.
  for (const collab::Item item : collab::needs_of(edit).items)
    if (item.kind != collab::ItemKind::Object) shared->hold_for_action(item);
  shared->goes_on = true;
  revisions.performed();
  mirror(true);
  return {};
}

/// Undoes or redoes the last own action.
base::Result<void> SessionParts::turn_for_all(bool back) {
  if (const auto kept = submit_tried(); !kept) return kept;
  const auto number = back ? shared->talk().undo() : shared->talk().redo();
  if (!number) return tl::unexpected(number.error());
  shared->goes_on = false;
  revisions.performed();
  mirror(true);
  return {};
}

/// Makes what is tried out an action for all.
base::Result<void> SessionParts::submit_tried() {
  if (!history.trying()) return {};
  const SharedDesign::Tried tried = *std::exchange(shared->tried, std::nullopt);
  if (const auto taken = take_back(); !taken) return taken;
  world::EditGroup group{{*std::exchange(performed, std::nullopt)->for_replicas}};
  history = {};
  const auto number = shared->talk().perform(tried.edit, tried.name);
  for (world::Edit& edit : shared->take_way().edits)
    if (world::apply(world, edit)) group.edits.push_back(std::move(edit));
  shared->goes_on = number.has_value();
  post_mirrored(std::move(group), true);
  if (!number) return tl::unexpected(number.error());
  return {};
}

// ---- the floor

void SessionParts::hold_selection() {
  if (shared) shared->hold(interaction::topmost(world, selection));
}

std::optional<SessionSharing::Holder> SessionSharing::holder_of(ObjectId object) const {
  if (!parts_.shared) return std::nullopt;
  const collab::Conversation& talk = parts_.shared->talk();
  const auto hold = collab::hold_over(talk.holds(), parts_.world, talk.replica().author(), object);
  if (!hold) return std::nullopt;
  const auto person = talk.people().find(hold->holder);
  const collab::Person known = person == talk.people().end() ? collab::Person{hold->holder} : person->second;
  return Holder{hold->holder, talk.name_of(hold->holder), known.colour, ObjectId{hold->item.id}};
}

void SessionSharing::wait_for(ObjectId object) {
  if (parts_.shared) parts_.shared->wait_for(object);
}

base::Result<void> SessionSharing::take_away(ObjectId object) {
  if (!parts_.shared) return {};
  if (parts_.shared->talk().role() < collab::Role::Own)
    return base::fail("Only who has a link with the role own may take things away.");
  parts_.shared->talk().take_away(collab::item_of(object));
  return {};
}

// ---- work without a connection

std::vector<SessionSharing::Conflict> SessionSharing::conflicts() const {
  std::vector<Conflict> result;
  if (!parts_.shared) return result;
  const collab::Conversation& talk = parts_.shared->talk();
  for (const collab::Conflict& it : talk.conflicts()) {
    const bool is_object = it.item.kind == collab::ItemKind::Object;
    result.push_back({it.name, is_object ? ObjectId{it.item.id} : ObjectId{}, it.is_gone,
                      it.whose == 0 ? std::string() : talk.name_of(it.whose)});
  }
  return result;
}

base::Result<void> SessionSharing::resolve(const std::vector<collab::Choice>& choices) {
  if (!parts_.shared || choices.size() != parts_.shared->talk().conflicts().size())
    return base::fail("These are choices for conflicts that are over.");
  if (const auto kept = parts_.submit_tried(); !kept) return kept;
  const auto resolved = parts_.shared->talk().resolve(choices, parts_.ids);
  parts_.shared->goes_on = false;
  parts_.revisions.performed();
  parts_.mirror(true);
  return resolved;
}

// ---- kept for offline work

bool SessionSharing::is_kept() const { return parts_.shared && parts_.shared->kept; }

void SessionSharing::keep(bool keeps) {
  if (!parts_.shared || keeps == is_kept()) return;
  const auto note = [this](const std::string& text) { parts_.tell(SessionEvent::Kind::Notice, text); };
  const collab::Conversation& talk = parts_.shared->talk();
  if (!keeps && talk.replica().unacknowledged() > 0)
    return note("The server has not got all of your edits yet, so the copy is kept until it has.");
  if (!keeps) {
    parts_.shared->forget_copy();
    return note("This design is not kept on this machine any more.");
  }
  if (parts_.settings.kept_folder.empty()) return note("There is no folder to keep designs in.");
  auto kept = collab::KeptDesign::make(parts_.settings.kept_folder, talk.address());
  if (!kept) return note(kept.error().message);
  parts_.shared->kept = std::make_shared<const collab::KeptDesign>(std::move(*kept));
  parts_.shared->keep_copy();
  note("This design is kept on this machine now, and opens without its server, too.");
}

// ---- people

std::optional<SessionSharing::State> SessionSharing::state() const {
  if (!parts_.shared) return std::nullopt;
  const collab::Conversation& talk = parts_.shared->talk();
  return State{talk.state(),
               talk.role(),
               collab::shown_address(talk.address()),
               talk.address().design,
               talk.delay(),
               talk.replica().unacknowledged(),
               parts_.shared->last_why(),
               talk.silence()};
}

std::vector<SessionSharing::Colleague> SessionSharing::people() const {
  std::vector<Colleague> result;
  if (!parts_.shared) return result;
  const collab::Conversation& talk = parts_.shared->talk();
  for (const auto& [author, person] : talk.people()) {
    if (!person.here) continue;
    Colleague it{author, person.name, person.colour, person.role, author == talk.replica().author(),
                 {},     false};
    for (const auto& [item, hold] : talk.holds())
      if (hold.holder == author && item.kind == collab::ItemKind::Object)
        it.holds.push_back(ObjectId{item.id});
    const auto sighting = talk.sightings().find(author);
    it.has_view = sighting != talk.sightings().end() && sighting->second.where.view.has_value();
    result.push_back(std::move(it));
  }
  std::ranges::stable_partition(result, &Colleague::is_me);
  return result;
}

base::Result<void> SessionSharing::say(const std::string& text) {
  if (!parts_.shared || text.empty()) return {};
  return parts_.shared->talk().say(text);
}

const std::deque<SharedLine>& SessionSharing::lines() const {
  static const std::deque<SharedLine> kNone;
  return parts_.shared ? parts_.shared->lines() : kNone;
}

const world::World& SessionSharing::design() const {
  return parts_.shared ? parts_.shared->talk().replica().world() : parts_.world;
}

void SessionSharing::follow(std::optional<std::uint32_t> author) { parts_.followed = author; }

std::optional<std::uint32_t> SessionSharing::followed() const { return parts_.followed; }

namespace {

collab::SharedPose shared_pose(const base::Pose& pose) {
  return {pose.translation(), base::Quaternion(pose.linear())};
}

bool same(const std::optional<collab::SharedPose>& a, const std::optional<collab::SharedPose>& b) {
  if (a.has_value() != b.has_value()) return false;
  return !a || (a->position == b->position && a->turn.coeffs() == b->turn.coeffs());
}

}  // namespace

/// Tells the others where one's pointer is and where one looks, some 30 times a second while that changes.
void SessionParts::present() {
  const std::int64_t now = base::steady_nanoseconds();
  if (shared->talk().state() != ConversationState::Live || now - presented_at < kPresentEvery) return;
  collab::Whereabouts where;
  const bool is_aside = is_mouse(0) && !hand_is_aimed;
  if (hands.pointers() > 0 && !is_aside) {
    const PointerView& hand = hands.view(0);
    if (hand.time != 0 && hand.status != devices::DeviceStatus::Lost && hand.tip.allFinite())
      where.pointer = collab::SharedPose{hand.scp, base::Quaternion::Identity()};
  }
  where.view = shared_pose(user.view().world_from_eye);
  if (user.drawn_view().world_from_eye.matrix() != user.view().world_from_eye.matrix())
    where.head = shared_pose(user.drawn_view().world_from_eye);
  if (same(where.pointer, presented.pointer) && same(where.view, presented.view) &&
      same(where.head, presented.head))
    return;
  presented_at = now;
  presented = where;
  shared->talk().present(where);
}

/// Looks from where the followed person looks.
void SessionParts::follow_person() {
  if (!followed || !shared) return;
  const auto found = places.now().find(*followed);
  if (found == places.now().end() || !found->second.view) return;
  interaction::View view = user.view();
  view.world_from_eye.linear() = found->second.view->turn.toRotationMatrix();
  view.world_from_eye.translation() = found->second.view->position;
  if (view.world_from_eye.matrix() != user.view().world_from_eye.matrix()) user.set_view(view);
}

/// Renews what is seen of others: their pointers, eyes and names, and the lines around what they hold.
void SessionParts::renew_people() {
  if (!shared) {
    if (people.empty() && held_outlines.empty()) return;
    people.clear();
    held_outlines.clear();
    look_is_new = true;
    return;
  }
  const collab::Conversation& talk = shared->talk();
  if (std::exchange(holds_are_new, false) || outline_is_new) {
    held_outlines.clear();
    for (const auto& [item, hold] : talk.holds()) {
      if (hold.holder == talk.replica().author() || item.kind != collab::ItemKind::Object) continue;
      if (!world.find(ObjectId{item.id})) continue;  // deleted here, without a connection
      const auto person = talk.people().find(hold.holder);
      const collab::Person known =
          person == talk.people().end() ? collab::Person{hold.holder} : person->second;
      held_outlines.push_back({world::subtree(world, ObjectId{item.id}), colour_of(known.colour)});
    }
    look_is_new = true;
  }
  if (!places.update(talk, session_seconds()) && people.size() == places.now().size()) return;
  people.clear();
  for (const auto& [author, where] : places.now()) {
    const auto person = talk.people().find(author);
    if (person == talk.people().end() || !person->second.here) continue;
    const auto sign = look.name_signs.find(author);
    people.push_back({colour_of(person->second.colour),
                      sign == look.name_signs.end() ? nullptr : sign->second, where, followed != author});
  }
  look_is_new = true;
}

}  // namespace icome::session
