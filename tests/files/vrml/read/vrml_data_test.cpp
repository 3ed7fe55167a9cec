// Every shared VRML file, read as a user would.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "files/design_files.h"
#include "files/vrml/read/vrml_reader.h"
#include "places.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {
namespace {

using base::Bounds;
using base::Vector3;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<double, 3> kNoPoint = {kNaN, kNaN, kNaN};

/// What a file holds by a count that knows nothing of ICOME or Coin: a script that expands PROTOs, USE and
/// Inlines in the text of the file and follows the rules of vrml_builder.h.
struct VrmlCount {
  const char* file;
  std::size_t objects, clones, materials;
  std::size_t triangles;              // of IndexedFaceSets, each time that one is seen
  std::array<std::size_t, 4> solids;  // boxes, spheres, cones, cylinders, each time that one is seen
  std::size_t fixtures;               // lamps and eyes
  bool has_made_faces;  // of Text, Extrusion, ElevationGrid or an open Cylinder, which were not counted
  std::array<double, 3> low, high;  // around the vertices of IndexedFaceSets and boxes
};

// clang-format off
const std::vector<VrmlCount> kCounts = {
    {"assimp/HelloWorld.wrl", 4, 0, 2, 0, {0, 1, 0, 0}, 1, true, kNoPoint, kNoPoint},
    {"castle/animation/simple_tests_interpolation_and_time/orientation_interpolator_aluminium.wrl", 11, 0, 1, 288, {0, 0, 0, 0}, 7, false, {-0.0908120514, -0.0609502747, -0.1}, {0.0908120514, 0.0609502747, 0.1}},
    {"castle/castle/old/vrml_2/castle.wrl", 42, 4, 9, 1066, {0, 0, 0, 0}, 0, false, {-127.794831, -98.4477494, -1.98040102}, {128.362305, 104.928119, 64}},
    {"castle/castle/old/vrml_2/castle_with_lights.wrl", 45, 4, 9, 1066, {0, 0, 0, 0}, 2, false, {-127.794831, -98.4477494, -1.98040102}, {128.362305, 104.928119, 64}},
    {"castle/lights_materials/raytracer/alien_mirror.wrl", 14, 0, 4, 4206, {0, 0, 0, 0}, 4, false, {-4.60000086, -4.60000076, -3.77800067}, {4.59999943, 4.60000124, 0.455001062}},
    {"castle/navigation/type_examine.wrl", 47, 4, 9, 1066, {0, 0, 0, 0}, 3, false, {-127.794831, -98.4477494, -1.98040102}, {128.362305, 104.928119, 64}},
    {"castle/navigation/type_walk_no_headlight.wrl", 47, 4, 9, 1066, {0, 0, 0, 0}, 3, false, {-127.794831, -98.4477494, -1.98040102}, {128.362305, 104.928119, 64}},
    {"castle/prototypes/extern_proto_routes_2.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"castle/prototypes/proto_nested_expand.wrl", 2, 0, 1, 0, {0, 1, 0, 0}, 0, true, kNoPoint, kNoPoint},
    {"castle/prototypes/proto_other.wrl", 9, 3, 2, 0, {0, 5, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"castle/sensors_environmental/deranged_house_door.wrl", 4, 0, 2, 1130, {0, 0, 0, 0}, 0, false, {-0.21999982, -1.04868305, 0.0141932249}, {0.220000297, 1.05649471, 2.62999992}},
    {"castle/shadow_maps/projector_room.wrl", 14, 0, 6, 1300, {0, 0, 0, 0}, 3, false, {-1.44676546, -1.00000066, -0.0556743771}, {1.40000065, 1.0467657, 2.00000009}},
    {"castle/vrml_2/backface_culling.wrl", 18, 2, 6, 48, {0, 4, 0, 0}, 0, true, {-4, -4, -1}, {4, 4, 1}},
    {"castle/vrml_2/collisions.wrl", 20, 0, 5, 10789, {0, 0, 0, 0}, 0, false, {-11.1000032, -11.1000013, -0.110003471}, {40.0999985, 11.1000032, 6.66809704}},
    {"castle/vrml_2/collisions_final.wrl", 23, 0, 5, 10789, {0, 0, 0, 0}, 1, false, {-11.1000032, -11.1000013, -0.110003471}, {40.0999985, 11.1000032, 6.66809704}},
    {"castle/vrml_2/empty_no_coords.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"castle/vrml_2/extrusion_concave_cap.wrl", 5, 0, 4, 12, {0, 0, 0, 0}, 0, true, {-1.09, 44.84, 0}, {80.7, 133.72, 0}},
    {"castle/vrml_2/kings_head.wrl", 9, 1, 4, 0, {0, 4, 0, 0}, 0, true, kNoPoint, kNoPoint},
    {"castle/vrml_2/normals.wrl", 4, 0, 1, 8, {0, 0, 0, 0}, 0, false, {0, -20, 0}, {50, 5, 0}},
    {"castle/vrml_2/smoothing_independent_of_faces_order-min.wrl", 3, 0, 2, 16, {0, 0, 0, 0}, 1, false, {-1.91, -5.7, 1.86}, {5.7, 1.91, 5.7}},
    {"castle/vrml_2/subdir1/subdir2/texture_test.wrl", 6, 0, 4, 3, {1, 2, 1, 1}, 0, false, {5, -1, -1}, {11, 3, 1}},
    {"castle/vrml_engine_doc_simple_examples/cylinder_fields.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, true, kNoPoint, kNoPoint},
    {"castle/vrml_engine_doc_simple_examples/inline.wrl", 14, 9, 2, 0, {0, 0, 10, 0}, 0, false, kNoPoint, kNoPoint},
    {"castle/vrml_engine_doc_simple_examples/octree_example.wrl", 4, 0, 1, 0, {2, 1, 0, 0}, 1, false, {-5, -1, -5}, {5, 1, 5}},
    {"castle/vrml_engine_doc_simple_examples/reuse_cone.wrl", 2, 1, 2, 0, {0, 0, 2, 0}, 0, false, kNoPoint, kNoPoint},
    {"castle/vrml_engine_doc_simple_examples/reuse_coordinate.wrl", 3, 0, 1, 448, {0, 0, 0, 0}, 0, false, {-11.172124, -11.172125, -1}, {11.172121, 11.17212, 64}},
    {"castle/vrml_engine_doc_simple_examples/reuse_texture_no.wrl", 2, 0, 2, 0, {1, 1, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"castle/vrml_engine_doc_simple_examples/transform.wrl", 2, 0, 2, 0, {1, 1, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"choreonoid/block0_prt.wrl", 9, 0, 1, 28, {0, 0, 0, 0}, 0, false, {0, 0, -0.2}, {0.2, 0.45, 0}},
    {"choreonoid/tire.wrl", 1, 0, 1, 212, {0, 0, 0, 0}, 0, false, {-0.025, -0.099956, -0.1}, {0.025, 0.099956, 0.1}},
    {"openhrp3/PA10/pa10.main.wrl", 51, 0, 17, 1372, {0, 0, 0, 0}, 0, false, {-0.14, -0.117, -1.20991518e-14}, {0.135, 0.117, 1.505}},
    {"openhrp3/box.wrl", 6, 0, 1, 0, {1, 0, 0, 0}, 1, false, {-0.400000367, -0.100001469, -0.1}, {0.400000367, 0.100001469, 0.1}},
    {"openhrp3/cylinder.wrl", 7, 0, 1, 0, {0, 0, 0, 1}, 1, false, kNoPoint, kNoPoint},
    {"openvrml/models/Click.wrl", 1, 0, 1, 0, {0, 1, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/models/ExternPROTO.wrl", 1, 0, 1, 0, {0, 1, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/models/Prox1.wrl", 3, 0, 3, 0, {1, 1, 1, 0}, 0, false, {-4.72940151, -1.35389577, -0.55389577}, {-1.27059849, 1.75389577, 2.55389577}},
    {"openvrml/models/RefractiveMaterial.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/models/SimplePROTO.wrl", 10, 0, 3, 0, {0, 3, 0, 0}, 3, false, kNoPoint, kNoPoint},
    {"openvrml/models/bounce.wrl", 1, 0, 1, 0, {0, 1, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/models/jsTouch.wrl", 2, 0, 2, 0, {1, 0, 1, 0}, 0, false, {-4, -1, -1}, {-2, 1, 1}},
    {"openvrml/models/pixtex1.wrl", 6, 2, 4, 8, {0, 0, 0, 0}, 1, false, {-3.46534082, -1, 0}, {6, 1, 1.02736809}},
    {"openvrml/models/scale.wrl", 10, 0, 3, 0, {0, 3, 0, 0}, 3, false, kNoPoint, kNoPoint},
    {"openvrml/models/warbird.wrl", 30, 0, 8, 251, {0, 0, 0, 0}, 2, false, {-600, -600, -35}, {600, 600, 2.06997593}},
    {"openvrml/tests/vrml97/good/line-number.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/tests/vrml97/good/proto-containment-2-deep.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/tests/vrml97/good/proto-field-is-proto.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/tests/vrml97/good/proto-in-proto-default-value.wrl", 3, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/tests/vrml97/good/self-referential-script-in-proto.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"openvrml/tests/vrml97/good/unimplemented-externproto.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"vtk/bot2.wrl", 43, 0, 31, 486, {0, 0, 0, 0}, 3, false, {-0.718140319, -0.0159972827, -0.5075}, {0.664199528, 2.25299932, 0.281498556}},
    {"vtk/teapot.wrl", 1, 0, 1, 2378, {0, 0, 0, 0}, 0, false, {-2.95609, -2.01033, 0.004061}, {3.45695, 1.98978, 3.03026}},
    {"xj3d/Appearance/Texture-gif.wrl", 1, 0, 1, 12, {0, 0, 0, 0}, 0, false, {-2, -1.5, -1}, {2, 1.5, 1}},
    {"xj3d/Appearance/app-01-unlit.wrl", 1, 0, 0, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/Appearance/app-04-TextureTransform.wrl", 1, 0, 1, 2, {0, 0, 0, 0}, 0, false, {-1, -1, 0}, {1, 1, 0}},
    {"xj3d/Appearance/ils-material.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/Appearance/pixeltexture.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/Appearance/textured-cone.wrl", 1, 0, 1, 0, {0, 0, 1, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/background/animation.wrl", 2, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/background/multi_sky.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/background/single_sky_interp.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/events/colormorph_box.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/events/empty_timesensor.wrl", 1, 0, 0, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/events/scalarmorph_dirlight01.wrl", 2, 0, 1, 0, {1, 0, 0, 0}, 1, false, {-1.3570081, -1, -1.3570081}, {1.3570081, 1, 1.3570081}},
    {"xj3d/events/spinning_box.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/exporter/DiamondManLOA-0.wrl", 59, 0, 1, 8, {0, 0, 0, 0}, 4, false, {-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}},
    {"xj3d/external/basic_anchor.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/external/complex_proto.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/external/externproto.wrl", 3, 0, 1, 0, {1, 1, 0, 0}, 0, false, {-0.5, 2.5, -0.5}, {0.5, 3.5, 0.5}},
    {"xj3d/external/inlined_boxes.wrl", 3, 0, 3, 0, {3, 0, 0, 0}, 0, false, {-5.41419296, -1, -1.41419296}, {5.41419296, 1, 1.41419296}},
    {"xj3d/external/moving_box.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1.41419296, -1, -1.41419296}, {1.41419296, 1, 1.41419296}},
    {"xj3d/external/relativeurl.wrl", 5, 0, 4, 0, {4, 0, 0, 0}, 0, false, {-5.41419296, -1, -11.414193}, {5.41419296, 1, 1}},
    {"xj3d/geometry/ElevationGrid-Color-CPF.wrl", 3, 0, 0, 0, {0, 0, 0, 0}, 2, true, kNoPoint, kNoPoint},
    {"xj3d/geometry/ElevationGrid.wrl", 3, 0, 1, 0, {0, 0, 0, 0}, 2, true, kNoPoint, kNoPoint},
    {"xj3d/geometry/cone.wrl", 1, 0, 1, 0, {0, 0, 1, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/geometry/ifs-concave.wrl", 2, 0, 2, 7, {0, 0, 0, 0}, 0, false, {-2, -2, 0}, {2, 3, 0}},
    {"xj3d/geometry/pointset-color.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/geometry/text/basic_text.wrl", 1, 0, 1, 0, {0, 0, 0, 0}, 0, true, kNoPoint, kNoPoint},
    {"xj3d/geometry/text/japanese3-bom.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, true, kNoPoint, kNoPoint},
    {"xj3d/geometry/text/rev_text.wrl", 1, 0, 1, 0, {0, 0, 0, 0}, 0, true, kNoPoint, kNoPoint},
    {"xj3d/geometry/text/use_text.wrl", 2, 0, 1, 0, {0, 0, 0, 0}, 0, true, kNoPoint, kNoPoint},
    {"xj3d/groups/switch-dynamic.wrl", 3, 0, 1, 0, {1, 0, 0, 0}, 1, false, {-1, -1, -11}, {1, 1, -9}},
    {"xj3d/lights/directional.wrl", 4, 0, 1, 6, {0, 0, 0, 0}, 2, false, {-1, 0, -1}, {1, 2, 1}},
    {"xj3d/navigation/anchor_dest.wrl", 5, 0, 3, 0, {3, 0, 0, 0}, 2, false, {-5, -1.41419296, -1.41419296}, {5.41419296, 1.41419296, 1.41419296}},
    {"xj3d/navigation/collision.wrl", 7, 1, 3, 0, {3, 0, 0, 0}, 2, false, {-500, -1, -500}, {500, 3, 500}},
    {"xj3d/navigation/flat_terrain.wrl", 8, 3, 5, 0, {5, 0, 0, 0}, 2, false, {-500, -0.05, -500}, {500, 1.5, 500}},
    {"xj3d/navigation/lod.wrl", 1, 0, 0, 0, {0, 1, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/navigation/multi_transition_vp.wrl", 5, 0, 1, 0, {1, 0, 0, 0}, 2, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/navigation/single_navinfo.wrl", 3, 0, 1, 0, {1, 0, 0, 0}, 1, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/navigation/use_vp.wrl", 5, 0, 1, 0, {1, 0, 0, 0}, 2, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/proto/Label_p2.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/proto/box_fields.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-2, -2, -2}, {2, 2, 2}},
    {"xj3d/proto/ep-viewp.wrl", 2, 0, 0, 0, {0, 0, 0, 0}, 1, true, kNoPoint, kNoPoint},
    {"xj3d/proto/externproto_inline_sensor.wrl", 2, 0, 0, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/proto/ils-geoprop-color.wrl", 2, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/proto/inline_tests.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/proto/inlined_boxes.wrl", 3, 0, 3, 0, {3, 0, 0, 0}, 0, false, {-5.41419296, -1, -1.41419296}, {5.41419296, 1, 1.41419296}},
    {"xj3d/proto/moving_box.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/proto/multi_instance.wrl", 2, 0, 2, 0, {2, 0, 0, 0}, 0, false, {-1, -1, -1}, {2, 2, 1}},
    {"xj3d/proto/nested.wrl", 17, 0, 15, 0, {15, 0, 0, 0}, 0, false, {-2.56072958, -1.25, -2.06059075}, {2.56072958, 3.25, 0.25}},
    {"xj3d/proto/proto_bindable.wrl", 2, 0, 0, 0, {1, 0, 0, 0}, 1, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/proto/proto_material.wrl", 1, 0, 1, 0, {0, 1, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/proto/proto_script.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/proto/touch_box.wrl", 1, 0, 0, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/sensors/TransformedPlaneSensor.wrl", 9, 0, 2, 4, {0, 0, 1, 0}, 2, false, {-3.90618893, -1.31973647, -4.00000163}, {4.5085272, 4.08328285, 6.00000163}},
    {"xj3d/sensors/cartesian_axis.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/sensors/drag_over.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {0, -1, -1}, {2, 1, 1}},
    {"xj3d/sensors/proximity-initial.wrl", 1, 0, 0, 0, {0, 1, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/sensors/touch_over.wrl", 1, 0, 1, 0, {1, 0, 0, 0}, 0, false, {-1, -1, -1}, {1, 1, 1}},
    {"xj3d/vrml97/empty1.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/vrml97/field1.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 1, false, kNoPoint, kNoPoint},
    {"xj3d/vrml97/proto5.wrl", 0, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
    {"xj3d/vrml97/single_node2.wrl", 1, 0, 0, 0, {0, 0, 0, 0}, 0, false, kNoPoint, kNoPoint},
};
// clang-format on

const std::filesystem::path kVrmlData = places::shared_data() / "vrml";

#define SKIP_WITHOUT_VRML_DATA() \
  if (!std::filesystem::exists(kVrmlData)) GTEST_SKIP() << kVrmlData << " is not there"

/// What a world holds, counted as in the table.
struct WorldCount {
  std::size_t clones = 0, triangles = 0, fixtures = 0;
  std::array<std::size_t, 4> solids = {};
  Bounds around = {};

  explicit WorldCount(const world::World& from) {
    for (const auto& [id, geometry] : from.geometries()) clones += geometry.users - 1;
    for (const auto& [id, object] : from.objects()) {
      if (object.fixture && !std::holds_alternative<world::Inert>(*object.fixture)) ++fixtures;
      if (object.geometry) add(*from.find(object.geometry)->shape, world_from_object(from, id));
    }
  }

 private:
  void add(const world::Geometry& shape, const base::Affine3& world_from_shape) {
    if (const auto* mesh = dynamic_cast<const world::MeshGeometry*>(&shape)) {
      triangles += mesh->mesh.triangles.size();
      for (const Vector3& position : mesh->mesh.positions) around.extend(world_from_shape * position);
    } else if (const auto* solid = dynamic_cast<const world::PrimitiveGeometry*>(&shape)) {
      const geometry::Primitive& primitive = solid->primitive;
      if (std::holds_alternative<geometry::Sphere>(primitive)) ++solids[1];
      if (std::holds_alternative<geometry::Cone>(primitive)) ++solids[2];
      if (std::holds_alternative<geometry::Cylinder>(primitive)) ++solids[3];
      if (const auto* box = std::get_if<geometry::Box>(&primitive)) {
        ++solids[0];
        for (int i = 0; i < 8; ++i) {
          const Vector3 corner((i & 1) ? 1 : -1, (i & 2) ? 1 : -1, (i & 4) ? 1 : -1);
          around.extend(world_from_shape * box->half.cwiseProduct(corner));
        }
      }
    }
  }
};

base::Result<LoadedDesign> read_shared(const std::string& file) {
  return read_design(kVrmlData / file, {.follows_urls_above = true});
}

TEST(VrmlData, HoldsWhatAnIndependentCountFinds) {
  SKIP_WITHOUT_VRML_DATA();
  for (const VrmlCount& expected : kCounts) {
    SCOPED_TRACE(expected.file);
    const auto design = read_shared(expected.file);
    if (!design) {
      ADD_FAILURE() << design.error().message;
      continue;
    }
    const WorldCount count(design->world);
    const std::size_t inert = std::size_t(
        std::count_if(design->world.objects().begin(), design->world.objects().end(), [](const auto& it) {
          return it.second.fixture && std::holds_alternative<world::Inert>(*it.second.fixture);
        }));
    EXPECT_EQ(design->world.objects().size() - inert, expected.objects);
    EXPECT_EQ(count.clones, expected.clones);
    EXPECT_EQ(design->world.materials().size(), expected.materials);
    EXPECT_EQ(count.solids, expected.solids);
    EXPECT_EQ(count.fixtures, expected.fixtures);
    if (expected.has_made_faces) continue;
    EXPECT_EQ(count.triangles, expected.triangles);
    EXPECT_EQ(count.around.isEmpty(), std::isnan(expected.low[0]));
    if (count.around.isEmpty() || std::isnan(expected.low[0])) continue;
    const double size = count.around.sizes().norm();
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(count.around.min()[axis], expected.low[std::size_t(axis)], 1e-6 * size);
      EXPECT_NEAR(count.around.max()[axis], expected.high[std::size_t(axis)], 1e-6 * size);
    }
  }
}

std::vector<std::string> remarks_on(const std::string& file) {
  std::vector<std::string> result;
  const auto design = read_shared(file);
  if (!design) return {design.error().message};
  for (const Remark& remark : design->remarks) {
    const std::string said = sentence(remark, file);
    // Told of each file that a url above the design's folder takes in: vrml_fetch_test looks at these.
    if (said.find("lies above the design's folder") != std::string::npos) continue;
    result.push_back(said.substr(said.rfind('/') + 1));
  }
  return result;
}

TEST(VrmlData, TellsWhatIsLeftOutWithItsLines) {
  SKIP_WITHOUT_VRML_DATA();
  const std::vector<std::pair<const char*, std::vector<std::string>>> expected = {
      {"openvrml/models/Click.wrl",
       {"Click.wrl:3: A Script is kept but not run.", "Click.wrl:25: A Sound is left out.",
        "Click.wrl:26: An AudioClip is left out.", "Click.wrl:38: A TouchSensor is left out.",
        "Click.wrl:40: 3 ROUTEs are left out, the first at line 40."}},
      {"openhrp3/box.wrl",
       {"box.wrl:200: 3 CylinderSensors are left out, at lines 200, 226 and 252.",
        "box.wrl:214: 3 ROUTEs are left out, the first at line 214.",
        "box.wrl:269: A NavigationInfo is left out.", "box.wrl:275: A Background is left out."}},
      {"castle/vrml_2/empty_no_coords.wrl",
       {"empty_no_coords.wrl:8: An IndexedLineSet is left out.",
        "empty_no_coords.wrl:9: A PointSet is left out."}},
      {"xj3d/navigation/lod.wrl",
       {"lod.wrl:3: An LOD is taken at the finest level.",
        "lod.wrl: Shapes without a Material are lit here: one without a name."}},
      {"castle/navigation/type_examine.wrl",
       {"type_examine.wrl:3: A NavigationInfo is left out.",
        "castle.wrl:21: 14 Collisions are taken as plain Groups, at lines 21, 75, 455, 655, 668, 681, 694, "
        "707 "
        "and others."}},
      {"vtk/teapot.wrl", {}},
  };
  for (const auto& [file, remarks] : expected) EXPECT_EQ(remarks_on(file), remarks) << file;
}

TEST(VrmlData, FindsPictures) {
  SKIP_WITHOUT_VRML_DATA();
  const std::vector<std::tuple<const char*, const char*, const char*>> expected = {
      {"xj3d/Appearance/Texture-gif.wrl", "x3d2-s.gif", "image/gif"},
      {"xj3d/external/externproto.wrl", "vts.jpg", "image/jpeg"},
      {"assimp/HelloWorld.wrl", "earth-topo.png", "image/png"},
      {"castle/vrml_2/subdir1/subdir2/texture_test.wrl", "../../../textures/test_texture.png", "image/png"},
      {"xj3d/Appearance/pixeltexture.wrl", "PixelTexture", "image/png"},
  };
  for (const auto& [file, name, type] : expected) {
    const auto design = read_shared(file);
    ASSERT_TRUE(design.has_value()) << file;
    ASSERT_EQ(design->world.textures().size(), 1U) << file;
    const world::Texture& texture = design->world.textures().begin()->second;
    EXPECT_EQ(texture.name, name);
    EXPECT_EQ(texture.media_type, type);
    if (texture.name == "PixelTexture") continue;
    const auto path = (kVrmlData / file).parent_path() / name;
    EXPECT_EQ(texture.bytes->size(), std::filesystem::file_size(path));
  }
}

TEST(VrmlData, KeepsNamesAndHierarchy) {
  SKIP_WITHOUT_VRML_DATA();
  const auto design = read_shared("openhrp3/PA10/pa10.main.wrl");
  ASSERT_TRUE(design.has_value());
  std::size_t named = 0, deepest = 0;
  for (const auto& [id, object] : design->world.objects()) {
    if (object.name.starts_with("J") && object.name.size() == 2) ++named;
    std::size_t depth = 0;
    for (auto at = object.parent; at; at = design->world.find(at)->parent) ++depth;
    deepest = std::max(deepest, depth);
  }
  EXPECT_GE(named, 6U);
  EXPECT_GE(deepest, 8U);
}

/// What a file of the folder `malformed` is refused with; empty for those that are read.
const std::vector<std::pair<const char*, const char*>> kMalformed = {
    {"castle/normal_index_wrong.wrl", ""},
    {"castle/not_enough_coords.wrl", ""},
    {"castle/proto_invalid_nest.wrl", ""},
    {"castle/proto_separate_namespace.wrl", ""},
    {"castle/test_invalid_hierarchy.wrl", ""},
    {"coin/bug055-3.wrl", "no node where one is expected"},
    {"coin/bug055-8.wrl", "line 11"},
    {"coin/bug199-error-1.wrl", "line 6"},
    {"coin/bug199-error-3.wrl", "line 6"},
    {"openvrml/exposedfield-in-script.wrl", "line"},
    {"openvrml/is-value-type-mismatch.wrl", ""},
    {"openvrml/proto-eventout-conflict.wrl", ""},
    {"openvrml/route-sfint32-to-sfbool.wrl", ""},
    {"openvrml/unrecognized-field.wrl", ""},
    {"openvrml/use-def-in-different-proto-default-value.wrl", ""},
    {"xj3d/bad_field_name.wrl", ""},
    {"xj3d/bad_field_value.wrl", "line 5"},
    {"xj3d/bad_header2.wrl", "is not VRML 2.0"},
    {"xj3d/bad_header4.wrl", "is not VRML 2.0"},
    {"xj3d/eventIn_set.wrl", ""},
    {"xj3d/non_child_root.wrl", ""},
};

TEST(VrmlData, ReadsMalformedFilesOrSaysWhyNot) {
  SKIP_WITHOUT_VRML_DATA();
  std::size_t known = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kVrmlData / "malformed"))
    known += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(known, kMalformed.size());
  for (const auto& [file, why] : kMalformed) {
    const auto path = kVrmlData / "malformed" / file;
    const auto design = read_design(path);
    EXPECT_EQ(design.has_value(), std::string(why).empty()) << file;
    if (design) continue;
    EXPECT_TRUE(design.error().message.starts_with(path.string() + ":")) << design.error().message;
    EXPECT_NE(design.error().message.find(why), std::string::npos) << design.error().message;
  }
}

TEST(VrmlData, RefusesVrml1) {
  SKIP_WITHOUT_VRML_DATA();
  const auto design = read_shared("occt/face.vrml");
  ASSERT_FALSE(design.has_value());
  EXPECT_NE(design.error().message.find("VRML 1.0"), std::string::npos);
}

}  // namespace
}  // namespace icome::files
