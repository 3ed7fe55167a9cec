#pragma once
#include "render/pictures/picture_of_scene.h"

namespace icome::render {

/// Lays the pictures of both eyes into one. Precondition: they have the same size.
charts::Image stereo_picture(const charts::Image& left, const charts::Image& right, StereoLayout layout);

/// draw_picture() for each eye, of that many pixels, laid into one picture: twice as wide, or as high, where
/// the eyes' pictures lie beside or above each other.
base::Result<charts::Image> draw_stereo_picture(const RenderScene& scene, const EyeCameras& eyes,
                                                StereoLayout layout, const SceneLook& look, int width,
                                                int height);

}  // namespace icome::render
