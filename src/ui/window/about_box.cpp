#include "ui/window/about_box.h"

#include <QDialogButtonBox>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>

#include "base/version.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr int kIconSide = 64;

QLabel* words(const QString& text, QWidget* parent) {
  auto* label = new QLabel(text, parent);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextBrowserInteraction);
  label->setOpenExternalLinks(true);
  return label;
}

QLabel* headline(QWidget* parent) {
  auto* label = new QLabel("ICOME", parent);
  QFont font = label->font();
  font.setPointSizeF(font.pointSizeF() * 1.8);
  font.setWeight(QFont::DemiBold);
  label->setFont(font);
  return label;
}

QString link(const char* address, const char* name) {
  return QString("<a href=\"%1\">%2</a>").arg(address, name);
}

QString thanks() {
  const QStringList parts{
      link("https://www.qt.io", "Qt"),
      link("https://opencsg.org", "OpenCSG"),
      link("https://www.coin3d.org", "Coin"),
      link("https://graphics.pixar.com/opensubdiv", "OpenSubdiv"),
      link("https://eigen.tuxfamily.org", "Eigen"),
      link("https://beltoforion.de/en/muparser", "muParser"),
      link("https://flatbuffers.dev", "FlatBuffers"),
      link("https://spacenav.sourceforge.net", "spacenav"),
      link("https://www.mesa3d.org", "Mesa"),
      link("https://www.debian.org", "Debian"),
  };
  return QString("It stands on the work of others; thanks to those who make %1.").arg(parts.join(", "));
}

QString machine(const QString& renderer) {
  const QString drawn =
      renderer.isEmpty() ? "not known yet: nothing has been drawn" : renderer.toHtmlEscaped();
  return QString("Qt %1 on %2<br>Drawn by: %3").arg(qVersion(), QGuiApplication::platformName(), drawn);
}

}  // namespace

AboutBox::AboutBox(const QString& renderer, QWidget* parent) : QDialog(parent) {
  setWindowTitle("About ICOME");
  auto* picture = new QLabel(this);
  picture->setPixmap(app_icon().pixmap(QSize(kIconSide, kIconSide), devicePixelRatioF()));
  picture->setAccessibleName("ICOME's icon");

  auto* text = new QVBoxLayout;
  text->setSpacing(3 * kGrid);
  text->addWidget(headline(this));
  auto* version = words(QString("Version %1").arg(base::kVersion), this);
  version->setForegroundRole(QPalette::PlaceholderText);
  text->addWidget(version);
  text->addWidget(
      words("An <b>Immersive Collaborative Object Modelling Environment</b>: makes 3D designs "
            "touchable, with a force-feedback device or with the mouse, and lets you change them "
            "under your hand.",
            this));
  text->addWidget(words(thanks(), this));
  text->addWidget(words(machine(renderer), this));
  text->addWidget(
      words("© 2026 The ICOME authors. Free software under the MIT licence: use, change and pass "
            "it on as you like, without warranty.",
            this));

  auto* across = new QHBoxLayout;
  across->setSpacing(5 * kGrid);
  across->addWidget(picture, 0, Qt::AlignTop);
  across->addLayout(text, 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(6 * kGrid, 6 * kGrid, 6 * kGrid, 4 * kGrid);
  all->setSpacing(5 * kGrid);
  all->addLayout(across);
  all->addWidget(buttons);
  setMinimumWidth(120 * kGrid);
}

}  // namespace icome::ui
