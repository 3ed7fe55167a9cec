#include "interaction/operations/toml_value.h"

namespace icome::interaction {

Value value_from_toml(const io::TomlNode& node) {
  switch (node.kind) {
    case io::TomlNode::Kind::Table: {
      Value::Fields fields;
      for (const io::TomlMember& member : node.members)
        fields.emplace_back(member.key, value_from_toml(member.value));
      return fields;
    }
    case io::TomlNode::Kind::Array: {
      Value::List list;
      for (const io::TomlNode& element : node.elements) list.push_back(value_from_toml(element));
      return list;
    }
    case io::TomlNode::Kind::Number:
      return node.number;
    case io::TomlNode::Kind::Boolean:
      return node.boolean;
    case io::TomlNode::Kind::String:
    case io::TomlNode::Kind::Date:
      break;
  }
  return node.text;
}

}  // namespace icome::interaction
