#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace icome::fuzz {

/// One reader of strangers' bytes as libFuzzer drives it. Whatever the bytes are, `run` returns, in time and
/// memory that follow their size; where a promise of the reader is broken, it ends the program.
struct Harness {
  const char* name;
  void (*run)(std::string_view bytes);
  std::vector<std::string> (*seeds)();  // good input of our own making, to begin with
};

/// All harnesses: of files, of shapes and edits, of texts that people write, of devices over the
/// network, of designs that are shared, of drawings and of cut-out animations.
std::vector<Harness> harnesses();

// Parts of that list.
std::span<const Harness> mesh_harnesses();
std::span<const Harness> design_harnesses();
std::span<const Harness> text_harnesses();
std::span<const Harness> vrpn_harnesses();
std::span<const Harness> haply_harnesses();
std::span<const Harness> collab_harnesses();
std::span<const Harness> drawing_harnesses();
std::span<const Harness> cutout_harnesses();

/// Ends the program, telling what was promised, unless that holds.
void require(bool holds, const char* promise);

/// An error is a sentence, or several lines of them, but never nothing.
void require_told(const base::Error& error);

}  // namespace icome::fuzz
