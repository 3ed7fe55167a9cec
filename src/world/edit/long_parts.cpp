#include "world/edit/long_parts.h"

#include <edit_generated.h>

#include <algorithm>

namespace icome::world {
namespace {

/// Finds the long parts of an edit and of those in it.
class LongParts {
 public:
  LongParts(std::string_view bytes, std::size_t least) : bytes_(bytes), least_(least) {}

  std::vector<ByteRange> find() {
    look_at(flat::GetEdit(bytes_.data()));
    std::ranges::sort(parts_, {}, &ByteRange::offset);
    // An edit of a stranger may name the same bytes twice.
    const auto overlaps = [](const ByteRange& a, const ByteRange& b) { return b.offset < a.offset + a.size; };
    parts_.erase(std::unique(parts_.begin(), parts_.end(), overlaps), parts_.end());
    return std::move(parts_);
  }

 private:
  void look_at(const flat::Edit* edit) {
    switch (edit->what_type()) {
      case flat::What::CreateGeometry:
        return look_at(edit->what_as_CreateGeometry()->shape());
      case flat::What::ReplaceGeometry:
        return look_at(edit->what_as_ReplaceGeometry()->shape());
      case flat::What::CreateTexture:
        return look_at(edit->what_as_CreateTexture()->picture());
      case flat::What::EditGroup:
        if (const auto* const edits = edit->what_as_EditGroup()->edits())
          for (const flat::Edit* it : *edits) look_at(it);
        return;
      default:
        return;
    }
  }
  void look_at(const flat::Shape* shape) {
    if (shape != nullptr) look_at(shape->bytes());
  }
  void look_at(const flatbuffers::Vector<std::uint8_t>* part) {
    if (part == nullptr || part->size() < least_) return;
    parts_.push_back(
        {std::size_t(reinterpret_cast<const char*>(part->data()) - bytes_.data()), part->size()});
  }

  std::string_view bytes_;
  std::size_t least_;
  std::vector<ByteRange> parts_;
};

}  // namespace

std::vector<ByteRange> long_parts(std::string_view edit, std::size_t least_bytes) {
  if (edit.size() < least_bytes) return {};
  return LongParts(edit, std::max<std::size_t>(1, least_bytes)).find();
}

}  // namespace icome::world
