#include "files/vrml/read/vrml_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <unordered_set>
#include <utility>

#include "files/vrml/read/vrml_header.h"
#include "files/vrml/read/vrml_tallies.h"

namespace icome::files {
namespace {

enum class Character : unsigned char { Word, Blank, Comment, Quote, Open, Close };

constexpr std::array<Character, 256> characters() {
  std::array<Character, 256> table{};
  for (const unsigned char c : std::string_view(" \t\r\n,")) table[c] = Character::Blank;
  for (const unsigned char c : std::string_view("{[")) table[c] = Character::Open;
  for (const unsigned char c : std::string_view("}]")) table[c] = Character::Close;
  table['#'] = Character::Comment;
  table['"'] = Character::Quote;
  return table;
}

constexpr std::array<Character, 256> kCharacters = characters();

Character character(char c) { return kCharacters[static_cast<unsigned char>(c)]; }

bool makes_motions(std::string_view type) {
  return type == "TimeSensor" || type == "PositionInterpolator" || type == "OrientationInterpolator" ||
         type == "ScalarInterpolator";
}

bool begins_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

/// Goes through the tokens of a text once.
class VrmlScan {
 public:
  VrmlScan(std::string_view text, bool tells_unknown, const VrmlTaken& taken)
      : text_(text),
        tells_unknown_(tells_unknown),
        taken_(taken),
        line_end_(text.find('\n') == std::string_view::npos ? '\r' : '\n') {}

  /// False when it is nested too deeply.
  bool run() {
    const char* const end = text_.data() + text_.size();
    for (at_ = text_.data(); at_ != end;) {
      switch (character(*at_)) {
        case Character::Word:
          word();
          break;
        case Character::Blank:
          ++at_;
          break;
        case Character::Comment:
          at_ = std::find_if(at_, end, [](char c) { return c == '\n' || c == '\r'; });
          break;
        case Character::Quote:
          string();
          break;
        case Character::Open:
          if (!open()) return false;
          break;
        case Character::Close:
          close();
          break;
      }
    }
    return true;
  }

  VrmlLeftOut take(const std::string& of) { return {std::move(scripts_), tallies_.remarks(of)}; }

  /// Line of the current position, from 1.
  int line() {
    const char* const counted_to = text_.data() + counted_to_;
    line_ += static_cast<int>(std::count(counted_to, at_, line_end_));
    counted_to_ = position();
    return line_;
  }

 private:
  /// Kind of an open brace or bracket.
  enum class Frame : unsigned char { Plain, Proto, Script };

  std::size_t position() const { return static_cast<std::size_t>(at_ - text_.data()); }

  void word() {
    const char* const end = text_.data() + text_.size();
    const char* const begin = at_;
    while (at_ != end && character(*at_) == Character::Word) ++at_;
    if (begins_number(*begin)) return forget_words();
    words_[2] = words_[1];
    words_[1] = words_[0];
    words_[0] = {begin, static_cast<std::size_t>(at_ - begin)};
    if (words_[1] == "PROTO" || words_[1] == "EXTERNPROTO") protos_.insert(words_[0]);
    if (words_[0] == "USE" || words_[0] == "IS") script_refers_ = true;
    if (words_[0] == "ROUTE") route();
  }

  void route() {
    const int here = line();
    if (const auto taken = taken_.routes.find(here); taken != taken_.routes.end())
      taken_.routes.erase(taken);
    else
      tallies_.add(words_[0], VrmlFate::Route, here);
  }

  void string() {
    const char* const end = text_.data() + text_.size();
    for (++at_; at_ != end && *at_ != '"'; ++at_) {
      if (*at_ == '\\' && at_ + 1 != end) ++at_;
    }
    if (at_ != end) ++at_;
    forget_words();
  }

  bool open() {
    if (frames_.size() == std::size_t{kMostNestedVrml}) return false;
    Frame frame = Frame::Plain;
    const bool is_interface = *at_ == '[' && (words_[1] == "PROTO" || words_[1] == "EXTERNPROTO");
    const bool is_body = *at_ == '{' && words_[0].empty();
    if (is_interface || is_body) frame = Frame::Proto;
    if (*at_ == '{' && !is_body) frame = node();
    if (frame == Frame::Proto) ++protos_around_;
    if (frame == Frame::Script && ++scripts_around_ == 1) begin_script();
    frames_.push_back(frame);
    ++at_;
    forget_words();
    return true;
  }

  void close() {
    ++at_;
    forget_words();
    if (frames_.empty()) return;  // the parser reports that
    const Frame frame = frames_.back();
    frames_.pop_back();
    if (frame == Frame::Proto) --protos_around_;
    if (frame == Frame::Script && --scripts_around_ == 0) end_script();
  }

  /// Counts the type before a brace.
  Frame node() {
    const std::string_view type = words_[0];
    if (type == "Script") return Frame::Script;
    const VrmlFate fate = fate_of(type);
    if (words_[2] == "DEF" && makes_motions(type) && taken_.nodes.contains(words_[1])) return Frame::Plain;
    if (protos_.count(type) == 0 && (tells_unknown_ || fate != VrmlFate::Unknown))
      tallies_.add(type, fate, line());
    return Frame::Plain;
  }

  void begin_script() {
    const bool has_name = words_[2] == "DEF";
    script_begin_ = offset(has_name ? words_[2] : words_[0]);
    script_name_ = has_name ? words_[1] : std::string_view();
    script_line_ = line();
    script_refers_ = false;
  }

  void end_script() {
    const std::string_view source = text_.substr(script_begin_, position() - script_begin_);
    if (protos_around_ > 0) {
      tallies_.add("Script", VrmlFate::ProtoScript, script_line_);
    } else if (script_refers_) {
      tallies_.add("Script", VrmlFate::BoundScript, script_line_);
    } else {
      tallies_.add("Script", VrmlFate::Kept, script_line_);
      scripts_.push_back({std::string(script_name_), std::string(source), script_line_});
    }
  }

  std::size_t offset(std::string_view word) const {
    return static_cast<std::size_t>(word.data() - text_.data());
  }
  void forget_words() { words_ = {}; }

  std::string_view text_;
  bool tells_unknown_;
  VrmlTaken taken_;  // those still to be met
  char line_end_;
  const char* at_ = nullptr;
  std::array<std::string_view, 3> words_;  // adjacent words before here, the last one first
  std::vector<Frame> frames_;
  std::unordered_set<std::string_view> protos_;
  int protos_around_ = 0;
  int scripts_around_ = 0;
  std::size_t script_begin_ = 0;
  std::string_view script_name_;
  int script_line_ = 0;
  bool script_refers_ = false;  // to something around it?
  std::vector<VrmlScript> scripts_;
  VrmlTallies tallies_;
  std::size_t counted_to_ = 0;
  int line_ = 1;  // at counted_to_
};

}  // namespace

base::Result<VrmlLeftOut> scan_vrml(std::string_view text, const std::string& name, const std::string& of,
                                    const VrmlTaken& taken) {
  const bool is_part = !of.empty();
  const auto header = find_vrml_header(text);
  if (!header && !is_part) return base::fail(fmt::format("{}: {}", name, header.error().message));
  VrmlScan scan(text, !is_part, taken);
  if (!scan.run())
    return base::fail(fmt::format("{}:{}: braces and brackets lie more than {} deep within each other", name,
                                  scan.line(), kMostNestedVrml));
  return scan.take(of);
}

}  // namespace icome::files
