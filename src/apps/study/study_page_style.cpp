#include "apps/study/study_page_parts.h"

namespace icome::apps {
namespace {

constexpr const char* kScreenStyle = R"(
:root { color-scheme: light; --ink: #1d2129; --quiet: #5d6470; --rule: #1d2129; --thin: #d8dbe1; }
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; }
body { margin: 0 auto; padding: 2.5rem 1.25rem 5rem; max-width: 50rem; background: #fff; color: var(--ink);
  font: 1.06rem/1.6 Charter, "Bitstream Charter", "Iowan Old Style", "Source Serif 4", Cambria, Georgia,
  "DejaVu Serif", serif; }
h1, h2, h3, caption, figcaption, table, .note, .byline, .banner, nav, .stamp { font-family: system-ui,
  -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; }
h1 { margin: 0 0 .4rem; font-size: 2rem; line-height: 1.2; letter-spacing: -.015em; }
h2 { margin: 3rem 0 .8rem; padding-top: 1.1rem; border-top: 1px solid var(--thin); font-size: 1.35rem;
  line-height: 1.3; }
h3 { margin: 2rem 0 .5rem; font-size: 1.05rem; line-height: 1.4; }
h1, h2, h3, caption, figcaption, p, li, blockquote, .left { overflow-wrap: break-word; word-break: break-word;
  overflow-wrap: anywhere; }
p { margin: 0 0 1rem; }
ul { margin: 0 0 1rem; padding-left: 1.3rem; }
li { margin: .2rem 0; }
.byline { color: var(--quiet); font-size: .92rem; margin-bottom: 2rem; }
.banner { margin: 0 0 2rem; padding: .9rem 1.2rem; border: 2px solid #b45309; border-radius: .4rem;
  background: #fef3c7; color: #7c2d12; font-size: 1rem; line-height: 1.45; }
.banner b { display: block; font-size: 1.9rem; letter-spacing: .16em; line-height: 1.2; }
.stamp { display: inline-block; padding: 0 .4em; border-radius: .2em; background: #fef3c7; color: #7c2d12;
  font-size: .78em; font-weight: 700; letter-spacing: .08em; }
.care { margin: 0 0 1.5rem; padding: .8rem 1.2rem .3rem; border-left: 4px solid #d97706; background: #fffbeb; }
.wide { overflow-x: auto; margin: 1.8rem 0 .4rem; }
.wide:focus-visible { outline: 2px solid #2563eb; outline-offset: 4px; }
.alone { margin-bottom: 1.6rem; }
table { width: 100%; border-collapse: collapse; font-size: .9rem; line-height: 1.4;
  font-variant-numeric: tabular-nums lining-nums; border-bottom: 2px solid var(--rule); }
caption, figcaption { text-align: left; font-size: .9rem; line-height: 1.45; color: var(--ink); }
caption { padding-bottom: .5rem; }
thead th, thead td { border-top: 2px solid var(--rule); border-bottom: 1px solid var(--rule); font-weight: 600;
  vertical-align: bottom; }
th, td { padding: .38rem .7rem; }
th:first-child, td:first-child { padding-left: 0; }
th:last-child, td:last-child { padding-right: 0; }
tbody th, tbody td { vertical-align: top; border-bottom: 1px solid #eef0f3; font-weight: 400; }
tbody .last { border-bottom: 0; }
.left { text-align: left; min-width: 6.5em; }
.right { text-align: right; white-space: nowrap; }
th.right { white-space: normal; max-width: 16em; overflow-wrap: break-word; word-wrap: break-word; }
.note { color: var(--quiet); font-size: .82rem; line-height: 1.5; margin-bottom: 1.6rem; }
figure { margin: 2rem 0; }
figure img { display: block; width: 100%; height: auto; }
figcaption { margin-top: .5rem; }
blockquote { margin: 0 0 1rem; padding: .2rem 0 .2rem 1.1rem; border-left: 3px solid var(--thin); }
.who { color: var(--quiet); font-size: .85rem; }
@media (max-width: 40rem) {
  body { padding: 1.5rem 1rem 3rem; font-size: 1rem; }
  h1 { font-size: 1.55rem; }
  table { font-size: .82rem; }
  th, td { padding: .35rem .45rem; }
}
@media print {
  @page { size: A4; margin: 20mm 18mm; }
  body { max-width: none; padding: 0; font-size: 10.5pt; }
  h2, h3 { break-after: avoid; }
  figure, table, .banner, blockquote { break-inside: avoid; }
  .wide { overflow: visible; }
  .banner, .stamp, .care { -webkit-print-color-adjust: exact; print-color-adjust: exact; }
}
)";

// Qt's rich text knows no more than this.
constexpr const char* kPaperStyle = R"(
body { color: #1d2129; }
h1 { font-family: "DejaVu Sans"; font-size: 19pt; margin-top: 0px; margin-bottom: 4px; }
h2 { font-family: "DejaVu Sans"; font-size: 13pt; margin-top: 26px; margin-bottom: 8px; }
h3 { font-family: "DejaVu Sans"; font-size: 10.5pt; margin-top: 16px; margin-bottom: 5px; }
p { margin-top: 0px; margin-bottom: 8px; }
table { border-collapse: collapse; border-style: none; font-family: "DejaVu Sans"; font-size: 8pt; }
th { border-top: 1px solid #1d2129; border-bottom: 1px solid #1d2129; font-weight: bold; }
td.last { border-bottom: 1px solid #1d2129; }
.byline { font-family: "DejaVu Sans"; font-size: 8.5pt; color: #5d6470; }
.banner { font-family: "DejaVu Sans"; font-size: 9pt; color: #7c2d12; background-color: #fef3c7; }
.banner b { font-size: 20pt; }
.stamp { font-family: "DejaVu Sans"; font-weight: bold; color: #7c2d12; background-color: #fef3c7; }
.caption { font-family: "DejaVu Sans"; font-size: 8.5pt; margin-top: 12px; margin-bottom: 5px; }
.note { font-family: "DejaVu Sans"; font-size: 7.5pt; color: #5d6470; margin-top: 4px; margin-bottom: 12px; }
.who { font-family: "DejaVu Sans"; font-size: 7.5pt; color: #5d6470; }
.picture { margin-top: 12px; margin-bottom: 2px; }
)";

}  // namespace

std::string page_style(PageForm form) { return form == PageForm::Screen ? kScreenStyle : kPaperStyle; }

}  // namespace icome::apps
