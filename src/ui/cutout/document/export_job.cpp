#include "ui/cutout/document/export_job.h"

#include <utility>

namespace icome::ui {

ExportJob::ExportJob(const CutoutDocument& document, std::string out, animation::ExportOptions options,
                     Progress progress, Done done)
    : progress_(std::move(progress)), done_(std::move(done)) {
  thread_ =
      std::jthread([this, project = document.project(), folder = document.folder(), out = std::move(out),
                    options = std::move(options)] { run(project, folder, out, options); });
}

ExportJob::~ExportJob() {
  cancel();
  thread_.join();
}

void ExportJob::run(const animation::Project& project, const std::filesystem::path& folder,
                    const std::string& out, animation::ExportOptions options) {
  animation::CellPictures pictures(folder, {.reach = animation::Reach::Anywhere});
  options.progress = [this](double part) {
    QMetaObject::invokeMethod(
        &here_, [this, part] { progress_(part); }, Qt::QueuedConnection);
    return !cancelled_;
  };
  const auto states = [&project](int frame) { return animation::states_at(project, frame); };
  auto report = animation::export_animation(project, states, pictures, out, options);
  QMetaObject::invokeMethod(
      &here_, [this, report = std::move(report)] { done_(report); }, Qt::QueuedConnection);
}

}  // namespace icome::ui
