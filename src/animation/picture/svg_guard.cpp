#include "animation/picture/svg_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_map>
#include <vector>

#include "drawing/svg/xml_text.h"

namespace icome::animation {
namespace {

using base::fail;
using base::Result;
using drawing::XmlAttribute;
using drawing::XmlNode;

constexpr int kDeepestPictures = 2;  // SVG files in SVG files

/// Properties for which a renderer makes a picture of its own.
constexpr std::array<std::string_view, 7> kLayerWords = {
    "opacity", "mask", "filter", "clip-path", "mix-blend-mode", "isolation", "enable-background"};

bool makes_layer(std::string_view text) {
  return std::ranges::any_of(
      kLayerWords, [&](std::string_view word) { return text.find(word) != std::string_view::npos; });
}

/// The names behind url(# in a text.
std::vector<std::string> urls_in(std::string_view text) {
  std::vector<std::string> names;
  for (std::size_t at = text.find("url("); at != std::string_view::npos; at = text.find("url(", at + 4)) {
    const std::size_t begin = text.find('#', at);
    const std::size_t end = text.find(')', at);
    if (begin == std::string_view::npos || end == std::string_view::npos || begin > end) continue;
    std::string_view name = text.substr(begin + 1, end - begin - 1);
    while (!name.empty() && (name.back() == '"' || name.back() == '\'' || name.back() == ' '))
      name.remove_suffix(1);
    names.emplace_back(name);
  }
  return names;
}

std::optional<std::string> from_base64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    int digit = -1;
    if (c >= 'A' && c <= 'Z') digit = c - 'A';
    if (c >= 'a' && c <= 'z') digit = c - 'a' + 26;
    if (c >= '0' && c <= '9') digit = c - '0' + 52;
    if (c == '+' || c == '-') digit = 62;
    if (c == '/' || c == '_') digit = 63;
    if (c == '=') break;
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    if (digit < 0) return std::nullopt;
    bits = bits << 6U | std::uint32_t(digit);
    if (++count % 4 != 1) bytes += char(bits >> (6 - 2 * ((count + 3) % 4)) & 0xffU);
  }
  return bytes;
}

/// Encodings in which markup is what it is in ASCII, as both parsers know them.
bool has_usual_encoding(std::string_view text) {
  const std::string_view head = text.substr(0, text.find("?>"));
  const std::size_t at = text.find("<?xml") < 4 ? head.find("encoding") : std::string_view::npos;
  if (at == std::string_view::npos) return true;
  const std::size_t begin = head.find_first_of("\"'", at);
  if (begin == std::string_view::npos) return false;
  std::string name;
  for (const char c : head.substr(begin + 1, head.find_first_of("\"'", begin + 1) - begin - 1))
    name += char(c >= 'A' && c <= 'Z' ? c + 32 : c);
  return name == "utf-8" || name == "utf8" || name == "us-ascii" || name == "ascii" ||
         name.starts_with("iso-8859-") || name.starts_with("windows-125");
}

class SvgJudge {
 public:
  SvgJudge(const drawing::XmlText& xml, std::string_view text, int pictures_deep)
      : xml_(xml),
        has_entities_(text.find("<!ENTITY") != std::string_view::npos),
        pictures_deep_(pictures_deep) {}

  Result<SvgCost> judge();

 private:
  /// Costs of an element with all in it: 0 while they are being found.
  struct Known {
    SvgCost cost;
    bool is_found = false;
  };

  void note_names();
  std::optional<SvgCost> cost_of(const XmlNode& node, int depth);
  std::optional<SvgCost> cost_of_parts(const XmlNode& node, int depth);
  std::optional<SvgCost> cost_of_attribute(const XmlNode& node, const XmlAttribute& attribute, int depth);
  std::optional<SvgCost> cost_of_name(const std::string& name, int depth);
  std::optional<SvgCost> cost_of_picture(std::string_view url);
  std::optional<SvgCost> refuse(std::string why) {
    if (why_.empty()) why_ = std::move(why);
    return std::nullopt;
  }

  const drawing::XmlText& xml_;
  bool has_entities_;
  int pictures_deep_;
  bool sheets_make_layers_ = false;
  std::vector<std::string> named_in_sheets_;
  std::unordered_map<std::string, XmlNode> names_;
  std::unordered_map<const void*, Known> known_;
  std::string why_;
};

void SvgJudge::note_names() {
  drawing::for_each_element(xml_.root(), [&](const XmlNode& node) {
    if (const XmlAttribute id = node.attribute("id")) names_.try_emplace(id.value(), node);
    if (drawing::local_name(node.name()) != "style") return;
    for (const XmlNode& part : node.children()) {
      sheets_make_layers_ = sheets_make_layers_ || makes_layer(part.value());
      for (std::string& name : urls_in(part.value())) named_in_sheets_.push_back(std::move(name));
    }
  });
  std::ranges::sort(named_in_sheets_);
  named_in_sheets_.erase(std::ranges::unique(named_in_sheets_).begin(), named_in_sheets_.end());
}

