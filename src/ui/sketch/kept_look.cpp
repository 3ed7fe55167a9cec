#include "ui/sketch/kept_look.h"

#include <QColor>
#include <algorithm>
#include <array>
#include <utility>

#include "ui/forms/colour_button.h"

namespace icome::ui {
namespace {

struct KeptNumber {
  const char* name;
  double SketchLook::*value;
  double least, most;
};
constexpr std::array<KeptNumber, 2> kKeptNumbers = {
    {{"opacity", &SketchLook::opacity, 0.0, 1.0},
     {"eraser_radius", &SketchLook::eraser_radius, kLeastEraser, kWidestTip}}};

constexpr std::array<std::pair<const char*, bool SketchLook::*>, 6> kKeptSwitches = {
    {{"whole_strokes", &SketchLook::whole_strokes},
     {"constant_width", &SketchLook::constant_width},
     {"predict", &SketchLook::predict},
     {"onion", &SketchLook::onion},
     {"attract", &SketchLook::attract},
     {"force", &SketchLook::force}}};

double kept_number(const QSettings& kept, const char* name, double usual, double least, double most) {
  bool read = false;
  const double value = kept.value(name).toDouble(&read);
  return read && value >= least && value <= most ? value : usual;
}

drawing::Colour kept_colour(const QSettings& kept, const char* name, const drawing::Colour& usual) {
  const QColor read(kept.value(name).toString());
  return read.isValid() ? world_colour(read) : usual;
}

}  // namespace

void take_kept_look(const QSettings& kept, SketchLook& look) {
  look.colour = kept_colour(kept, "colour", look.colour);
  look.fill = kept_colour(kept, "fill", look.fill);
  for (const KeptNumber& it : kKeptNumbers)
    look.*it.value = kept_number(kept, it.name, look.*it.value, it.least, it.most);
  for (const auto& [name, flag] : kKeptSwitches) look.*flag = kept.value(name, look.*flag).toBool();
  look.tip.thinnest = kept_number(kept, "thinnest", look.tip.thinnest, 0.0, kWidestTip);
  look.tip.widest = kept_number(kept, "widest", look.tip.widest, 0.0, kWidestTip);
  sketch::PressureCurve& pressure = look.pressure;
  pressure.lightest = kept_number(kept, "lightest", pressure.lightest, 0.0, 1.0);
  pressure.hardest =
      kept_number(kept, "hardest", std::max(pressure.lightest, pressure.hardest), pressure.lightest, 1.0);
  pressure.middle = kept_number(kept, "middle", 0.5 * (pressure.lightest + pressure.hardest),
                                pressure.lightest, pressure.hardest);
  if (kept.contains("flat_ends"))
    look.ends = kept.value("flat_ends").toBool() ? drawing::CurveEnds::Flat : drawing::CurveEnds::Round;
}

void keep_look(const SketchLook& look, QSettings& kept) {
  kept.setValue("colour", screen_colour(look.colour).name());
  kept.setValue("fill", screen_colour(look.fill).name());
  for (const KeptNumber& it : kKeptNumbers) kept.setValue(it.name, look.*it.value);
  for (const auto& [name, flag] : kKeptSwitches) kept.setValue(name, look.*flag);
  kept.setValue("thinnest", look.tip.thinnest);
  kept.setValue("widest", look.tip.widest);
  kept.setValue("lightest", look.pressure.lightest);
  kept.setValue("middle", look.pressure.middle);
  kept.setValue("hardest", look.pressure.hardest);
  kept.setValue("flat_ends", look.ends == drawing::CurveEnds::Flat);
}

}  // namespace icome::ui
