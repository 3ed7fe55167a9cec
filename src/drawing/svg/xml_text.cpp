#include "drawing/svg/xml_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <pugixml.hpp>

#include "base/shown_text.h"
#include "base/utf8.h"

namespace icome::drawing {

const char* XmlAttribute::name() const { return pugi::xml_attribute(attribute_).name(); }
const char* XmlAttribute::value() const { return pugi::xml_attribute(attribute_).value(); }
XmlAttribute XmlAttribute::next() const {
  return XmlAttribute(pugi::xml_attribute(attribute_).next_attribute().internal_object());
}

const char* XmlNode::name() const { return pugi::xml_node(node_).name(); }
const char* XmlNode::value() const { return pugi::xml_node(node_).value(); }
bool XmlNode::is_element() const { return pugi::xml_node(node_).type() == pugi::node_element; }
XmlAttribute XmlNode::attribute(const char* name) const {
  return XmlAttribute(pugi::xml_node(node_).attribute(name).internal_object());
}
XmlRun<XmlAttribute> XmlNode::attributes() const {
  return XmlRun(XmlAttribute(pugi::xml_node(node_).first_attribute().internal_object()));
}
XmlNode XmlNode::first_child() const {
  return XmlNode(pugi::xml_node(node_).first_child().internal_object());
}
XmlNode XmlNode::next() const { return XmlNode(pugi::xml_node(node_).next_sibling().internal_object()); }
XmlNode XmlNode::element_before() const {
  pugi::xml_node before = pugi::xml_node(node_).previous_sibling();
  while (before && before.type() != pugi::node_element) before = before.previous_sibling();
  return XmlNode(before.internal_object());
}
XmlNode XmlNode::element_after() const {
  pugi::xml_node after = pugi::xml_node(node_).next_sibling();
  while (after && after.type() != pugi::node_element) after = after.next_sibling();
  return XmlNode(after.internal_object());
}
XmlNode XmlNode::parent() const { return XmlNode(pugi::xml_node(node_).parent().internal_object()); }
std::ptrdiff_t XmlNode::offset() const { return pugi::xml_node(node_).offset_debug(); }

XmlText::XmlText() : document_(std::make_unique<pugi::xml_document>()) {}
XmlText::~XmlText() = default;

XmlNode XmlText::root() const { return XmlNode(document_->document_element().internal_object()); }

base::Result<void> XmlText::load(std::string_view text, const std::string& name) {
  name_ = name;
  lines_ = TextLines(text);
  const pugi::xml_parse_result read = document_->load_buffer(text.data(), text.size());
  if (!read)
    return base::fail(fmt::format("{}:{}: it is no sound XML ({}); the file may be cut short or damaged",
                                  name, lines_.line_of(read.offset), read.description()));
  find_namespaces();
  return {};
}

void XmlText::find_namespaces() {
  for_each_element(root(), [&](const XmlNode& node) {
    for (const XmlAttribute attribute : node.attributes()) {
      const std::string_view name = attribute.name();
      if (name == "xmlns") namespaces_.emplace(std::string_view(), attribute.value());
      if (name.starts_with("xmlns:")) namespaces_.emplace(local_name(name), attribute.value());
    }
  });
}

tl::unexpected<base::Error> XmlText::fail_at(const XmlNode& node, const std::string& wrong,
                                             std::size_t behind) const {
  const std::size_t line = lines_.line_of(node.offset() + std::ptrdiff_t(behind));
  return base::fail(fmt::format("{}:{}: {}", name_, line, wrong));
}

std::string quoted_value(std::string_view text) {
  std::string shown = base::shown_text(text);
  std::ranges::replace_if(
      shown, [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return "'" + base::as_utf8(shown) + "'";
}

std::string_view local_name(std::string_view name) {
  const std::size_t colon = name.find(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

std::string_view XmlText::namespace_of(std::string_view name) const {
  const std::size_t colon = name.find(':');
  const auto found = namespaces_.find(name.substr(0, colon == std::string_view::npos ? 0 : colon));
  return found == namespaces_.end() ? std::string_view() : found->second;
}

bool XmlText::declares(std::string_view space) const {
  for (const XmlAttribute attribute : root().attributes())
    if (std::string_view(attribute.name()).starts_with("xmlns:") && attribute.value() == space) return true;
  return false;
}

XmlAttribute XmlText::attribute_of(const XmlNode& node, std::string_view space,
                                   std::string_view local) const {
  for (const XmlAttribute attribute : node.attributes()) {
    const std::string_view name = attribute.name();
    // A name without a prefix is in no namespace.
    if (name.size() > local.size() && local_name(name) == local && namespace_of(name) == space)
      return attribute;
  }
  return {};
}

}  // namespace icome::drawing
