#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/records/data_folder.h"
#include "study/run/steps.h"

namespace icome::study {

/// What the study itself says on a page, in the person's language.
struct PageText {
  std::string title;
  std::string body;  // paragraphs, parted by empty lines; may be empty
};
PageText page_text(const Study& study, const Participant& participant, const Step& step);

/// One person's session: what is next, and what was done, which is on disk before the next begins. The study
/// outlives it.
class SessionRun {
 public:
  /// Seconds since the person's session began, by whatever clock it runs.
  using Clock = std::function<double()>;
  /// Begins the session or goes on with it; `now` is the date and time, ISO 8601. Fails as SessionLog::add().
  static base::Result<SessionRun> begin(const Study& study, SessionLog log, Clock clock,
                                        const std::string& now);

  const Study& study() const { return *study_; }
  const Participant& participant() const { return log_.participant(); }
  const Progress& progress() const { return log_.progress(); }
  const std::vector<std::string>& notices() const { return log_.notices(); }
  const Step& step() const { return step_; }
  /// In [0, 1].
  double share() const { return share_done(study(), participant(), progress()); }

  // What was done of the step, which is of that kind; then step() is the next one. Fail as SessionLog::add(),
  // and the step stays.
  base::Result<void> page_read();
  /// One answer for each item of the questionnaire, in their order; "" for none. Fails, naming the question,
  /// on an answer that is none of its choices, no number in its range, or missing where it is required.
  base::Result<void> answered(const std::vector<std::string>& answers);
  base::Result<void> trial_done(const TrialMeasures& measures, const Trace& trace);
  /// Notes that the trial was given up, and why; it stays the step.
  base::Result<void> trial_broken_off(const std::string& why);
  /// The person does not agree to take part: the session has ended, and begin() refuses it from now on.
  base::Result<void> declined();

 private:
  SessionRun(const Study& study, SessionLog log, Clock clock);
  base::Result<void> add(EventRecord event);
  base::Result<void> note_unpractised(std::size_t position);
  base::Result<void> go_on();

  const Study* study_;
  SessionLog log_;
  Clock clock_;
  double step_began_ = 0.0;                // s
  std::optional<double> trial_over_ = {};  // s, of a trial that is not on record yet
  Step step_;
};

/// Why this is no answer to the question; empty: it is one.
std::string why_no_answer(const Item& item, const std::string& answer);

}  // namespace icome::study
