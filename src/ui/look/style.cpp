#include "ui/look/style.h"

#include <QPainter>
#include <QPainterPath>
#include <QPlainTextEdit>
#include <QStyleOption>
#include <QWidget>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr double kRounding = 4.0;

bool enabled(const QStyleOption& option) { return option.state & QStyle::State_Enabled; }
bool under_mouse(const QStyleOption& option) {
  return enabled(option) && (option.state & QStyle::State_MouseOver);
}

void draw_panel(QPainter& painter, const QRect& rect, const QColor& fill, const QColor& edge,
                double width = 1.0) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(edge.alpha() == 0 ? QPen(Qt::NoPen) : QPen(edge, width));
  painter.setBrush(fill);
  const double inset = width / 2.0;
  painter.drawRoundedRect(QRectF(rect).adjusted(inset, inset, -inset, -inset), kRounding, kRounding);
  painter.restore();
}

/// Draws a field for typing: the focus shows as an edge in the accent's colour, a refused value as a red one.
void draw_field(QPainter& painter, const QStyleOption& option, const QWidget* widget) {
  const ThemeColours& theme = colours();
  const bool focus = enabled(option) && (option.state & QStyle::State_HasFocus);
  if (widget && widget->property("refused").toBool())
    return draw_panel(painter, option.rect, option.palette.color(QPalette::Base), theme.bad, 1.5);
  const QColor edge = focus ? theme.accent : under_mouse(option) ? theme.faint : theme.line;
  draw_panel(painter, option.rect, option.palette.color(QPalette::Base), edge, focus ? 1.5 : 1.0);
}

void draw_button(QPainter& painter, const QStyleOption& option, bool flat) {
  const ThemeColours& theme = colours();
  const bool down = option.state & (QStyle::State_Sunken | QStyle::State_On);
  const bool focus =
      (option.state & QStyle::State_HasFocus) && (option.state & QStyle::State_KeyboardFocusChange);
  if (flat && !down && !under_mouse(option) && !focus) return;
  QColor fill = flat ? QColor(Qt::transparent) : enabled(option) ? theme.raised : theme.window;
  if (under_mouse(option)) fill = theme.hover;
  if (down) fill = theme.selection;
  QColor edge = flat ? QColor(Qt::transparent) : theme.line;
  if (focus || (option.state & QStyle::State_On)) edge = theme.accent;
  draw_panel(painter, option.rect, fill, edge);
}

/// A small angle that points down, up, left or right.
void draw_chevron(QPainter& painter, const QRect& rect, double degrees, const QColor& colour) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colour, 1.4, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  painter.translate(QRectF(rect).center());
  painter.rotate(degrees);
  painter.drawPolyline(QPolygonF{{-3.5, -1.75}, {0.0, 1.75}, {3.5, -1.75}});
  painter.restore();
}

