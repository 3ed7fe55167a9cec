#include "fuzz/harness.h"

#include <cstdio>
#include <cstdlib>

namespace icome::fuzz {

std::vector<Harness> harnesses() {
  std::vector<Harness> all;
  for (const auto part : {mesh_harnesses(), design_harnesses(), text_harnesses(), vrpn_harnesses(),
                          haply_harnesses(), collab_harnesses(), drawing_harnesses(), cutout_harnesses()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

void require_told(const base::Error& error) { require(!error.message.empty(), "an error says what it is"); }

}  // namespace icome::fuzz
