#include "collab/protocol/message_bytes.h"

#include <flatbuffers/flatbuffers.h>
#include <message_generated.h>

#include <cstring>

#include "world/edit/flat_bytes.h"

namespace icome::collab {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

constexpr std::size_t kFrameHeader = 8;  // length of the message (u32, little-endian), four zeros
constexpr std::size_t kFrameStep = 8;    // messages take a multiple of these

flat::Item flat_item(Item item) { return {std::uint8_t(item.kind), item.id}; }

std::optional<flat::Pose> flat_pose(const std::optional<SharedPose>& pose) {
  if (!pose) return std::nullopt;
  return flat::Pose(flatbuffers::span<const double, 3>(pose->position.data(), 3),
                    flatbuffers::span<const double, 4>(pose->turn.coeffs().data(), 4));
}

template <typename Struct>
const Struct* or_null(const std::optional<Struct>& value) {
  return value ? &*value : nullptr;
}

/// A message's content that was written: its kind and offset.
struct WrittenContent {
  flat::Content kind;
  Offset<void> table;
};

template <typename Table>
WrittenContent as_content(Offset<Table> table) {
  return {flat::ContentTraits<Table>::enum_value, table.Union()};
}

/// Writes messages, each kind by its own function.
class MessageWriter {
 public:
  template <typename Message>
  std::string write(const Message& message) {
    const WrittenContent content = std::visit(*this, message);
    flat::FinishMessageBuffer(builder_, flat::CreateMessage(builder_, content.kind, content.table));
    return {reinterpret_cast<const char*>(builder_.GetBufferPointer()), builder_.GetSize()};
  }

  WrittenContent operator()(const Hello& it) {
    const auto token = text(it.token), design = text(it.design), key = text(it.client_key),
               name = text(it.name), program = text(it.program);
    return as_content(flat::CreateHello(builder_, it.least_version, it.most_version, token, design, key, name,
                                        it.colour, program, it.has_world, it.have, it.history,
                                        it.first_pending, it.only_reads));
  }
  WrittenContent operator()(const Fetch& it) {
    return as_content(flat::CreateFetch(builder_, bytes(it.hash), it.offset, it.bytes));
  }
  WrittenContent operator()(const Loaded& it) {
    return as_content(flat::CreateLoaded(builder_, it.snapshot));
  }
  WrittenContent operator()(const Submit& it) {
    const auto fences = builder_.CreateVector(it.fences);
    const auto edit = bytes(it.edit);
    return as_content(
        flat::CreateSubmit(builder_, it.number, it.base, fences, edit, it.total, it.takes_back));
  }
  WrittenContent operator()(const Select& it) {
    const flat::Item item = flat_item(it.item);
    return as_content(flat::CreateSelect(builder_, &item, it.waits));
  }
  WrittenContent operator()(const Deselect& it) {
    const flat::Item item = flat_item(it.item);
    return as_content(flat::CreateDeselect(builder_, &item));
  }
  WrittenContent operator()(const TakeAway& it) {
    const flat::Item item = flat_item(it.item);
    return as_content(flat::CreateTakeAway(builder_, &item));
  }
  WrittenContent operator()(const Present& it) {
    const auto pointer = flat_pose(it.where.pointer), view = flat_pose(it.where.view),
               head = flat_pose(it.where.head);
    return as_content(flat::CreatePresent(builder_, or_null(pointer), or_null(view), or_null(head)));
  }
  WrittenContent operator()(const Say& it) { return as_content(flat::CreateSay(builder_, text(it.text))); }
  WrittenContent operator()(const Alive& it) { return as_content(flat::CreateAlive(builder_, it.echo)); }
  WrittenContent operator()(const Bye&) { return as_content(flat::CreateBye(builder_)); }

