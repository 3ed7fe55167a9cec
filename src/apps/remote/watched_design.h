#pragma once
#include <string>

#include "collab/client/conversation.h"

namespace icome::apps {

/// A line that tells of something that happened to a shared design: JSON for scripts, or a sentence. Empty
/// for what is not told.
std::string watched_line(const collab::Seen& seen, const collab::Conversation& talk, bool json);

}  // namespace icome::apps
