#include "collab/storage/random_bytes.h"

#include <fmt/format.h>
#include <openssl/rand.h>

namespace icome::collab {

base::Result<std::string> random_bytes(std::size_t count) {
  std::string bytes(count, '\0');
  if (RAND_bytes(reinterpret_cast<unsigned char*>(bytes.data()), int(count)) == 1) return bytes;
  return base::fail("The system gives no random numbers, so nothing can be kept secret. Try again later.");
}

std::string hex_text(std::string_view bytes) {
  std::string text;
  for (const char byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return text;
}

}  // namespace icome::collab
