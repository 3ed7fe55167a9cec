#pragma once
#include <QStringList>
#include <filesystem>

class QSettings;

namespace icome::ui {

/// The designs that were opened or saved last, the newest first; kept in the settings, which outlive it.
class RecentFiles {
 public:
  static constexpr int kMost = 10;

  explicit RecentFiles(QSettings& settings);

  /// Absolute paths.
  const QStringList& paths() const { return paths_; }
  void add(const std::filesystem::path& design);
  void remove(const std::filesystem::path& design);
  void clear();
  /// What to call them in a menu: the file's name, with its folder where two have the same.
  QStringList labels() const;

 private:
  void keep();

  QSettings& settings_;
  QStringList paths_;
};

/// Between the two ways to write a path, whatever the locale.
QString text_of(const std::filesystem::path& path);
std::filesystem::path path_of(const QString& text);

}  // namespace icome::ui
