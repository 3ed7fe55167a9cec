#include "coin_peer.h"

#include <Inventor/SoDB.h>
#include <Inventor/SoInput.h>
#include <Inventor/SoInteraction.h>
#include <Inventor/SoOutput.h>
#include <Inventor/VRMLnodes/SoVRMLGroup.h>
#include <Inventor/actions/SoCallbackAction.h>
#include <Inventor/actions/SoWriteAction.h>
#include <Inventor/nodes/SoShape.h>

#include "base/clock.h"

namespace icome::benchmarks {
namespace {

/// A scene of Coin, released at the end.
class CoinScene {
 public:
  explicit CoinScene(const std::filesystem::path& path) {
    static const bool kReady = (SoDB::init(), SoInteraction::init(), true);
    (void)kReady;
    SoInput input;
    if (input.openFile(path.c_str())) root_ = SoDB::readAllVRML(&input);
    if (root_) root_->ref();
  }
  CoinScene(const CoinScene&) = delete;
  CoinScene& operator=(const CoinScene&) = delete;
  ~CoinScene() {
    if (root_) root_->unref();
  }
  SoVRMLGroup* root() const { return root_; }

 private:
  SoVRMLGroup* root_ = nullptr;
};

void count(void* counter, SoCallbackAction*, const SoPrimitiveVertex*, const SoPrimitiveVertex*,
           const SoPrimitiveVertex*) {
  ++*static_cast<std::size_t*>(counter);
}

}  // namespace

bool parse_with_coin(const std::filesystem::path& path) { return CoinScene(path).root() != nullptr; }

bool walk_with_coin(const std::filesystem::path& path) {
  const CoinScene scene(path);
  if (!scene.root()) return false;
  std::size_t triangles = 0;
  SoCallbackAction action;
  action.addTriangleCallback(SoShape::getClassTypeId(), count, &triangles);
  action.apply(scene.root());
  return triangles > 0;
}

double write_with_coin(const std::filesystem::path& path, const std::filesystem::path& to) {
  const CoinScene scene(path);
  const std::int64_t begin = base::steady_nanoseconds();
  SoOutput output;
  if (!scene.root() || !output.openFile(to.c_str())) return 0.0;
  output.setHeaderString("#VRML V2.0 utf8");
  SoWriteAction action(&output);
  action.apply(scene.root());
  output.closeFile();
  return double(base::steady_nanoseconds() - begin) * 1e-9;
}

}  // namespace icome::benchmarks
