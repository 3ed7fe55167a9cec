#include "speech/words/own_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::speech {
namespace {

using base::Result;

constexpr std::uint64_t kLongestWords = 1'000'000;  // bytes

void put_in(std::vector<WordMeaning>& words, WordMeaning word) {
  std::erase_if(words, [&](const WordMeaning& it) { return it.words == word.words; });
  words.push_back(std::move(word));
}

std::string table_text(const std::string& name, const std::vector<WordMeaning>& words, const char* quote) {
  if (words.empty()) return {};
  std::string text = fmt::format("\n[words.{}]\n", name);
  for (const WordMeaning& word : words)
    text += fmt::format("\"{}\" = {}{}{}\n", word.words, quote, word.meaning, quote);
  return text;
}

}  // namespace

std::filesystem::path OwnWords::usual_file() {
  const char* const config = std::getenv("XDG_CONFIG_HOME");
  if (config != nullptr && *config == '/') return std::filesystem::path(config) / "icome" / "words.toml";
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home != '/') return {};
  return std::filesystem::path(home) / ".config" / "icome" / "words.toml";
}

Result<OwnWords> OwnWords::open(std::filesystem::path file) {
  OwnWords words;
  words.file_ = std::move(file);
  std::error_code error;
  if (words.file_.empty() || !std::filesystem::exists(words.file_, error)) return words;
  const auto text = io::read_bytes(words.file_, kLongestWords);
  if (!text) return tl::unexpected(text.error());
  Vocabulary read;
  if (const auto added = add_vocabulary(read, *text, words.file_.string()); !added)
    return tl::unexpected(added.error());
  words.colours_ = read.table("own-colour");
  words.sizes_ = read.table("own-size");
  return words;
}

Result<void> OwnWords::add_colour(const std::string& words, const std::string& hex) {
  put_in(colours_, {words, {}, hex});
  return write();
}

Result<void> OwnWords::add_size(const std::string& words, double metres) {
  put_in(sizes_, {words, {}, fmt::format("{}", metres)});
  return write();
}

Result<bool> OwnWords::forget(const std::string& words) {
  const auto is_it = [&](const WordMeaning& it) { return it.words == words; };
  if (std::erase_if(colours_, is_it) + std::erase_if(sizes_, is_it) == 0) return false;
  const auto written = write();
  return written ? Result<bool>(true) : tl::unexpected(written.error());
}

Result<void> OwnWords::write() const {
  if (file_.empty()) return {};
  std::error_code error;
  std::filesystem::create_directories(file_.parent_path(), error);
  auto out = io::NewFile::create(file_);
  if (!out) return tl::unexpected(out.error());
  out->write(
      "# Words of one's own for the voice commands of ICOME: \"word\" = colour, or the largest extent in "
      "metres.\n" +
      table_text("own-colour", colours_, "\"") + table_text("own-size", sizes_, ""));
  return out->finish();
}

}  // namespace icome::speech
