#include "ui/study/study_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QPainter>
#include <QScreen>
#include <QShortcut>
#include <QStackedWidget>
#include <QTimer>
#include <QVBoxLayout>
#include <cmath>
#include <cstdio>

#include "base/terminal_text.h"
#include "sound/sound_output.h"
#include "study/definition/session_length.h"
#include "ui/look/theme.h"
#include "ui/study/start_tone.h"
#include "ui/study/study_page.h"
#include "ui/study/study_questions.h"
#include "ui/study/study_scene.h"
#include "ui/window/connect_display.h"

namespace icome::ui {

using session::SessionEvent;
using study::Step;
using State = study::TrialStage::State;

namespace {

constexpr int kThrough = 0;
constexpr int kUnfinished = 3;
constexpr int kToneRate = 48000;   // Hz
constexpr double kLetters = 15.0;  // points: readable at arm's length

/// A thin line that shows how much is done.
class ShareLine final : public QWidget {
 public:
  explicit ShareLine(QWidget* parent) : QWidget(parent) {
    setObjectName("study.share");
    setFixedHeight(kGrid);
  }

  void show_share(double share) {
    share_ = share;
    update();
  }

 protected:
  void paintEvent(QPaintEvent* /*event*/) override {
    QPainter painter(this);
    painter.fillRect(rect(), colours().grid);
    painter.fillRect(QRectF(0.0, 0.0, share_ * width(), height()), colours().accent);
  }

 private:
  double share_ = 0.0;
};

/// Leads a person through a session: a page for each step that is read or answered, the scene for trials. Run
/// and session outlive it.
class StudyWindow final : public QWidget {
 public:
  StudyWindow(study::SessionRun& run, session::Session& session, study::TrialStage& stage,
              sound::SoundOutput* beep, const StudyWindowOptions& options);

 protected:
  void closeEvent(QCloseEvent* event) override;

 private:
  using Act = std::function<base::Result<void>()>;

  void show_look();
  void add_keys();
  void tick();
  void hear(const SessionEvent& event);
  void show_step();
  study::PageText text_of_page() const;
  void show_page();
  void show_questions();
  void show_trial();
  void show_thanks();
  void set_page(StudyPage* page);
  void show_on_top();
  void cover(StudyPage* page);
  void uncover();
  StudyPage* make_end(const QString& title, const QString& text, int code);
  void attempt(const Act& act);
  void follow_trial(State state);
  void note_broken_off(const std::string& why);
  void break_off_trial(const std::string& why);
  void decline();
  void ask_to_interrupt();
  void tell_trouble(const std::string& what, const std::function<void()>& again);
  void tell_unpractised();
  void end(int code);
  bool in_trial() const { return run_.step().kind == Step::Kind::Trial && covers_.empty(); }

