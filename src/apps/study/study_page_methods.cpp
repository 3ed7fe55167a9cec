#include <fmt/format.h>

#include <algorithm>

#include "apps/stats/stats_text.h"
#include "apps/study/study_page_parts.h"
#include "study/definition/conditions.h"
#include "study/definition/counterbalancing.h"
#include "study/definition/needs.h"
#include "study/definition/session_length.h"
#include "study/run/steps.h"
#include "study/simulation/depth_sight.h"
#include "study/simulation/simulated_person.h"

namespace icome::apps {
namespace {

/// "a", "a and b", "a, b and c".
std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text.append(i == 0 ? "" : (i + 1 == parts.size() ? " and " : ", ")).append(parts[i]);
  return text;
}

std::string participants_text(const StudyPage& page) {
  const study::ParticipantSummary& people = page.analysis().participants;
  if (people.people == 0) return "Nobody has taken part.";
  std::string text = fmt::format("{} took part", people_phrase(people.people, page.data().simulated));
  std::vector<std::string> parts;
  for (const study::ControlSummary& summary : people.control) {
    const study::ControlVariable& control = page.data().study.control[summary.variable];
    if (summary.numbers)
      parts.push_back(fmt::format("{}: M = {:.1f}, SD = {}, range {:g}\u2013{:g}",
                                  name_of(control.name, control.id), summary.numbers->mean,
                                  fixed_text(summary.numbers->standard_deviation, 1),
                                  summary.numbers->minimum, summary.numbers->maximum));
    std::string counts;
    for (const auto& [level, count] : summary.counts)
      if (count > 0) counts.append(fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, level));
    if (!counts.empty()) parts.push_back(fmt::format("{}: {}", name_of(control.name, control.id), counts));
  }
  std::string all;
  for (const std::string& part : parts) all.append(all.empty() ? " (" : "; ").append(part);
  text.append(all).append(all.empty() ? "" : ")");
  if (page.data().simulated)
    return fmt::format("{}; {} went through all of the study.", text, people.complete);
  return fmt::format(
      "{}; {} completed the session. [Say how they were recruited and whether they were paid.]", text,
      people.complete);
}

/// The factors of two or more levels: one whose other levels could not be run compares nothing.
std::vector<const study::IndependentVariable*> varied_factors(const study::Study& study, bool between) {
  auto factors = study::factors_of(study, between);
  std::erase_if(factors, [](const auto* factor) { return factor->levels.size() < 2; });
  return factors;
}

/// A sentence on what the study was run without.
std::string left_out_sentence(const study::Study& study) {
  std::vector<std::string> needs;
  for (const std::string& need : study.without) {
    const auto all = study::capabilities();
    const auto found = std::ranges::find(all, need, &study::Capability::id);
    needs.emplace_back(found == all.end() ? std::string_view(need)
                                          : found->what.substr(0, found->what.find(',')));
  }
  if (needs.empty()) return {};
  return fmt::format(" The study was run without {}; levels and scenes that need it, if any, were left out.",
                     joined(needs));
}

std::string design_sentence(const study::Study& study) {
  const auto between = varied_factors(study, true), within = varied_factors(study, false);
  std::vector<std::string> factors;
  for (const auto* const kind : {&within, &between}) {
    for (const study::IndependentVariable* factor : *kind) {
      std::vector<std::string> levels;
      for (const study::Level& level : factor->levels) levels.push_back(name_of(level.name, level.id));
      factors.push_back(fmt::format("{} ({} people: {})", name_of(factor->name, factor->id),
                                    factor->between ? "between" : "within", joined(levels)));
    }
  }
  if (factors.empty()) return "There was one condition, so that nothing was compared.";
  return fmt::format("The design was {}, with the factor{} {}.",
                     !between.empty() && !within.empty() ? "mixed"
                     : within.empty()                    ? "between people"
                                                         : "one of repeated measures",
                     factors.size() == 1 ? "" : "s", joined(factors));
}

/// The least and the most people of a group that had the same order.
struct OrderSpread {
  std::size_t least = 0, most = 0;
};

OrderSpread order_spread(const StudyPage& page) {
  const study::Study& study = page.data().study;
  const auto& orders = page.analysis().participants.orders;
  const std::size_t conditions = study::crossings(study, false).size();
  if (orders.empty()) return {};
  const auto [least, most] = std::ranges::minmax(orders, {}, &study::OrderUse::people);
  const std::size_t all = study::crossings(study, true).size() * study::order_count(study.order, conditions);
  return {orders.size() < all ? 0 : least.people, most.people};
}

