#include "cutout/calibration/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "charts/canvas.h"

namespace icome::cutout {
namespace {

using base::Vector2;

constexpr double kPointsInMm = 72.0 / 25.4;
constexpr double kPageWidth = 297.0, kPageHeight = 210.0;  // mm, A4 on its side
constexpr double kPageMargin = 12.0;
constexpr charts::Colour kInk = {0, 0, 0};
constexpr charts::Colour kCutBlue = {28 / 255.0, 74 / 255.0, 172 / 255.0};

/// Draws in mm.
class MmPage {
 public:
  MmPage() : canvas_(charts::Canvas::of_pdf(kPageWidth * kPointsInMm, kPageHeight * kPointsInMm)) {}

  void box(double x, double y, double width, double height) {
    canvas_.fill({x * kPointsInMm, y * kPointsInMm, width * kPointsInMm, height * kPointsInMm}, kInk);
  }
  void text(double x, double y, const std::string& words, double size = 3.2) {
    canvas_.text({x * kPointsInMm, y * kPointsInMm}, words, {.size = size * kPointsInMm, .colour = kInk});
  }
  void triangle(const std::array<Vector2, 3>& corners) {
    std::array<Vector2, 4> points;
    for (std::size_t i = 0; i < 4; ++i) points[i] = corners[i % 3] * kPointsInMm;
    canvas_.fill_polygon(std::span(points).first(3), kCutBlue);
  }
  void next() {
    canvas_.next_page();
    ++pages;
  }
  std::string pdf() { return canvas_.pdf(); }

  int pages = 1;

 private:
  charts::Canvas canvas_;
};

void draw_board(MmPage& page, const Chessboard& board) {
  const double width = board.square * (board.columns + 1), height = board.square * (board.rows + 1);
  const double left = (kPageWidth - width) / 2, top = (kPageHeight - height) / 2 - 3;
  for (int row = 0; row <= board.rows; ++row)
    for (int column = 0; column <= board.columns; ++column)
      if ((row + column) % 2 == 0)
        page.box(left + column * board.square, top + row * board.square, board.square, board.square);
  const double below = top + height + 5;
  page.text(
      left, below + 1,
      fmt::format("ICOME, {} x {} squares of {:g} mm. Print at true size (100 %). This line is 100 mm long:",
                  board.columns + 1, board.rows + 1, board.square));
  page.box(left + width - 100, below + 3, 100, 0.4);
  for (const double end : {0.0, 99.6}) page.box(left + width - 100 + end, below + 1.5, 0.4, 3.4);
}

/// A triangle on a page: as it is cut, with its base below.
struct Cutting {
  const KnownTriangle* triangle;
  double width, height;
};

void draw_triangles(MmPage& page, const KnownTriangles& known, std::vector<std::string>& notes) {
  constexpr double kGap = 6.0, kLabel = 5.0;
  std::vector<Cutting> cuttings;
  for (const KnownTriangle& triangle : known.triangles) {
    const Cutting cutting = {&triangle, 2.0 * triangle.height / std::tan(triangle.base_angle),
                             triangle.height};
    if (cutting.width > kPageWidth - 2 * kPageMargin ||
        cutting.height > kPageHeight - 2 * kPageMargin - kLabel) {
      notes.push_back(
          fmt::format("'{}' is {:.0f} x {:.0f} mm large and fits on no page of A4; draw it by hand",
                      triangle.id, cutting.width, cutting.height));
    } else {
      cuttings.push_back(cutting);
    }
  }
  std::ranges::stable_sort(cuttings, std::greater(), &Cutting::height);
  double x = kPageMargin, y = kPageHeight, row = 0;
  for (const Cutting& cutting : cuttings) {
    if (x + cutting.width > kPageWidth - kPageMargin) {
      x = kPageMargin;
      y += row + kLabel + kGap;
      row = 0;
    }
    if (y + cutting.height + kLabel > kPageHeight - kPageMargin) {
      page.next();
      x = y = kPageMargin;
      row = 0;
    }
    const double foot = y + cutting.height;
    page.triangle({{{x + cutting.width / 2, y}, {x, foot}, {x + cutting.width, foot}}});
    page.text(x, foot + 4,
              fmt::format("{}: {:.4g} degrees, {:.4g} mm", cutting.triangle->id,
                          cutting.triangle->base_angle * 57.29577951308232, cutting.height),
              2.6);
    x += std::max(cutting.width, 38.0) + kGap;
    row = std::max(row, cutting.height);
  }
}

}  // namespace

Sheet make_sheet(const Chessboard& board, const KnownTriangles& known) {
  Sheet sheet;
  MmPage page;
  draw_board(page, board);
  draw_triangles(page, known, sheet.notes);
  sheet.pages = page.pages;
  sheet.pdf = page.pdf();
  return sheet;
}

}  // namespace icome::cutout
