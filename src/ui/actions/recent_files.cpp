#include "ui/actions/recent_files.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSettings>

namespace icome::ui {
namespace {

const char* const kKey = "recent";

QString kept_path(const std::filesystem::path& design) {
  return QDir::cleanPath(QFileInfo(text_of(design)).absoluteFilePath());
}

}  // namespace

QString text_of(const std::filesystem::path& path) {
  return QFile::decodeName(QByteArray::fromStdString(path.string()));
}

std::filesystem::path path_of(const QString& text) { return QFile::encodeName(text).toStdString(); }

RecentFiles::RecentFiles(QSettings& settings) : settings_(settings) {
  for (const QString& path : settings_.value(kKey).toStringList()) {
    if (paths_.size() < kMost && !path.isEmpty() && !paths_.contains(path)) paths_ << path;
  }
}

void RecentFiles::add(const std::filesystem::path& design) {
  const QString path = kept_path(design);
  paths_.removeAll(path);
  paths_.prepend(path);
  paths_ = paths_.mid(0, kMost);
  keep();
}

void RecentFiles::remove(const std::filesystem::path& design) {
  if (paths_.removeAll(kept_path(design)) > 0) keep();
}

void RecentFiles::clear() {
  paths_.clear();
  keep();
}

void RecentFiles::keep() { settings_.setValue(kKey, paths_); }

QStringList RecentFiles::labels() const {
  QStringList names, labels;
  for (const QString& path : paths_) names << QFileInfo(path).fileName();
  for (int i = 0; i < paths_.size(); ++i) {
    const QFileInfo file(paths_[i]);
    const bool clear = names.count(names[i]) == 1;
    labels << (clear ? names[i] : QString("%1  (%2)").arg(names[i], file.dir().path()));
  }
  return labels;
}

}  // namespace icome::ui
