#pragma once
#include <QSettings>
#include <memory>

namespace icome::ui {

/// A person's settings for one kind of window, in a group of their own: those of ICOME, or where a file is
/// named, as tests do, that one's.
std::unique_ptr<QSettings> window_settings(const QString& file, const char* group);

}  // namespace icome::ui
