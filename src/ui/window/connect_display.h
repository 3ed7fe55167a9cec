#pragma once
#include <memory>

class QApplication;

namespace icome::ui {

/// The program's application of Qt, connected to the display; argc and argv outlive it. Where there is no
/// display it says so on standard error, with `ways_on` (a sentence that names what works without one), and
/// gives null or ends the program with 1.
std::unique_ptr<QApplication> connect_display(int& argc, char** argv, const char* ways_on);

}  // namespace icome::ui
