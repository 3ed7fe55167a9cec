#include "io/file_ending.h"

namespace icome::io {
namespace {

/// The word with its ASCII capitals made small, whatever the machine's language is.
std::string small_letters(std::string word) {
  for (char& letter : word) {
    if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
  }
  return word;
}

}  // namespace

FileEnding ending_of(const std::filesystem::path& path) {
  FileEnding ending{small_letters(path.extension().string())};
  ending.packed = ending.type == ".xz";
  if (ending.packed) ending.type = small_letters(path.stem().extension().string());
  return ending;
}

std::string bare_name(const std::filesystem::path& path) {
  const std::filesystem::path stem = path.stem();
  return ending_of(path).packed ? stem.stem().string() : stem.string();
}

}  // namespace icome::io
