#pragma once
#include <string>
#include <string_view>

namespace icome::apps {

// Output of text for people. Text from files may be anything, so it all goes through
// base::terminal_text().

/// "icome: The sentence." on standard error, without the secrets of links in it.
void tell(std::string_view sentence);
/// Asks on standard error, and waits for a line on standard input; true for one that begins with y. False at
/// the end of the input, and when the run is asked to end (interrupt.h).
bool ask(std::string_view question);
/// On standard output: a report or JSON.
void print(std::string_view text);
/// As print(); gives the exit code, kFailed where standard output cannot be written.
int print_answer(std::string_view text);
/// "1 stroke", "2 strokes".
std::string how_many(std::size_t count, std::string_view what);

constexpr int kFailed = 1;  // exit code: something could not be done

}  // namespace icome::apps
