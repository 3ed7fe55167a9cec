#include "session/elements/felt_sheets.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "interaction/elements/element_feel.h"

namespace icome::session {

FeltSheets::Sheet* FeltSheets::open_sheet(const interaction::Widget* opener) {
  const auto found = std::ranges::find_if(
      sheets_, [&](const Sheet& it) { return !it.until && !it.goes && it.opener == opener; });
  return found == sheets_.end() ? nullptr : &*found;
}

void FeltSheets::let_go() {
  for (Sheet& it : sheets_) it.goes = true;
}

void FeltSheets::close(Sheet& sheet, double time) {
  haptics::PanelSettings panel = *sheet.effect.panel;
  panel.closes = true;
  sheet.until = time + 2.0 * panel.opening_seconds;
  sheet.effect.panel = std::make_shared<const haptics::PanelSettings>(std::move(panel));
}

/// Sheets that stay open keep their effects, wherever they are now.
void FeltSheets::bring_up_to_date(const interaction::ElementUse& use) {
  const auto& laid = use.layout().sheets;
  const double size = use.frame().size;
  const bool has_moved = std::exchange(revision_, use.layout_revision()) != use.layout_revision();
  outdated_ = outdated_ || has_moved;
  std::vector<interaction::FeltSheet> felt;
  for (std::size_t i = 0; i < laid.size(); ++i) {
    Sheet* sheet = open_sheet(laid[i].opened_by);
    const bool is_new = sheet == nullptr;
    if (is_new || outdated_ || sheet->effect.panel->size != size) {
      if (felt.empty()) felt = interaction::feel_of(use.element(), use.layout(), use.frame(), use.settings());
      if (is_new) {
        sheet = &sheets_.emplace_back(Sheet{laid[i].opened_by});
        sheet->effect.id = next_id_++;
      }
      sheet->effect.panel = std::make_shared<const haptics::PanelSettings>(felt[i].panel);
    }
    sheet->effect.world_from_effect = interaction::world_from_sheet(use.frame(), laid[i]);
  }
  outdated_ = false;
}

bool FeltSheets::follow(const interaction::ElementUse* use, double time) {
  std::erase_if(sheets_, [&](const Sheet& it) { return it.until && *it.until <= time; });
  const auto is_open = [&](const interaction::Widget* opener) {
    return use != nullptr && (opener == nullptr || std::ranges::count(use->open(), opener) > 0);
  };
  for (Sheet& it : sheets_)
    if (!it.until && (it.goes || !is_open(it.opener))) close(it, time);
  if (use != nullptr) bring_up_to_date(*use);
  std::vector<haptics::PlacedEffect> now;
  for (const Sheet& it : sheets_) now.push_back(it.effect);
  if (now == effects_) return false;
  effects_ = std::move(now);
  return true;
}

}  // namespace icome::session
