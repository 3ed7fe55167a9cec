#include "collab/client/kept_copy.h"

#include <fmt/format.h>

#include <sstream>

#include "collab/content/outline.h"
#include "collab/order/world_bytes.h"
#include "collab/protocol/message_bytes.h"
#include "world/edit/edit_bytes.h"

namespace icome::collab {
namespace {

// As bytes: frames with a text of what is no edit, with the world, and then two for each edit, its name and a
// Submit; last the SHA-256 of all before.
constexpr const char* kFirstWord = "icome-kept-1";
constexpr std::size_t kSumBytes = 8 + kContentHashBytes;  // a frame

tl::unexpected<base::Error> unreadable() {
  return base::fail("The copy that was kept for offline work is damaged.");
}

}  // namespace

base::Result<std::string> to_bytes(const KeptCopy& copy) {
  std::string bytes;
  add_to_frame(bytes, fmt::format("{}\n{}\n{}\n{} {} {} {} {} {} {} {}\n", kFirstWord, copy.link, copy.key,
                                  copy.at, copy.history, copy.sequence, copy.author, copy.last_number,
                                  copy.lives, int(copy.role), copy.edits.size()));
  const auto world = world_to_bytes(copy.world);
  if (!world) return world;
  add_to_frame(bytes, *world);
  for (const KeptEdit& it : copy.edits) {
    auto edit = world::to_bytes(it.edit);
    if (!edit) return edit;
    add_to_frame(bytes, it.name);
    add_to_frame(bytes, to_bytes(ClientMessage(Submit{it.number, it.base, it.fences, std::move(*edit), 0})));
  }
  add_to_frame(bytes, hash_of_content(bytes));
  return bytes;
}

base::Result<KeptCopy> kept_copy_from_bytes(std::string_view bytes, const world::GeometryFactory& factory) {
  if (bytes.size() < kSumBytes) return unreadable();
  std::string_view sum = bytes.substr(bytes.size() - kSumBytes);
  bytes.remove_suffix(kSumBytes);
  if (next_in_frame(sum).value_or("") != hash_of_content(bytes)) return unreadable();
  const auto text = next_in_frame(bytes);
  if (!text) return unreadable();
  std::istringstream head{std::string(*text)};
  std::string word;
  KeptCopy copy;
  std::size_t edits = 0;
  unsigned role = 0;
  std::getline(head, word);
  std::getline(head, copy.link);
  std::getline(head, copy.key);
  head >> copy.at >> copy.history >> copy.sequence >> copy.author >> copy.last_number >> copy.lives >> role >>
      edits;
  if (!head || word != kFirstWord || role > unsigned(Role::Own)) return unreadable();
  copy.role = Role(role);
  const auto world_bytes = next_in_frame(bytes);
  if (!world_bytes) return unreadable();
  auto world = world_from_bytes(*world_bytes, factory);
  if (!world) return unreadable();
  copy.world = std::move(*world);
  for (std::size_t i = 0; i < edits; ++i) {
    const auto name = next_in_frame(bytes);
    const auto message = name ? next_in_frame(bytes) : name;
    if (!message) return unreadable();
    const auto submit = client_message(*message);
    const auto* const it = submit ? std::get_if<Submit>(&*submit) : nullptr;
    if (it == nullptr) return unreadable();
    auto edit = world::edit_from_bytes(it->edit, factory);
    if (!edit) return unreadable();
    copy.edits.push_back({it->number, std::string(*name), it->base, it->fences, std::move(*edit)});
  }
  return copy;
}

}  // namespace icome::collab
