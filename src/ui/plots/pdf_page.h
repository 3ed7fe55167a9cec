#pragma once
#include <filesystem>
#include <string>

#include "base/result.h"

namespace icome::ui {

/// What a PDF file says about itself.
struct PdfTitle {
  std::string title;
  std::string foot;  // left of the page numbers, at the foot of every page
};

/// Writes a page of HTML as a PDF file of A4 pages with their numbers. The HTML is of the subset that Qt's
/// rich text knows, with pictures as data: addresses of PNG bytes. Needs no display, and no other Qt
/// application in the program, which it makes and ends. The file appears whole or not at all. Fails, saying
/// why, when it cannot be written.
base::Result<void> write_pdf(const std::string& html, const PdfTitle& title,
                             const std::filesystem::path& out);

}  // namespace icome::ui
