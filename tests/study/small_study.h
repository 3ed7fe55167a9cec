#pragma once
#include <string>

#include "study/definition/study_reader.h"
#include "study/definition/templates.h"

namespace icome::study {

/// A study of two conditions with two practice and three measured trials each, and a question after each.
inline constexpr const char* kSmallStudy = R"(
name = "small"
languages = ["en"]
title = "Small"
consent = "Yes?"
instructions = "Touch it."
participants = 4
[[independent]]
id = "side"
name = "Side"
kind = "within"
levels = [{ id = "left", name = "Left" }, { id = "right", name = "Right", forces = false, select = "click" }]
[[dependent]]
id = "seconds"
name = "Time"
type = "ratio"
from = "time"
[task]
target = "item-{colour}"
wrong = "item-*"
shown = ["cube-{colour}"]
start = [0.0, 0.0, 0.1]
[trials]
practice = 1
measured = 3
rest = 30
criterion = { successes = 2, within = 5, most-attempts = 4 }
scenes = [{ id = "a", file = "a.wrl" }, { id = "b", file = "b.wrl" }]
scene-order = "shuffled"
[[trials.variables]]
id = "colour"
name = "Colour"
values = [{ id = "red", name = "Red" }, { id = "blue", name = "Blue" }]
draw = "shuffled"
[[questionnaires]]
id = "after"
title = "After"
when = "after-condition"
[[questionnaires.items]]
id = "ease"
kind = "rating"
text = "Easy?"
points = 5
low = "no"
high = "yes"
[[questionnaires.items]]
id = "why"
kind = "text"
text = "Why?"
)";

inline Study small_study() { return read_study(kSmallStudy, "small.toml").value(); }

}  // namespace icome::study