  WrittenContent operator()(const Welcome& it) {
    const auto accepted = builder_.CreateVector(it.accepted);
    const auto hash = bytes(it.snapshot_hash);
    return as_content(flat::CreateWelcome(builder_, it.version, it.author, it.last_number,
                                          std::uint8_t(it.role), it.sequence, it.durable, it.loads,
                                          it.snapshot, it.snapshot_bytes, it.lease, it.history, accepted,
                                          it.accepted_from, it.content_bytes, hash));
  }
  WrittenContent operator()(const Refused& it) {
    return as_content(flat::CreateRefused(builder_, text(it.why), std::uint8_t(it.code)));
  }
  WrittenContent operator()(const Piece& it) {
    const auto hash = bytes(it.hash);
    return as_content(flat::CreatePiece(builder_, hash, it.offset, bytes(it.bytes)));
  }
  WrittenContent operator()(const Ordered& it) {
    const auto edit = bytes(it.edit);
    if (it.creates)
      return as_content(flat::CreateCreate(builder_, it.last, it.author, it.number, edit, it.is_outline));
    return as_content(
        flat::CreateEdited(builder_, it.first, it.last, it.author, it.number, edit, it.is_outline));
  }
  WrittenContent operator()(const Accepted& it) {
    return as_content(flat::CreateAccepted(builder_, it.number, it.sequence));
  }
  WrittenContent operator()(const Rejected& it) {
    return as_content(flat::CreateRejected(builder_, it.number, text(it.why), it.whose));
  }
  WrittenContent operator()(const Durable& it) {
    return as_content(flat::CreateDurable(builder_, it.sequence));
  }
  WrittenContent operator()(const Selected& it) {
    const auto why = text(it.why);
    const flat::Item item = flat_item(it.item), obstacle = flat_item(it.obstacle);
    return as_content(
        flat::CreateSelected(builder_, &item, it.granted, it.fence, it.by, &obstacle, why, it.waits));
  }
  WrittenContent operator()(const FloorChanged& it) {
    const flat::Item item = flat_item(it.item);
    return as_content(flat::CreateFloorChanged(builder_, &item, it.holder, it.fence, it.taken_by));
  }
  WrittenContent operator()(const FloorState& it) {
    std::vector<flat::Hold> holds;
    holds.reserve(it.holds.size());
    for (const FloorChanged& hold : it.holds)
      holds.emplace_back(flat_item(hold.item), hold.holder, hold.fence);
    return as_content(flat::CreateFloor(builder_, builder_.CreateVectorOfStructs(holds)));
  }
  WrittenContent operator()(const People& it) {
    std::vector<Offset<flat::Person>> people;
    people.reserve(it.people.size());
    for (const Person& person : it.people)
      people.push_back(flat::CreatePerson(builder_, person.author, text(person.name), person.colour,
                                          std::uint8_t(person.role), person.here));
    return as_content(flat::CreatePeople(builder_, builder_.CreateVector(people)));
  }
  WrittenContent operator()(const Presence& it) {
    const auto pointer = flat_pose(it.where.pointer), view = flat_pose(it.where.view),
               head = flat_pose(it.where.head);
    return as_content(
        flat::CreatePresence(builder_, it.author, or_null(pointer), or_null(view), or_null(head)));
  }
  WrittenContent operator()(const Said& it) {
    return as_content(flat::CreateSaid(builder_, it.author, text(it.text)));
  }
  WrittenContent operator()(const Living& it) { return as_content(flat::CreateLiving(builder_, it.echo)); }
  WrittenContent operator()(const Goodbye& it) {
    return as_content(flat::CreateGoodbye(builder_, text(it.why), std::uint8_t(it.code)));
  }

 private:
  Offset<flatbuffers::String> text(const std::string& text) { return builder_.CreateString(text); }
  Offset<flatbuffers::Vector<std::uint8_t>> bytes(const std::string& bytes) {
    // Aligned as an edit wants it, so that it can be read where it lies.
    builder_.ForceVectorAlignment(bytes.size(), 1, 8);
    return builder_.CreateVector(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }

  FlatBufferBuilder builder_{256};
};

/// Reads messages that are verified to lie within their bytes.
class MessageReader {
 public:
  explicit MessageReader(world::FlatReader& reader) : reader_(reader) {}

  ClientMessage operator()(const flat::Hello& it) {
    return Hello{it.least_version(),    it.most_version(), text(it.token()), text(it.design()),
                 text(it.client_key()), text(it.name()),   it.colour(),      text(it.program()),
                 it.has_world(),        it.have(),         it.history(),     it.first_pending(),
                 it.only_reads()};
  }
  ClientMessage operator()(const flat::Fetch& it) { return Fetch{bytes(it.hash()), it.offset(), it.bytes()}; }
  ClientMessage operator()(const flat::Loaded& it) { return Loaded{it.snapshot()}; }
  ClientMessage operator()(const flat::Submit& it) {
    return Submit{it.number(),      it.base(),  reader_.items<std::uint64_t>(it.fences()),
                  bytes(it.edit()), it.total(), it.takes_back()};
  }
  ClientMessage operator()(const flat::Select& it) { return Select{item(it.item()), it.waits()}; }
  ClientMessage operator()(const flat::Deselect& it) { return Deselect{item(it.item())}; }
  ClientMessage operator()(const flat::TakeAway& it) { return TakeAway{item(it.item())}; }
  ClientMessage operator()(const flat::Present& it) { return Present{whereabouts(it)}; }
  ClientMessage operator()(const flat::Say& it) { return Say{text(it.text())}; }
  ClientMessage operator()(const flat::Alive& it) { return Alive{it.echo()}; }
  ClientMessage operator()(const flat::Bye&) { return Bye{}; }

