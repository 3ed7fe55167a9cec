#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "speech/words/vocabulary.h"

namespace icome::speech {

/// The words that a person made for colours and sizes (thesis 8.2), kept in a file of theirs, if there is
/// one.
class OwnWords {
 public:
  /// Words that are forgotten at the end.
  OwnWords() = default;
  /// Those of the file, which need not be there yet. Fails, naming the line, where it is not such a file.
  static base::Result<OwnWords> open(std::filesystem::path file);
  /// icome/words.toml in $XDG_CONFIG_HOME or ~/.config; empty where there is neither.
  static std::filesystem::path usual_file();

  const std::vector<WordMeaning>& colours() const { return colours_; }  // "#rrggbb"
  const std::vector<WordMeaning>& sizes() const { return sizes_; }      // m

  /// Changes from now on are forgotten at the end.
  void keep_nothing() { file_.clear(); }

  /// Keeps the word, in place of one of the same name. Fails where the file cannot be written; it is known
  /// until the end then.
  base::Result<void> add_colour(const std::string& words, const std::string& hex);
  base::Result<void> add_size(const std::string& words, double metres);
  /// False: there is no such word.
  base::Result<bool> forget(const std::string& words);

 private:
  base::Result<void> write() const;

  std::filesystem::path file_;
  std::vector<WordMeaning> colours_, sizes_;
};

}  // namespace icome::speech
