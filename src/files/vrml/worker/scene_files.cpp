#include "files/vrml/worker/scene_files.h"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/VRMLnodes/SoVRMLImageTexture.h>
#include <Inventor/VRMLnodes/SoVRMLInline.h>
#include <Inventor/errors/SoDebugError.h>
#include <Inventor/errors/SoReadError.h>
#include <Inventor/fields/SoMFString.h>
#include <Inventor/lists/SoFieldList.h>
#include <Inventor/misc/SoProto.h>
#include <Inventor/nodes/SoNode.h>

#include <algorithm>
#include <cstdlib>
#include <unordered_set>

#include "base/parse_number.h"
#include "files/vrml/worker/ready_text.h"

namespace icome::files {
namespace {

/// Does Coin's node of this type have this field?
bool coin_has_field(const std::string& node, const std::string& field) {
  static std::unordered_map<std::string, std::unordered_set<std::string>> known;
  const auto [fields, is_new] = known.try_emplace(node);
  if (is_new) {
    const SoType type = SoType::fromName(("VRML" + node).c_str());
    if (!type.isBad() && type.canCreateInstance()) {
      auto* example = static_cast<SoNode*>(type.createInstance());
      example->ref();
      SoFieldList list;
      example->getFields(list);
      for (int i = 0; i < list.getLength(); ++i) {
        SbName name;
        example->getFieldName(list[i], name);
        fields->second.emplace(name.getString());
      }
      example->unref();
    }
  }
  return fields->second.contains(field);
}

/// "Unknown reference" from "Coin read error: Unknown reference\n\tOccurred at line   3 in <memory>", and
/// the 3.
TextNote told_by_coin(const SbString& message) {
  std::string_view text(message.getString(), static_cast<std::size_t>(message.getLength()));
  TextNote note;
  if (const std::size_t at = text.rfind("Occurred at line"); at != std::string_view::npos) {
    const std::size_t digits = std::min(text.find_first_of("0123456789", at), text.size());
    note.line = base::number_at_front<decltype(note.line)>(text.substr(digits)).value;
  }
  constexpr std::string_view kStart = "Coin read error: ";
  if (text.starts_with(kStart)) text.remove_prefix(kStart.size());
  text = text.substr(0, text.find('\n'));
  note.text = text;
  // Removes the prefix of Coin's node names.
  for (std::size_t at = 0; (at = note.text.find("VRML", at)) != std::string::npos;)
    if (at + 4 < note.text.size() && note.text[at + 4] >= 'A' && note.text[at + 4] <= 'Z')
      note.text.erase(at, 4);
    else
      at += 4;
  return note;
}

std::string joined(const std::vector<std::string>& urls) {
  std::string all;
  for (const std::string& url : urls) (all += url) += '\0';
  if (!all.empty()) all.pop_back();
  return all;
}

}  // namespace

/// A file while Coin reads it; Coin passes it to the callbacks.
struct SceneFiles::Reading : SoInput {
  Reading(SceneFile& of, ReadyText text) : file(of), ready(std::move(text)) {
    setBuffer(ready.text.data(), ready.text.size());
  }
  SceneFile& file;
  ReadyText ready;
  std::size_t externs = 0;  // read so far
  std::vector<TextNote> errors = {};
};

/// Functions that Coin calls while it reads.
struct SceneFiles::Callbacks {
  static void note_error(const SoError* error, void* closure) {
    auto& files = *static_cast<SceneFiles*>(closure);
    if (files.reading_.empty()) return;
    Reading& reading = *files.reading_.back();
    TextNote note = told_by_coin(error->getDebugString());
    note.line = std::max(0, note.line - reading.ready.added_lines);
    // Textures are not read here, and an outer node always fails with an inner one.
    if (note.text.starts_with("Could not read texture file")) return;
    if (note.text.starts_with("Couldn't read value for field") && !reading.errors.empty() &&
        reading.errors.back().line == note.line)
      return;
    reading.errors.push_back(std::move(note));
  }
  static void ignore(const SoError*, void*) {}

  static SoProto* fetch_proto(SoInput* input, const SbString* urls, int count, void* closure) {
    auto& files = *static_cast<SceneFiles*>(closure);
    auto& reading = *static_cast<Reading*>(input);
    std::vector<std::string> wanted;
    for (int i = 0; i < count; ++i) wanted.emplace_back(urls[i].getString());
    const std::size_t number = reading.externs++;
    if (const SceneFile* file = files.fetch(reading.file, wanted, "EXTERNPROTO"))
      if (SoProto* proto = find_proto(*file, wanted)) {
        files.homes_[proto] = file;
        return proto;
      }
    return number < reading.ready.stand_ins.size() ? stand_in(reading.ready.stand_ins[number]) : nullptr;
  }