  ServerMessage operator()(const flat::Welcome& it) {
    return Welcome{it.version(),       it.author(),        it.last_number(),
                   role(it.role()),    it.sequence(),      it.durable(),
                   it.loads(),         it.snapshot(),      it.snapshot_bytes(),
                   it.lease(),         it.history(),       reader_.items<std::uint64_t>(it.accepted()),
                   it.accepted_from(), it.content_bytes(), bytes(it.snapshot_hash())};
  }
  ServerMessage operator()(const flat::Refused& it) { return Refused{text(it.why()), parting(it.code())}; }
  ServerMessage operator()(const flat::Piece& it) {
    return Piece{bytes(it.hash()), it.offset(), bytes(it.bytes())};
  }
  ServerMessage operator()(const flat::Create& it) {
    return Ordered{it.sequence(),    it.sequence(), it.author(),    it.number(),
                   bytes(it.edit()), true,          it.is_outline()};
  }
  ServerMessage operator()(const flat::Edited& it) {
    return Ordered{it.first(), it.last(), it.author(), it.number(), bytes(it.edit()), false, it.is_outline()};
  }
  ServerMessage operator()(const flat::Accepted& it) { return Accepted{it.number(), it.sequence()}; }
  ServerMessage operator()(const flat::Rejected& it) {
    return Rejected{it.number(), text(it.why()), it.whose()};
  }
  ServerMessage operator()(const flat::Durable& it) { return Durable{it.sequence()}; }
  ServerMessage operator()(const flat::Selected& it) {
    return Selected{item(it.item()),     it.granted(),   it.fence(), it.by(),
                    item(it.obstacle()), text(it.why()), it.waits()};
  }
  ServerMessage operator()(const flat::FloorChanged& it) {
    return FloorChanged{item(it.item()), it.holder(), it.fence(), it.taken_by()};
  }
  ServerMessage operator()(const flat::Floor& it) {
    FloorState state;
    if (it.holds() == nullptr) return state;
    for (const flat::Hold* hold : *it.holds())
      state.holds.push_back({item(&hold->item()), hold->holder(), hold->fence(), 0});
    return state;
  }
  ServerMessage operator()(const flat::People& it) {
    People people;
    if (it.people() == nullptr) return people;
    for (const flat::Person* person : *it.people())
      people.people.push_back(
          {person->author(), text(person->name()), person->colour(), role(person->role()), person->here()});
    return people;
  }
  ServerMessage operator()(const flat::Presence& it) { return Presence{it.author(), whereabouts(it)}; }
  ServerMessage operator()(const flat::Said& it) { return Said{it.author(), text(it.text())}; }
  ServerMessage operator()(const flat::Living& it) { return Living{it.echo()}; }
  ServerMessage operator()(const flat::Goodbye& it) { return Goodbye{text(it.why()), parting(it.code())}; }

 private:
  std::string text(const flatbuffers::String* text) { return reader_.text(text); }
  std::string bytes(const flatbuffers::Vector<std::uint8_t>* bytes) {
    return bytes == nullptr ? std::string() : std::string(reader_.view(*bytes));
  }
  Item item(const flat::Item* from) {
    if (from == nullptr) return {};
    if (from->kind() > std::uint8_t(ItemKind::Scene))
      reader_.refuse("The message names a thing of an unknown kind.");
    return {ItemKind(from->kind()), from->id()};
  }
  Role role(std::uint8_t from) {
    if (from > std::uint8_t(Role::Own)) reader_.refuse("The message names an unknown role.");
    return Role(from);
  }
  static Parting parting(std::uint8_t from) {
    return from > std::uint8_t(Parting::TooSlow) ? Parting::Other : Parting(from);
  }
  std::optional<SharedPose> pose(const flat::Pose* from) {
    if (from == nullptr) return std::nullopt;
    SharedPose result;
    for (std::uint16_t i = 0; i < 3; ++i) result.position[i] = from->position()->Get(i);
    for (std::uint16_t i = 0; i < 4; ++i) result.turn.coeffs()[i] = from->turn()->Get(i);
    if (!result.position.allFinite() || !result.turn.coeffs().allFinite())
      reader_.refuse("The message holds a pose that is not finite.");
    return result;
  }
  template <typename Table>
  Whereabouts whereabouts(const Table& from) {
    return {pose(from.pointer()), pose(from.view()), pose(from.head())};
  }

