#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "base/parse_number.h"
#include "base/shown_text.h"
#include "drawing/svg/xml_text.h"
#include "io/text_scanner.h"
#include "sketch/files/stroke_collector.h"
#include "sketch/files/stroke_formats.h"

namespace icome::sketch {
namespace {

using drawing::local_name;
using drawing::XmlAttribute;
using drawing::XmlNode;
using drawing::XmlText;

constexpr int kDeepestInk = 100;  // groups of traces within one another

enum class InkRole : std::uint8_t { X, Y, Force, Time, Other };

/// One number of every point of a trace, as <channel> tells.
struct InkChannel {
  InkRole role = InkRole::Other;
  double unit = 1.0;          // m, s or share of the full pressure
  bool is_sometimes = false;  // intermittent: points may leave it out
};
using InkFormat = std::vector<InkChannel>;

/// A channel while its values are read: W3C InkML 2011, 4.2.
struct ChannelState {
  enum class Mode : std::uint8_t { Explicit, First, Second };
  Mode mode = Mode::Explicit;
  double value = 0.0, speed = 0.0;

  void take(double number) {
    if (mode == Mode::Explicit) {
      value = number;
      return;
    }
    speed = mode == Mode::First ? number : speed + number;
    value += speed;
  }
};

std::optional<double> ink_length_unit(std::string_view units) {
  static constexpr std::array<std::pair<std::string_view, double>, 8> kUnits = {{{"mm", 1e-3},
                                                                                 {"cm", 1e-2},
                                                                                 {"m", 1.0},
                                                                                 {"in", 0.0254},
                                                                                 {"pt", 0.0254 / 72.0},
                                                                                 {"pc", 0.0254 / 6.0},
                                                                                 {"himetric", 1e-5},
                                                                                 {"um", 1e-6}}};
  for (const auto& [name, metres] : kUnits)
    if (io::same_word(name, units)) return metres;
  return std::nullopt;
}

std::optional<double> ink_time_unit(std::string_view units) {
  if (io::same_word(units, "s")) return 1.0;
  if (io::same_word(units, "ms")) return 1e-3;
  if (io::same_word(units, "us")) return 1e-6;
  if (io::same_word(units, "ns")) return 1e-9;
  return std::nullopt;
}

InkRole ink_role(std::string_view name) {
  if (name == "X") return InkRole::X;
  if (name == "Y") return InkRole::Y;
  if (name == "F") return InkRole::Force;
  return name == "T" ? InkRole::Time : InkRole::Other;
}

/// Splits the text of a trace into points and those into values, and follows the differences.
class TraceText {
 public:
  explicit TraceText(std::string_view text) : text_(text) {}

  bool more_points() { return skip_blanks(), at_ < text_.size(); }
  /// Reads a point into the states. Returns what is wrong, or nothing.
  std::optional<std::string> read_point(std::vector<ChannelState>& states, std::size_t least);
  std::size_t place() const { return at_; }

 private:
  void skip_blanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }
  bool take(char c) {
    const bool is_there = text_.substr(at_).starts_with(c);
    at_ += is_there ? 1 : 0;
    return is_there;
  }
  bool read_value(ChannelState& state);

