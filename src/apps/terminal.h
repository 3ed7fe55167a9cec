#pragma once
#include <string>
#include <string_view>

namespace icome::apps {

// Output of text for people. Text from files may be anything, so it all goes through
// base::terminal_text().

/// "icome: The sentence." on standard error.
void tell(std::string_view sentence);
/// On standard output: a report or JSON.
void print(std::string_view text);

}  // namespace icome::apps
