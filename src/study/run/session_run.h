#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/records/data_folder.h"
#include "study/run/steps.h"
#include "study/run/trial_ear.h"

namespace icome::study {

/// The text of the study itself for a page, in the person's language.
struct PageText {
  std::string title;
  std::string body;  // paragraphs, separated by empty lines; may be empty
};
PageText page_text(const Study& study, const Participant& participant, const Step& step);

/// When and with what a session begins or goes on.
struct Occasion {
  std::string time;     // the date and time, ISO 8601
  std::string devices;  // "mouse", or the names of the devices that touch: "Touch, Haply Inverse3"
};

/// One person's session: the next step, and the record of those that were done, which is on disk before the
/// next one begins. The study must outlive it.
class SessionRun {
 public:
  /// Seconds since the person's session began, by any clock.
  using Clock = std::function<double()>;
  /// Begins the session or goes on with it. Fails as SessionLog::add().
  static base::Result<SessionRun> begin(const Study& study, SessionLog log, Clock clock,
                                        const Occasion& occasion);

  const Study& study() const { return *study_; }
  const Participant& participant() const { return log_.participant(); }
  const Progress& progress() const { return log_.progress(); }
  const std::vector<std::string>& notices() const { return log_.notices(); }
  const Step& step() const { return step_; }
  /// The share of the session that is done, in [0, 1].
  double share() const { return share_done(study(), participant(), progress()); }

  // Each of these records a step of its kind as done; step() is the next one then. On failure, as of
  // SessionLog::add(), the step stays.
  base::Result<void> page_read();
  /// One answer for each item of the questionnaire, in their order; "" for none. Fails, naming the question,
  /// on an answer that is not one of its choices, not a number in its range, or missing although required.
  base::Result<void> answered(const std::vector<std::string>& answers);
  base::Result<void> trial_done(const TrialMeasures& measures, const Trace& trace,
                                const std::vector<SaidInTrial>& said = {});
  /// Notes that the trial was given up, and why; the step stays.
  base::Result<void> trial_broken_off(const std::string& why);
  /// The person does not agree to take part: the session has ended, and begin() refuses it from now on.
  base::Result<void> declined();

 private:
  SessionRun(const Study& study, SessionLog log, Clock clock);
  base::Result<void> add(EventRecord event);
  base::Result<void> add_said(const std::vector<SaidInTrial>& said, const Trace& trace, double trial_onset);
  base::Result<void> note_unpractised(std::size_t position);
  base::Result<void> go_on();

  const Study* study_;
  SessionLog log_;
  Clock clock_;
  double step_began_ = 0.0;                // s
  std::optional<double> trial_over_ = {};  // s, the end of a trial that is not on record yet
  Step step_;
};

/// The reason why this is not an answer to the question; empty if it is one.
std::string why_no_answer(const Item& item, const std::string& answer);

}  // namespace icome::study
