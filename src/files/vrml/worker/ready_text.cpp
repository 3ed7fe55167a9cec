#include "files/vrml/worker/ready_text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "base/parse_number.h"
#include "files/vrml/read/vrml_header.h"
#include "files/vrml/read/vrml_scanner.h"
#include "files/vrml/worker/refusal.h"
#include "files/vrml/worker/tokens.h"

namespace icome::files {
namespace {

/// Coin reads by recursion, with up to 2 KB of stack for a level.
constexpr int kDepthLimit = kMostNestedVrml;
constexpr std::size_t kLongName = 200;
constexpr std::size_t kLongString = 4000;
/// Longest word that is no name of a node: types, fields and PROTOs.
constexpr std::size_t kWordLimit = 1000;
constexpr std::size_t kTextNoteLimit = 1000;
/// Limit of the rows and columns of a PixelTexture: Coin keeps them in 16 bits.
constexpr std::uint64_t kImageSideLimit = 32767;
constexpr std::size_t kRouteLimit = 1'000'000;
constexpr const char* kHeaderLine = "#VRML V2.0 utf8\n";

/// The default value of a field type of VRML 2.0.
const char* default_value(std::string_view type) {
  if (type.starts_with("MF")) return "[]";
  if (type == "SFNode") return "NULL";
  if (type == "SFBool") return "FALSE";
  if (type == "SFString") return "\"\"";
  if (type == "SFVec2f") return "0 0";
  if (type == "SFColor" || type == "SFVec3f" || type == "SFImage") return "0 0 0";
  if (type == "SFRotation") return "0 0 1 0";
  return "0";
}

std::string too_deep() { return "nests nodes more than " + std::to_string(kDepthLimit) + " deep"; }

bool is_value_word(std::string_view word) { return word == "TRUE" || word == "FALSE" || word == "NULL"; }

/// Does Coin keep a node name unchanged? (It also cuts `+3` from the end of names, which it adds itself.)
bool is_plain_name(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  const auto is_plain = [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '+';
  };
  return name.size() <= kLongName && is_letter(name[0]) && std::all_of(name.begin(), name.end(), is_plain) &&
         !name.starts_with(kChangedName);
}

/// The replacement of a part of the text.
struct Change {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::string text;
};

/// Parses the grammar of VRML 2.0 (ISO/IEC 14772-1, annex A) in a text and records changes.
class TextReader {
 public:
  TextReader(std::string_view text, bool tells_strange_nodes,
             base::FunctionRef<bool(const std::string&, const std::string&)> has_field,
             std::vector<std::string>& names)
      : text_(text),
        tells_strange_nodes_(tells_strange_nodes),
        tokens_(text),
        has_field_(has_field),
        names_(names) {}

  void read(ReadyText& ready) {
    try {
      statements(Kind::End);
    } catch (const Unclear&) {
      // Coin reports the error there, but must not recurse too deep before it.
      if (tokens_.deepest() > kDepthLimit) ready.error = too_deep();
    } catch (const Refusal& refusal) {
      ready.error = refusal.why;
    }
    ready.stand_ins = std::move(stand_ins_);
    ready.notes = std::move(notes_);
    ready.routes = std::move(routes_);
    ready.text.reserve(ready.text.size() + text_.size() + 64);
    std::size_t copied = 0;
    for (const Change& change : changes_) {
      ready.text.append(text_, copied, change.begin - copied).append(change.text);
      // Keeps the line numbers of what follows.
      ready.text.append(
          static_cast<std::size_t>(std::count(text_.begin() + static_cast<long>(change.begin),
                                              text_.begin() + static_cast<long>(change.end), '\n')),
          '\n');
      copied = change.end;
    }
    ready.text.append(text_, copied);
  }

 private:
  using Kind = Token::Kind;
  using Fields = std::unordered_set<std::string>;
  using SharedFields = std::shared_ptr<const Fields>;
  /// The names in a file or in the definition of a PROTO.
  struct Scope {
    std::unordered_set<std::string> nodes;
    std::unordered_map<std::string, SharedFields> protos;
  };
  struct Unclear {};
  enum class Outcome { Kept, Dropped };

  /// A level of nesting, for the lifetime of this object.
  class Level {
   public:
    explicit Level(int& depth) : depth_(depth) {
      if (++depth_ > kDepthLimit) throw Refusal{too_deep()};
    }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    ~Level() { --depth_; }

   private:
    int& depth_;
  };

