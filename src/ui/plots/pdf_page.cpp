#include "ui/plots/pdf_page.h"

#include <fmt/format.h>

#include <QAbstractTextDocumentLayout>
#include <QBuffer>
#include <QByteArray>
#include <QFont>
#include <QFontMetricsF>
#include <QGuiApplication>
#include <QPainter>
#include <QPdfWriter>
#include <QSaveFile>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <QTextFrame>
#include <QTextTable>
#include <algorithm>
#include <memory>

namespace icome::ui {
namespace {

constexpr int kDotsPerInch = 300;
constexpr double kMarginMm = 20.0;
constexpr double kFootMm = 8.0;     // from the text to its foot, in the margin below
constexpr double kTopMm = 1.0;      // above the first line of each page
constexpr double kFootGapMm = 6.0;  // between the foot's words and the page number
constexpr double kMmPerInch = 25.4;

double dots(double mm) { return mm / kMmPerInch * kDotsPerInch; }

/// An application that draws in memory, so that it does not depend on the platform.
std::unique_ptr<QGuiApplication> offscreen_application() {
  static int argc = 1;
  static char name[] = "icome";
  static char* argv[] = {name, nullptr};
  qputenv("QT_QPA_PLATFORM", "offscreen");
  // Messages about a machine without a desktop are of no use here.
  qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
  return std::make_unique<QGuiApplication>(argc, argv);
}

bool is_in_table(const QTextBlock& block) { return QTextCursor(block).currentTable() != nullptr; }

/// Is the block a heading, the caption above a table, or a picture above its caption?
bool stays_with_next(const QTextBlock& block) {
  if (!block.next().isValid() || is_in_table(block)) return false;
  const bool picture = block.text() == QString(QChar::ObjectReplacementCharacter);
  return picture || block.blockFormat().headingLevel() > 0 || is_in_table(block.next());
}

/// The part of a block that must stay with the blocks before it: of a table, its first row below the head.
QTextBlock held(const QTextBlock& block) {
  const QTextTable* const table = QTextCursor(block).currentTable();
  if (table == nullptr) return block;
  return table->cellAt(std::min(1, table->rows() - 1), 0).firstCursorPosition().block();
}

int page_at(const QTextDocument& document, double y) { return int(y / document.pageSize().height()); }

/// Inserts a page break where otherwise a heading or a caption would be the last thing on a page.
void keep_together(QTextDocument& document) {
  const QAbstractTextDocumentLayout& layout = *document.documentLayout();
  for (QTextBlock block = document.begin(); block.isValid();) {
    QTextBlock last = block;
    while (stays_with_next(last)) last = last.next();
    if (last != block) {
      const int first_page = page_at(document, layout.blockBoundingRect(block).top() + 1.0);
      const int last_page = page_at(document, layout.blockBoundingRect(held(last)).bottom() - 1.0);
      if (first_page != last_page) {
        QTextBlockFormat format = block.blockFormat();
        format.setPageBreakPolicy(QTextFormat::PageBreak_AlwaysBefore);
        QTextCursor(block).setBlockFormat(format);
        document.markContentsDirty(0, document.characterCount());
      }
    }
    block = last.next();
  }
}

/// The text as one line, without control characters.
QString clean_line(const std::string& text) {
  QString line = QString::fromStdString(text);
  for (QChar& letter : line)
    if (letter.category() == QChar::Other_Control) letter = ' ';
  return line.simplified();
}

void draw_foot(QPainter& painter, const QRectF& text_area, const std::string& foot, int page, int pages) {
  QFont font("DejaVu Sans");
  font.setPointSizeF(8.0);
  painter.setFont(font);
  painter.setPen(QColor(0x66, 0x6b, 0x75));
  const QRectF area(0.0, text_area.height() + dots(kFootMm), text_area.width(), dots(5.0));
  const QString number = QString::fromStdString(fmt::format("{} / {}", page, pages));
  const QFontMetricsF metrics(font, painter.device());
  const double room = area.width() - metrics.horizontalAdvance(number) - dots(kFootGapMm);
  painter.drawText(area, Qt::AlignLeft | Qt::AlignTop,
                   metrics.elidedText(clean_line(foot), Qt::ElideRight, room));
  painter.drawText(area, Qt::AlignRight | Qt::AlignTop, number);
}

void draw_pages(QPdfWriter& writer, QTextDocument& document, const QSizeF& size, const std::string& foot) {
  QPainter painter(&writer);
  const int pages = document.pageCount();
  for (int page = 0; page < pages; ++page) {
    if (page > 0) writer.newPage();
    painter.save();
    painter.translate(0.0, -page * size.height());
    QAbstractTextDocumentLayout::PaintContext context;
    context.clip = QRectF(0.0, page * size.height(), size.width(), size.height());
    context.palette.setColor(QPalette::Text, QColor(0x1d, 0x21, 0x29));
    painter.setClipRect(context.clip);
    document.documentLayout()->draw(&painter, context);
    painter.restore();
    draw_foot(painter, QRectF(QPointF(), size), foot, page + 1, pages);
  }
}

QByteArray pdf_bytes(const std::string& html, const PdfTitle& title) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  QPdfWriter writer(&buffer);
  writer.setResolution(kDotsPerInch);
  writer.setPageSize(QPageSize(QPageSize::A4));
  writer.setPageMargins(QMarginsF(kMarginMm, kMarginMm, kMarginMm, kMarginMm), QPageLayout::Millimeter);
  writer.setTitle(clean_line(title.title));
  writer.setCreator("icome");
  QTextDocument document;
  document.documentLayout()->setPaintDevice(&writer);
  QFont font("DejaVu Serif");
  font.setPointSizeF(9.5);
  document.setDefaultFont(font);
  document.setDocumentMargin(0.0);
  document.setHtml(QString::fromStdString(html));
  // Text begins a little lower, so that a viewer that clips to whole pixels shows none of the next page.
  QTextFrameFormat frame = document.rootFrame()->frameFormat();
  frame.setTopMargin(dots(kTopMm));
  document.rootFrame()->setFrameFormat(frame);
  const QSizeF size(writer.width(), writer.height());
  document.setPageSize(size);
  keep_together(document);
  draw_pages(writer, document, size, title.foot);
  return bytes;
}

}  // namespace

base::Result<void> write_pdf(const std::string& html, const PdfTitle& title,
                             const std::filesystem::path& out) {
  // Qt's messages about a missing desktop do not matter for a file.
  const QtMessageHandler usual =
      qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
  const auto application = offscreen_application();
  const QByteArray bytes = pdf_bytes(html, title);
  qInstallMessageHandler(usual);
  if (bytes.isEmpty()) return base::fail(fmt::format("{}: the pages could not be drawn.", out.string()));
  QSaveFile file(QString::fromStdString(out.string()));
  if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.commit())
    return base::fail(
        fmt::format("{} cannot be written: {}.", out.string(), file.errorString().toStdString()));
  return {};
}

}  // namespace icome::ui
