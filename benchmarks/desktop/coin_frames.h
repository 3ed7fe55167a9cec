#pragma once
#include <memory>
#include <vector>

#include "frame_scenes.h"

namespace icome::benchmarks {

/// Coin3D drawing into the current OpenGL context and frame, as in a program that uses it: with its own
/// solids, a light at the eye, no shadows.
class CoinFrames {
 public:
  explicit CoinFrames(const std::vector<FrameSolid>& solids);
  explicit CoinFrames(const geometry::TriangleMesh& mesh);
  CoinFrames(const CoinFrames&) = delete;
  CoinFrames& operator=(const CoinFrames&) = delete;
  ~CoinFrames();

  void move_all(const base::Vector3& by);
  /// Draws the scene from that direction, so that all is seen.
  void draw(const base::Vector3& toward_eye, int width, int height);

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace icome::benchmarks