void draw_check(QPainter& painter, const QStyleOption& option, bool round) {
  const ThemeColours& theme = colours();
  const bool on = option.state & QStyle::State_On;
  const bool mixed = option.state & QStyle::State_NoChange;
  const bool focus = option.state & QStyle::State_HasFocus;
  const QColor mark = enabled(option) ? theme.accent : theme.line;
  const QColor edge = on || mixed || focus ? mark : under_mouse(option) ? theme.faint : theme.line;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = QRectF(option.rect).adjusted(0.75, 0.75, -0.75, -0.75);
  painter.setPen(QPen(edge, 1.2));
  painter.setBrush(on || mixed ? mark : option.palette.color(QPalette::Base));
  const double rounding = round ? box.height() / 2.0 : 3.0;
  painter.drawRoundedRect(box, rounding, rounding);
  const QColor ink = is_dark() ? theme.base : QColor(Qt::white);
  painter.setPen(QPen(ink, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  painter.translate(box.center());
  painter.scale(box.width() / 14.0, box.width() / 14.0);
  if (mixed) {
    painter.drawLine(QPointF(-3.5, 0.0), QPointF(3.5, 0.0));
  } else if (on && round) {
    painter.setBrush(ink);
    painter.drawEllipse(QPointF(), 2.2, 2.2);
  } else if (on) {
    painter.drawPolyline(QPolygonF{{-3.6, 0.2}, {-1.0, 2.8}, {3.8, -2.8}});
  }
  painter.restore();
}

void draw_combo_box(QPainter& painter, const QStyleOptionComboBox& option) {
  if (option.editable) {
    draw_field(painter, option, nullptr);
  } else {
    draw_button(painter, option, !option.frame);
    if (option.state & QStyle::State_HasFocus)
      draw_panel(painter, option.rect, Qt::transparent, colours().accent);
  }
  const QRect arrow(option.rect.right() - 18, option.rect.top(), 14, option.rect.height());
  draw_chevron(painter, arrow, 0.0, enabled(option) ? colours().faint : colours().line);
}

void draw_scroll_bar(QPainter& painter, const QStyleOptionSlider& option, QRect handle) {
  painter.fillRect(option.rect, option.palette.color(QPalette::Window));
  if (option.minimum >= option.maximum) return;
  const bool held = option.state & QStyle::State_Sunken;
  const ThemeColours& theme = colours();
  QColor fill = theme.faint;
  fill.setAlphaF(held ? 0.9F : under_mouse(option) ? 0.7F : 0.45F);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(fill);
  const QRectF bar = QRectF(handle).adjusted(2.5, 2.5, -2.5, -2.5);
  const double rounding = std::min(bar.width(), bar.height()) / 2.0;
  painter.drawRoundedRect(bar, rounding, rounding);
  painter.restore();
}

double chevron_turn(QStyle::PrimitiveElement element) {
  switch (element) {
    case QStyle::PE_IndicatorArrowUp:
      return 180.0;
    case QStyle::PE_IndicatorArrowLeft:
      return 90.0;
    case QStyle::PE_IndicatorArrowRight:
      return -90.0;
    default:
      return 0.0;
  }
}

}  // namespace

void DesktopStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                                 const QWidget* widget) const {
  switch (element) {
    case PE_PanelLineEdit: {
      const auto* frame = qstyleoption_cast<const QStyleOptionFrame*>(option);
      if (frame && frame->lineWidth > 0) draw_field(*painter, *option, widget);
      return;
    }
    case PE_FrameLineEdit:
      return draw_field(*painter, *option, widget);
    case PE_PanelButtonCommand: {
      const auto* button = qstyleoption_cast<const QStyleOptionButton*>(option);
      draw_button(*painter, *option, button && (button->features & QStyleOptionButton::Flat));
      if (button && (button->features & QStyleOptionButton::DefaultButton))
        draw_panel(*painter, option->rect, Qt::transparent, colours().accent);
      return;
    }
    case PE_PanelButtonTool:
      return draw_button(*painter, *option, true);
    case PE_IndicatorCheckBox:
      return draw_check(*painter, *option, false);
    case PE_IndicatorRadioButton:
      return draw_check(*painter, *option, true);
    case PE_IndicatorArrowDown:
    case PE_IndicatorArrowUp:
    case PE_IndicatorArrowLeft:
    case PE_IndicatorArrowRight:
      return draw_chevron(*painter, option->rect, chevron_turn(element), colours().faint);
    case PE_IndicatorBranch:
      if (option->state & State_Children)
        draw_chevron(*painter, option->rect, option->state & State_Open ? 0.0 : -90.0, colours().faint);
      return;
    case PE_Frame:
      if (qobject_cast<const QPlainTextEdit*>(widget)) return draw_field(*painter, *option, widget);
      painter->save();
      painter->setPen(colours().line);
      painter->drawRect(option->rect.adjusted(0, 0, -1, -1));
      painter->restore();
      return;
    default:
      return QProxyStyle::drawPrimitive(element, option, painter, widget);
  }
}

void DesktopStyle::drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                               const QWidget* widget) const {
  // Tool bars are as flat as the panels beside them.
  if (element == CE_ToolBar || element == CE_MenuBarEmptyArea) {
    painter->fillRect(option->rect, colours().window);
    return;
  }
  QProxyStyle::drawControl(element, option, painter, widget);
}

