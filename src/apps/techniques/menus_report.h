#pragma once
#include <string>

#include "charts/image.h"
#include "study/menus/menu_bench.h"

namespace icome::apps {

// Reports of the bench of menus, `icome techniques --menus`.

/// The result as a JSON object on several lines: the names are a contract with scripts (see the help).
std::string menus_json(const study::MenuBenchResult& result);

/// A table for a person, and its meaning.
std::string menus_text(const study::MenuBenchResult& result);

/// A page of 1600 x 1000 pixels: times above errors, a column for each kind of menu, over the number of
/// items.
charts::Image draw_menus(const study::MenuBenchResult& result);

/// "list", "pie", "daisy"; "none", "well", "recess"; "click" or "push".
const char* kind_word(const study::MenuCondition& condition);
const char* feel_word(const study::MenuCondition& condition);
const char* choose_word(const study::MenuCondition& condition);

}  // namespace icome::apps