  world::FlatReader& reader_;
};

template <typename... Kinds>
struct KindList {};
using ClientKinds =
    KindList<flat::Hello, flat::Fetch, flat::Loaded, flat::Submit, flat::Select, flat::Deselect,
             flat::TakeAway, flat::Present, flat::Say, flat::Alive, flat::Bye>;
using ServerKinds =
    KindList<flat::Welcome, flat::Refused, flat::Piece, flat::Create, flat::Edited, flat::Accepted,
             flat::Rejected, flat::Durable, flat::Selected, flat::FloorChanged, flat::Floor, flat::People,
             flat::Presence, flat::Said, flat::Living, flat::Goodbye>;

/// Makes a message of one of these kinds; nothing for one of another.
template <typename Message, typename... Kinds>
std::optional<Message> message_of(const flat::Message& from, MessageReader& reads, KindList<Kinds...>) {
  std::optional<Message> result;
  const auto try_kind = [&]<typename Kind>() {
    if (from.content_type() == flat::ContentTraits<Kind>::enum_value)
      result = reads(*from.content_as<Kind>());
  };
  (try_kind.template operator()<Kinds>(), ...);
  return result;
}

template <typename Message, typename Kinds>
base::Result<Message> read_message(std::string_view bytes, Kinds kinds) {
  constexpr flatbuffers::uoffset_t kMostTablesDeep = 8;
  constexpr std::size_t kFewestBytesOfTable = 8;
  if (bytes.size() > world::kMostReadBytes) return base::fail("The message is too long.");
  world::FlatReader reader(bytes);
  flatbuffers::Verifier verifier(
      reader.data(), reader.size(), kMostTablesDeep,
      flatbuffers::uoffset_t(reader.size() / kFewestBytesOfTable + kMostTablesDeep));
  if (!flat::VerifyMessageBuffer(verifier)) return base::fail("The message is damaged.");
  MessageReader reads(reader);
  std::optional<Message> result = message_of<Message>(*flat::GetMessage(reader.data()), reads, kinds);
  if (!result) return base::fail("The message is of a kind that is not said here.");
  if (!reader.fault().empty()) return base::fail(reader.fault());
  return std::move(*result);
}

}  // namespace

std::string to_bytes(const ClientMessage& message) { return MessageWriter().write(message); }
std::string to_bytes(const ServerMessage& message) { return MessageWriter().write(message); }

base::Result<ClientMessage> client_message(std::string_view bytes) {
  return read_message<ClientMessage>(bytes, ClientKinds());
}
base::Result<ServerMessage> server_message(std::string_view bytes) {
  return read_message<ServerMessage>(bytes, ServerKinds());
}

void add_to_frame(std::string& frame, std::string_view message) {
  const auto length = std::uint32_t(message.size());
  for (unsigned i = 0; i < 4; ++i) frame += static_cast<char>(length >> (8 * i) & 0xFFU);
  frame.append(4, '\0');
  frame += message;
  frame.append((kFrameStep - message.size() % kFrameStep) % kFrameStep, '\0');
}

base::Result<std::string_view> next_in_frame(std::string_view& frame) {
  std::size_t length = 0;
  if (frame.size() < kFrameHeader) return base::fail("The frame ends within a message.");
  for (unsigned i = 0; i < 4; ++i) length |= std::size_t(static_cast<unsigned char>(frame[i])) << (8 * i);
  const std::size_t padded = (length + kFrameStep - 1) / kFrameStep * kFrameStep;
  if (padded > frame.size() - kFrameHeader) return base::fail("The frame ends within a message.");
  const std::string_view message = frame.substr(kFrameHeader, length);
  frame.remove_prefix(kFrameHeader + padded);
  return message;
}

std::string_view role_name(Role role) {
  constexpr std::string_view kNames[] = {"view", "edit", "own"};
  return kNames[std::size_t(role)];
}

}  // namespace icome::collab
