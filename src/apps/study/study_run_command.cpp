#include "apps/study/study_run_command.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>

#include "apps/design/design_work.h"
#include "apps/desktop/device_choice.h"
#include "apps/interrupt.h"
#include "apps/terminal.h"
#include "base/parse_number.h"
#include "io/file_bytes.h"
#include "study/definition/needs.h"
#include "study/definition/scene_check.h"
#include "study/definition/study_reader.h"
#include "study/records/data_folder.h"
#include "study/run/session_run.h"
#include "study/simulation/simulation.h"
#include "ui/study/study_window.h"

namespace icome::apps {
namespace {

constexpr std::uint64_t kLargestStudyFile = 16U << 20U;  // bytes
constexpr std::uint64_t kLargestScene = 1U << 30U;       // bytes

/// The study without the parts that need more than a pointer.
base::Result<study::Study> pointer_alone(const study::Study& study) {
  std::vector<std::string> needs;
  for (const study::UnmetNeed& need : study::needs_beyond_pointer(study))
    if (std::ranges::find(needs, need.id) == needs.end()) needs.push_back(need.id);
  return study::without_needs(study, needs);
}

/// The study as the options have it run; fails, with the reasons, where it cannot be run.
base::Result<OpenedStudy> study_to_run(const StudyOptions& options) {
  auto opened = open_study(options.file);
  if (!opened) return opened;
  if (options.pointer_alone) {
    auto alone = pointer_alone(opened->study);
    if (!alone) return tl::unexpected(alone.error());
    opened->study = std::move(*alone);
  }
  study::StudyCheck check = study::check_study(opened->study);
  study::check_scenes(opened->study, opened->folder, check);
  const auto unmet = study::unmet_needs(opened->study);
  std::string why;
  const std::string name = options.file.string();
  // Reasons begin with unmet needs, and simulated people need no devices.
  for (std::size_t i = options.simulate > 0 ? unmet.size() : 0; i < check.reasons.size(); ++i)
    why += fmt::format(" {}", check.reasons[i].sentence);
  const auto needs = study::all_needs(opened->study);
  const bool lacks_head = options.simulate == 0 && options.devices.head.empty() &&
                          std::ranges::find(needs, "head-tracking") != needs.end();
  if (why.empty() && lacks_head)
    return base::fail(fmt::format(
        "{} needs head-tracking: name the tracker with --head (icome devices lists them), or leave "
        "what needs it out with --pointer-only; --simulate needs no devices.",
        name));
  if (why.empty()) return opened;
  if (!unmet.empty() && options.simulate == 0)
    why += " With --pointer-only what needs these is left out; --simulate needs no devices.";
  return base::fail(fmt::format("{} cannot be run as it is:{}", name, why));
}

std::filesystem::path data_folder(const StudyOptions& options) {
  if (!options.data.empty()) return options.data;
  return options.file.parent_path() / fmt::format("{}-{}{}", options.file.stem().string(),
                                                  options.pointer_alone ? "pointer-" : "",
                                                  options.simulate > 0 ? "simulated" : "data");
}

/// The files of scenes and of their elements as they are now.
base::Result<std::vector<study::SceneFile>> scenes_of(const OpenedStudy& opened) {
  std::vector<study::SceneFile> files;
  for (const std::string& name : study::stage_files(opened.study)) {
    auto bytes = io::read_bytes(opened.folder / name, kLargestScene);
    if (!bytes) return tl::unexpected(bytes.error());
    files.push_back({name, std::move(*bytes)});
  }
  return files;
}

base::Result<study::DataFolder> open_data(const StudyOptions& options, const OpenedStudy& opened) {
  const auto scenes = scenes_of(opened);
  if (!scenes) return tl::unexpected(scenes.error());
  return study::DataFolder::open(opened.study, opened.text, data_folder(options), options.simulate > 0,
                                 *scenes);
}

struct TrialCount {
  std::size_t all = 0, ended = 0;  // ended: by the time limit
};

TrialCount count_trials(const study::StudyData& data) {
  TrialCount count;
  for (const study::StudyData::Person& person : data.people)
    for (const study::TrialRecord& trial : person.progress.trials) {
      ++count.all;
      count.ended += trial.measures.completed ? 0 : 1;
    }
  return count;
}

int simulate_people(const StudyOptions& options, const OpenedStudy& opened) {
  StatusLine status;
  auto data = open_data(options, opened);
  if (!data) return end_without_result(data.error(), status);
  catch_interrupts();
  const auto show = [&](double share) {
    status.progress("Simulating", std::round(1000.0 * share) / 10.0, 100.0, "%");
    return !interrupted();
  };
  const auto done = study::simulate(opened.study, opened.folder, *data, options.simulate, show);
  status.clear();
  if (!done) return end_without_result(done.error(), status);
  if (interrupted()) {
    tell("interrupted; the same command goes on with what is done.");
    return kDesignInterrupted;
  }
  const auto records = study::read_study_data(data->path());
  if (!records) return end_without_result(records.error(), status);
  const TrialCount trials = count_trials(*records);
  if (trials.ended > 0)
    tell(fmt::format("{} of {} trials were ended by the time limit: can a hand get to all targets?",
                     trials.ended, trials.all));
  if (options.json) {
    const nlohmann::ordered_json answer = {
        {"study", opened.study.name},       {"simulated", true},    {"folder", data->path().string()},
        {"participants", options.simulate}, {"trials", trials.all}, {"ended_by_limit", trials.ended}};
    return print_answer(answer.dump(2) + "\n");
  }
  return print_answer(fmt::format(
      "{} SIMULATED {} through the study; nobody took part. Data: {}\nNext: icome study report {}\n",
      options.simulate, options.simulate == 1 ? "person is" : "people are", data->path().string(),
      data->path().string()));
}

base::Result<std::size_t> language_of(const study::Study& study, const std::string& language) {
  const auto found = std::ranges::find(study.languages, language);
  if (language.empty()) return 0;
  if (found != study.languages.end()) return std::size_t(found - study.languages.begin());
  return base::fail(fmt::format("the study has no texts in '{}'; there are {}.", language,
                                fmt::join(study.languages, ", ")));
}

std::string possible_values(const study::ControlVariable& variable) {
  if (variable.levels.empty())
    return variable.unit.empty() ? "NUMBER" : fmt::format("NUMBER ({})", variable.unit);
  std::string all;
  for (const study::Level& level : variable.levels) all.append(all.empty() ? "" : "|").append(level.id);
  return all;
}

/// The answers of --with, in the order of the study's variables; "n/a" for those not given.
base::Result<std::vector<std::string>> control_answers(const study::Study& study,
                                                       const std::vector<std::string>& with) {
  std::vector<std::string> answers(study.control.size(), "n/a");
  for (const std::string& said : with) {
    const std::string id = said.substr(0, said.find('='));
    const auto found = std::ranges::find(study.control, id, &study::ControlVariable::id);
    if (found == study.control.end() || id.size() == said.size())
      return base::fail(
          fmt::format("--with {}: write a control variable of the study and its value, such as "
                      "age=31.",
                      said));
    std::string& answer = answers[std::size_t(found - study.control.begin())];
    if (answer != "n/a") return base::fail(fmt::format("--with {}: {} is given twice.", said, id));
    answer = said.substr(id.size() + 1);
  }
  std::string missing;
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (study.control[i].balanced && answers[i] == "n/a")
      missing += fmt::format(" --with {}={}", study.control[i].id, possible_values(study.control[i]));
  if (!missing.empty())
    return base::fail(fmt::format("groups are balanced by what people bring along; give{}.", missing));
  return answers;
}

std::string names_of(const std::vector<study::Participant>& people) {
  std::string names;
  for (const study::Participant& person : people) names.append(names.empty() ? "" : ", ").append(person.id);
  return names;
}

/// The person who is to go on.
base::Result<study::Participant> to_resume(const study::DataFolder& data, const StudyOptions& options) {
  if (options.participant) return data.find(*options.participant);
  const auto unfinished = data.unfinished();
  if (!unfinished) return tl::unexpected(unfinished.error());
  if (unfinished->size() == 1) return unfinished->front();
  if (unfinished->empty())
    return base::fail("nobody has begun without being through; start with icome study run.");
  return base::fail(fmt::format("several have begun: {}; say who goes on, as --participant {}.",
                                names_of(*unfinished), unfinished->front().id));
}

constexpr double kLongestBreak = 366.0 * 86400.0;  // s; a clock that says more is wrong

using Moment = std::chrono::sys_time<std::chrono::milliseconds>;

Moment now() { return std::chrono::floor<std::chrono::milliseconds>(std::chrono::system_clock::now()); }

std::string text_of(Moment moment) {
  const auto whole = std::chrono::floor<std::chrono::seconds>(moment);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", whole, (moment - whole).count());
}

/// The moment whose text_of() is this text; nothing for other text.
std::optional<Moment> moment_of(std::string_view text) {
  std::array<int, 7> numbers{};
  constexpr std::string_view kBehind = "--T::.Z";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto read = base::number_at_front<int>(text);
    if (!read.good() || !read.rest.starts_with(kBehind[i])) return {};
    numbers[i] = read.value;
    text = read.rest.substr(1);
  }
  const auto [year, month, day, hour, minute, second, millisecond] = numbers;
  std::tm parts = {};
  parts.tm_year = year - 1900;
  parts.tm_mon = month - 1;
  parts.tm_mday = day;
  parts.tm_hour = hour;
  parts.tm_min = minute;
  parts.tm_sec = second;
  return Moment(std::chrono::seconds(timegm(&parts)) + std::chrono::milliseconds(millisecond));
}

/// Seconds since the person's session began, going on evenly while this program runs.
study::SessionRun::Clock clock_of(const study::Progress& progress) {
  double before = 0.0;  // s
  for (const study::EventRecord& event : progress.events) {
    if (event.kind != study::EventKind::Session) continue;
    if (const auto began = moment_of(event.value))
      before = std::clamp(std::chrono::duration<double>(now() - *began).count(), 0.0, kLongestBreak);
  }
  const auto since = std::chrono::steady_clock::now();
  return [before, since] {
    return before + std::chrono::duration<double>(std::chrono::steady_clock::now() - since).count();
  };
}

base::Result<study::SessionRun> begin_session(const StudyOptions& options, const OpenedStudy& opened,
                                              study::DataFolder& data, const std::string& devices) {
  const auto language = language_of(opened.study, options.language);
  if (!language) return tl::unexpected(language.error());
  base::Result<study::Participant> person = base::fail("");
  if (options.task == "resume") {
    person = to_resume(data, options);
  } else {
    const auto control = control_answers(opened.study, options.with);
    if (!control) return tl::unexpected(control.error());
    person = data.enrol(options.participant, *language, *control);
  }
  if (!person) return tl::unexpected(person.error());
  auto log = data.open_log(*person);
  if (!log) return tl::unexpected(log.error());
  for (const std::string& notice : log->notices()) tell(notice);
  auto clock = clock_of(log->progress());
  return study::SessionRun::begin(opened.study, std::move(*log), std::move(clock),
                                  {.time = text_of(now()), .devices = devices});
}

/// Tells how the person's session ended, and what comes next.
void tell_end(const StudyOptions& options, const study::DataFolder& data, const std::string& id,
              bool through) {
  const std::string folder = data.path().string();
  if (through) {
    print(fmt::format("{} is through. Data: {}\nNext: icome study report {}\n", id, folder, folder));
    return;
  }
  const auto unfinished = data.unfinished();
  if (unfinished && std::ranges::find(*unfinished, id, &study::Participant::id) == unfinished->end()) {
    print(fmt::format("{} did not agree to take part, which is noted in {}.\n", id, folder));
    return;
  }
  const std::string where = options.data.empty() ? std::string() : fmt::format(" --data {}", folder);
  print(fmt::format(
      "{} is not through; what is done is kept. Go on with: icome study resume {} --participant {}{}{}\n", id,
      options.file.string(), id, where, options.pointer_alone ? " --pointer-only" : ""));
}

/// Warns of forces that nobody feels, before somebody takes part.
void tell_of_forces(const study::Study& study) {
  const auto gives = [](const study::Level& level) { return level.forces.value_or(false); };
  const bool varied = std::ranges::any_of(study.independent, [&](const study::IndependentVariable& factor) {
    return std::ranges::any_of(factor.levels, gives);
  });
  if (varied)
    tell(
        "no force-feedback device was chosen (--device): the mouse or a pen drives a simulated hand, which "
        "forces "
        "push, and which nobody feels. Do not take such data for a study of force feedback.");
}

/// Leaves the mouse's hand out beside devices: what a person does is done with these alone.
void use_devices_alone(session::SessionSettings& settings) {
  for (session::PointerConnection& it : settings.connections)
    settings.pointers.push_back(std::make_unique<devices::MappedDevice>(std::move(it.device), it.mapping));
  settings.connections.clear();
}

/// The devices of a session, as they name themselves: what the person's data were taken with.
std::string names_of(const session::SessionSettings& settings) {
  std::string names;
  for (const auto& it : settings.pointers) names += (names.empty() ? "" : ", ") + it->info().name;
  return names.empty() ? "mouse" : names;
}

/// Fails for resume where there are no data yet.
base::Result<void> check_begun(const StudyOptions& options) {
  std::error_code failed;
  const std::filesystem::path folder = data_folder(options);
  if (options.task != "resume" || std::filesystem::is_directory(folder, failed)) return {};
  return base::fail(fmt::format("{}: there are no data; begin with icome study run.", folder.string()));
}

/// The microphone of trials that need speech. Fails where it cannot be heard, and where it is named for
/// nothing.
base::Result<speech::OpenSource> microphone_of(const StudyOptions& options, const study::Study& study) {
  const std::vector<std::string> needs = study::all_needs(study);
  if (std::ranges::find(needs, "speech") == needs.end()) {
    if (options.microphone.empty()) return speech::OpenSource();
    return base::fail("--microphone is for studies that need speech, and this one does not.");
  }
  speech::OpenSource source = speech::source_of(options.microphone);
  if (const auto heard = source(); !heard)
    return base::fail("Nothing can be heard in trials, and --microphone names no recording: " +
                      heard.error().message);
  return source;
}

int run_person(int argc, char** argv, const StudyOptions& options, const OpenedStudy& opened) {
  StatusLine status;
  if (const auto begun = check_begun(options); !begun) return end_without_result(begun.error(), status);
  auto microphone = microphone_of(options, opened.study);
  if (!microphone) return end_without_result(microphone.error(), status);
  catch_interrupts();
  auto settings = session_settings(options.devices);
  if (!settings) return end_without_result(settings.error(), status);
  use_devices_alone(*settings);
  const std::string devices = names_of(*settings);
  ui::StudyWindowOptions window;
  window.full_screen = !options.in_window;
  window.microphone = std::move(*microphone);
  window.interrupted = [] { return interrupted(); };
  std::string id;
  std::optional<study::DataFolder> data;  // opened once there is a display, without which nothing begins
  const int code = ui::run_study_window(argc, argv, window, opened.folder, std::move(*settings), [&] {
    auto folder = open_data(options, opened);
    if (!folder) return base::Result<study::SessionRun>(tl::unexpected(folder.error()));
    data.emplace(std::move(*folder));
    auto run = begin_session(options, opened, *data, devices);
    if (run) id = run->participant().id;
    if (run && options.devices.pointers.empty()) tell_of_forces(opened.study);
    return run;
  });
  if (!id.empty()) tell_end(options, *data, id, code == 0);
  return code;
}

}  // namespace

base::Result<OpenedStudy> open_study(const std::filesystem::path& file) {
  auto bytes = io::read_bytes(file, kLargestStudyFile);
  if (!bytes) return tl::unexpected(bytes.error());
  auto study = study::read_study(*bytes, file.string());
  if (!study) return tl::unexpected(study.error());
  return OpenedStudy{std::move(*study), std::move(*bytes), file.parent_path()};
}

int run_study_session(int argc, char** argv, const StudyOptions& options) {
  const auto opened = study_to_run(options);
  if (!opened) {
    StatusLine status;
    return end_without_result(opened.error(), status);
  }
  return options.simulate > 0 ? simulate_people(options, *opened) : run_person(argc, argv, options, *opened);
}

}  // namespace icome::apps