std::string order_text(const StudyPage& page) {
  const study::Study& study = page.data().study;
  const study::ParticipantSummary& people = page.analysis().participants;
  if (study.order == study::OrderMethod::Random)
    return " The order of conditions was drawn at random for each person.";
  if (study.order == study::OrderMethod::Fixed) return " Everybody had the conditions in the same order.";
  const OrderSpread spread = order_spread(page);
  const bool equal = spread.least == spread.most;
  const bool full = study.order == study::OrderMethod::Full;
  if (full && equal && people.people > 0 && people.complete == people.people)
    return " All orders of conditions were used equally often.";
  std::string text = full ? " All orders of conditions were to be used equally often"
                          : " The order of conditions was counterbalanced by Latin squares (Williams 1949)";
  if (!equal)
    text += fmt::format("; each order was used by {} to {} people{}", spread.least, spread.most,
                        study::crossings(study, true).size() > 1 ? " of a group" : "");
  return text + ".";
}

std::string balance_text(const StudyPage& page) {
  const study::Study& study = page.data().study;
  std::string text;
  if (study::crossings(study, false).size() > 1) text = order_text(page);
  std::vector<std::string> balanced;
  for (const study::ControlVariable& control : study.control)
    if (control.balanced) balanced.push_back(name_of(control.name, control.id));
  if (!balanced.empty() && study::crossings(study, true).size() > 1)
    text += fmt::format(" People were spread over the groups by minimisation (Pocock and Simon 1975) on {}.",
                        joined(balanced));
  return text;
}

/// Is there something to feel in some trial, with a device that gives forces?
bool gives_forces(const study::Study& study) {
  bool always_set = false;
  for (const study::IndependentVariable& factor : study.independent) {
    if (std::ranges::any_of(factor.levels, [](const auto& level) { return level.forces.value_or(false); }))
      return true;
    always_set = always_set || std::ranges::all_of(
                                   factor.levels, [](const auto& level) { return level.forces.has_value(); });
  }
  return study.task && study.task->forces && !always_set;
}

std::string apparatus_of_simulation(const study::Study& study) {
  std::vector<std::string> missing;
  for (const study::UnmetNeed& need : study::needs_not_simulated(study))
    if (std::ranges::find(missing, need.what) == missing.end()) missing.push_back(need.what);
  std::string text = "There was no device: ICOME moved a simulated hand";
  if (gives_forces(study)) text += ", with forces computed at 1 kHz that nobody felt";
  text += fmt::format(". Depth was seen in the picture to {:g} % of its distance",
                      100.0 * study::DepthSight::kOfPicture);
  const std::vector<std::string> needs = study::all_needs(study);
  const auto asks_for = [&](const char* need) { return std::ranges::find(needs, need) != needs.end(); };
  if (asks_for("stereo")) text += ", better in trials with a picture for each eye";
  if (asks_for("head-tracking"))
    text +=
        fmt::format(", better in trials whose view follows the head, which swayed by {:g} mm to each side",
                    1000.0 * study::DepthSight::kSway);
  if (!missing.empty())
    text += fmt::format(". The study also asks for {}, which {} not there", joined(missing),
                        missing.size() == 1 ? "was" : "were");
  return text + ".";
}

std::string apparatus_text(const StudyPage& page) {
  const study::Study& study = page.data().study;
  if (page.data().simulated) return apparatus_of_simulation(study);
  const std::vector<std::string> ids = study::all_needs(study);
  std::vector<std::string> needs;
  for (const study::Capability& capability : study::capabilities())
    if (std::ranges::find(ids, capability.id) != ids.end())
      needs.emplace_back(capability.what.substr(0, capability.what.find(',')));
  return fmt::format(
      "[Name the device, the display and the computer.] The study was run with ICOME{}.{}",
      gives_forces(study) ? ", with forces computed at 1 kHz [say on which device they were felt]" : "",
      needs.empty() ? "" : fmt::format(" [The study asks for {}: say what was used.]", joined(needs)));
}

std::string criterion_text(const StudyPage& page) {
  const std::optional<study::PracticeCriterion>& criterion = page.data().study.trials.criterion;
  if (!criterion) return {};
  std::string text =
      fmt::format(" Practice went on until {} completed in less than {:g} s each, with at most {} attempts.",
                  criterion->successes == 1 ? std::string("one trial was")
                                            : fmt::format("{} trials were", criterion->successes),
                  criterion->within, criterion->most_attempts);
  const auto& people = page.data().people;
  const auto failed = std::ranges::count_if(people, [](const study::StudyData::Person& person) {
    const auto& events = person.progress.events;
    return std::ranges::find(events, study::EventKind::Unpractised, &study::EventRecord::kind) !=
           events.end();
  });
  if (failed > 0)
    text += fmt::format(" {} had not got there after as many attempts.",
                        people.size() == 1 ? std::string("The only person")
                                           : fmt::format("{} of {} people", failed, people.size()));
  return text;
}

