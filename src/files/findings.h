#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "files/remark.h"

namespace icome::files {

/// Something that may be wrong with many things of a file.
struct FindingKind {
  const char* text;    // "Faces with fewer than three corners are left out"
  const char* owners;  // that have it: "shapes"
};

/// Counts what is found wrong as a file is read, and tells it in one remark a kind, however many there are.
class Findings {
 public:
  /// `owner` is the name of what has it; empty: it has none. `count` is how many times it has it; 0: that
  /// means nothing. Kinds are told apart by their address.
  void add(const FindingKind& kind, const std::string& owner, std::size_t count = 0);
  /// A sentence of its own, for what happens seldom; of very many, only the first ones are kept.
  void tell(std::string text);
  /// In the order in which their kinds were found first, then the single ones.
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

/// A name as sentences have it: in quotes, shortened, "one without a name" for none.
std::string quoted_name(const std::string& name);

}  // namespace icome::files
