#pragma once
#include "study/definition/study.h"

namespace icome::apps {

// What the values of a study file are called in it.

const char* scale_word(study::Scale scale);
const char* order_word(study::OrderMethod method);
const char* better_word(study::Better better);  // "neither": not said
const char* test_word(study::Test test);        // "none": not said
const char* when_word(study::AskWhen when);

}  // namespace icome::apps