void DesktopStyle::drawComplexControl(ComplexControl control, const QStyleOptionComplex* option,
                                      QPainter* painter, const QWidget* widget) const {
  if (const auto* box = qstyleoption_cast<const QStyleOptionComboBox*>(option); box && control == CC_ComboBox)
    return draw_combo_box(*painter, *box);
  if (const auto* bar = qstyleoption_cast<const QStyleOptionSlider*>(option); bar && control == CC_ScrollBar)
    return draw_scroll_bar(*painter, *bar, subControlRect(control, option, SC_ScrollBarSlider, widget));
  if (const auto* box = qstyleoption_cast<const QStyleOptionSpinBox*>(option);
      box && control == CC_SpinBox && box->buttonSymbols == QAbstractSpinBox::NoButtons) {
    if (box->frame) draw_field(*painter, *option, widget);
    return;
  }
  QProxyStyle::drawComplexControl(control, option, painter, widget);
}

int DesktopStyle::pixelMetric(PixelMetric metric, const QStyleOption* option, const QWidget* widget) const {
  switch (metric) {
    case PM_ScrollBarExtent:
      return 3 * kGrid;
    case PM_ScrollBarSliderMin:
      return 6 * kGrid;
    case PM_ToolBarIconSize:
      return 5 * kGrid;
    case PM_SmallIconSize:
      return 4 * kGrid;
    case PM_TreeViewIndentation:
      return 4 * kGrid;
    case PM_ToolBarItemSpacing:
      return 2;
    case PM_ToolBarItemMargin:
      return kGrid;
    case PM_ToolBarFrameWidth:
      return 0;
    case PM_LayoutHorizontalSpacing:
    case PM_LayoutVerticalSpacing:
      return 2 * kGrid;
    case PM_IndicatorWidth:
    case PM_IndicatorHeight:
    case PM_ExclusiveIndicatorWidth:
    case PM_ExclusiveIndicatorHeight:
      return std::max(4 * kGrid, widget ? widget->fontMetrics().ascent() : 0);  // large type, large boxes
    default:
      return QProxyStyle::pixelMetric(metric, option, widget);
  }
}

int DesktopStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                            QStyleHintReturn* answer) const {
  switch (hint) {
    case SH_ToolTip_WakeUpDelay:
      return 500;
    case SH_EtchDisabledText:
      return 0;
    case SH_ScrollBar_ContextMenu:
      return 0;
    default:
      return QProxyStyle::styleHint(hint, option, widget, answer);
  }
}

QRect DesktopStyle::subControlRect(ComplexControl control, const QStyleOptionComplex* option, SubControl part,
                                   const QWidget* widget) const {
  const auto* bar = qstyleoption_cast<const QStyleOptionSlider*>(option);
  if (control != CC_ScrollBar || !bar) return QProxyStyle::subControlRect(control, option, part, widget);
  // No buttons at the ends: the groove is all there is.
  const bool across = bar->orientation == Qt::Horizontal;
  const int length = across ? bar->rect.width() : bar->rect.height();
  const double range = double(bar->maximum) - bar->minimum + bar->pageStep;
  const int least = pixelMetric(PM_ScrollBarSliderMin, option, widget);
  const int size =
      range > 0 ? std::clamp(int(length * (bar->pageStep / range)), std::min(least, length), length) : length;
  const int start = sliderPositionFromValue(bar->minimum, bar->maximum, bar->sliderPosition, length - size,
                                            bar->upsideDown);
  const auto piece = [&](int from, int to) {
    const QRect rect =
        across ? QRect(from, 0, to - from, bar->rect.height()) : QRect(0, from, bar->rect.width(), to - from);
    return visualRect(bar->direction, bar->rect, rect.translated(bar->rect.topLeft()));
  };
  switch (part) {
    case SC_ScrollBarSlider:
      return piece(start, start + size);
    case SC_ScrollBarGroove:
      return piece(0, length);
    case SC_ScrollBarSubPage:
      return piece(0, start);
    case SC_ScrollBarAddPage:
      return piece(start + size, length);
    default:
      return {};
  }
}

}  // namespace icome::ui
