#include "ui/voice/voice_agent.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/look/theme.h"

namespace icome::ui {
namespace {

constexpr int kOutcomeStays = 2500;  // ms
constexpr int kAgentSide = 32;       // pixels

QColor colour_of(VoiceAgent::Mood mood) {
  using Mood = VoiceAgent::Mood;
  switch (mood) {
    case Mood::Asleep:
      return colours().line;
    case Mood::Puzzled:
      return colours().warning;
    case Mood::Understood:
      return colours().good;
    default:
      return colours().accent;
  }
}

bool is_outcome(VoiceAgent::Mood mood) { return mood >= VoiceAgent::Mood::Understood; }

}  // namespace

VoiceAgent::VoiceAgent(QWidget* parent) : QWidget(parent) {
  setObjectName("voice.agent");
  setFixedSize(kAgentSide, kAgentSide);
}

void VoiceAgent::show(Mood mood) {
  if (is_outcome(mood)) {
    outcome_ = mood;
    since_outcome_.start();
  } else {
    mood_ = mood;
  }
  if (this->mood() != drawn_) update();
}

void VoiceAgent::show_level(double level) {
  constexpr double kSeen = 0.02;
  if (std::abs(level - level_) < kSeen) return;
  level_ = std::clamp(level, 0.0, 1.0);
  update();
}

VoiceAgent::Mood VoiceAgent::mood() const {
  const bool stays = since_outcome_.isValid() && since_outcome_.elapsed() < kOutcomeStays;
  return stays ? outcome_ : mood_;
}

void VoiceAgent::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Mood mood = drawn_ = this->mood();
  const QColor colour = colour_of(mood);
  const QPointF centre(kAgentSide / 2.0, kAgentSide / 2.0);
  // A ring as wide as what is heard is loud.
  if (mood == Mood::Listening || mood == Mood::Hearing) {
    QColor ring = colour;
    ring.setAlphaF(0.3F);
    painter.setPen(Qt::NoPen);
    painter.setBrush(ring);
    painter.drawEllipse(centre, 11.0 + 5.0 * level_, 11.0 + 5.0 * level_);
  }
  painter.setPen(QPen(colour, 2.0, Qt::SolidLine, Qt::RoundCap));
  painter.setBrush(colours().window);
  painter.drawEllipse(centre, 11.0, 11.0);
  if (mood == Mood::Asleep) {
    painter.drawLine(QPointF(10.5, 14.0), QPointF(13.5, 14.0));
    painter.drawLine(QPointF(18.5, 14.0), QPointF(21.5, 14.0));
  } else {
    painter.setBrush(colour);
    painter.drawEllipse(QPointF(12.0, 14.0), 0.8, 0.8);
    painter.drawEllipse(QPointF(20.0, 14.0), 0.8, 0.8);
  }
  painter.setBrush(Qt::NoBrush);
  switch (mood) {
    case Mood::Understood:  // smiles
      painter.drawArc(QRectF(11.0, 14.0, 10.0, 7.0), 200 * 16, 140 * 16);
      break;
    case Mood::Puzzled:
      painter.drawArc(QRectF(12.0, 19.0, 8.0, 6.0), 30 * 16, 120 * 16);
      break;
    case Mood::Hearing:
    case Mood::Asking:
      painter.drawEllipse(QPointF(16.0, 20.0), 2.0, 2.0);
      break;
    case Mood::Speaking:
      painter.drawEllipse(QPointF(16.0, 20.0), 4.0, 2.5);
      break;
    case Mood::Busy:
      for (const double x : {12.5, 16.0, 19.5}) painter.drawPoint(QPointF(x, 20.0));
      break;
    default:
      painter.drawLine(QPointF(13.0, 20.0), QPointF(19.0, 20.0));
  }
}

}  // namespace icome::ui
