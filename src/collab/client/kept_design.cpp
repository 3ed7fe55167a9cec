#include "collab/client/kept_design.h"

#include <fmt/format.h>

#include <system_error>

#include "collab/content/outline.h"
#include "collab/storage/private_file.h"
#include "collab/storage/random_bytes.h"
#include "collab/storage/store_folder.h"
#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::collab {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostCopyBytes = std::uint64_t{4} << 30;
constexpr std::size_t kNameBytes = 16;  // of the hash, in a folder's name

fs::path copy_in(const fs::path& place) { return place / "copy"; }

}  // namespace

base::Result<fs::path> KeptDesign::usual_folder() {
  const auto store = StoreFolder::default_path();
  if (!store) return store;
  return store->parent_path() / "kept";
}

fs::path KeptDesign::place_of(const fs::path& folder, const DesignAddress& address) {
  const std::string what =
      fmt::format("{}:{}/{}#{}", address.host, address.port, address.design, address.fingerprint);
  return folder / hex_text(hash_of_content(what).substr(0, kNameBytes));
}

base::Result<KeptDesign> KeptDesign::make(const fs::path& folder, const DesignAddress& address) {
  const fs::path place = place_of(folder, address);
  if (const auto made = StoreFolder::make(folder); !made) return tl::unexpected(made.error());
  if (const auto made = StoreFolder::make(place); !made) return tl::unexpected(made.error());
  const fs::path lock_path = place / "in_use.lock";
  if (const auto made = make_private_file(lock_path, {}); !made) return tl::unexpected(made.error());
  auto lock = io::OpenFile::open(lock_path, io::OpenFile::Use::Change);
  if (!lock) return tl::unexpected(lock.error());
  const auto locked = lock->lock();
  if (!locked) return tl::unexpected(locked.error());
  if (!*locked) return base::fail("Another program works with the copy of this design that is kept here.");
  return KeptDesign(place, std::move(*lock));
}

std::optional<std::optional<KeptDesign>> KeptDesign::find(const fs::path& folder,
                                                          const DesignAddress& address) {
  std::error_code error;
  if (!fs::exists(copy_in(place_of(folder, address)), error)) return std::nullopt;
  auto design = make(folder, address);
  return design ? std::optional(std::move(*design)) : std::nullopt;
}

std::vector<fs::path> KeptDesign::all(const fs::path& folder) {
  std::vector<fs::path> places;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    if (fs::exists(copy_in(it->path()), ignored)) places.push_back(it->path());
  }
  return places;
}

base::Result<std::optional<KeptCopy>> KeptDesign::read() const { return read(place_); }

base::Result<std::optional<KeptCopy>> KeptDesign::read(const fs::path& place) {
  std::error_code error;
  if (!fs::exists(copy_in(place), error)) return std::nullopt;
  const auto bytes = io::read_bytes(copy_in(place), kMostCopyBytes);
  if (!bytes) return tl::unexpected(bytes.error());
  auto copy = kept_copy_from_bytes(*bytes);
  if (!copy) return base::fail(copy_in(place).string() + ": " + copy.error().message);
  return std::move(*copy);
}

base::Result<void> KeptDesign::write(const KeptCopy& copy) const {
  const auto bytes = to_bytes(copy);
  if (!bytes) return tl::unexpected(bytes.error());
  auto file = io::NewFile::create(copy_in(place_));
  if (!file) return tl::unexpected(file.error());
  file->write(*bytes);
  return file->finish();
}

base::Result<void> KeptDesign::resume(Conversation& talk, const KeptCopy& copy) const {
  talk.resume(copy);
  auto next = talk.keep();
  if (!next) return base::fail("The copy that is kept here cannot be gone on with.");
  next->at = copy.at;
  return write(*next);
}

void KeptDesign::put_aside() const {
  std::error_code ignored;
  fs::rename(copy_in(place_), place_ / "copy.former", ignored);
}

void KeptDesign::remove() const {
  std::error_code ignored;
  fs::remove_all(place_, ignored);
}

}  // namespace icome::collab
