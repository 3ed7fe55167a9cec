#include "study/definition/study_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/definition/study_parts.h"

namespace icome::study {
namespace {

constexpr double kMostPeople = 100000.0;
constexpr int kLargestSeed = 2147483647;

/// Can the tag be that of a language in BCP 47, such as "en", "nl" or "pt-BR"?
bool is_language(const std::string& tag) { return is_id(tag) && tag.size() >= 2 && tag.size() <= 35; }

std::vector<std::string> read_languages(const TomlNode& root, Problems& problems) {
  const std::vector<std::string> none;
  KeyReader keys(root, "the study", none, problems);
  std::vector<std::string> languages = keys.strings("languages");
  for (std::size_t i = 0; i < languages.size(); ++i) {
    if (!is_language(languages[i]))
      problems.add(keys.place_of("languages"),
                   fmt::format("the study: languages holds '{}'; write their short names, such as en or nl.",
                               languages[i]));
    if (std::find(languages.begin(), languages.begin() + std::ptrdiff_t(i), languages[i]) !=
        languages.begin() + std::ptrdiff_t(i))
      problems.add(keys.place_of("languages"),
                   fmt::format("the study: languages holds '{}' twice.", languages[i]));
  }
  if (languages.empty()) {
    problems.add(keys.place_of("languages"), "the study: languages is missing; write languages = [\"en\"].");
    languages.emplace_back("en");
  }
  return languages;
}

void read_head(KeyReader& keys, Study& study) {
  study.name = keys.id("name");
  study.title = keys.text("title", true);
  study.authors = keys.strings("authors");
  study.contact = keys.plain("contact");
  study.goal = keys.text("goal", false);
  study.consent = keys.text("consent", false);
  study.instructions = keys.text("instructions", false);
  study.needs = read_needs(keys);
  study.needs_place = keys.place_of("needs");
  study.participants = std::size_t(keys.whole("participants", 0, 1, int(kMostPeople)));
  study.seed = std::uint64_t(keys.whole("seed", 1, 0, kLargestSeed));
  study.order = keys.word<OrderMethod>("order",
                                       {{"full", OrderMethod::Full},
                                        {"latin-square", OrderMethod::LatinSquare},
                                        {"random", OrderMethod::Random},
                                        {"fixed", OrderMethod::Fixed}},
                                       OrderMethod::LatinSquare);
}

}  // namespace

base::Result<Study> read_study(std::string_view text, const std::string& source) {
  const auto root = io::parse_toml(text, source);
  if (!root) return tl::unexpected(root.error());
  Problems problems;
  Study study;
  study.languages = read_languages(*root, problems);
  KeyReader keys(*root, "the study", study.languages, problems);
  keys.strings("languages");  // known, and read above
  read_head(keys, study);
  read_variables(keys, study);
  study.task = read_task(keys, study.languages);
  read_trials(keys, study.languages, study.trials);
  read_questionnaires(keys, study);
  keys.finish();
  check_references(study, problems);
  if (!problems.none()) return base::fail(problems.text(source));
  study.hash = io::toml_hash(*root);
  return study;
}

}  // namespace icome::study
