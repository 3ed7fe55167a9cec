#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>

#include "base/result.h"
#include "drawing/svg/text_lines.h"

namespace pugi {
class xml_document;
struct xml_attribute_struct;
struct xml_node_struct;
}  // namespace pugi

namespace icome::drawing {

/// A run of attributes or nodes, one after another.
template <typename Item>
class XmlRun {
 public:
  class Iterator {
   public:
    explicit Iterator(Item item) : item_(item) {}
    Item operator*() const { return item_; }
    Iterator& operator++() {
      item_ = item_.next();
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    Item item_;
  };

  explicit XmlRun(Item first) : first_(first) {}
  Iterator begin() const { return Iterator(first_); }
  Iterator end() const { return Iterator(Item()); }

 private:
  Item first_;
};

/// An attribute of an XmlText, which owns it, or none: then it is false, and its texts are empty.
class XmlAttribute {
 public:
  XmlAttribute() = default;
  explicit XmlAttribute(pugi::xml_attribute_struct* attribute) : attribute_(attribute) {}

  const char* name() const;
  const char* value() const;
  XmlAttribute next() const;
  explicit operator bool() const { return attribute_ != nullptr; }
  bool operator==(const XmlAttribute&) const = default;

 private:
  pugi::xml_attribute_struct* attribute_ = nullptr;
};

/// An element or text of an XmlText, which owns it, or none: then it is false, and its texts are empty.
class XmlNode {
 public:
  XmlNode() = default;
  explicit XmlNode(pugi::xml_node_struct* node) : node_(node) {}

  const char* name() const;
  const char* value() const;  ///< of text
  bool is_element() const;
  XmlAttribute attribute(const char* name) const;
  XmlRun<XmlAttribute> attributes() const;
  XmlRun<XmlNode> children() const { return XmlRun<XmlNode>(first_child()); }
  XmlNode first_child() const;
  XmlNode next() const;            ///< beside it
  XmlNode element_before() const;  ///< beside it, or none
  XmlNode element_after() const;   ///< likewise
  XmlNode parent() const;
  std::ptrdiff_t offset() const;  ///< byte of the file, -1 where it is not known
  const void* identity() const { return node_; }
  explicit operator bool() const { return node_ != nullptr; }
  bool operator==(const XmlNode&) const = default;

 private:
  pugi::xml_node_struct* node_ = nullptr;
};

/// An XML file with the lines of its elements, as InkML and SVG need it. Entities of a document type are not
/// expanded, so that a small file stays small.
class XmlText {
 public:
  XmlText();
  ~XmlText();
  /// `text` is not needed afterwards. Fails with name and line on what is no XML.
  base::Result<void> load(std::string_view text, const std::string& name);

  /// The first element; its name is in `root().name()`.
  XmlNode root() const;
  const std::string& name() const { return name_; }
  std::size_t line_of(const XmlNode& node) const { return lines_.line_of(node.offset()); }
  /// The failed result: file, line of the node (and of a place behind its start), what is wrong.
  tl::unexpected<base::Error> fail_at(const XmlNode& node, const std::string& wrong,
                                      std::size_t behind = 0) const;

  /// The namespace that a name's prefix stands for; empty where it stands for none. A prefix means the same
  /// in all of the file, what it is declared as first.
  std::string_view namespace_of(std::string_view name) const;
  /// Has the outermost element a prefix for the namespace?
  bool declares(std::string_view space) const;
  /// The attribute of that local name in a namespace, whatever prefix stands for it.
  XmlAttribute attribute_of(const XmlNode& node, std::string_view space, std::string_view local) const;

 private:
  void find_namespaces();

  std::unique_ptr<pugi::xml_document> document_;
  std::string name_;
  TextLines lines_{std::string_view()};
  std::unordered_map<std::string_view, std::string_view> namespaces_;  // by prefix
};

/// Calls `use` with every element of a document, in its order.
template <typename Use>
void for_each_element(XmlNode root, const Use& use) {
  XmlNode node = root;
  while (node) {
    if (node.is_element()) use(node);
    if (node.first_child()) {
      node = node.first_child();
      continue;
    }
    while (node && node != root && !node.next()) node = node.parent();
    node = node == root ? XmlNode() : node.next();
  }
}

/// Text of an attribute made fit for a message: between quotes, shortened, without line ends.
std::string quoted_value(std::string_view text);

/// "trace" of "inkml:trace".
std::string_view local_name(std::string_view name);

}  // namespace icome::drawing
