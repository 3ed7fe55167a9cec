#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace icome::speech {

/// What sentences can do beside single operations: the values of `does` in a vocabulary.
const std::vector<std::string>& act_names();
bool is_act(std::string_view name);

}  // namespace icome::speech
