#include "session/design_loader.h"

#include <algorithm>
#include <utility>

namespace icome::session {

struct DesignLoader::Reading {
  Reading(std::filesystem::path name, Read read, files::DesignReadOptions options)
      : design(std::move(name)), task([this, read = std::move(read), options = std::move(options)]() mutable {
          return run(read, options);
        }) {}

  base::Result<files::LoadedDesign> run(const Read& read, files::DesignReadOptions& options) {
    options.progress = [this](double done) {
      // Readers that go through a file in several ways may begin anew; people see it go on.
      part.store(std::clamp(done, part.load(std::memory_order_relaxed), 1.0), std::memory_order_relaxed);
      return !stopped.load(std::memory_order_relaxed);
    };
    auto result = read(options);
    // What nobody wants is freed here, as that may take a while.
    if (stopped.load(std::memory_order_relaxed)) return base::fail("interrupted");
    return result;
  }

  std::filesystem::path design;
  std::atomic<double> part = 0.0;
  std::atomic<bool> stopped = false;
  BackgroundTask<files::LoadedDesign> task;  // last: it uses what is above
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
}

void DesignLoader::cancel() {
  if (reading_) cancelled_ = Outcome{reading_->design, std::nullopt};
  give_up();
}

void DesignLoader::give_up() {
  if (!reading_) return;
  reading_->stopped.store(true, std::memory_order_relaxed);
  leaving_.push_back(std::move(reading_));
}

std::optional<double> DesignLoader::part() const {
  if (!reading_) return std::nullopt;
  return reading_->part.load(std::memory_order_relaxed);
}

std::optional<DesignLoader::Outcome> DesignLoader::poll() {
  std::erase_if(leaving_, [](const auto& it) { return it->task.is_done(); });
  if (cancelled_) return std::exchange(cancelled_, std::nullopt);
  if (!reading_ || !reading_->task.is_done()) return std::nullopt;
  const std::unique_ptr<Reading> ended = std::move(reading_);
  return Outcome{ended->design, ended->task.take()};
}

void DesignLoader::wait() const {
  if (reading_) reading_->task.wait();
}

}  // namespace icome::session
