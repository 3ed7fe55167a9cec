#include "ui/actions/file_actions.h"

namespace icome::ui {
namespace {

struct Format {
  const char* name;
  const char* endings;
  bool written;
};

// The formats that `files` reads and writes, with their names for people.
constexpr Format kFormats[] = {
    {"ICOME", "*.icome", true},
    {"VRML 2.0", "*.wrl *.vrml", true},
    {"glTF 2.0, binary", "*.glb", true},
    {"glTF 2.0", "*.gltf", true},
    {"Wavefront OBJ", "*.obj", true},
    {"PLY", "*.ply", true},
    {"STL", "*.stl", true},
    {"OFF", "*.off", true},
    {"SVG drawing", "*.svg", true},
    {"OpenSCAD CSG", "*.csg", false},
    {"Packed meshes", "*.obj.xz *.ply.xz *.stl.xz *.off.xz", false},
};

QString filter_of(const Format& format) { return QString("%1 (%2)").arg(format.name, format.endings); }

}  // namespace

QStringList open_filters() {
  QStringList endings, filters;
  for (const Format& it : kFormats) {
    endings << it.endings;
    filters << filter_of(it);
  }
  filters.prepend(QString("All designs (%1)").arg(endings.join(' ')));
  return filters << "Cut-out animation (*.cutout)"
                 << "All files (*)";
}

QStringList save_filters() {
  QStringList filters;
  for (const Format& it : kFormats) {
    if (it.written) filters << filter_of(it);
  }
  return filters;
}

QString ending_of(const QString& filter) {
  const qsizetype star = filter.indexOf("*.");
  if (star < 0) return {};
  qsizetype end = star + 2;
  while (end < filter.size() && filter[end].isLetterOrNumber()) ++end;
  return filter.mid(star + 2, end - star - 2);
}

}  // namespace icome::ui
