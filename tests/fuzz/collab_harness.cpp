// What the server and the clients of a design say to each other, as a hostile side would.
#include "collab/client/conversation.h"
#include "collab/protocol/message_bytes.h"
#include "collab/server/room.h"
#include "fuzz/harness.h"
#include "world/edit/edit_bytes.h"

namespace icome::fuzz {
namespace {

using namespace collab;

/// A member of a room who says anything at all.
void run_room(std::string_view bytes) {
  const world::GeometryFactory factory;
  RoomSettings settings;
  settings.most_edit_bytes = settings.most_parts_bytes = 1U << 20U;
  auto room = Room::open({.design = "fuzz", .fence = 1}, settings, factory);
  require(room.has_value(), "an empty design opens");
  (*room)->join(1, {.author = 1, .role = Role::Own, .name = "Eve"}, 0);
  (*room)->join(2, {.author = 2, .role = Role::Edit, .name = "Ann"}, 0);
  std::int64_t now = 0;
  while (!bytes.empty()) {
    const auto next = next_in_frame(bytes);
    if (!next) return require_told(next.error());
    auto message = client_message(*next);
    if (!message) {
      require_told(message.error());
      continue;
    }
    ++now;
    (*room)->receive(1, std::move(*message), now, now);
    for (const LinkId link : {LinkId{1}, LinkId{2}})
      while ((*room)->next_frame(link, now)) {
      }
    require(!(*room)->parting(2), "nobody else is sent away");
  }
  (*room)->committed((*room)->sequence());
  (*room)->tick(now + 100'000);
}

/// A server that says anything at all.
void run_conversation(std::string_view bytes) {
  Conversation talk({"host", 1, "fuzz", "", ""}, {.key = "key", .name = "Ann"});
  talk.opened(0);
  talk.received(bytes, 1);
  while (talk.next_frame(2)) {
  }
  (void)talk.take_seen();
  talk.closed("over", 3);
}

template <typename... Messages>
std::string frame_of_all(const Messages&... messages) {
  std::string frame;
  (add_to_frame(frame, to_bytes(messages)), ...);
  return frame;
}

std::string box_bytes() {
  world::IdSource ids(1);
  return world::to_bytes(world::CreateObject{ids.next<world::ObjectId>(), 0, {.name = "box"}}).value();
}

std::vector<std::string> room_seeds() {
  const Item box{ItemKind::Object, (std::uint64_t{1} << world::IdSource::kNumberBits) | 1};
  return {frame_of_all(ClientMessage(Loaded{0}), ClientMessage(Submit{1, 0, {}, box_bytes(), 0}),
                       ClientMessage(Select{box, true}), ClientMessage(TakeAway{box}),
                       ClientMessage(Deselect{box}), ClientMessage(Say{"hello"}), ClientMessage(Alive{1}),
                       ClientMessage(Present{}), ClientMessage(Fetch{std::string(32, 'h'), 0, 100}),
                       ClientMessage(Bye{}))};
}

std::vector<std::string> conversation_seeds() {
  return {frame_of_all(ServerMessage(Welcome{.author = 1, .role = Role::Own, .sequence = 1, .loads = true}),
                       ServerMessage(Ordered{1, 1, 2, 1, box_bytes(), true}), ServerMessage(Durable{1}),
                       ServerMessage(People{{{2, "Ann", 1, Role::Edit, true}}}),
                       ServerMessage(Said{2, "text"}), ServerMessage(Goodbye{"bye", Parting::Other}))};
}

constexpr Harness kCollabHarnesses[] = {
    {"room", run_room, room_seeds},
    {"conversation", run_conversation, conversation_seeds},
};

}  // namespace

std::span<const Harness> collab_harnesses() { return kCollabHarnesses; }

}  // namespace icome::fuzz