Result<SvgCost> SvgJudge::judge() {
  note_names();
  std::optional<SvgCost> sum = cost_of(xml_.root(), 0);
  // An element that sheets name is drawn within itself never, so once at most on any way.
  for (const std::string& name : named_in_sheets_) {
    if (!sum) break;
    const auto more = cost_of_name(name, 0);
    sum = more ? std::optional(SvgCost{sum->depth + more->depth, sum->layers + more->layers}) : std::nullopt;
  }
  if (sum && sum->depth > kDeepestSvg)
    sum = refuse(fmt::format("it has elements more than {} deep in one another", kDeepestSvg));
  if (sum) return *sum;
  return fail(fmt::format("{}: it cannot be drawn: {}", xml_.name(), why_));
}

std::optional<SvgCost> SvgJudge::cost_of(const XmlNode& node, int depth) {
  // Gradients are followed from one to the next by a loop.
  if (drawing::local_name(node.name()).ends_with("Gradient")) return SvgCost{0, 0};
  if (depth > kDeepestSvg)
    return refuse(fmt::format("it has elements more than {} deep in one another", kDeepestSvg));
  const auto [at, is_new] = known_.try_emplace(node.identity());
  if (!is_new) {
    if (at->second.is_found) return at->second.cost;
    return refuse(
        fmt::format("the element <{}> of line {} is drawn within itself", node.name(), xml_.line_of(node)));
  }
  const auto cost = cost_of_parts(node, depth);
  if (cost) known_[node.identity()] = {*cost, true};
  return cost;
}

std::optional<SvgCost> SvgJudge::cost_of_parts(const XmlNode& node, int depth) {
  const std::string_view kind = drawing::local_name(node.name());
  SvgCost inner{0, 0};
  int all_layers = 0;
  bool is_layer =
      sheets_make_layers_ || kind == "mask" || kind == "pattern" || kind == "filter" || kind == "image";
  const auto take = [&](const std::optional<SvgCost>& part) {
    if (!part) return false;
    inner = {std::max(inner.depth, part->depth), std::max(inner.layers, part->layers)};
    all_layers += std::min(part->layers, 1'000'000 - all_layers);
    return true;
  };
  for (const XmlAttribute& attribute : node.attributes()) {
    const std::string_view name = attribute.name();
    is_layer = is_layer || makes_layer(name) || (name == "style" && makes_layer(attribute.value()));
    if (!take(cost_of_attribute(node, attribute, depth))) return std::nullopt;
  }
  for (const XmlNode& child : node.children()) {
    if (!child.is_element()) {
      if (has_entities_ && kind != "style" &&
          std::string_view(child.value()).find('&') != std::string_view::npos)
        return refuse("it uses entities of its own; save it without");
      continue;
    }
    if (!take(cost_of(child, depth + 1))) return std::nullopt;
    if (kind == "filter") ++all_layers;  // each step's result is kept
  }
  return SvgCost{inner.depth + 1, (kind == "filter" ? all_layers : inner.layers) + (is_layer ? 1 : 0)};
}

std::optional<SvgCost> SvgJudge::cost_of_attribute(const XmlNode& node, const XmlAttribute& attribute,
                                                   int depth) {
  const std::string_view name = attribute.name(), value = attribute.value();
  if (has_entities_ && !name.starts_with("xmlns") && value.find('&') != std::string_view::npos)
    return refuse("it uses entities of its own; save it without");
  const std::string_view kind = drawing::local_name(node.name());
  if (drawing::local_name(name) == "href" && kind != "a") {
    const std::size_t first = value.find_first_not_of(" \t\r\n");
    const std::string_view url = first == std::string_view::npos ? std::string_view() : value.substr(first);
    if (url.starts_with('#')) return cost_of_name(std::string(url.substr(1)), depth + 1);
    return cost_of_picture(url);
  }
  SvgCost most{0, 0};
  for (const std::string& each : urls_in(value)) {
    const auto cost = cost_of_name(each, depth + 1);
    if (!cost) return cost;
    // A mask, a filter and a pattern of one element may be there at a time.
    most = {std::max(most.depth, cost->depth), most.layers + cost->layers};
  }
  return most;
}

std::optional<SvgCost> SvgJudge::cost_of_name(const std::string& name, int depth) {
  const auto found = names_.find(name);
  return found == names_.end() ? SvgCost{0, 0} : cost_of(found->second, depth);
}

std::optional<SvgCost> SvgJudge::cost_of_picture(std::string_view url) {
  const std::string_view head = url.substr(0, std::min(url.find(','), url.size()));
  if (!head.starts_with("data:") || head.find("svg") == std::string_view::npos) return SvgCost{0, 0};
  const auto bytes = head.ends_with("base64") ? from_base64(url.substr(std::min(head.size() + 1, url.size())))
                                              : std::nullopt;
  if (!bytes || pictures_deep_ >= kDeepestPictures)
    return refuse("it has an SVG file in it that cannot be looked into");
  drawing::XmlText xml;
  if (const auto loaded = xml.load(*bytes, "in it"); !loaded || !has_usual_encoding(*bytes))
    return refuse("it has an SVG file in it that cannot be looked into");
  const auto cost = SvgJudge(xml, *bytes, pictures_deep_ + 1).judge();
  return cost ? std::optional(*cost) : refuse(cost.error().message);
}

}  // namespace

Result<SvgCost> svg_cost(std::string_view text, const std::string& name) {
  if (!has_usual_encoding(text)) return fail(fmt::format("{}: it cannot be drawn: save it as UTF-8", name));
  drawing::XmlText xml;
  if (const auto loaded = xml.load(text, name); !loaded) return tl::unexpected(loaded.error());
  return SvgJudge(xml, text, 0).judge();
}

}  // namespace icome::animation
