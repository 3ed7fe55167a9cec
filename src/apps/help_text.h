#pragma once

namespace icome::apps {

// The words of --help that do not stand beside an option.

constexpr const char* kProgramHelp =
    "ICOME makes models touchable: a servo loop computes, a thousand times a second and more, the force\n"
    "that a force-feedback device must give so that a model feels solid.";

constexpr const char* kProgramExamples =
    "Examples:\n"
    "  icome touch sphere:0.05                     a simulated hand explores a sphere for 5 s\n"
    "  icome touch bunny.obj --up y --fit 0.1 --picture touch.png\n"
    "                                              a scan, 0.1 m large, and a picture of the touch\n"
    "  icome touch part.stl --unit mm --path path.csv --trace out.csv\n"
    "                                              replay tip positions, keep what every tick did\n"
    "\n"
    "icome touch --help tells all about touching.";

constexpr const char* kTouchSummary =
    "Touch models: by a simulated hand in real time, or along a path from a file";

constexpr const char* kModelHelp =
    "Files (OBJ, PLY, STL, OFF, GLB, also .xz) or primitives, sizes in metres: plane, box:0.1x0.2x0.3, "
    "sphere:R, "
    "cylinder:RxH, cone:RxH, cone:R1xR2xH, torus:RxR, capsule:RxH";

constexpr const char* kDeviceHelp =
    "simulated, or the name of a device such as \"Touch\" or \"omega.x\": the simulated hand then has that "
    "device's "
    "forces, stiffness and mass (hardware itself cannot be driven yet)";

constexpr const char* kTouchExamples =
    "Examples:\n"
    "  icome touch bunny.obj --up y --fit 0.1 --seconds 5 --picture touch.png\n"
    "  icome touch box:0.1x0.1x0.1 --stiffness 800 --friction 0.4,0.3 --radius 0.002\n"
    "  icome touch part.stl --unit mm --path path.csv --check --json > report.json\n"
    "  icome touch tooth.obj jaw.obj --fit 0.08 --device \"PHANToM Desktop\" --trace out.csv\n"
    "\n"
    "World: metres, z up. Models stand where their file or primitive puts them: they are scaled about the\n"
    "origin and turned, never moved. A primitive stands centred on the origin, its axis along z; the plane\n"
    "is z = 0, solid below. Several models are touched together.\n"
    "\n"
    "With --path there is no clock: one tick a row, as fast as the machine can, and the same input gives "
    "the\n"
    "same trace (but tick_us). Forces are limited as for --device; they grow from zero at the start of a "
    "run.\n"
    "Without --path the simulated hand explores in real time, on any machine, and Ctrl-C ends it early.\n"
    "\n"
    "Trace: t,tip_x,tip_y,tip_z,scp_x,scp_y,scp_z,force_x,force_y,force_z,touching,object,tick_us\n"
    "  s, m and N in the world frame. scp is the surface contact point (the centre of a tip with a radius)\n"
    "  and equals the tip while nothing is touched; touching is 0 or 1; object numbers the MODELs from 0 "
    "and\n"
    "  is -1 while nothing is touched; tick_us is all of the tick but device input and output.\n"
    "\n"
    "JSON: model, triangles (0 for primitives), build_seconds (of what the servo touches, without reading\n"
    "  files), ticks, rate_hz, tick_us {median, p99, p999, max}, haptic_load {median, p999, max} (the tick "
    "as\n"
    "  a share of the period, 1 is all of it), overruns, max_force_n, touch_fraction, pops and sticks (null\n"
    "  without --check), peak_memory_bytes. It goes to standard output, all messages to standard error.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 a replay was interrupted.";

}  // namespace icome::apps
