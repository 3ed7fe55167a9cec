#include "ui/cutout/panels/stage_panel.h"

#include <fmt/format.h>

#include <QVBoxLayout>
#include <cmath>

#include "ui/panels/object_look.h"

namespace icome::ui {
namespace {

constexpr int kMostOnionPoses = 10;
constexpr double kFarthestSound = 1e6;  // s

}  // namespace

StagePanel::StagePanel(CutoutDocument& document, CutoutLook& look, QWidget* parent)
    : QWidget(parent),
      document_(document),
      look_(look),
      stage_(new PanelSection("Stage", this)),
      sound_(new PanelSection("Sound", this)),
      onion_(new PanelSection("Onion skin", this)) {
  setObjectName("stage_panel");
  add_stage_rows();
  add_sound_rows();
  add_onion_rows();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  for (PanelSection* section : {stage_, sound_, onion_}) column->addWidget(section);
  refresh();
}

QuantityField* StagePanel::add_field(PanelSection& section, Quantity quantity, const char* name,
                                     const QString& accessible,
                                     std::function<base::Result<void>(double)> commit) {
  auto* field = new QuantityField(quantity, section.body());
  field->setObjectName(name);
  field->setAccessibleName(accessible);
  field->on_refusal([&section](const QString& why) { section.note().keep(why); });
  field->on_commit([commit = std::move(commit)](std::optional<double> value, bool) -> base::Result<void> {
    if (!value) return base::fail("A number is needed.");
    return commit(*value);
  });
  return field;
}

std::function<base::Result<void>(double)> StagePanel::stage_setter(const char* parameter, double least,
                                                                   double most) {
  return [=, this](double value) -> base::Result<void> {
    if (value < least || value > most)
      return base::fail(fmt::format("A number from {} to {} is needed.", least, most));
    document_.perform(cutout_command("stage", {{parameter, value}}));
    return {};
  };
}

void StagePanel::add_stage_rows() {
  width_ = add_field(*stage_, Quantity::Whole, "stage.width", "Width of the stage",
                     stage_setter("width", 2, animation::kLargestStage));
  height_ = add_field(*stage_, Quantity::Whole, "stage.height", "Height of the stage",
                      stage_setter("height", 2, animation::kLargestStage));
  stage_->add_row("Size, px", "Width and height of the film", {width_, height_});
  length_ = add_field(*stage_, Quantity::Whole, "stage.length", "Length in frames",
                      stage_setter("length", 1, animation::kLongestAnimation));
  stage_->add_row("Length", "Frames of the film", {length_});
  rate_ = add_field(*stage_, Quantity::Plain, "stage.rate", "Frames a second", stage_setter("rate", 1, 120));
  stage_->add_row("Frames/s", "How fast frames follow one another", {rate_});
  background_ = new ColourButton("Background", stage_->body());
  background_->on_choice([this](const world::Colour& colour) {
    document_.perform(cutout_command(
        "stage",
        {{"background", interaction::Value::List{double(colour[0]), double(colour[1]), double(colour[2])}}}));
  });
  stage_->add_row("Background", "The colour where no cell lies", {background_});
}

void StagePanel::add_sound_rows() {
  no_sound_ = new QLabel("There is no sound. File > Sound adds one.", sound_->body());
  no_sound_->setWordWrap(true);
  sound_->add_wide(no_sound_);
  start_ = add_field(*sound_, Quantity::Plain, "sound.start", "Start of the sound in seconds",
                     [this](double value) -> base::Result<void> {
                       if (std::abs(value) > kFarthestSound) return base::fail("That is too far.");
                       document_.perform(cutout_command("sound", {{"start", value}}));
                       return {};
                     });
  start_row_ =
      sound_->add_row("Start, s", "When the sound begins; below 0 its beginning is cut off", {start_});
  gain_ = add_field(*sound_, Quantity::Share, "sound.gain", "Loudness of the sound",
                    [this](double value) -> base::Result<void> {
                      if (value < 0.0 || value > 4.0) return base::fail("A loudness is from 0 to 400 %.");
                      document_.perform(cutout_command("sound", {{"gain", value}}));
                      return {};
                    });
  gain_row_ = sound_->add_row("Loudness, %", "100: as the file has it", {gain_});
}

void StagePanel::add_onion_rows() {
  const auto setter = [this](int& count) {
    return [this, &count](double value) -> base::Result<void> {
      if (value < 0 || value > kMostOnionPoses)
        return base::fail(fmt::format("A number from 0 to {} is needed.", kMostOnionPoses));
      count = int(std::lround(value));
      looked_();
      return {};
    };
  };
  before_ = add_field(*onion_, Quantity::Whole, "onion.before", "Poses before", setter(look_.onion_before));
  after_ = add_field(*onion_, Quantity::Whole, "onion.after", "Poses after", setter(look_.onion_after));
  onion_->add_row("Before, after", "Poses that shine through, in red and in green", {before_, after_});
}

void StagePanel::refresh() {
  const animation::Stage& stage = document_.project().stage;
  width_->show_value(stage.width);
  height_->show_value(stage.height);
  length_->show_value(stage.length);
  rate_->show_value(stage.rate);
  background_->show_colour(stage.background);
  const auto& sound = document_.project().sound;
  no_sound_->setVisible(!sound);
  start_row_.set_visible(sound.has_value());
  gain_row_.set_visible(sound.has_value());
  if (sound) {
    start_->show_value(sound->start);
    gain_->show_value(sound->gain);
  }
  before_->show_value(look_.onion_before);
  after_->show_value(look_.onion_after);
}

}  // namespace icome::ui
