#include "study/run/session_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parse_number.h"
#include "stats/tables/data_table.h"
#include "study/records/record_rows.h"

namespace icome::study {
namespace {

/// Times on record are in microseconds.
double in_ticks(double seconds) { return std::round(seconds * 1e6) / 1e6; }

std::string text_for(const Text& text, const Participant& participant) {
  return text.empty() ? std::string() : text[participant.language];
}

std::vector<std::string_view> parts_of(std::string_view list) {
  std::vector<std::string_view> parts;
  while (!list.empty()) {
    const std::size_t end = std::min(list.find(','), list.size());
    parts.push_back(list.substr(0, end));
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  return parts;
}

std::string why_no_number(const Item& item, const std::string& answer) {
  const auto number = base::parse_finite(answer);
  if (!number) return "write a number";
  if (item.least && *number < *item.least) return fmt::format("write a number from {:g} on", *item.least);
  if (item.most && *number > *item.most) return fmt::format("write a number up to {:g}", *item.most);
  return {};
}

std::string why_no_rating(const Item& item, const std::string& answer) {
  const auto number = base::parse_finite(answer);
  const bool fits = number && *number == std::floor(*number) && *number >= 1.0 && *number <= item.points;
  return fits ? std::string() : fmt::format("choose from 1 to {}", item.points);
}

std::string why_no_choice(const Item& item, const std::string& answer) {
  const auto parts = parts_of(answer);
  const bool known = std::ranges::all_of(parts, [&](std::string_view part) {
    return std::ranges::find(item.choices, part, &Level::id) != item.choices.end();
  });
  if (!known) return "choose one of the answers";
  return item.kind == ItemKind::Choice && parts.size() > 1 ? "choose one answer only" : "";
}

}  // namespace

std::string why_no_answer(const Item& item, const std::string& answer) {
  if (answer.empty()) return item.required ? "answer this question" : "";
  switch (item.kind) {
    case ItemKind::Choice:
    case ItemKind::Choices:
      return why_no_choice(item, answer);
    case ItemKind::Rating:
      return why_no_rating(item, answer);
    case ItemKind::Number:
      return why_no_number(item, answer);
    case ItemKind::OpenText:
      break;
  }
  return {};
}

PageText page_text(const Study& study, const Participant& participant, const Step& step) {
  const std::string title = text_for(study.title, participant);
  if (step.page == PageKind::Consent) return {title, text_for(study.consent, participant)};
  // The names of the conditions would reveal what is being compared.
  if (step.page != PageKind::Instructions) return {title, {}};
  const std::string goal = text_for(study.goal, participant);
  const std::string instructions = text_for(study.instructions, participant);
  const bool both = !goal.empty() && !instructions.empty();
  return {title, fmt::format("{}{}{}", goal, both ? "\n\n" : "", instructions)};
}

SessionRun::SessionRun(const Study& study, SessionLog log, Clock clock)
    : study_(&study),
      log_(std::move(log)),
      clock_([clock = std::move(clock)] { return in_ticks(clock()); }) {}

base::Result<SessionRun> SessionRun::begin(const Study& study, SessionLog log, Clock clock,
                                           const Occasion& occasion) {
  SessionRun run(study, std::move(log), std::move(clock));
  run.step_began_ = run.clock_();
  if (has_event(run.progress(), EventKind::Declined))
    return base::fail(
        fmt::format("{} did not agree to take part; nobody is asked twice.", run.participant().id));
  const bool fresh = run.progress().events.empty() && run.progress().trials.empty();
  if (!has_ended(run.progress())) {
    EventRecord event;
    event.kind = fresh ? EventKind::Session : EventKind::Resumed;
    event.name = occasion.devices;
    event.value = occasion.time;
    if (const auto added = run.add(std::move(event)); !added) return tl::unexpected(added.error());
  }
  if (const auto gone_on = run.go_on(); !gone_on) return tl::unexpected(gone_on.error());
  return run;
}

/// Records an event that began with the step and is over now.
base::Result<void> SessionRun::add(EventRecord event) {
  event.onset = step_began_;
  event.duration = in_ticks(clock_() - step_began_);
  return log_.add(event);
}

/// Notes that practice has ended without its criterion being met.
base::Result<void> SessionRun::note_unpractised(std::size_t position) {
  const bool noted = std::ranges::any_of(progress().events, [&](const EventRecord& event) {
    return event.kind == EventKind::Unpractised && event.position == position;
  });
  if (noted || is_practised(study(), progress(), position)) return {};
  EventRecord event;
  event.kind = EventKind::Unpractised;
  event.position = position;
  return add(std::move(event));
}

/// Goes on to the next step, once the last one is on record. Events that follow from the record are noted
/// here, so that a kill or a full disk between the two costs nothing.
base::Result<void> SessionRun::go_on() {
  const Step next = next_step(study(), participant(), progress());
  const bool practice_is_over = next.kind == Step::Kind::Page && next.page == PageKind::Measured;
  if (practice_is_over)
    if (const auto noted = note_unpractised(next.position); !noted) return noted;
  if (next.kind == Step::Kind::Over && !has_event(progress(), EventKind::Over)) {
    EventRecord over;
    over.kind = EventKind::Over;
    if (const auto added = add(std::move(over)); !added) return added;
  }
  step_ = next;
  step_began_ = clock_();
  trial_over_.reset();
  return {};
}

base::Result<void> SessionRun::page_read() {
  EventRecord event;
  event.kind = EventKind::Page;
  event.name = page_name(step_.page);
  event.position = step_.position;
  if (const auto added = add(std::move(event)); !added) return added;
  return go_on();
}

base::Result<void> SessionRun::answered(const std::vector<std::string>& answers) {
  const Questionnaire& questionnaire = study().questionnaires[step_.questionnaire];
  for (std::size_t i = 0; i < questionnaire.items.size(); ++i) {
    const Item& item = questionnaire.items[i];
    const std::string why = i < answers.size() ? why_no_answer(item, answers[i]) : "answer this question";
    if (!why.empty()) return base::fail(fmt::format("{}: {}.", text_for(item.text, participant()), why));
  }
  for (std::size_t i = 0; i < questionnaire.items.size(); ++i) {
    EventRecord event;
    event.kind = EventKind::Answer;
    event.name = fmt::format("{}.{}", questionnaire.id, questionnaire.items[i].id);
    event.position = step_.position;
    event.value = answers[i];
    // After an interruption some answers are on record already.
    if (answer_of(progress(), event.name, event.position) != nullptr) continue;
    if (const auto added = add(std::move(event)); !added) return added;
  }
  return go_on();
}

/// Records what was said in a trial, but for what is on record already after a failure.
base::Result<void> SessionRun::add_said(const std::vector<SaidInTrial>& said, const Trace& trace,
                                        double trial_onset) {
  for (const SaidInTrial& one : said) {
    EventRecord event{EventKind::Said,
                      in_ticks(trial_onset + one.begin),
                      in_ticks(one.end - one.begin),
                      step_.position,
                      one.heard,
                      {}};
    if (one.thing >= 0) event.value = trace.things[std::size_t(one.thing)];
    const bool is_known = std::ranges::any_of(progress().events, [&](const EventRecord& it) {
      return it.kind == EventKind::Said && it.onset == event.onset && it.name == event.name;
    });
    if (is_known) continue;
    if (const auto added = log_.add(event); !added) return added;
  }
  return {};
}

base::Result<void> SessionRun::trial_done(const TrialMeasures& measures, const Trace& trace,
                                          const std::vector<SaidInTrial>& said) {
  if (!trial_over_) trial_over_ = clock_();  // at the first attempt to record it
  const double onset = in_ticks(*trial_over_ - measures.time);
  if (const auto added = add_said(said, trace, onset); !added) return added;
  const bool recorded = !progress().trials.empty() && progress().trials.back().plan == step_.trial;
  if (!recorded) {
    TrialRecord record;
    record.plan = step_.trial;
    record.measures = measures;
    record.onset = onset;
    if (const auto added = log_.add(record, trace); !added) return added;
  }
  return go_on();
}

base::Result<void> SessionRun::trial_broken_off(const std::string& why) {
  EventRecord event;
  event.kind = EventKind::BrokenOff;
  event.position = step_.position;
  event.value = why;
  return add(std::move(event));
}

base::Result<void> SessionRun::declined() {
  EventRecord event;
  event.kind = EventKind::Declined;
  return add(std::move(event));
}

}  // namespace icome::study
