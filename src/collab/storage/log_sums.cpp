#include "collab/storage/log_sums.h"

#include <fmt/format.h>
#include <lzma.h>

#include <array>
#include <string_view>

#include "base/shown_text.h"
#include "io/byte_order.h"

namespace icome::collab {
namespace {

class Sum {
 public:
  void add(std::uint64_t number) {
    std::array<char, sizeof number> bytes;
    io::store(number, io::ByteOrder::LittleEndian, bytes.data());
    add({bytes.data(), bytes.size()});
  }
  void add(std::string_view bytes) {
    value_ = lzma_crc32(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), value_);
  }
  std::uint32_t value() const { return value_; }

 private:
  std::uint32_t value_ = 0;
};

base::Error damaged(const std::string& design, const char* what, std::uint64_t sequence) {
  return {fmt::format("{}: the {} {} is not what was written: the store is damaged. Restore a backup.",
                      base::shown_text(design), what, sequence)};
}

}  // namespace

std::uint32_t sum_of(const LogEntry& entry) {
  Sum sum;
  for (const std::uint64_t number :
       {entry.sequence, std::uint64_t{entry.author}, entry.number, std::uint64_t(entry.at)})
    sum.add(number);
  sum.add(entry.edit);
  return sum.value();
}

std::uint32_t sum_of(const Snapshot& snapshot) {
  Sum sum;
  sum.add(snapshot.sequence);
  sum.add(snapshot.bytes);
  return sum.value();
}

base::Result<void> demand_sum(const std::string& design, const LogEntry& entry, std::int64_t kept) {
  if (kept == kNoSum || kept == sum_of(entry)) return {};
  return tl::unexpected(damaged(design, "edit", entry.sequence));
}

base::Result<void> demand_sum(const std::string& design, const Snapshot& snapshot, std::int64_t kept) {
  if (kept == kNoSum || kept == sum_of(snapshot)) return {};
  return tl::unexpected(damaged(design, "snapshot of", snapshot.sequence));
}

}  // namespace icome::collab
