#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/vector.h"
#include "study/definition/trial_plan.h"

namespace icome::study {

/// The measures of a trial.
struct TrialMeasures {
  double time = 0.0;           // s, from the start (the beep) to the end
  double approach_time = 0.0;  // s, until the pointer first came into the vicinity
  double homing_time = 0.0;    // s, from then to the end
  double distance = 0.0;       // m, covered by the pointer from the start on
  int errors = 0;              // wrong touches or choices
  bool completed = true;       // otherwise it was ended by the time limit
};

/// A trial that was done.
struct TrialRecord {
  TrialPlan plan;
  double onset = 0.0;  // s, of the start, since the person's session began
  TrialMeasures measures;
};

enum class EventKind : std::uint8_t {
  Session,  // began; value: the date and time, ISO 8601; name: the devices it is done with
  Resumed,  // after an interruption; value and name likewise
  Page,     // was read; name: see PageKind
  Answer,   // name: "questionnaire.question"; value: level ids (comma between several), number, points, text
  Unpractised,  // the criterion was not met after all attempts
  BrokenOff,    // a trial was given up and is done again; value: why
  Declined,     // the person did not agree to take part, which ends the session
  Over,         // the session is complete
  Said,  // in a trial; name: the words that were heard; value: the thing that was chosen by it, or empty
};

/// An event other than a trial.
struct EventRecord {
  EventKind kind = EventKind::Page;
  double onset = 0.0;        // s, since the person's session began
  double duration = 0.0;     // s
  std::size_t position = 0;  // of the condition in the person's order, where it has to do with one
  std::string name;
  std::string value;
};

/// All that a person has done.
struct Progress {
  std::vector<TrialRecord> trials;
  std::vector<EventRecord> events;
};

/// The pointer at one tick of the servo; stage frame.
struct Sample {
  double time = 0.0;                                            // s, since the start; negative before it
  base::Vector3 tip = base::Vector3::Zero();                    // m
  base::Quaternion orientation = base::Quaternion::Identity();  // stage_from_stylus
  base::Vector3 scp = base::Vector3::Zero();                    // m, equal to the tip if nothing is touched
  base::Vector3 force = base::Vector3::Zero();                  // N, on the hand
  std::uint32_t buttons = 0;                                    // bit i: button i is down
  // Indices of Trace::things, or -1.
  int touched = -1;  // what the tip is against, or pressed into
  int lit = -1;      // what would be chosen now
  int chosen = -1;   // what was chosen in this tick, right or wrong
};

/// The movement of the pointer in six degrees of freedom, over a whole trial.
struct Trace {
  double rate_hz = 1000.0;
  std::string device;               // its name
  std::vector<std::string> things;  // names of the things that Sample::touched may be
  std::vector<Sample> samples;
};

}  // namespace icome::study
