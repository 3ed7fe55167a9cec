#include "ui/cutout/document/sound_loader.h"

#include <algorithm>
#include <cmath>

#include "animation/sound/sound_track.h"

namespace icome::ui {
namespace {

constexpr double kShapeRate = 400.0;  // pairs a second

SoundLoader::Loaded read_loaded(const std::filesystem::path& folder, const animation::Sound& sound) {
  SoundLoader::Loaded loaded;
  auto samples = animation::read_track(folder, sound, 0, animation::Reach::Anywhere);
  if (!samples) {
    loaded.problem = samples.error().message;
    return loaded;
  }
  loaded.samples = std::make_shared<const sound::Samples>(std::move(*samples));
  SoundShape shape;
  shape.rate = kShapeRate;
  const animation::Sound as_it_is{.file = sound.file};
  const int count = int(std::ceil(loaded.samples->seconds() * kShapeRate));
  for (const animation::Peak& peak : animation::waveform(*loaded.samples, as_it_is, kShapeRate, 0, count)) {
    shape.least.push_back(peak.least);
    shape.greatest.push_back(peak.greatest);
  }
  loaded.shape = std::make_shared<const SoundShape>(std::move(shape));
  return loaded;
}

}  // namespace

SoundLoader::SoundLoader(std::function<void(const Loaded&)> loaded) : loaded_(std::move(loaded)) {}

void SoundLoader::follow(const CutoutDocument& document) {
  const auto sound = document.project().sound;
  const std::string wanted = sound ? (document.folder() / sound->file).string() : std::string();
  if (asked_ == wanted) return;
  asked_ = wanted;
  ++number_;
  loaded_({});
  if (!sound) return;
  threads_.emplace_back([this, number = number_, folder = document.folder(), what = *sound] {
    const Loaded loaded = read_loaded(folder, what);
    QMetaObject::invokeMethod(
        &here_,
        [=, this] {
          if (number == number_) loaded_(loaded);
        },
        Qt::QueuedConnection);
  });
}

}  // namespace icome::ui
