#pragma once
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "base/result.h"
#include "world/shape/geometry.h"

namespace icome::world {

/// Makes shapes from bytes by the name of their kind (the object factory of thesis 5.6.2). Knows the
/// built-in kinds, and any kinds added to it. A plain value.
class GeometryFactory {
 public:
  /// Makes a shape from the bytes of Geometry::write, which may come from a stranger or a broken disk: it
  /// checks everything, and fails with a sentence.
  using Reader = std::function<base::Result<GeometryPointer>(std::string_view bytes)>;

  GeometryFactory();

  /// Fails when this kind is known already.
  base::Result<void> add(const std::string& kind, const Reader& reader);
  /// Fails for a kind that nobody has added, and as the reader does.
  base::Result<GeometryPointer> read(std::string_view kind, std::string_view bytes) const;

 private:
  std::map<std::string, Reader, std::less<>> readers_;
};

}  // namespace icome::world
