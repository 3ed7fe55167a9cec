#include "collab/storage/store.h"

#include "collab/storage/sample_log.h"
#include "collab/storage/sqlite_op_log.h"
#include "files/sample_files.h"
#include "memory_place.h"

namespace icome::collab {
namespace {

TEST(Store, TakesWhatIsNoAddressForAFolder) {
  const files::ScratchFolder folder(memory_place());
  const std::filesystem::path place = folder.path() / "store";
  EXPECT_FALSE(Store::open(place)) << "there is none yet";
  const Store store = good(Store::make(place));
  EXPECT_FALSE(store.is_database());
  good(good(store.log())->create("a"));
  EXPECT_TRUE(good(good(SqliteOpLog::open(place / "designs.sqlite")).find("a")));
  folder.write("file", "no store");
  EXPECT_NE(sentence_of(Store::make(folder.path() / "file")).find("is not a folder"), std::string::npos);
}

}  // namespace
}  // namespace icome::collab