  std::string_view text_;
  std::size_t at_ = 0;
};

/// One value with its prefix; false where there is none.
bool TraceText::read_value(ChannelState& state) {
  using Mode = ChannelState::Mode;
  if (take('!'))
    state.mode = Mode::Explicit;
  else if (take('\''))
    state.mode = Mode::First;
  else if (take('"'))
    state.mode = Mode::Second;
  skip_blanks();
  // Values that are repeated or unknown stay as they were, as do the buttons, which are true or false.
  if (take('*') || take('?') || take('T') || take('F')) return true;
  const std::string_view rest = text_.substr(at_);
  if (rest.starts_with('#')) {
    const auto number = base::number_at_front<std::int64_t>(rest.substr(1), 16);
    if (!number.good()) return false;
    state.take(double(number.value));
    at_ = text_.size() - number.rest.size();
    return true;
  }
  const std::size_t first = rest.find_first_not_of("+-");
  if (first > 1 || std::string_view("0123456789.").find(rest[first]) == std::string_view::npos) return false;
  const auto number = base::number_at_front<double>(rest);
  if (!number.good()) return false;
  state.take(number.value);
  at_ = text_.size() - number.rest.size();
  return true;
}

std::optional<std::string> TraceText::read_point(std::vector<ChannelState>& states, std::size_t least) {
  std::size_t count = 0;
  for (skip_blanks(); at_ < text_.size() && text_[at_] != ','; skip_blanks(), ++count) {
    if (count == states.size())
      return fmt::format("a point of the trace has more than its {} channels", states.size());
    if (!read_value(states[count]))
      return io::quoted(text_.substr(at_, text_.substr(at_).find_first_of(" ,\r\n\t"))) +
             " is no number of a trace";
  }
  if (count < least)
    return fmt::format("a point of the trace has {} of its {} numbers{}", count, least,
                       at_ == text_.size() ? ": it may be cut short" : "");
  take(',');
  return std::nullopt;
}

class InkReader {
 public:
  InkReader(const XmlText& xml, StrokeCollector& collector) : xml_(xml), collector_(collector) {}

  base::Result<void> read();
  void tell_notes();

 private:
  base::Result<void> index(const XmlNode& above, int depth);
  base::Result<void> read_inside(const XmlNode& above, const InkFormat& around, int depth);
  base::Result<void> read_trace(const XmlNode& trace, const InkFormat& format);
  base::Result<void> read_points(const XmlNode& text, const InkFormat& format);
  base::Result<InkFormat> format_of(const XmlNode& description);
  base::Result<InkChannel> channel_of(const XmlNode& channel);
  XmlNode find_format(const XmlNode& node, int depth) const;
  base::Result<InkFormat> format_named(const XmlNode& node, const InkFormat& around);
  PenSample sample_of(const std::vector<ChannelState>& states, const InkFormat& format) const;

