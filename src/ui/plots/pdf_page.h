#pragma once
#include <filesystem>
#include <string>

#include "base/result.h"

namespace icome::ui {

/// The title of a PDF file, and the line at the foot of its pages.
struct PdfTitle {
  std::string title;
  std::string foot;  // left of the page numbers, at the foot of every page
};

/// Writes HTML as a PDF file of numbered A4 pages. The HTML is of the subset that Qt's rich text knows, with
/// pictures as data: addresses of PNG bytes. Needs no display; it makes and ends a Qt application, so there
/// must be no other in the program. The file appears whole or not at all. Fails, with the reason, when it
/// cannot be written.
base::Result<void> write_pdf(const std::string& html, const PdfTitle& title,
                             const std::filesystem::path& out);

}  // namespace icome::ui
