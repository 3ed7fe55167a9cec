#pragma once
#include <string>
#include <vector>

#include "animation/project/project_edit.h"
#include "base/random.h"

namespace icome::animation {

/// A change of any kind, often one that the project must refuse.
ProjectChange random_change(const Project& project, base::Random& random);

/// A project that random changes made.
Project random_project(base::Random& random, int changes);

}  // namespace icome::animation
