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
  /// Labels for a menu: the file names, each with its folder where two are equal.
  QStringList labels() const;

 private:
  void keep();

  QSettings& settings_;
  QStringList paths_;
};

/// Conversions between the two types of a path, whatever the locale.
QString text_of(const std::filesystem::path& path);
std::filesystem::path path_of(const QString& text);

}  // namespace icome::ui
