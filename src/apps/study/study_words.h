#pragma once
#include "study/definition/study.h"

namespace icome::apps {

// The words of a study file for its values.

const char* scale_word(study::Scale scale);
const char* order_word(study::OrderMethod method);
const char* better_word(study::Better better);  // "neither": not given
const char* test_word(study::Test test);        // "none": not given
const char* when_word(study::AskWhen when);

}  // namespace icome::apps