bool is_asked(const study::Study& study, study::AskWhen when) {
  return std::ranges::find(study.questionnaires, when, &study::Questionnaire::when) !=
         study.questionnaires.end();
}

/// "in each condition 3 practice trials and 10 measured trials".
std::string trials_phrase(const study::Study& study) {
  std::vector<std::string> trials;
  if (study.trials.practice > 0)
    trials.push_back(count_text(std::size_t(study.trials.practice), "practice trial"));
  trials.push_back(count_text(study::trials_a_condition(study.trials), "measured trial"));
  const bool several = study::crossings(study, false).size() > 1;
  return fmt::format("{}{}", several ? "in each condition " : "", joined(trials));
}

/// A sentence on the beginning of a session and the trials of a condition.
std::string trials_sentence(const study::Study& study) {
  std::vector<std::string> before;
  if (!study.consent.empty()) before.emplace_back("giving consent");
  if (is_asked(study, study::AskWhen::Before)) before.emplace_back("answering a first questionnaire");
  if (!study.instructions.empty()) before.emplace_back("reading written instructions");
  return fmt::format("{}eople had {}.", before.empty() ? "P" : fmt::format("After {}, p", joined(before)),
                     trials_phrase(study));
}

/// The rests that people had, as their pages were on the screen.
std::string rest_text(const StudyPage& page) {
  const double planned = page.data().study.trials.rest;
  std::size_t rests = 0, shorter = 0;
  double least = planned;
  for (const study::StudyData::Person& person : page.data().people) {
    for (const study::EventRecord& event : person.progress.events) {
      if (event.kind != study::EventKind::Page || event.name != study::page_name(study::PageKind::Rest))
        continue;
      ++rests;
      // A page that is left when its time is over can be a frame short of it.
      if (event.duration < planned - 0.1) ++shorter;
      least = std::min(least, event.duration);
    }
  }
  if (rests == 0)
    return fmt::format(" A rest of {:g} s between conditions was planned; none is on record.", planned);
  if (shorter == 0) return fmt::format(" Between conditions there was a rest of {:g} s or more.", planned);
  return fmt::format(
      " Between conditions a rest of {:g} s was planned; {} of {} were shorter, down to {:.0f} s.", planned,
      shorter, rests, least);
}

/// The procedure of simulated people, and the parts of the protocol that they did not do.
std::string procedure_of_simulation(const StudyPage& page) {
  const study::Study& study = page.data().study;
  const study::Trials& trials = study.trials;
  std::string text = fmt::format("Simulated hands did {}.{}", trials_phrase(study), criterion_text(page));
  text += fmt::format(" Before each trial they were held for {:g} s", study::kSimulatedHold);
  if (trials.hold > 0.0) text += fmt::format("; for people the study has {:g} s", trials.hold);
  text += ".";
  if (study.task)
    text += fmt::format(" A trial that was not done after {:g} s was ended.", study.task->limit);
  text += " Nobody agreed to anything, read anything or rested";
  if (!study.questionnaires.empty()) text += ", and answers to questions were drawn by chance";
  return text + ".";
}

std::string procedure_text(const StudyPage& page) {
  if (page.data().simulated) return procedure_of_simulation(page);
  const study::Study& study = page.data().study;
  const study::Trials& trials = study.trials;
  const bool several = study::crossings(study, false).size() > 1;
  std::string text = trials_sentence(study) + criterion_text(page);
  if (trials.hold > 0.0)
    text += fmt::format(" Before each trial the pointer was held at its start for {:g} s{}.", trials.hold,
                        trials.beep ? ", and a beep told its release" : "");
  if (study.task)
    text += fmt::format(" A trial that was not done after {:g} s was ended.", study.task->limit);
  if (trials.rest > 0.0 && several) text += rest_text(page);
  if (is_asked(study, study::AskWhen::AfterCondition))
    text += several ? " A questionnaire followed each condition." : " A questionnaire followed the trials.";
  if (is_asked(study, study::AskWhen::AfterLast) || is_asked(study, study::AskWhen::End))
    text += " At the end people answered a final questionnaire.";
  return text;
}