  study::SessionRun& run_;
  study::TrialStage& stage_;
  sound::SoundOutput* beep_;  // null: there is no sound
  StudyWindowOptions options_;
  StudyWords words_;
  ShareLine* share_;
  QStackedWidget* stack_;
  StudyScene* scene_;
  StudyPage* page_ = nullptr;       // of the step; null: it is a trial
  std::vector<StudyPage*> covers_;  // questions and messages over it; the last is seen
  bool trial_begun_ = false;
  bool asking_ = false;   // whether to interrupt
  bool leaving_ = false;  // nothing is left to do but to close
  int code_ = kUnfinished;
  std::string lost_;  // message on the lost device; empty: none is lost
  std::size_t events_told_ = 0;
  QTimer timer_;
};

std::string language_of(const study::SessionRun& run) {
  const auto& languages = run.study().languages;
  const std::size_t language = run.participant().language;
  return language < languages.size() ? languages[language] : std::string();
}

StudyWindow::StudyWindow(study::SessionRun& run, session::Session& session, study::TrialStage& stage,
                         sound::SoundOutput* beep, const StudyWindowOptions& options)
    : run_(run),
      stage_(stage),
      beep_(beep),
      options_(options),
      words_(language_of(run)),
      share_(new ShareLine(this)),
      stack_(new QStackedWidget(this)),
      events_told_(run.progress().events.size()) {
  setObjectName("study");
  setWindowTitle(study_text(run.study().title, run.participant().language) + " - ICOME");
  QFont letters = font();
  letters.setPointSizeF(kLetters);
  setFont(letters);
  scene_ = new StudyScene(session, words_, stack_);
  stack_->addWidget(scene_);
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  rows->addWidget(share_);
  rows->addWidget(stack_, 1);
  const QSize room = screen()->availableSize();
  resize(room.width() * 7 / 8, room.height() * 7 / 8);
  add_keys();
  show_look();
  show_step();
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, [this] { tick(); });
  timer_.start(16);
}

/// Gives the scene the look that it has on the desktop, without the parts that serve editing only.
void StudyWindow::show_look() {
  const SceneColours its = scene_colours();
  session::DisplayWish wish;
  wish.look.above = its.above;
  wish.look.below = its.below;
  wish.selection = its.selection;
  wish.look.outline_width = int(std::lround(wish.look.outline_width * devicePixelRatio()));
  wish.look.passes = 16;
  stage_.set_look(wish);
}

void StudyWindow::add_keys() {
  const auto add = [this](const QKeySequence& keys, const std::function<void()>& what) {
    auto* shortcut = new QShortcut(keys, this);
    shortcut->setContext(Qt::ApplicationShortcut);
    shortcut->setAutoRepeat(false);
    connect(shortcut, &QShortcut::activated, this, what);
  };
  add(Qt::Key_Escape, [this] { ask_to_interrupt(); });
  // For the experimenter: ends a break early.
  add(Qt::CTRL | Qt::SHIFT | Qt::Key_N, [this] {
    if (auto* rest = dynamic_cast<StudyRestPage*>(page_); rest && covers_.empty()) rest->end_wait();
  });
}

void StudyWindow::tick() {
  if (options_.interrupted()) return end(kUnfinished);
  scene_->move_hand();
  const State state = stage_.update();
  for (const SessionEvent& event : stage_.take_events()) hear(event);
  scene_->tick();
  if (in_trial()) follow_trial(state);
}

/// Prints messages for the experimenter, and remembers a lost device, which stops trials.
void StudyWindow::hear(const SessionEvent& event) {
  if (event.kind == SessionEvent::Kind::DeviceLost) lost_ = event.text;
  if (event.kind == SessionEvent::Kind::DeviceBack) lost_.clear();
  if (event.kind == SessionEvent::Kind::DeviceLost || event.kind == SessionEvent::Kind::DeviceBack ||
      event.kind == SessionEvent::Kind::Notice)
    std::fprintf(stderr, "icome: %s\n", base::terminal_text(event.text).c_str());
}

void StudyWindow::show_step() {
  tell_unpractised();
  share_->show_share(run_.share());
  switch (run_.step().kind) {
    case Step::Kind::Page:
      return show_page();
    case Step::Kind::Questions:
      return show_questions();
    case Step::Kind::Trial:
      return show_trial();
    case Step::Kind::Over:
      return show_thanks();
  }
}

/// Title and text of the page: the study's own, or else the program's.
study::PageText StudyWindow::text_of_page() const {
  const Step& step = run_.step();
  const auto said = [this](StudyWord title, StudyWord body) {
    return study::PageText{words_(title).toStdString(), words_(body).toStdString()};
  };
  if (step.page == study::PageKind::Measured) return said(StudyWord::MeasuredTitle, StudyWord::Measured);
  if (step.page == study::PageKind::Rest) return said(StudyWord::RestTitle, StudyWord::Rest);
  if (step.page != study::PageKind::Condition)
    return study::page_text(run_.study(), run_.participant(), step);
  const study::Trials& trials = run_.study().trials;
  const bool practises = trials.practice > 0 || trials.criterion;
  auto text = said(StudyWord::OnlyPart, practises ? StudyWord::PartWithPractice : StudyWord::Part);
  const std::size_t parts = study::conditions_of(run_.study(), run_.participant()).size();
  if (parts > 1)
    text.title =
        words_(StudyWord::PartOf).arg(qulonglong(step.position) + 1).arg(qulonglong(parts)).toStdString();
  return text;
}

void StudyWindow::show_page() {
  const study::PageText text = text_of_page();
  const QString title = QString::fromStdString(text.title);
  const bool rests = run_.step().page == study::PageKind::Rest;
  const bool asks = run_.step().page == study::PageKind::Consent;
  auto* rest = rests ? new StudyRestPage(title, words_(StudyWord::RestLeft), stack_) : nullptr;
  StudyPage* const page = rest ? rest : new StudyPage(title, stack_);
  page->add_text(QString::fromStdString(text.body));
  if (asks) page->add_button(words_(StudyWord::Disagree), [this] { decline(); });
  page->add_main_button(words_(asks ? StudyWord::Agree : StudyWord::GoOn),
                        [this] { attempt([this] { return run_.page_read(); }); });
  page->show_hint(words_(StudyWord::PageKeys));
  if (rest) rest->wait(run_.study().trials.rest);
  set_page(page);
}

void StudyWindow::show_questions() {
  const study::Questionnaire& its = run_.study().questionnaires[run_.step().questionnaire];
  set_page(new StudyQuestions(
      its, run_.participant().language, words_,
      [this](const std::vector<std::string>& answers) {
        attempt([this, answers] { return run_.answered(answers); });
      },
      stack_));
}

void StudyWindow::show_trial() {
  const study::TrialPlan& plan = run_.step().trial;
  const study::Trials& trials = run_.study().trials;
  const auto number = qulonglong(plan.number) + 1;
  QString which;
  if (!plan.practice) {
    which = words_(StudyWord::TrialOf).arg(number).arg(qulonglong(study::trials_a_condition(trials)));
  } else if (trials.criterion) {
    which = words_(StudyWord::Practice).arg(number);
  } else {
    which = words_(StudyWord::PracticeOf).arg(number).arg(trials.practice);
  }
  scene_->show_trial(which);
  set_page(nullptr);
}

StudyPage* StudyWindow::make_end(const QString& title, const QString& text, int code) {
  leaving_ = true;
  code_ = code;
  auto* page = new StudyPage(title, stack_);
  page->add_text(text);
  page->add_main_button(words_(StudyWord::Close), [this, code] { end(code); });
  return page;
}

void StudyWindow::show_thanks() {
  set_page(make_end(words_(StudyWord::ThanksTitle), words_(StudyWord::Thanks), kThrough));
}

void StudyWindow::decline() {
  if (const auto noted = run_.declined(); !noted)
    return tell_trouble(noted.error().message, [this] { decline(); });
  cover(make_end(words_(StudyWord::DeclinedTitle), words_(StudyWord::Declined), kUnfinished));
}

/// Shows the page of the step; null: the scene.
void StudyWindow::set_page(StudyPage* page) {
  if (page_) {
    stack_->removeWidget(page_);
    page_->deleteLater();  // we may have been called by one of its buttons
  }
  page_ = page;
  if (page_) stack_->addWidget(page_);
  show_on_top();
}

void StudyWindow::show_on_top() {
  if (StudyPage* const page = covers_.empty() ? page_ : covers_.back()) {
    stack_->setCurrentWidget(page);
    page->take_keyboard();
  } else if (stack_->currentWidget() != scene_ || !scene_->isAncestorOf(QApplication::focusWidget())) {
    stack_->setCurrentWidget(scene_);
    scene_->take_keyboard();
  }
}

void StudyWindow::cover(StudyPage* page) {
  covers_.push_back(page);
  stack_->addWidget(page);
  show_on_top();
}

void StudyWindow::uncover() {
  stack_->removeWidget(covers_.back());
  covers_.back()->deleteLater();
  covers_.pop_back();
  show_on_top();
}

/// Records what was done; on failure tells why, and can be tried again until it succeeds.
void StudyWindow::attempt(const Act& act) {
  const auto done = act();
  if (done) return show_step();
  tell_trouble(done.error().message, [this, act] { attempt(act); });
}

void StudyWindow::follow_trial(State state) {
  if (!lost_.empty()) {
    break_off_trial(lost_);
    return tell_trouble(lost_, [] {});
  }
  if (!scene_->is_drawn())
    return break_off_trial("There is no picture.");  // the scene says why, once it knows
  if (!trial_begun_) {
    trial_begun_ = true;
    stage_.begin(run_.step().trial);
    state = stage_.state();
  }
  if (stage_.take_beep() && beep_) beep_->play(start_tone(kToneRate));
  scene_->show_stage(stage_);
  if (state == State::Failed) {
    note_broken_off(stage_.why());
    tell_trouble(stage_.why(), [] {});
  } else if (state == State::Over) {
    trial_begun_ = false;
    attempt([this] { return run_.trial_done(stage_.measures(), stage_.trace(), stage_.said()); });
  }
}

/// Records that the trial was broken off: it was begun, which cannot be undone.
void StudyWindow::note_broken_off(const std::string& why) {
  trial_begun_ = false;
  if (const auto noted = run_.trial_broken_off(why); !noted)
    std::fprintf(stderr, "icome: %s\n", base::terminal_text(noted.error().message).c_str());
}

/// Breaks off a trial that was begun; it begins again when the scene is next seen.
void StudyWindow::break_off_trial(const std::string& why) {
  if (!trial_begun_) return;
  note_broken_off(why);
  stage_.stop();
  scene_->show_stage(stage_);
}

void StudyWindow::ask_to_interrupt() {
  if (leaving_) return end(code_);
  if (asking_) return;
  asking_ = true;
  if (in_trial()) break_off_trial("The person was asked whether to interrupt.");
  auto* page = new StudyPage(words_(StudyWord::InterruptTitle), stack_);
  page->add_text(words_(StudyWord::Interrupt));
  page->add_button(words_(StudyWord::InterruptYes), [this] { end(kUnfinished); });
  page->add_main_button(words_(StudyWord::InterruptNo), [this] {
    asking_ = false;
    uncover();
  });
  cover(page);
}

void StudyWindow::tell_trouble(const std::string& what, const std::function<void()>& again) {
  std::fprintf(stderr, "icome: %s\n", base::terminal_text(what).c_str());
  auto* page = new StudyPage(words_(StudyWord::TroubleTitle), stack_);
  page->add_text(words_(StudyWord::Trouble));
  page->add_text(QString::fromStdString(what));
  page->add_button(words_(StudyWord::EndHere), [this] { end(kUnfinished); });
  page->add_main_button(words_(StudyWord::TryAgain), [this, again] {
    uncover();
    again();
  });
  cover(page);
}

/// Tells the experimenter, and not the person, of a practice criterion that was not met.
void StudyWindow::tell_unpractised() {
  const auto& events = run_.progress().events;
  for (; events_told_ < events.size(); ++events_told_) {
    if (events[events_told_].kind != study::EventKind::Unpractised) continue;
    std::fprintf(stderr, "icome: sub-%s has not met the practice criterion, and goes on unpractised.\n",
                 run_.participant().id.c_str());
  }
}

void StudyWindow::end(int code) {
  timer_.stop();
  break_off_trial("The session was interrupted.");
  leaving_ = true;
  QApplication::exit(code);
}

void StudyWindow::closeEvent(QCloseEvent* event) {
  event->ignore();
  ask_to_interrupt();
}

std::unique_ptr<sound::SoundOutput> open_beep() {
  auto beep = sound::SoundOutput::open(kToneRate);
  if (beep) return std::move(*beep);
  std::fprintf(stderr, "icome: The start of a trial is seen but not heard. %s\n",
               base::terminal_text(beep.error().message).c_str());
  return nullptr;
}

constexpr const char* kNoStudyDisplayWays =
    "A study of people needs one; `icome study run --simulate` tries a study out without.";

}  // namespace

