#include "files/gltf/json_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace icome::files {
namespace {

using nlohmann::json;

constexpr std::size_t kDeepestNesting = 64;  // the model's extras are read and freed by recursion
constexpr std::uint64_t kBytesOfObject = 1200;
constexpr std::uint64_t kBytesOfValue = 200;

/// Counts values while the text is parsed; the names of its functions are the library's.
class JsonLook final : public nlohmann::json_sax<json> {
 public:
  JsonLook(std::string_view text, std::uint64_t memory_limit) : text_(text), limit_(memory_limit) {}

  bool null() override { return count(kBytesOfValue); }
  bool boolean(bool) override { return count(kBytesOfValue); }
  bool number_integer(number_integer_t) override { return count(kBytesOfValue); }
  bool number_unsigned(number_unsigned_t) override { return count(kBytesOfValue); }
  bool number_float(number_float_t, const string_t&) override { return count(kBytesOfValue); }
  bool string(string_t& value) override { return count(kBytesOfValue + 4 * value.size()); }
  bool binary(binary_t&) override { return false; }

  bool key(string_t& name) override {
    if (depth_ == 1) top_ = name;
    if (top_ == "buffers" && depth_ == 3 && name == "uri") has_uri_ = true;
    return count(2 * name.size());
  }
  bool start_object(std::size_t) override {
    if (depth_ == 2) has_uri_ = false;
    return enter() && count(kBytesOfObject);
  }
  bool end_object() override {
    --depth_;
    if (depth_ == 2 && top_ == "buffers" && !has_uri_) ++shape_.own_buffers;
    return true;
  }
  bool start_array(std::size_t) override { return enter() && count(kBytesOfValue); }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception&) override {
    const std::size_t at = std::min(position, text_.size());
    const auto line = 1 + std::count(text_.begin(), text_.begin() + std::ptrdiff_t(at), '\n');
    error_ = fmt::format("line {} of its JSON is malformed", line);
    return false;
  }

  const std::string& error() const { return error_; }
  const JsonShape& shape() const { return shape_; }

 private:
  bool enter() {
    if (++depth_ <= kDeepestNesting) return true;
    error_ = fmt::format("its JSON nests deeper than {} levels", kDeepestNesting);
    return false;
  }
  bool count(std::uint64_t bytes) {
    ++shape_.values;
    shape_.memory_estimate += bytes;
    if (shape_.memory_estimate <= limit_) return true;
    error_ = "its JSON describes more than there is memory for";
    return false;
  }

  std::string_view text_;
  std::uint64_t limit_;
  std::size_t depth_ = 0;
  std::string top_;  // the member of the outermost object that is being read
  bool has_uri_ = false;
  JsonShape shape_;
  std::string error_;
};

}  // namespace

base::Result<JsonShape> look_at_json(std::string_view text, std::uint64_t memory_limit) {
  JsonLook look(text, memory_limit);
  if (json::sax_parse(text.begin(), text.end(), &look)) return look.shape();
  return base::fail(look.error().empty() ? "its JSON is malformed" : look.error());
}

}  // namespace icome::files
