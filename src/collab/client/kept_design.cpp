#include "collab/client/kept_design.h"

#include <fmt/format.h>

#include <system_error>

#include "collab/content/outline.h"
#include "collab/storage/private_file.h"
#include "collab/storage/random_bytes.h"
#include "collab/storage/store_folder.h"
#include "files/design_files.h"
#include "io/file_bytes.h"
#include "io/new_file.h"

namespace icome::collab {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostCopyBytes = std::uint64_t{4} << 30;
constexpr std::size_t kNameBytes = 16;  // of the hash, in a folder's name

constexpr const char* kLockName = "in_use.lock";

fs::path copy_in(const fs::path& place) { return place / "copy"; }

/// A name under which nothing was put aside yet: "copy.former", "copy.former-2".
std::string free_former(const fs::path& place) {
  std::error_code error;
  for (int i = 1;; ++i) {
    std::string name = i == 1 ? "copy.former" : fmt::format("copy.former-{}", i);
    if (!fs::exists(place / name, error) && !fs::exists(place / (name + ".icome"), error)) return name;
  }
}

/// The world of a copy with what was not sent, but for what does not fit to it.
world::World world_with_edits(const KeptCopy& copy) {
  world::World world = copy.world;
  for (const KeptEdit& it : copy.edits) (void)world::apply(world, it.edit);
  return world;
}

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
  const fs::path lock_path = place / kLockName;
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

base::Result<fs::path> KeptDesign::put_aside() const {
  const std::string former = free_former(place_);
  fs::path shown = place_ / former;
  if (const auto copy = read(); copy && *copy) {
    const fs::path design = place_ / (former + ".icome");
    if (files::write_design(design, world_with_edits(**copy))) shown = design;
  }
  std::error_code error;
  fs::rename(copy_in(place_), place_ / former, error);
  if (error)
    return base::fail(
        fmt::format("{}: cannot be put aside ({}).", copy_in(place_).string(), error.message()));
  return shown;
}

void KeptDesign::remove_if_empty() const {
  std::error_code error;
  for (fs::directory_iterator it(place_, error), end; !error && it != end; it.increment(error))
    if (it->path().filename() != kLockName) return;
  if (!error) remove();
}

void KeptDesign::remove() const {
  std::error_code ignored;
  fs::remove_all(place_, ignored);
}

}  // namespace icome::collab
