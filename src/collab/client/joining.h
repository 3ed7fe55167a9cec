#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "collab/client/conversation.h"

namespace icome::collab {

/// A key that no other client has, for ClientIdentity: 128 random bits.
base::Result<std::string> make_client_key();

/// The identity of a new client of this program: with the name given, or else that of the environment
/// variable ICOME_NAME, or that of the system's user.
base::Result<ClientIdentity> new_identity(const std::string& name = {});

/// The address that a person gave; without a token it takes that of the environment variable ICOME_TOKEN, so
/// that the secret need not stand among a process's arguments, which everybody can see.
base::Result<DesignAddress> address_to_join(std::string_view text);

}  // namespace icome::collab
