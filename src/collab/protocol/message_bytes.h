#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "collab/protocol/message.h"

namespace icome::collab {

// Messages as bytes (message.fbs), and frames that hold several of them. A message takes a multiple of 8
// bytes, so that each in a frame can be read where it lies. Whatever the bytes of a stranger are, reading
// them takes memory and time in proportion to their number.

std::string to_bytes(const ClientMessage& message);
std::string to_bytes(const ServerMessage& message);

/// Fail for bytes that are no message, and for one that only the other side says.
base::Result<ClientMessage> client_message(std::string_view bytes);
base::Result<ServerMessage> server_message(std::string_view bytes);

/// Appends a message, as to_bytes() gives it, to a frame.
void add_to_frame(std::string& frame, std::string_view message);
/// Takes the next message off the front of a frame that is not empty; fails for a damaged one.
base::Result<std::string_view> next_in_frame(std::string_view& frame);

}  // namespace icome::collab
