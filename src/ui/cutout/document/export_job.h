#pragma once
#include <QObject>
#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "animation/export/export_animation.h"
#include "ui/cutout/document/cutout_document.h"

namespace icome::ui {

/// Writes an animation on a thread of its own, as it is when this begins.
class ExportJob {
 public:
  using Done = std::function<void(const base::Result<animation::ExportReport>&)>;
  using Progress = std::function<void(double part)>;

  /// Both are called on the thread that makes the job.
  ExportJob(const CutoutDocument& document, std::string out, animation::ExportOptions options,
            Progress progress, Done done);
  /// Stops it, which takes away what was written.
  ~ExportJob();
  ExportJob(const ExportJob&) = delete;
  ExportJob& operator=(const ExportJob&) = delete;

  /// Asks it to stop; `done` hears of that.
  void cancel() { cancelled_ = true; }

 private:
  void run(const animation::Project& project, const std::filesystem::path& folder, const std::string& out,
           animation::ExportOptions options);

  QObject here_;  // answers are given in its thread
  Progress progress_;
  Done done_;
  std::atomic<bool> cancelled_ = false;
  std::jthread thread_;
};

}  // namespace icome::ui