  std::string_view word(const Token& token) const { return tokens_.word(token); }
  Token expect(Kind kind) {
    const Token token = tokens_.next();
    if (token.kind != kind) throw Unclear{};
    if (kind == Kind::Word && token.end - token.begin > kWordLimit)
      throw Refusal{"has a word of more than " + std::to_string(kWordLimit) + " letters"};
    return token;
  }
  Token expect_name() {
    const Token token = tokens_.next();
    if (token.kind != Kind::Word && token.kind != Kind::Number) throw Unclear{};
    return token;
  }
  void note(std::size_t place, std::string text) {
    // The needs of a Script have no effect, since no Script runs.
    if (!in_script_ && notes_.size() < kTextNoteLimit)
      notes_.push_back({tokens_.line(place), std::move(text)});
  }
  std::string quoted(const Token& token) const {
    std::string text = "'";
    text.append(word(token).substr(0, 60)) += '\'';
    return text;
  }
  void replace(std::size_t begin, std::size_t end, std::string text) {
    changes_.push_back({begin, end, std::move(text)});
  }
  /// Drops the text from here to the end of the last token.
  void drop(std::size_t begin) { replace(begin, tokens_.place(), " "); }

  void statements(Kind last);
  bool statement(const Token& first);
  void keep_route(int line, const Token& from, const Token& to);
  void proto(bool is_extern);
  Fields interface(bool is_extern, std::string& stand_in);
  void route(const Token& first);
  Outcome value();
  Outcome node(Token first);
  void list();
  void body(const std::string& type, const SharedFields& proto_fields);
  void image();
  bool script_field(const Token& access);
  void skip_value();
  SharedFields find_proto(const std::string& name) const;
  std::string name_for_coin(std::string_view name) const;
  void change_name(const Token& name);
  void change_string(const Token& string);

