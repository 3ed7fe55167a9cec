// Coin keeps every name that it reads in 1,999 lists and searches one of them for each word of a file, so
// that a design of 100,000 named nodes takes three times as long as one without names. The dynamic linker
// takes these two functions, which Coin calls for that, from the program instead; a Coin that calls other
// functions remains as slow as before.
#include <string>
#include <string_view>
#include <unordered_set>

namespace {

struct TextHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
};

/// Elements of an unordered_set keep their addresses. Lives as long as the process.
auto& coin_names() {
  static auto* const kNames = new std::unordered_set<std::string, TextHash, std::equal_to<>>();
  return *kNames;
}

}  // namespace

extern "C" {

const char* cc_namemap_get_address(const char* text);
const char* cc_namemap_peek_string(const char* text);

/// The unique address of this text, for as long as the process lives.
const char* cc_namemap_get_address(const char* text) {
  const auto known = coin_names().find(std::string_view(text));
  return (known != coin_names().end() ? known : coin_names().emplace(text).first)->c_str();
}

/// Null: nobody has asked for the address of this text.
const char* cc_namemap_peek_string(const char* text) {
  const auto known = coin_names().find(std::string_view(text));
  return known == coin_names().end() ? nullptr : known->c_str();
}
}
