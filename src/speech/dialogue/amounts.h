#pragma once
#include "speech/dialogue/references.h"

namespace icome::speech {

/// The length that a phrase of the rule length says, m.
double length_of(const Phrase& phrase);
/// The angle that a phrase of the rule angle says, degrees.
double angle_of(const Phrase& phrase);
/// The direction of a phrase of the rule direction in the viewer's frame: a unit vector of the world.
Vector3 direction_of(const Phrase& phrase, const ViewerAxes& axes);
/// "5 cm", "2.5 mm", "1.2 m".
std::string length_words(double metres);

}  // namespace icome::speech
