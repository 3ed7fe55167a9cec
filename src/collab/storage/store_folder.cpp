#include "collab/storage/store_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "base/parse_number.h"
#include "collab/protocol/address.h"
#include "collab/storage/private_file.h"
#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::collab {
namespace {

constexpr std::string_view kHostLine = "host: ", kPortLine = "port: ", kFingerprintLine = "fingerprint: ";
constexpr std::size_t kLongestHost = 255;
constexpr std::uint64_t kLongestAddress = 1024;  // bytes of the note

bool is_host(std::string_view text) {
  return !text.empty() && text.size() <= kLongestHost &&
         std::all_of(text.begin(), text.end(), [](char it) { return it > ' ' && it < '\x7f'; });
}

bool is_address(const ServedAddress& address) {
  return is_host(address.host) && address.port != 0 &&
         (address.fingerprint.empty() || is_fingerprint(address.fingerprint));
}

/// Takes a line that begins with `name` from the front of the text, and gives what follows the name.
std::optional<std::string_view> take_line(std::string_view& text, std::string_view name) {
  const std::size_t end = text.find('\n');
  if (!text.starts_with(name) || end == text.npos) return std::nullopt;
  const std::string_view value = text.substr(name.size(), end - name.size());
  text.remove_prefix(end + 1);
  return value;
}

/// Others who may write to the folder could put their own key in the place of the one that signs invitations.
base::Result<void> demand_own_folder(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0)
    return base::fail(fmt::format("{}: there is no store here ({}).", path.string(), std::strerror(errno)));
  if (!S_ISDIR(status.st_mode)) return base::fail(path.string() + ": is not a folder.");
  if ((status.st_mode & 022U) == 0) return {};
  return base::fail(fmt::format(
      "{0}: others may write to this folder. Choose another one, or take away their right: chmod go-w {0}",
      path.string()));
}

}  // namespace

base::Result<std::filesystem::path> StoreFolder::default_path() {
  namespace fs = std::filesystem;
  const fs::path within = fs::path("icome") / "store";
  const char* const data = std::getenv("XDG_DATA_HOME");
  // The specification has relative ones ignored.
  if (data != nullptr && fs::path(data).is_absolute()) return data / within;
  const char* const home = std::getenv("HOME");
  if (home != nullptr && fs::path(home).is_absolute()) return home / fs::path(".local") / "share" / within;
  return base::fail(
      "Neither XDG_DATA_HOME nor HOME is set, so there is no place for the store. Name a folder.");
}

base::Result<StoreFolder> StoreFolder::open(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  if (error) return base::fail(fmt::format("{}: cannot be opened ({}).", path.string(), error.message()));
  if (const auto own = demand_own_folder(whole); !own) return tl::unexpected(own.error());
  return StoreFolder(whole);
}

base::Result<StoreFolder> StoreFolder::make(const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::path whole = std::filesystem::absolute(path, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();  // of "store/"
  if (whole.has_parent_path()) std::filesystem::create_directories(whole.parent_path(), error);
  if (error)
    return base::fail(fmt::format("{}: this folder cannot be made ({}).", path.string(), error.message()));
  constexpr mode_t kOnlyMine = 0700;
  if (::mkdir(whole.c_str(), kOnlyMine) == 0)
    io::sync_folder_of(whole);
  else if (errno != EEXIST)
    return base::fail(
        fmt::format("{}: this folder cannot be made ({}).", path.string(), std::strerror(errno)));
  return open(whole);
}

base::Result<io::OpenFile> StoreFolder::lock() const {
  // Nobody else can open it, and so keep the owner from serving.
  const std::filesystem::path path = path_ / "serving.lock";
  if (const auto made = make_private_file(path, {}); !made) return tl::unexpected(made.error());
  auto file = io::OpenFile::open(path, io::OpenFile::Use::Change);
  if (!file) return file;
  const auto locked = file->lock();
  if (!locked) return tl::unexpected(locked.error());
  if (*locked) return file;
  return base::fail(path_.string() +
                    ": a server serves this store already. End it first, or name another store.");
}

std::optional<ServedAddress> address_in(std::string_view text) {
  const auto host = take_line(text, kHostLine);
  const auto port = take_line(text, kPortLine);
  const auto fingerprint = take_line(text, kFingerprintLine);
  if (!host || !port || !fingerprint || !text.empty()) return std::nullopt;
  const auto number = base::parse_number<std::uint16_t>(*port);
  if (!number) return std::nullopt;
  ServedAddress address{std::string(*host), *number, std::string(*fingerprint)};
  return is_address(address) ? std::optional(std::move(address)) : std::nullopt;
}

base::Result<std::string> address_note(const ServedAddress& address) {
  if (!is_address(address))
    return base::fail(
        fmt::format("{}:{} is no address that a store could be served at.", address.host, address.port));
  return fmt::format("{}{}\n{}{}\n{}{}\n", kHostLine, address.host, kPortLine, address.port, kFingerprintLine,
                     address.fingerprint);
}

base::Result<void> StoreFolder::write_address(const ServedAddress& address) const {
  const auto note = address_note(address);
  if (!note) return tl::unexpected(note.error());
  auto file = io::NewFile::create(path_ / "address");
  if (!file) return tl::unexpected(file.error());
  file->write(*note);
  return file->finish();
}

base::Result<std::optional<ServedAddress>> StoreFolder::address() const {
  const std::filesystem::path path = path_ / "address";
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  const auto text = io::read_bytes(path, kLongestAddress);
  if (!text) return tl::unexpected(text.error());
  auto address = address_in(*text);
  if (address) return address;
  return base::fail(path.string() +
                    ": does not say where the store is served. Remove it, and serve the store again.");
}

}  // namespace icome::collab