  std::string_view text_;
  bool tells_strange_nodes_;
  Tokens tokens_;
  base::FunctionRef<bool(const std::string&, const std::string&)> has_field_;
  std::vector<std::string>& names_;
  std::vector<Change> changes_;
  std::vector<TextNote> notes_;
  std::vector<TextRoute> routes_;
  std::vector<std::string> stand_ins_;
  int depth_ = 0;
  bool in_script_ = false;
  std::vector<Scope> scopes_ = std::vector<Scope>(1);  // of the file and of the PROTOs around this place
  std::unordered_map<std::string, std::string> changed_;
};

/// Reads the statements of a file or of a PROTO.
void TextReader::statements(Kind last) {
  while (tokens_.peek().kind != last) {
    const Token first = expect(Kind::Word);
    if (!statement(first) && node(first) == Outcome::Dropped) drop(first.begin);
  }
}

/// Reads PROTO, EXTERNPROTO and ROUTE; anything else is left to the caller.
bool TextReader::statement(const Token& first) {
  if (word(first) == "PROTO" || word(first) == "EXTERNPROTO") {
    proto(word(first) == "EXTERNPROTO");
    return true;
  }
  if (word(first) != "ROUTE") return false;
  const Token from = expect_name();
  if (word(expect(Kind::Word)) != "TO") throw Unclear{};
  keep_route(tokens_.line(first.begin), from, expect_name());
  drop(first.begin);
  return true;
}

void TextReader::keep_route(int line, const Token& from, const Token& to) {
  if (scopes_.size() > 1 || routes_.size() == kRouteLimit) return;
  const std::string_view source = word(from), target = word(to);
  const std::size_t source_dot = source.find('.'), target_dot = target.find('.');
  if (source_dot == std::string_view::npos || target_dot == std::string_view::npos) return;
  routes_.push_back({name_for_coin(source.substr(0, source_dot)), std::string(source.substr(source_dot + 1)),
                     name_for_coin(target.substr(0, target_dot)), std::string(target.substr(target_dot + 1)),
                     line});
}

/// The name after change_name().
std::string TextReader::name_for_coin(std::string_view name) const {
  const auto changed = changed_.find(std::string(name));
  return changed == changed_.end() ? std::string(name) : changed->second;
}

void TextReader::proto(bool is_extern) {
  const Level level(depth_);
  const std::string name(word(expect(Kind::Word)));
  expect(Kind::OpenList);
  std::string stand_in = std::string(kHeaderLine) + "PROTO " + name + " [\n";
  Fields fields = interface(is_extern, stand_in);
  if (is_extern) {
    stand_ins_.push_back(stand_in + "] { Group { } }\n");
    skip_value();
  } else {
    expect(Kind::Open);
    scopes_.emplace_back();
    statements(Kind::Close);
    scopes_.pop_back();
    expect(Kind::Close);
  }
  scopes_.back().protos[name] = std::make_shared<const Fields>(std::move(fields));
}

TextReader::Fields TextReader::interface(bool is_extern, std::string& stand_in) {
  Fields fields;
  while (true) {
    const Token first = tokens_.next();
    if (first.kind == Kind::CloseList) return fields;
    const std::string_view access = word(first);
    const bool has_value = access == "field" || access == "exposedField";
    if (!has_value && access != "eventIn" && access != "eventOut") throw Unclear{};
    const std::string_view type = word(expect(Kind::Word));
    const std::string_view name = word(expect(Kind::Word));
    fields.emplace(name);
    const std::size_t begin = tokens_.peek().begin;
    if (has_value && !is_extern && value() == Outcome::Dropped)
      replace(begin, tokens_.place(), default_value(type));
    for (const std::string_view part : {access, type, name}) stand_in.append(part) += ' ';
    if (has_value) stand_in += default_value(type);
    stand_in += '\n';
  }
}

/// Reads the value of a field, whose kind its first word tells. Dropped: it is a node that is to be
/// left out; the caller removes it.
TextReader::Outcome TextReader::value() {
  const Token first = tokens_.next();
  if (first.kind == Kind::String) {
    change_string(first);
    return Outcome::Kept;
  }
  if (first.kind == Kind::Number) {
    tokens_.skip_numbers();
    return Outcome::Kept;
  }
  if (first.kind == Kind::OpenList) {
    list();
    return Outcome::Kept;
  }
  if (first.kind != Kind::Word) throw Unclear{};
  if (is_value_word(word(first))) return Outcome::Kept;
  if (word(first) != "IS") return node(first);
  expect(Kind::Word);
  return Outcome::Kept;
}

void TextReader::list() {
  const Level level(depth_);
  while (true) {
    tokens_.skip_numbers();
    const Token token = tokens_.next();
    if (token.kind == Kind::CloseList) return;
    if (token.kind == Kind::String) {
      change_string(token);
      continue;
    }
    if (token.kind != Kind::Word) throw Unclear{};
    if (is_value_word(word(token))) continue;
    if (node(token) == Outcome::Dropped) drop(token.begin);
  }
}

TextReader::Outcome TextReader::node(Token first) {
  if (word(first) == "USE") {
    const Token name = expect_name();
    if (!scopes_.back().nodes.contains(std::string(word(name)))) {
      note(first.begin, "USE " + quoted(name) + " is left out: no node before it has this name.");
      return Outcome::Dropped;
    }
    change_name(name);
    return Outcome::Kept;
  }
  std::optional<Token> name;
  if (word(first) == "DEF") {
    name = expect_name();
    first = expect(Kind::Word);
  }
  const std::string type(word(first));
  const SharedFields proto = find_proto(type);
  const bool known = proto || is_vrml_node(type);
  expect(Kind::Open);
  if (!known) {
    if (tells_strange_nodes_)
      note(first.begin, quoted(first) + " is left out: neither VRML 2.0 nor this file has such a node.");
    if (!tokens_.skip_to_partner()) throw Unclear{};
    return Outcome::Dropped;
  }
  if (name) change_name(*name);
  body(type, proto);
  if (name) scopes_.back().nodes.emplace(word(*name));
  return Outcome::Kept;
}

/// Reads the content between the braces of a node, an instance of a PROTO if there are `proto_fields`.
void TextReader::body(const std::string& type, const SharedFields& proto_fields) {
  const Level level(depth_);
  while (true) {
    const Token first = tokens_.next();
    if (first.kind == Kind::Close) return;
    if (first.kind != Kind::Word) throw Unclear{};
    if (statement(first)) continue;
    if (type == "Script" && !proto_fields && script_field(first)) continue;
    const std::string field(word(first));
    if (proto_fields ? proto_fields->contains(field) : has_field_(type, field)) {
      if (!proto_fields && type == "PixelTexture" && field == "image" &&
          tokens_.peek().kind == Kind::Number) {
        image();
        continue;
      }
      if (value() == Outcome::Dropped) drop(first.begin);
      continue;
    }
    // An event that a PROTO passes on has no value to lose.
    if (word(tokens_.peek()) != "IS")
      note(first.begin, "The field " + quoted(first) + " is left out: " + type + " has none of this name.");
    skip_value();
    drop(first.begin);
  }
}

/// Reads the image of a PixelTexture. It becomes an empty one where its pixels do not fit its size, since
/// Coin gives up the whole file for that.
void TextReader::image() {
  const std::size_t begin = tokens_.peek().begin;
  std::array<std::string, 3> size;  // width, height, components
  std::array<std::uint64_t, 3> numbers{};
  bool is_right = true;
  for (std::size_t i = 0; i < size.size(); ++i) {
    size[i] = word(expect(Kind::Number)).substr(0, 20);
    const auto number = base::parse_number<std::uint64_t>(size[i]);
    is_right &= number.has_value();
    numbers[i] = number.value_or(0);
  }
  const auto [width, height, components] = numbers;
  is_right &= width <= kImageSideLimit && height <= kImageSideLimit && components <= 4;
  std::uint64_t pixels = 0;
  for (; tokens_.peek().kind == Kind::Number; ++pixels) tokens_.next();
  const std::string named = "The image of a PixelTexture is left out: ";
  if (!is_right)
    note(begin, named + "its size is " + size[0] + " x " + size[1] + " with " + size[2] +
                    " components; it may have up to 32767 x 32767 with 4.");
  else if (pixels != width * height)
    note(begin,
         named + "of its " + size[0] + " x " + size[1] + " pixels there are " + std::to_string(pixels) + ".");
  else
    return;
  replace(begin, tokens_.place(), "0 0 0");
}

/// Reads a field that a Script declares for itself. Nothing here runs the Script.
bool TextReader::script_field(const Token& access) {
  const bool has_value = word(access) == "field";
  if (!has_value && word(access) != "eventIn" && word(access) != "eventOut" && word(access) != "exposedField")
    return false;
  const std::string_view type = word(expect(Kind::Word));
  expect(Kind::Word);
  const Token next = tokens_.peek();
  const bool was_in_script = std::exchange(in_script_, true);
  if ((has_value || word(next) == "IS") && value() == Outcome::Dropped)
    replace(next.begin, tokens_.place(), default_value(type));
  in_script_ = was_in_script;
  return true;
}

void TextReader::skip_value() {
  Token token = tokens_.next();
  if (token.kind == Kind::Number) tokens_.skip_numbers();
  if (token.kind == Kind::OpenList && !tokens_.skip_to_partner()) throw Unclear{};
  if (token.kind != Kind::Word || is_value_word(word(token))) return;
  if (word(token) == "IS" || word(token) == "USE") {
    expect_name();
    return;
  }
  if (word(token) == "DEF") {
    expect_name();
    expect(Kind::Word);
  }
  expect(Kind::Open);
  if (!tokens_.skip_to_partner()) throw Unclear{};
}

TextReader::SharedFields TextReader::find_proto(const std::string& name) const {
  for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
    if (const auto found = scope->protos.find(name); found != scope->protos.end()) return found->second;
  return nullptr;
}

void TextReader::change_name(const Token& token) {
  const std::string name(word(token));
  if (is_plain_name(name)) return;
  const auto [changed, is_new] =
      changed_.try_emplace(name, std::string(kChangedName) + std::to_string(names_.size()));
  if (is_new) names_.push_back(name.substr(0, name.find('+')));
  replace(token.begin, token.end, changed->second);
}

void TextReader::change_string(const Token& token) {
  const std::string_view quoted = word(token);
  if (quoted.size() <= kLongString || quoted.back() != '"') return;
  std::string text;
  for (std::size_t i = 1; i + 1 < quoted.size(); ++i) {
    if (quoted[i] == '\\' && i + 2 < quoted.size()) ++i;
    text += quoted[i];
  }
  replace(token.begin, token.end, '"' + std::string(kChangedName) + std::to_string(names_.size()) + '"');
  names_.push_back(std::move(text));
}

}  // namespace

ReadyText make_ready(std::string_view file,
                     base::FunctionRef<bool(const std::string&, const std::string&)> has_field,
                     std::vector<std::string>& names) {
  ReadyText ready;
  ready.text = kHeaderLine;
  if (const auto header = find_vrml_header(file)) {
    // The rest of the first line belongs to the program that wrote it.
    file.remove_prefix(std::min(file.find_first_of("\r\n", *header), file.size()));
    ready.text.pop_back();
  } else if (begins_like_vrml(file)) {
    ready.added_lines = 1;
  } else {
    ready.error = header.error().message;
    return ready;
  }
  TextReader(file, ready.added_lines > 0, has_field, names).read(ready);
  return ready;
}

}  // namespace icome::files
