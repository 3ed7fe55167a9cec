#include "session/storage/design_loader.h"

#include <algorithm>
#include <utility>

#include "files/design_files.h"

namespace icome::session {

struct DesignLoader::Reading {
  Reading(std::filesystem::path name, Read how, files::DesignReadOptions its_options)
      : design(std::move(name)), read(std::move(how)), options(std::move(its_options)) {}

  void begin() {
    task.emplace([this] { return run(); });
  }
  bool has_begun() const { return task.has_value(); }
  bool has_ended() const { return task && task->is_done(); }

  base::Result<files::LoadedDesign> run() {
    options.progress = [this](double done) {
      // Readers that go through a file in several ways may begin anew; the shown part never goes back.
      part.store(std::clamp(done, part.load(std::memory_order_relaxed), 1.0), std::memory_order_relaxed);
      return !stopped.load(std::memory_order_relaxed);
    };
    auto result = read(options);
    // An unwanted result is freed here, as that may take a while.
    if (stopped.load(std::memory_order_relaxed)) return base::fail("interrupted");
    return result;
  }

  std::filesystem::path design;
  Read read;
  files::DesignReadOptions options;
  std::atomic<double> part = 0.0;
  std::atomic<bool> stopped = false;
  std::optional<BackgroundTask<files::LoadedDesign>> task;  // last: it uses what is above
};

DesignLoader::DesignLoader() = default;

DesignLoader::~DesignLoader() { give_up(); }

void DesignLoader::open(const std::filesystem::path& design, const files::DesignReadOptions& options) {
  start(
      design, [design](const files::DesignReadOptions& all) { return files::read_design(design, all); },
      options);
}

void DesignLoader::start(const std::filesystem::path& design, Read read,
                         const files::DesignReadOptions& options) {
  give_up();
  cancelled_.reset();
  reading_ = std::make_unique<Reading>(design, std::move(read), options);
  begin_when_possible();
}

void DesignLoader::cancel() {
  if (reading_) cancelled_ = Outcome{reading_->design, std::nullopt};
  give_up();
}

void DesignLoader::give_up() {
  if (!reading_) return;
  reading_->stopped.store(true, std::memory_order_relaxed);
  if (reading_->has_begun()) leaving_.push_back(std::move(reading_));
  reading_.reset();
}

void DesignLoader::begin_when_possible() {
  std::erase_if(leaving_, [](const auto& it) { return it->has_ended(); });
  if (reading_ && !reading_->has_begun() && leaving_.size() < kMostLeaving) reading_->begin();
}

std::optional<double> DesignLoader::part() const {
  if (!reading_) return std::nullopt;
  return reading_->part.load(std::memory_order_relaxed);
}

std::optional<DesignLoader::Outcome> DesignLoader::poll() {
  begin_when_possible();
  if (cancelled_) return std::exchange(cancelled_, std::nullopt);
  if (!reading_ || !reading_->has_ended()) return std::nullopt;
  const std::unique_ptr<Reading> ended = std::move(reading_);
  return Outcome{ended->design, ended->task->take()};
}

void DesignLoader::wait() {
  for (begin_when_possible(); reading_ && !reading_->has_begun(); begin_when_possible())
    leaving_.front()->task->wait();
  if (reading_) reading_->task->wait();
}

}  // namespace icome::session