int run_study_window(int argc, char** argv, const StudyWindowOptions& options,
                     const std::filesystem::path& folder, session::SessionSettings settings,
                     const std::function<base::Result<study::SessionRun>()>& begin) {
  const auto application = connect_display(argc, argv, kNoStudyDisplayWays);
  if (!application) return 1;
  apply_theme(*application, theme_of(options.theme).value_or(Theme::Light));
  const auto fail = [](const base::Error& error) {
    std::fprintf(stderr, "icome: %s\n", base::terminal_text(error.message).c_str());
    return 1;
  };
  settings.autosave_folder.clear();  // trials are nobody's design
  auto session = session::Session::create(std::move(settings));
  if (!session) return fail(session.error());
  auto run = begin();
  if (!run) return fail(run.error());
  study::TrialStage stage(**session, run->study(), folder, run->participant());
  if (options.microphone) stage.listen_to(options.microphone);
  const auto beep = run->study().trials.beep ? open_beep() : nullptr;
  StudyWindow window(*run, **session, stage, beep.get(), options);
  options.full_screen ? window.showFullScreen() : window.show();
  const std::size_t told = run->notices().size();
  const int code = QApplication::exec();
  for (std::size_t i = told; i < run->notices().size(); ++i)
    std::fprintf(stderr, "icome: %s\n", base::terminal_text(run->notices()[i]).c_str());
  return code;
}

}  // namespace icome::ui
