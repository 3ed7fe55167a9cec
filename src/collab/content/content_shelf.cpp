#include "collab/content/content_shelf.h"

#include "collab/protocol/message_bytes.h"

namespace icome::collab {

ContentShelf::Shelved ContentShelf::take_edit(std::string_view edit) {
  const std::vector<world::ByteRange> parts = world::long_parts(edit, least_bytes_);
  return parts.empty() ? Shelved() : shelve(edit, parts);
}

ContentShelf::ShelvedWorld ContentShelf::take_world(std::string_view world) {
  std::vector<world::ByteRange> parts;
  for (std::string_view left = world; !left.empty();) {
    const auto edit = next_in_frame(left);
    if (!edit) break;
    const std::size_t offset = std::size_t(edit->data() - world.data());
    for (const world::ByteRange& part : world::long_parts(*edit, least_bytes_))
      parts.push_back({offset + part.offset, part.size});
  }
  ShelvedWorld result;
  result.shelved = shelve(world, parts);
  result.hash = hash_of_content(*result.shelved.outline);
  if (const ContentPointer same = find(result.hash)) {
    result.shelved.outline = same;
  } else {
    contents_[result.hash] = result.shelved.outline;
  }
  return result;
}

ContentShelf::Shelved ContentShelf::shelve(std::string_view whole,
                                           const std::vector<world::ByteRange>& parts) {
  std::erase_if(contents_, [](const auto& it) { return it.second.expired(); });
  Shelved shelved;
  const Outline outline = outline_of(whole, parts);
  for (const ContentPlace& place : outline.places) {
    ContentPointer content = find(place.hash);
    if (!content) {
      content = std::make_shared<const std::string>(whole.substr(place.offset, place.size));
      contents_[place.hash] = content;
    }
    shelved.bytes += place.size;
    shelved.contents.push_back(std::move(content));
  }
  shelved.outline = std::make_shared<const std::string>(to_bytes(outline));
  return shelved;
}

ContentPointer ContentShelf::find(const ContentHash& hash) const {
  const auto found = contents_.find(hash);
  return found == contents_.end() ? nullptr : found->second.lock();
}

}  // namespace icome::collab
