#include "files/journal/journal_format.h"

#include <lzma.h>

#include "io/byte_order.h"

namespace icome::files {
namespace {

constexpr std::string_view kMagic = "\x89ICOME\r\n";
constexpr auto kOrder = io::ByteOrder::LittleEndian;

std::uint32_t checksum_of(std::string_view bytes) {
  return lzma_crc32(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), 0);
}

std::uint32_t number_at(std::string_view bytes, std::size_t place) {
  return io::load<std::uint32_t>(bytes.data() + place, kOrder);
}

bool known(char kind) {
  return kind == char(JournalKind::Contents) || kind == char(JournalKind::Snapshot) ||
         kind == char(JournalKind::SnapshotEnd) || kind == char(JournalKind::Edit);
}

}  // namespace

std::string journal_header() {
  std::string bytes(kMagic);
  io::store(kJournalVersion, kOrder, bytes);
  io::store(checksum_of(bytes), kOrder, bytes);
  return bytes;
}

JournalHeader judge_journal_header(std::string_view bytes) {
  const bool whole = bytes.size() >= kJournalHeaderBytes;
  const bool sealed = whole && number_at(bytes, 12) == checksum_of(bytes.substr(0, 12));
  const bool named = bytes.substr(0, kMagic.size()) == kMagic.substr(0, bytes.size());
  if (!named || bytes.empty()) return JournalHeader::SomethingElse;
  if (!sealed || number_at(bytes, 8) == 0) return JournalHeader::Damaged;
  return number_at(bytes, 8) > kJournalVersion ? JournalHeader::Newer : JournalHeader::Good;
}

bool JournalFrame::fits(std::string_view padded_content) const {
  return checksum_of(padded_content) == checksum;
}

std::optional<JournalFrame> read_journal_frame(std::string_view bytes) {
  if (!bytes.starts_with(kJournalMarker) || !known(bytes[3])) return std::nullopt;
  if (number_at(bytes, 20) != checksum_of(bytes.substr(0, 20))) return std::nullopt;
  return JournalFrame{.kind = JournalKind(bytes[3]),
                      .length = number_at(bytes, 4),
                      .number = io::load<std::uint64_t>(bytes.data() + 8, kOrder),
                      .checksum = number_at(bytes, 16)};
}

std::string journal_names_to_bytes(const JournalNames& names) {
  std::string bytes;
  for (const auto& [id, name] : names) {
    io::store(id.value, kOrder, bytes);
    io::store(std::uint32_t(name.size()), kOrder, bytes);
    bytes += name;
  }
  return bytes;
}

JournalNames journal_names_from_bytes(std::string_view bytes) {
  constexpr std::size_t kHead = 12;
  JournalNames names;
  while (bytes.size() >= kHead) {
    const world::ObjectId id{io::load<std::uint64_t>(bytes.data(), kOrder)};
    const std::uint32_t length = number_at(bytes, 8);
    bytes.remove_prefix(kHead);
    if (length > bytes.size()) break;
    names.emplace_back(id, bytes.substr(0, length));
    bytes.remove_prefix(length);
  }
  return names;
}

void add_journal_record(JournalKind kind, std::uint64_t number, std::string_view content,
                        std::string& bytes) {
  const JournalFrame frame{.kind = kind, .length = std::uint32_t(content.size()), .number = number};
  const std::size_t start = bytes.size();
  bytes += kJournalMarker;
  bytes += char(kind);
  io::store(frame.length, kOrder, bytes);
  io::store(frame.number, kOrder, bytes);
  std::uint32_t checksum = checksum_of(content);
  const std::string padding(frame.padded_length() - content.size(), '\0');
  checksum = lzma_crc32(reinterpret_cast<const std::uint8_t*>(padding.data()), padding.size(), checksum);
  io::store(checksum, kOrder, bytes);
  io::store(checksum_of(std::string_view(bytes).substr(start)), kOrder, bytes);
  bytes += content;
  bytes += padding;
}

}  // namespace icome::files
