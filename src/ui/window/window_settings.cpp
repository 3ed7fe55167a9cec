#include "ui/window/window_settings.h"

namespace icome::ui {

std::unique_ptr<QSettings> window_settings(const QString& file, const char* group) {
  auto settings = file.isEmpty() ? std::make_unique<QSettings>("icome", "icome")
                                 : std::make_unique<QSettings>(file, QSettings::IniFormat);
  settings->beginGroup(group);
  return settings;
}

}  // namespace icome::ui
