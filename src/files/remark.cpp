#include "files/remark.h"

#include <fmt/format.h>

namespace icome::files {

std::string sentence(const Remark& remark, const std::string& file) {
  const std::string& name = remark.file.empty() ? file : remark.file;
  return remark.line > 0 ? fmt::format("{}:{}: {}", name, remark.line, remark.text)
                         : fmt::format("{}: {}", name, remark.text);
}

}  // namespace icome::files
