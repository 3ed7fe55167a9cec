#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "study/definition/study.h"

namespace icome::study {

/// A capability of the program and the lab that a study may need.
struct Capability {
  std::string_view id;
  std::string_view what;  // "a tracker of the head"
  bool available;         // in this program
  bool simulated;         // for simulated people
  bool of_pointer;        // with a pointing device alone
};

/// All capabilities that a study may name.
std::span<const Capability> capabilities();

/// A need of a study that is not met, and the part that has it: "the study", "level 'with'".
struct UnmetNeed {
  std::string id;
  std::string what;
  std::string of;
  Place place;
};

/// The needs of the study, of its levels and of its scenes, in this order, that this program does not meet.
std::vector<UnmetNeed> unmet_needs(const Study& study);
/// Those that are not met for simulated people.
std::vector<UnmetNeed> needs_not_simulated(const Study& study);
/// Those that take more than a pointing device.
std::vector<UnmetNeed> needs_beyond_pointer(const Study& study);

/// The ids of all needs of the study, its levels and its scenes; some of them more than once.
std::vector<std::string> all_needs(const Study& study);

/// The study without these needs and without the levels and scenes that have them: the rest can be run
/// where they cannot be met, such as with the pointer alone. Its hash is different, so that its data are
/// kept apart. Fails when nothing is left of a factor or of the scenes. Without needs it is the same study.
base::Result<Study> without_needs(const Study& study, const std::vector<std::string>& needs);

/// The quantities measured in a trial: "time", "distance", ...; dependent variables may be `from` one.
std::span<const std::string_view> measured_quantities();

}  // namespace icome::study