  const XmlText& xml_;
  StrokeCollector& collector_;
  std::map<std::string, XmlNode, std::less<>> named_;  // by xml:id
  std::vector<XmlNode> formats_;
  std::map<const void*, InkFormat> known_;                    // by the node that describes it
  std::map<std::string, InkFormat, std::less<>> by_context_;  // by contextRef
  std::map<std::string, std::size_t> told_;                   // sentences and how often they hold
};

void InkReader::tell_notes() {
  for (const auto& [sentence, count] : told_)
    collector_.note(count == 1 ? sentence : fmt::format("{} ({} times)", sentence, count));
}

base::Result<void> InkReader::index(const XmlNode& above, int depth) {
  for (const XmlNode node : above.children()) {
    if (depth > kDeepestInk)
      return xml_.fail_at(node,
                          fmt::format("elements lie more than {} deep within one another", kDeepestInk));
    if (const XmlAttribute id = node.attribute("xml:id")) named_.emplace(id.value(), node);
    if (local_name(node.name()) == "traceFormat") formats_.push_back(node);
    if (const auto inside = index(node, depth + 1); !inside) return inside;
  }
  return {};
}

base::Result<InkChannel> InkReader::channel_of(const XmlNode& channel) {
  InkChannel result;
  const std::string_view name = channel.attribute("name").value();
  const std::string_view units = channel.attribute("units").value();
  result.role = ink_role(name);
  const bool has_unit = !units.empty() && !io::same_word(units, "dev");
  std::optional<double> unit = 1.0;
  if (result.role == InkRole::X || result.role == InkRole::Y) {
    unit = has_unit ? ink_length_unit(units) : kMetresOfMm;
    if (!has_unit) ++told_["lengths without a unit are taken as mm"];
  } else if (result.role == InkRole::Time) {
    const bool is_whole = channel.attribute("type").value() == std::string_view("integer");
    unit = has_unit ? ink_time_unit(units) : is_whole ? 1e-3 : 1.0;
    if (!has_unit) ++told_[fmt::format("times without a unit are taken as {}", is_whole ? "ms" : "s")];
  } else if (result.role == InkRole::Other) {
    ++told_[fmt::format("the channel {} is skipped", io::quoted(name))];
  }
  if (!unit)
    return xml_.fail_at(channel, fmt::format("the unit {} of channel {} is unknown: write mm, cm, m, in or "
                                             "himetric, or s or ms of times",
                                             io::quoted(units), name));
  result.unit = *unit;
  if (const XmlAttribute most = channel.attribute("max"); most && result.role == InkRole::Force) {
    const double full = base::parse_finite(most.value()).value_or(0.0);
    if (!(full > 0.0))
      return xml_.fail_at(
          channel, fmt::format("the max {} of channel F is no number above 0", io::quoted(most.value())));
    result.unit = 1.0 / full;
  }
  return result;
}

base::Result<InkFormat> InkReader::format_of(const XmlNode& description) {
  if (const auto known = known_.find(description.identity()); known != known_.end()) return known->second;
  InkFormat format;
  const auto add = [&](const XmlNode& node, bool is_sometimes) -> base::Result<void> {
    if (local_name(node.name()) != "channel") return {};
    auto channel = channel_of(node);
    if (!channel) return tl::unexpected(channel.error());
    channel->is_sometimes = is_sometimes;
    format.push_back(*channel);
    return {};
  };
  for (const XmlNode node : description.children())
    if (const auto added = add(node, false); !added) return tl::unexpected(added.error());
  for (const XmlNode node : description.children()) {
    if (local_name(node.name()) != "intermittentChannels") continue;
    for (const XmlNode inner : node.children())
      if (const auto added = add(inner, true); !added) return tl::unexpected(added.error());
  }
  const auto count = [&](InkRole role) { return std::ranges::count(format, role, &InkChannel::role); };
  if (count(InkRole::X) != 1 || count(InkRole::Y) != 1)
    return xml_.fail_at(description, "a trace format has one channel X and one channel Y");
  return known_[description.identity()] = format;
}

/// The <traceFormat> that a node is, has or refers to; none where it tells of none.
XmlNode InkReader::find_format(const XmlNode& node, int depth) const {
  constexpr int kMostReferences = 8;
  if (!node || depth > kMostReferences) return {};
  if (local_name(node.name()) == "traceFormat") return node;
  for (const char* const reference : {"contextRef", "traceFormatRef", "inkSourceRef"}) {
    std::string_view id = node.attribute(reference).value();
    if (id.starts_with('#')) id.remove_prefix(1);
    const auto found = id.empty() ? named_.end() : named_.find(id);
    if (found == named_.end()) continue;
    if (const XmlNode format = find_format(found->second, depth + 1)) return format;
  }
  for (const XmlNode inner : node.children()) {
    const std::string_view name = local_name(inner.name());
    if (name != "traceFormat" && name != "inkSource" && name != "context") continue;
    if (const XmlNode format = find_format(inner, depth + 1)) return format;
  }
  return {};
}

/// The format that holds for a trace or group: what its contextRef names, else that of what is around it.
base::Result<InkFormat> InkReader::format_named(const XmlNode& node, const InkFormat& around) {
  const XmlAttribute context = node.attribute("contextRef");
  if (!context) return around;
  if (const auto known = by_context_.find(std::string_view(context.value())); known != by_context_.end())
    return known->second;
  const XmlNode found = find_format(node, 0);
  if (!found)
    ++told_[fmt::format("contextRef {} names no trace format here and is skipped",
                        io::quoted(context.value()))];
  auto format = found ? format_of(found) : around;
  if (format) by_context_[context.value()] = *format;
  return format;
}

PenSample InkReader::sample_of(const std::vector<ChannelState>& states, const InkFormat& format) const {
  PenSample sample;
  sample.time = kSampleSpacing * double(collector_.sample_count());
  for (std::size_t i = 0; i < format.size(); ++i) {
    const double value = states[i].value * format[i].unit;
    if (format[i].role == InkRole::X) sample.place.x() = value;
    if (format[i].role == InkRole::Y) sample.place.y() = value;
    if (format[i].role == InkRole::Time) sample.time = value;
    if (format[i].role == InkRole::Force) sample.pressure = value;
  }
  return sample;
}

base::Result<void> InkReader::read_points(const XmlNode& text, const InkFormat& format) {
  TraceText trace(text.value());
  std::vector<ChannelState> states(format.size());
  const auto least = std::size_t(std::ranges::count(format, false, &InkChannel::is_sometimes));
  while (trace.more_points()) {
    const std::size_t place = trace.place();
    if (const auto wrong = trace.read_point(states, least)) return xml_.fail_at(text, *wrong, place);
    const auto added = collector_.add(sample_of(states, format));
    if (!added) return xml_.fail_at(text, added.error().message, place);
  }
  return {};
}

base::Result<void> InkReader::read_trace(const XmlNode& trace, const InkFormat& around) {
  const std::string_view type = trace.attribute("type").value();
  if (type == "penUp" || type == "indeterminate") {
    ++told_[fmt::format("a trace of type {} is no stroke and is skipped", io::quoted(type))];
    return {};
  }
  if (trace.attribute("brushRef")) ++told_["the brush of a trace is skipped"];
  const auto format = format_named(trace, around);
  if (!format) return tl::unexpected(format.error());
  for (const XmlNode text : trace.children())
    if (const auto read = read_points(text, *format); !read) return read;
  // A trace that is to be continued is one stroke with the next one.
  const std::string_view continuation = trace.attribute("continuation").value();
  if (continuation != "begin" && continuation != "middle") collector_.lift();
  return {};
}

base::Result<void> InkReader::read_inside(const XmlNode& above, const InkFormat& around, int depth) {
  InkFormat current = around;
  for (const XmlNode node : above.children()) {
    const std::string_view name = local_name(node.name());
    if (name == "trace") {
      if (const auto read = read_trace(node, current); !read) return read;
    } else if (name == "traceGroup") {
      const auto format = format_named(node, current);
      if (!format) return tl::unexpected(format.error());
      if (const auto read = read_inside(node, *format, depth + 1); !read) return read;
    } else if (name == "traceFormat" || name == "context") {
      const XmlNode found = find_format(node, 0);
      if (!found) continue;
      const auto format = format_of(found);
      if (!format) return tl::unexpected(format.error());
      current = *format;
    } else if (name == "traceView") {
      ++told_["a traceView is skipped"];
    }
  }
  return {};
}

base::Result<void> InkReader::read() {
  const XmlNode root = xml_.root();
  if (local_name(root.name()) != "ink")
    return xml_.fail_at(root, fmt::format("it is no InkML, which begins with <ink>, but <{}>",
                                          base::shown_text(root.name())));
  if (const auto indexed = index(root, 0); !indexed) return indexed;
  InkFormat format(2);
  format[0] = {InkRole::X, kMetresOfMm};
  format[1] = {InkRole::Y, kMetresOfMm};
  // One format alone is meant for all traces, wherever it stands and though nothing refers to it.
  if (formats_.size() == 1) {
    auto only = format_of(formats_.front());
    if (!only) return tl::unexpected(only.error());
    format = std::move(*only);
  } else if (formats_.empty()) {
    ++told_["lengths without a unit are taken as mm"];
  }
  return read_inside(root, format, 0);
}

}  // namespace

base::Result<StrokesRead> read_inkml_strokes(std::string_view text, const std::string& name) {
  XmlText xml;
  if (const auto loaded = xml.load(text, name); !loaded) return tl::unexpected(loaded.error());
  StrokeCollector collector(name);
  InkReader reader(xml, collector);
  if (const auto read = reader.read(); !read) return tl::unexpected(read.error());
  reader.tell_notes();
  return collector.finish(0.0);
}

}  // namespace icome::sketch
