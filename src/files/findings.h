#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "files/remark.h"

namespace icome::files {

/// A kind of fault that many things of a file may have.
struct FindingKind {
  const char* text;    // "Faces with fewer than three corners are left out"
  const char* owners;  // that have it: "shapes"
};

/// Counts the faults found while a file is read, and reports each kind in one remark, however many there are.
class Findings {
 public:
  /// `owner` is the name of the thing with the fault; empty: it has none. `count` is how often it has the
  /// fault; 0: not counted. Kinds are told apart by their address.
  void add(const FindingKind& kind, const std::string& owner, std::size_t count = 0);
  /// Adds a sentence of its own, for rare cases; of very many, only the first ones are kept.
  void tell(std::string text);
  /// Remarks in the order in which their kinds were first found, then the single sentences.
  std::vector<Remark> remarks() const;

 private:
  struct Found {
    const FindingKind* kind;
    std::string first;  // owner
    std::size_t owners = 0;
    std::size_t count = 0;
  };
  std::vector<Found> found_;
  std::vector<Remark> told_;
  std::size_t untold_ = 0;
};

/// A name for sentences: in quotes, shortened; "one without a name" for none.
std::string quoted_name(const std::string& name);

}  // namespace icome::files