  /// The PROTO that a url names behind '#', or the first.
  static SoProto* find_proto(const SceneFile& file, const std::vector<std::string>& urls) {
    for (const std::string& url : urls) {
      const std::size_t mark = url.find('#');
      const std::string name = mark == std::string::npos ? "" : url.substr(mark + 1);
      for (SoNode* root : file.roots)
        if (root->isOfType(SoProto::getClassTypeId())) {
          auto* proto = static_cast<SoProto*>(root);
          if (name.empty() || name == proto->getProtoName().getString()) return proto;
        }
    }
    return nullptr;
  }
};

SceneFiles::SceneFiles(Channel& channel, Answer& answer) : channel_(channel), answer_(answer) {
  SoReadError::setHandlerCallback(Callbacks::note_error, this);
  SoDebugError::setHandlerCallback(Callbacks::ignore, nullptr);
  SoProto::setFetchExternProtoCallback(Callbacks::fetch_proto, this);
}

void SceneFiles::prepare_coin() {
  // Letters come from Coin's own font, the same everywhere; a library of fonts would open files.
  ::setenv("COIN_FORCE_FREETYPE_OFF", "1", 1);
  SoDB::init();
  SoInput::clearDirectories();
  SoVRMLInline::setReadAsSoFile(FALSE);
  SoVRMLImageTexture::setDelayFetchURL(TRUE);
}

SceneFile& SceneFiles::read_design(const std::string& path, std::string_view bytes) {
  auto& file = files_[0];
  file = std::make_unique<SceneFile>();
  file->path = path;
  read(*file, bytes);
  return *file;
}

SceneFile* SceneFiles::fetch(const SceneFile& from, const std::vector<std::string>& urls, const char* who) {
  channel_.send(VrmlFrame::Fetch, from.number, joined(urls));
  VrmlFrameHead head = channel_.receive_head();
  if (head.kind == VrmlFrame::Refused) {
    answer_.note(from.told, 0, std::string(who) + ": " + channel_.receive_bytes(head) + ".");
    return nullptr;
  }
  if (head.kind == VrmlFrame::Name) {
    auto& file = files_[head.file];
    file = std::make_unique<SceneFile>();
    file->number = head.file;
    file->path = channel_.receive_bytes(head);
    file->told = file->path;
    const std::string bytes = channel_.receive(VrmlFrame::File);
    try {
      read(*file, bytes);
    } catch (const Refusal& refusal) {
      answer_.note(file->told, 0, "This file " + refusal.why + ".");
    }
    return file.get();
  }
  SceneFile* known = files_.at(head.file).get();
  if (!known->is_being_read) return known;
  answer_.note(from.told, 0,
               std::string(who) + ": '" + urls.front() + "' leads back to a file that asks for it.");
  return nullptr;
}

const SceneFile* SceneFiles::home(const SoProto* proto) const {
  const auto found = homes_.find(proto);
  return found == homes_.end() ? nullptr : found->second;
}

std::string SceneFiles::original(const char* text) const {
  const std::string_view name = text;
  if (!name.starts_with(kChangedName)) return std::string(name);
  const auto number = base::number_at_front<std::size_t>(name.substr(kChangedName.size()));
  return number.good() && number.value < changed_names_.size() ? changed_names_[number.value]
                                                               : std::string(name);
}

std::string SceneFiles::original_name(const SbName& name) const { return original(name.getString()); }

std::vector<std::string> SceneFiles::strings(const SoMFString& field) const {
  std::vector<std::string> strings;
  for (int i = 0; i < field.getNum(); ++i) strings.push_back(original(field[i].getString()));
  return strings;
}

const std::vector<NodeRoute>& SceneFiles::routes_to(const SoNode& node) const {
  static const std::vector<NodeRoute> kNone;
  const auto found = routes_.find(&node);
  return found == routes_.end() ? kNone : found->second;
}

/// The last one of several nodes of one name counts, as in Coin.
void SceneFiles::keep_routes(const Reading& reading) {
  const auto named = [&](const std::string& name) -> const SoNode* {
    const SoBase* const found = reading.findReference(SbName(name.c_str()));
    const bool is_node = found && found->isOfType(SoNode::getClassTypeId());
    return is_node ? static_cast<const SoNode*>(found) : nullptr;
  };
  for (const TextRoute& route : reading.ready.routes) {
    const SoNode* const from = named(route.from);
    const SoNode* const to = named(route.to);
    if (!from || !to) continue;
    routes_[to].push_back({from, route.out, route.in, &reading.file, route.line});
  }
}

/// Reads node by node, so that all nodes before a mistake are kept.
void SceneFiles::read(SceneFile& file, std::string_view bytes) {
  ReadyText ready = make_ready(
      bytes, [](const std::string& node, const std::string& field) { return coin_has_field(node, field); },
      changed_names_);
  for (const TextNote& note : ready.notes) answer_.note(file.told, note.line, note.text);
  if (!ready.error.empty()) throw Refusal{ready.error};
  Reading reading(file, std::move(ready));
  reading_.push_back(&reading);
  file.is_being_read = true;
  bool is_whole = true;
  while (true) {
    SoNode* root = nullptr;
    is_whole = SoDB::read(&reading, root);
    if (root) root->ref();
    if (!is_whole || !root) break;
    file.roots.push_back(root);
  }
  keep_routes(reading);
  file.is_being_read = false;
  reading_.pop_back();
  is_whole = is_whole && reading.eof();
  for (const TextNote& error : reading.errors) answer_.note(file.told, error.line, error.text);
  if (is_whole) return;
  const TextNote why =
      reading.errors.empty() ? TextNote{0, "there is no node where one is expected"} : reading.errors.front();
  const std::string place = why.line > 0 ? "line " + std::to_string(why.line) + ": " : "";
  const bool has_nodes = std::any_of(file.roots.begin(), file.roots.end(), [](const SoNode* root) {
    return !root->isOfType(SoProto::getClassTypeId());
  });
  if (!has_nodes) throw Refusal{"cannot be read: " + place + why.text};
  answer_.note(file.told, why.line, "What follows this could not be read.");
}

/// Null if even that cannot be read.
SoProto* SceneFiles::stand_in(const std::string& text) {
  SoInput input;
  input.setBuffer(text.data(), text.size());
  SoNode* node = nullptr;
  if (!SoDB::read(&input, node) || !node) return nullptr;
  node->ref();
  return node->isOfType(SoProto::getClassTypeId()) ? static_cast<SoProto*>(node) : nullptr;
}

}  // namespace icome::files
