#pragma once
#include <memory>

class QApplication;

namespace icome::ui {

/// Makes the program's Qt application, connected to the display; argc and argv must outlive it. Where there
/// is no display, it prints an error to standard error, with `ways_on` (a sentence that names what works
/// without one), and returns null or ends the program with 1.
std::unique_ptr<QApplication> connect_display(int& argc, char** argv, const char* ways_on);

}  // namespace icome::ui
