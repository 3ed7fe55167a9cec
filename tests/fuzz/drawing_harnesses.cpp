// Drawings: SVG of others, recordings of pens, and drawings and their edits as bytes.
#include "drawing/shape/drawing_bytes.h"
#include "drawing/shape/drawing_shape.h"
#include "drawing/svg/svg_reader.h"
#include "drawing/svg/svg_writer.h"
#include "drawing/test_drawings.h"
#include "fuzz/harness.h"
#include "sketch/files/stroke_formats.h"
#include "world/shape/mesh_geometry.h"

namespace icome::fuzz {
namespace {

using drawing::Drawing;
using drawing::DrawingShape;

/// A drawing that was read can be written and is read again as the same.
void run_svg(std::string_view bytes) {
  const auto read = drawing::read_svg_text(bytes, "f");
  if (!read) return require_told(read.error());
  const std::string text = drawing::svg_text(read->drawing, drawing::SvgLines::CentreLines);
  const auto again = drawing::read_svg_text(text, "f");
  require(again.has_value(), "a drawing that was written can be read");
  require(again->drawing.stroke_count() == read->drawing.stroke_count(), "and has the same strokes");
}

void require_strokes(const base::Result<sketch::StrokesRead>& read) {
  if (!read) return require_told(read.error());
  require(!read->strokes.empty(), "a recording that was read has a stroke");
  for (const sketch::PenStroke& stroke : read->strokes) {
    require(!stroke.empty(), "a stroke that was read has a sample");
    for (const sketch::PenSample& sample : stroke)
      require(sample.place.allFinite() && sample.pressure >= 0.0 && sample.pressure <= 1.0,
              "places are finite, and pressures shares");
  }
}

void run_strokes(std::string_view bytes) {
  require_strokes(sketch::read_csv_strokes(bytes, "f"));
  require_strokes(sketch::read_inkml_strokes(bytes, "f"));
  require_strokes(sketch::read_svc_strokes(bytes, "f"));
  require_strokes(sketch::read_scap_strokes(bytes, "f"));
  require_strokes(sketch::read_mypaint_strokes(bytes, "f"));
}

Drawing sample_drawing() {
  return drawing::judges::drawing_with(
      {drawing::judges::random_curve(1, 3), drawing::judges::random_curve(2, 2, true)});
}

void run_drawing(std::string_view bytes) {
  const auto read = drawing::read_drawing_shape(bytes);
  if (!read) return require_told(read.error());
  const auto written = (*read)->write();
  require(written.has_value(), "a drawing that was read can be written");
  const auto again = drawing::read_drawing_shape(*written);
  require(again.has_value() && (*again)->hash() == (*read)->hash(), "and is read again as the same");
}

void run_drawing_edit(std::string_view bytes) {
  static const auto kShape = *DrawingShape::create(sample_drawing(), {});
  const auto amended = kShape->amended(bytes);
  if (!amended) return require_told(amended.error());
  const auto back = amended->shape->amended(amended->back);
  require(back.has_value() && back->shape->hash() == kShape->hash(),
          "an edit of a drawing can be taken back");
}

std::vector<std::string> svg_seeds() {
  return {
      drawing::svg_text(sample_drawing(), drawing::SvgLines::Outlines),
      drawing::svg_text(sample_drawing(), drawing::SvgLines::CentreLines),
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 10 10'><style>.a{fill:hsl(9,9%,9%)}</style>"
      "<g transform='rotate(9) skewX(3)' class='a'><path d='M0 0h1v2l3,4c1 2 3 4 5 6S1 2 3 4q1 2 3 4T5 6a1 2 "
      "3 0 1 4 5z'/><use href='#r'/><rect id='r' width='3' height='4' rx='1'/><polygon points='0,0 1,1 2,0'/>"
      "<ellipse rx='2' ry='1' stroke='currentColor' stroke-width='2%'/></g></svg>"};
}
std::vector<std::string> stroke_seeds() {
  return {"t,x,y,pressure\n0,1,2,0.5\n0.01,2,3,0.6\n0.02,0,0,0\n",
          "<ink xmlns='http://www.w3.org/2003/InkML'><traceFormat><channel name='X' type='decimal'/><channel "
          "name='Y' type='decimal'/></traceFormat><trace>1 2, 3 4, '1 \"1</trace></ink>",
          "3\n1 2 3 1 0 0 100\n2 3 4 1 0 0 200\n3 4 5 0 0 0 0\n",
          "#10\t10\n@1\n{\n\t#1\t1\n\t1\t2\t0\n\t3\t4\t0\n}\n", "0.0 1 2 0.5\n0.1 2 3 0.7\n"};
}
std::vector<std::string> drawing_seeds() { return {*(*DrawingShape::create(sample_drawing(), {}))->write()}; }
std::vector<std::string> drawing_edit_seeds() {
  using namespace drawing;
  const auto stroke = judges::stroke_of(9, judges::random_curve(3, 2));
  return {edit_bytes({PutStroke{LayerId{1}, 1, stroke}, TakeStroke{StrokeId{2}}}),
          edit_bytes({PutLayer{LayerId{9}, 0, {"new", false, true}}, MoveLayer{LayerId{9}, 1},
                      ChangeLayer{LayerId{1}, {"old", true, false}}, TakeLayer{LayerId{9}}}),
          edit_bytes({ResizePaper{Vector2(0.1, 0.2)}})};
}

constexpr Harness kAll[] = {{"svg", run_svg, svg_seeds},
                            {"strokes", run_strokes, stroke_seeds},
                            {"drawing", run_drawing, drawing_seeds},
                            {"drawing_edit", run_drawing_edit, drawing_edit_seeds}};

}  // namespace

std::span<const Harness> drawing_harnesses() { return kAll; }

}  // namespace icome::fuzz
