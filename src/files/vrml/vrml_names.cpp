#include "files/vrml/vrml_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "files/vrml/vrml_protos.h"

namespace icome::files {
namespace {

constexpr std::string_view kNotInNames = "\"#'+,.[\\]{}";
constexpr std::string_view kReserved[] = {"PROTO",   "DEF",      "USE",          "IS",   "TRUE",
                                          "FALSE",   "NULL",     "ROUTE",        "TO",   "EXTERNPROTO",
                                          "eventIn", "eventOut", "exposedField", "field"};

bool may_begin_name(char c) { return !(c >= '0' && c <= '9') && c != '-'; }
bool may_be_in_name(char c) { return c > ' ' && c <= '~' && kNotInNames.find(c) == std::string_view::npos; }

}  // namespace

bool is_vrml_name(std::string_view name) {
  return !name.empty() && may_begin_name(name[0]) && std::all_of(name.begin(), name.end(), may_be_in_name) &&
         std::find(std::begin(kReserved), std::end(kReserved), name) == std::end(kReserved);
}

std::string said_by(const std::string& def) { return def.starts_with(kNoName) ? std::string() : def; }

bool VrmlNames::take(const std::string& name) {
  return is_vrml_name(name) && !said_by(name).empty() && taken_.insert(name).second;
}

std::string VrmlNames::take_like(std::string_view wanted) {
  if (wanted.empty()) return take_free(kNoName);
  constexpr std::size_t kLongest = 64;
  std::string name(wanted.substr(0, kLongest));
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !may_be_in_name(c); }, '_');
  if (!is_vrml_name(name) || said_by(name).empty()) name = fmt::format("_{}", name);
  return take_free(name);
}

std::string VrmlNames::take_free(const std::string& name) {
  if (taken_.insert(name).second) return name;
  for (int& last = last_.try_emplace(name, 1).first->second;;) {
    std::string numbered = fmt::format("{}_{}", name, ++last);
    if (taken_.insert(numbered).second) return numbered;
  }
}

}  // namespace icome::files
