#include "session/design_saver.h"

#include <utility>

namespace icome::session {
namespace {

base::Result<std::vector<files::Remark>> write(const std::filesystem::path& design,
                                               const world::World& world) {
  auto written = files::write_design(design, world);
  if (written) return written;
  return base::fail(written.error().message +
                    " Your work is still open here, and a file of that name is as it was. Save to another "
                    "place, or put this right and save again.");
}

}  // namespace

struct DesignSaver::Writing {
  explicit Writing(Order what) : order(std::move(what)), task([this] { return run(); }) {}

  base::Result<std::vector<files::Remark>> run() {
    auto result = write(order.design, order.world);
    order.world = {};  // here, as freeing the last of a large one may take a while
    return result;
  }

  Order order;
  BackgroundTask<std::vector<files::Remark>> task;  // last: it uses what is above
};

DesignSaver::DesignSaver() = default;

DesignSaver::~DesignSaver() {
  while (busy()) {
    wait();
    (void)poll();
  }
}

void DesignSaver::save(const std::filesystem::path& design, world::World world, std::uint64_t number) {
  waiting_.push_back({design, std::move(world), number});
  begin_next();
}

void DesignSaver::begin_next() {
  if (writing_ || waiting_.empty()) return;
  Order next = std::move(waiting_.front());
  waiting_.pop_front();
  writing_ = std::make_unique<Writing>(std::move(next));
}

std::optional<DesignSaver::Outcome> DesignSaver::poll() {
  if (!writing_ || !writing_->task.is_done()) return std::nullopt;
  Outcome outcome{writing_->order.design, writing_->order.number, writing_->task.take()};
  writing_.reset();
  begin_next();
  return outcome;
}

void DesignSaver::wait() const {
  if (writing_) writing_->task.wait();
}

}  // namespace icome::session
