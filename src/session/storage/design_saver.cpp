#include "session/storage/design_saver.h"

#include <cassert>
#include <utility>

#include "files/design_files.h"

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
  Writing(Order what, std::optional<files::FileStamp> seen)
      : order(std::move(what)), stamp(seen), task([this] { return run(); }) {}

  base::Result<std::vector<files::Remark>> run() {
    if (order.replace == Replace::Safely) {
      if (const auto why = files::why_not_replace(order.design, stamp)) {
        asks = true;
        return base::fail(*why);
      }
    }
    auto result = write(order.design, order.world);
    stamp = files::stamp_of(order.design);
    order.world = {};  // here, as freeing the last of a large one may take a while
    return result;
  }

  Order order;
  std::optional<files::FileStamp> stamp;  // of the file: as it was seen, then as it was written
  bool asks = false;
  BackgroundTask<std::vector<files::Remark>> task;  // last: it uses what is above
};

DesignSaver::DesignSaver() = default;

DesignSaver::~DesignSaver() {
  while (busy()) {
    wait();
    (void)poll();
  }
}

void DesignSaver::has_read(const std::filesystem::path& design,
                           const std::optional<files::FileStamp>& stamp) {
  if (stamp) seen_[design] = *stamp;
}

void DesignSaver::save(const std::filesystem::path& design, world::World world, std::uint64_t number,
                       Replace replace) {
  assert(can_save());
  waiting_.push_back({design, std::move(world), number, replace});
  begin_next();
}

void DesignSaver::begin_next() {
  if (writing_ || waiting_.empty()) return;
  Order next = std::move(waiting_.front());
  waiting_.pop_front();
  const auto seen = seen_.find(next.design);
  writing_ = std::make_unique<Writing>(std::move(next),
                                       seen == seen_.end() ? std::nullopt : std::optional(seen->second));
}

std::optional<DesignSaver::Outcome> DesignSaver::poll() {
  if (!writing_ || !writing_->task.is_done()) return std::nullopt;
  Outcome outcome{writing_->order.design, writing_->order.number, writing_->task.take(), writing_->asks};
  if (outcome.result) has_read(outcome.design, writing_->stamp);
  writing_.reset();
  begin_next();
  return outcome;
}

void DesignSaver::wait() const {
  if (writing_) writing_->task.wait();
}

}  // namespace icome::session
