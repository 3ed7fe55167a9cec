#pragma once
#include <QObject>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

#include "sound/sound_file.h"
#include "ui/cutout/document/cutout_document.h"
#include "ui/cutout/time/time_rows.h"

namespace icome::ui {

/// Reads the sound of an animation on a thread of its own.
class SoundLoader {
 public:
  /// The sound for playing and for being seen; both null where there is none, or it cannot be read.
  struct Loaded {
    std::shared_ptr<const sound::Samples> samples;
    std::shared_ptr<const SoundShape> shape;
    std::string problem;
  };
  explicit SoundLoader(std::function<void(const Loaded&)> loaded);

  /// Reads the document's sound, unless it is the one that was asked for last.
  void follow(const CutoutDocument& document);

 private:
  QObject here_;  // answers are given in its thread
  std::function<void(const Loaded&)> loaded_;
  std::optional<std::string> asked_;  // folder and file
  std::uint64_t number_ = 0;
  std::vector<std::jthread> threads_;  // until all is over
};

}  // namespace icome::ui
