#include "apps/remote/watched_design.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace icome::apps {
namespace {

using collab::Conversation;
using collab::Item;
using Json = nlohmann::ordered_json;

std::string name_in(const Conversation& talk, Item item) {
  return collab::called(talk.replica().world(), item);
}

Json item_json(const Conversation& talk, Item item) {
  static constexpr const char* kKinds[] = {"object", "shape", "material", "texture", "scene"};
  return {{"kind", kKinds[std::size_t(item.kind)]},
          {"id", item.id},
          {"name", collab::name_of(talk.replica().world(), item)}};
}

Json author_json(const Conversation& talk, std::uint32_t author) {
  return author == 0 ? Json(nullptr) : Json(talk.name_of(author));
}

const char* state_word(collab::ConversationState state) {
  switch (state) {
    case collab::ConversationState::Away:
      return "away";
    case collab::ConversationState::Joining:
      return "joining";
    case collab::ConversationState::Live:
      return "live";
    case collab::ConversationState::Ended:
      return "ended";
  }
  return "";
}

/// What is told of each kind of happening, as JSON.
struct WatchedJson {
  const Conversation& talk;

  Json operator()(const collab::SeenEdit& it) const {
    Json json{{"event", "edit"},
              {"sequence", it.sequence},
              {"kind", it.word},
              {"author", it.author},
              {"name", author_json(talk, it.author)},
              {"items", Json::array()}};
    for (const Item item : it.items) json["items"].push_back(item_json(talk, item));
    return json;
  }
  Json operator()(const collab::SeenDurable& it) const {
    return {{"event", "durable"}, {"sequence", it.sequence}};
  }
  Json operator()(const collab::SeenState& it) const {
    return {{"event", "state"},
            {"state", state_word(it.state)},
            {"sequence", talk.replica().sequence()},
            {"why", it.why}};
  }
  Json operator()(const collab::Dropped& it) const {
    return {
        {"event", "dropped"}, {"action", it.name}, {"why", it.why}, {"whose", author_json(talk, it.whose)}};
  }
  Json operator()(const collab::Selected& it) const {
    return {{"event", "select"}, {"item", item_json(talk, it.item)}, {"granted", it.granted},
            {"fence", it.fence}, {"by", author_json(talk, it.by)},   {"waits", it.waits},
            {"why", it.why}};
  }
  Json operator()(const collab::FloorChanged& it) const {
    return {{"event", "floor"},
            {"item", item_json(talk, it.item)},
            {"holder", author_json(talk, it.holder)},
            {"author", it.holder},
            {"fence", it.fence},
            {"taken_by", author_json(talk, it.taken_by)}};
  }
  Json operator()(const collab::Person& it) const {
    return {{"event", "person"},
            {"author", it.author},
            {"name", it.name},
            {"role", std::string(collab::role_name(it.role))},
            {"here", it.here}};
  }
  Json operator()(const collab::Said& it) const {
    return {{"event", "chat"}, {"name", author_json(talk, it.author)}, {"text", it.text}};
  }
};

/// And as a sentence.
struct WatchedText {
  const Conversation& talk;

  std::string operator()(const collab::SeenEdit& it) const {
    std::string things;
    for (const Item item : it.items)
      if (item.kind == collab::ItemKind::Object || it.items.size() == 1)
        things += (things.empty() ? " " : ", ") + name_in(talk, item);
    return fmt::format("{:>6}  {}: {}{}", it.sequence, talk.name_of(it.author), it.word, things);
  }
  std::string operator()(const collab::SeenDurable&) const { return ""; }
  std::string operator()(const collab::SeenState& it) const {
    return fmt::format("        {}{}{}", state_word(it.state), it.why.empty() ? "" : ": ", it.why);
  }
  std::string operator()(const collab::Dropped& it) const {
    return fmt::format("        {} did not come to be: {}", it.name, it.why);
  }
  std::string operator()(const collab::Selected& it) const {
    return it.granted ? fmt::format("        you hold {}", name_in(talk, it.item)) : "        " + it.why;
  }
  std::string operator()(const collab::FloorChanged& it) const {
    if (it.taken_by != 0)
      return fmt::format("        {} took {} away", talk.name_of(it.taken_by), name_in(talk, it.item));
    return it.holder == 0
               ? fmt::format("        {} is free", name_in(talk, it.item))
               : fmt::format("        {} holds {}", talk.name_of(it.holder), name_in(talk, it.item));
  }
  std::string operator()(const collab::Person& it) const {
    return fmt::format("        {} {}", it.name, it.here ? "is here" : "has left");
  }
  std::string operator()(const collab::Said& it) const {
    return fmt::format("        {}: \"{}\"", talk.name_of(it.author), it.text);
  }
};

}  // namespace

std::string watched_line(const collab::Seen& seen, const Conversation& talk, bool json) {
  if (!json) {
    std::string line = std::visit(WatchedText{talk}, seen);
    std::ranges::replace(line, '\n', ' ');  // a name of several lines is no line of its own
    return line;
  }
  return std::visit(WatchedJson{talk}, seen).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace icome::apps
