#include "coin_frames.h"

#include <Inventor/SbViewportRegion.h>
#include <Inventor/SoDB.h>
#include <Inventor/SoInteraction.h>
#include <Inventor/actions/SoGLRenderAction.h>
#include <Inventor/nodes/SoCone.h>
#include <Inventor/nodes/SoCoordinate3.h>
#include <Inventor/nodes/SoCube.h>
#include <Inventor/nodes/SoCylinder.h>
#include <Inventor/nodes/SoDirectionalLight.h>
#include <Inventor/nodes/SoIndexedFaceSet.h>
#include <Inventor/nodes/SoMaterial.h>
#include <Inventor/nodes/SoPerspectiveCamera.h>
#include <Inventor/nodes/SoSeparator.h>
#include <Inventor/nodes/SoShapeHints.h>
#include <Inventor/nodes/SoSphere.h>
#include <Inventor/nodes/SoTranslation.h>

namespace icome::benchmarks {
namespace {

constexpr float kSize = float(kSolidSize);

SoNode* node_of(FrameSolid::Kind kind) {
  switch (kind) {
    case FrameSolid::Kind::Box: {
      auto* cube = new SoCube;
      cube->width = cube->height = cube->depth = kSize;
      return cube;
    }
    case FrameSolid::Kind::Ball: {
      auto* ball = new SoSphere;
      ball->radius = 0.5F * kSize;
      return ball;
    }
    case FrameSolid::Kind::Cylinder: {
      auto* cylinder = new SoCylinder;
      cylinder->radius = 0.5F * kSize;
      cylinder->height = kSize;
      return cylinder;
    }
    case FrameSolid::Kind::Cone:
      break;
  }
  auto* cone = new SoCone;
  cone->bottomRadius = 0.5F * kSize;
  cone->height = kSize;
  return cone;
}

SbVec3f vector(const base::Vector3& v) { return {float(v.x()), float(v.y()), float(v.z())}; }

}  // namespace

struct CoinFrames::Scene {
  SoSeparator* root = nullptr;
  SoPerspectiveCamera* camera = nullptr;
  SoDirectionalLight* light = nullptr;
  std::vector<SoTranslation*> places;
  std::unique_ptr<SoGLRenderAction> action;

  Scene() {
    static const bool kReady = (SoDB::init(), SoInteraction::init(), true);
    (void)kReady;
    root = new SoSeparator;
    root->ref();
    camera = new SoPerspectiveCamera;
    light = new SoDirectionalLight;
    root->addChild(camera);
    root->addChild(light);
    action = std::make_unique<SoGLRenderAction>(SbViewportRegion(1, 1));
    action->setCacheContext(own_cache());
  }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene() { root->unref(); }

  /// An id for the things that Coin keeps in a context, such as lists, which contexts do not share.
  static std::uint32_t own_cache() {
    static std::uint32_t contexts = 0;
    return ++contexts;
  }
};

CoinFrames::CoinFrames(const std::vector<FrameSolid>& solids) : scene_(std::make_unique<Scene>()) {
  for (const FrameSolid& it : solids) {
    auto* group = new SoSeparator;
    auto* place = new SoTranslation;
    place->translation = vector(it.at);
    auto* look = new SoMaterial;
    look->diffuseColor.setValue(vector(it.colour));
    group->addChild(place);
    group->addChild(look);
    group->addChild(node_of(it.kind));
    scene_->root->addChild(group);
    scene_->places.push_back(place);
  }
}

CoinFrames::CoinFrames(const geometry::TriangleMesh& mesh) : scene_(std::make_unique<Scene>()) {
  auto* hints = new SoShapeHints;
  hints->vertexOrdering = SoShapeHints::COUNTERCLOCKWISE;
  hints->creaseAngle = 0.9F;
  auto* points = new SoCoordinate3;
  points->point.setNum(int(mesh.positions.size()));
  SbVec3f* to = points->point.startEditing();
  for (const base::Vector3& it : mesh.positions) *to++ = vector(it);
  points->point.finishEditing();
  auto* faces = new SoIndexedFaceSet;
  faces->coordIndex.setNum(int(4 * mesh.triangles.size()));
  std::int32_t* index = faces->coordIndex.startEditing();
  for (const auto& it : mesh.triangles) {
    for (const std::uint32_t v : it) *index++ = std::int32_t(v);
    *index++ = -1;
  }
  faces->coordIndex.finishEditing();
  scene_->root->addChild(hints);
  scene_->root->addChild(points);
  scene_->root->addChild(faces);
}

CoinFrames::~CoinFrames() = default;

void CoinFrames::move_all(const base::Vector3& by) {
  for (SoTranslation* it : scene_->places) it->translation = it->translation.getValue() + vector(by);
}

void CoinFrames::draw(const base::Vector3& toward_eye, int width, int height) {
  const SbViewportRegion region{short(width), short(height)};
  scene_->camera->position = vector(toward_eye);
  scene_->camera->pointAt(SbVec3f(0.0F, 0.0F, 0.0F), SbVec3f(0.0F, 1.0F, 0.0F));
  scene_->camera->viewAll(scene_->root, region);
  scene_->light->direction = -vector(toward_eye);
  scene_->action->setViewportRegion(region);
  scene_->action->apply(scene_->root);
}

}  // namespace icome::benchmarks