std::string measures_text(const study::Study& study) {
  std::vector<std::string> measured, asked;
  for (const study::DependentVariable& variable : study.dependent) {
    if (study::is_measured(variable))
      measured.push_back(quantity_name(variable));
    else if (!variable.from.empty())
      asked.push_back(name_of(variable.name, variable.id));
  }
  std::string text;
  if (!measured.empty()) text += fmt::format("Measured in each trial: {}.", joined(measured));
  if (!asked.empty()) text += fmt::format(" Asked: {}.", joined(asked));
  return text;
}

/// "Wilcoxon's signed rank test (one-sided)", so that a list shows clearly which test is one-sided.
std::string test_phrase(const std::string& test) {
  const std::size_t comma = test.find(", ");
  return comma == std::string::npos ? test
                                    : fmt::format("{} ({})", test.substr(0, comma), test.substr(comma + 2));
}

void add_new(std::vector<std::string>& words, const std::string& word) {
  if (std::ranges::find(words, word) == words.end()) words.push_back(word);
}

std::string tests_text(const StudyPage& page) {
  std::vector<std::string> tests, alphas;
  for (const study::HypothesisResult& result : page.analysis().hypotheses) {
    if (!result.test.result) continue;
    add_new(tests, test_phrase(result.test.result->test));
    add_new(alphas, share_text(page.data().study.hypotheses[result.hypothesis].alpha));
  }
  if (tests.empty()) return {};
  return fmt::format(" Hypotheses were tested by {}, at \u03b1 = {}{}. {}", joined(tests), joined(alphas),
                     alphas.size() > 1 ? ", as the study file has it for each" : "",
                     decision_rule(page.data().study, page.analysis()));
}

/// A sentence on people who are missing in the tests of quantities.
std::string missing_text(const StudyPage& page) {
  const std::size_t people = page.analysis().participants.people;
  std::size_t least = people, most = 0;
  for (const study::ResultTable& table : page.analysis().tables) {
    if (table.within_level) continue;
    for (const study::ResultRow& row : table.rows) {
      if (row.total) continue;
      least = std::min(least, row.people);
      most = std::max(most, row.people);
    }
  }
  if (least >= people) return {};
  return fmt::format(" A person counts in a test who has a number in every condition: {} of {}{}.",
                     least == most ? std::to_string(least) : fmt::format("{} to {}", least, most), people,
                     least == most ? "" : ", by variable");
}

/// Is any P-value one of corrected degrees of freedom?
bool has_correction(const study::Analysis& analysis) {
  const auto corrected = [](const study::Tested& test) {
    return test.result && std::ranges::any_of(test.result->notes, [](const std::string& note) {
             return note.find("Greenhouse") != std::string::npos;
           });
  };
  const bool tables = std::ranges::any_of(analysis.tables, [&](const study::ResultTable& table) {
    return std::ranges::any_of(table.rows, corrected, &study::ResultRow::test);
  });
  return tables || std::ranges::any_of(analysis.hypotheses, corrected, &study::HypothesisResult::test);
}

std::string analysis_text(const StudyPage& page) {
  const study::Study& study = page.data().study;
  const study::ParticipantSummary& people = page.analysis().participants;
  const bool several = study::crossings(study, false).size() > 1;
  std::string text =
      several ? "Trials were averaged for each person and condition" : "Trials were averaged for each person";
  if (people.not_completed > 0)
    text += fmt::format("; {} of {} that were not completed were left out of times", people.not_completed,
                        people.trials);
  text += fmt::format(".{}{}", missing_text(page), tests_text(page));
  if (has_correction(page.analysis()))
    text +=
        " Degrees of freedom of factors of more than two levels within people were corrected after "
        "Greenhouse and Geisser.";
  if (several && std::ranges::any_of(study.dependent, study::is_measured))
    text += " Figures show within-subject confidence intervals (Cousineau 2005; Morey 2008).";
  return text;
}

void write_part(StudyPage& page, const char* title, const std::string& text) {
  if (text.empty()) return;
  page.raw(fmt::format("<p><b>{}.</b> {}{}</p>\n", title, page.stamp(), escaped(text)));
}

}  // namespace

void write_methods(StudyPage& page) {
  const study::Study& study = page.data().study;
  page.heading("Methods, ready to edit");
  write_part(page, "Participants", participants_text(page));
  write_part(page, "Design", design_sentence(study) + balance_text(page) + left_out_sentence(study));
  write_part(page, "Apparatus", apparatus_text(page));
  write_part(page, "Procedure", procedure_text(page));
  write_part(page, "Measures", measures_text(study));
  write_part(page, "Analysis", analysis_text(page));
}

}  // namespace icome::apps
