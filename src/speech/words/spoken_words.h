#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace icome::speech {

/// The words of a sentence as they are heard: small letters, without punctuation, numbers as words ("25" is
/// "twenty five", "1.5" is "one point five"), and each word of `same` replaced by the other one.
std::vector<std::string> spoken_words(std::string_view sentence,
                                      const std::map<std::string, std::string, std::less<>>& same = {});

/// The words with blanks between them.
std::string joined_words(const std::vector<std::string>& words);

/// The whole number in words: "one hundred twenty". Precondition: below 1000.
std::string number_words(unsigned number);

}  // namespace icome::speech
