#pragma once

namespace icome::apps {

// The words of --help that do not stand beside an option.

constexpr const char* kProgramHelp =
    "ICOME makes models touchable: a servo loop computes, a thousand times a second and more, the force\n"
    "that a force-feedback device must give so that a model feels solid. Without a command it opens its\n"
    "window, in which designs are seen, touched and changed; the mouse touches where there is no device.";

constexpr const char* kDesktopDesignHelp =
    "A design to open in the window (see icome info --help for its types)";

constexpr const char* kThemeHelp =
    "Colours of the window (default: as chosen in it before, else the system's)";

constexpr const char* kProgramExamples =
    "Examples:\n"
    "  icome                                       the window, with what was left unsaved, or empty\n"
    "  icome house.wrl                             the window, with a design\n"
    "  icome touch sphere:0.05                     a simulated hand explores a sphere for 5 s\n"
    "  icome touch bunny.obj --fit 0.1 --picture touch.png\n"
    "                                              a scan, 0.1 m large, and a picture of the touch\n"
    "  icome touch part.stl --unit mm --path path.csv --trace out.csv\n"
    "                                              replay tip positions, keep what every tick did\n"
    "  icome csg cup.csg --form normal --mesh cup.stl\n"
    "                                              a solid from OpenSCAD: its normal form, and a mesh of it\n"
    "  icome info house.glb                        what is in a design: its objects, shapes and materials\n"
    "  icome convert part.ply part.obj             the same design in another format\n"
    "  icome edit new --apply table.jsonl --out table.wrl\n"
    "                                              model by script: every tool is an operation\n"
    "  icome shot house.wrl house.png --view iso   a picture of a design\n"
    "  icome devices                               the devices that are there, and what is missing\n"
    "  icome techniques --picture techniques.png   which way of selecting is quick, by simulated people\n"
    "  icome stats anova times.csv --response time --factor interface\n"
    "                                              whether a difference between interfaces is chance\n"
    "  icome study new pointing.toml               begin a user study\n"
    "  icome say \"three red spheres\" --out balls.wrl\n"
    "                                              voice commands, as text\n"
    "  icome sketch fit strokes.csv                curves of a pen's strokes\n"
    "  icome track camera --known triangles.toml   follow triangles on a table with a camera\n"
    "  icome animate boat.cutout --out boat.mp4    cut-out animations: change, record, render\n"
    "  icome serve                                 several people shape one design: prints a link\n"
    "\n"
    "The window needs a display. Without one, icome touch touches a design and icome shot draws it.\n"
    "\n"
    "icome touch --help tells all about touching, icome csg --help about solids, icome info --help and\n"
    "icome convert --help about designs, icome edit --help about changing them, icome shot --help about\n"
    "pictures, icome techniques --help about ways of interaction, icome stats --help about statistics,\n"
    "icome study --help about user studies, icome serve --help about working together.";

constexpr const char* kTouchSummary =
    "Touch models: by a simulated hand in real time, or along a path from a file";

constexpr const char* kModelHelp =
    "Files (meshes: OBJ, PLY, STL, OFF; solids: OpenSCAD's .csg; also .xz), designs of many objects "
    "(VRML 2.0: .wrl, .vrml; glTF: .glb, .gltf; ICOME's .icome) or primitives, sizes in metres: plane, "
    "box:0.1x0.2x0.3, "
    "sphere:R, "
    "cylinder:RxH, cone:RxH, cone:R1xR2xH, torus:RxR, capsule:RxH";

constexpr const char* kDeviceHelp =
    "The address of a device, as icome devices lists it; or simulated, or the name of a device such as "
    "\"Touch\" or \"omega.x\": the simulated hand then has that device's forces, stiffness and mass";

constexpr const char* kTouchExamples =
    "Examples:\n"
    "  icome touch bunny.obj --fit 0.1 --seconds 5 --picture touch.png\n"
    "  icome touch box:0.1x0.1x0.1 --stiffness 800 --friction 0.4,0.3 --radius 0.002\n"
    "  icome touch part.stl --unit mm --path path.csv --check --json > report.json\n"
    "  icome touch solid.csg --check --picture touch.png\n"
    "  icome touch room.wrl --fit 0.3 --picture touch.png\n"
    "  icome touch control.obj --subdivide limit --crease 40\n"
    "  icome touch --implicit \"z - 0.005*sin(60*x + 3*t)*cos(60*y)\" --bounds 0.1,0.1,0.06\n"
    "  icome touch sphere:0.05 --texture ridges:0.0005,0.002 --effect viscous:2 --effect constant:0,0,-0.3\n"
    "  icome touch tooth.obj jaw.obj --fit 0.08 --device \"PHANToM Desktop\" --trace out.csv\n"
    "\n"
    "World: metres. A file stands in it as for all commands (icome info tells its bounds), y up: what has z "
    "up,\n"
    "as .csg and .stl files by custom, is turned, which is told. Only --fit scales, about the origin; "
    "nothing is\n"
    "moved. A primitive stands centred on the origin, its axis along z; the plane is z = 0, solid below. "
    "Several\n"
    "models are touched together.\n"
    "\n"
    "CSG trees, Loop and implicit surfaces are touched as what they are; no mesh is made of them but for\n"
    "the picture. A .csg file is in millimetres whatever --unit says. A formula knows x, y, z, t, pi, e,\n"
    "+ - * / ^, sin, cos, tan, exp, log, sqrt, abs, min, max and others, and if(condition, a, b) with\n"
    "< <= > >= && || !, as in if(x < 0.01 && y > 0, z, z + 0.02); the solid is where it is negative.\n"
    "A tip with a --radius feels all of them exactly, too, unless curved primitives of a tree are stretched\n"
    "or a formula comes to a point or a pole; such ones it feels as a fine mesh; the report says which, how\n"
    "fine and why.\n"
    "\n"
    "Of a design every object is touched as what it is, where it stands: scaled and mirrored ones too, and\n"
    "with the stiffness, friction and haptic texture of its material, unless --stiffness, --friction or\n"
    "--texture say otherwise, and with the effects in it. Objects with motions in their file move, from "
    "where\n"
    "these have them at 0 s; --still keeps them at rest. What cannot be touched, or is felt as triangles, "
    "is\n"
    "told in the report.\n"
    "\n"
    "With --path there is no clock: one tick a row, as fast as the machine can, and the same input gives "
    "the\n"
    "same trace (but tick_us). Forces are limited as for --device; they grow from zero at the start of a "
    "run.\n"
    "Without --path the simulated hand explores in real time, on any machine, and Ctrl-C ends it early. With "
    "the\n"
    "address of a device a person touches with it: its workspace lies about the middle of the models.\n";

constexpr const char* kTouchFormats =
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
    "  a share of the period, 1 is all of it), overruns, lost_ticks (without the device), max_force_n,\n"
    "  touch_fraction, pops, sticks, silent\n"
    "  (ticks in which the tip is inside and nothing is felt), pulls, unjudged (ticks in which the contact\n"
    "  went so long a way that nobody knows whether it was free), late (ticks that ended before the contact\n"
    "  was where it could come to; it went on in the next) and judge_unfinished (questions of the check "
    "that\n"
    "  took too long; what they would have found is not counted) (these seven null without --check),\n"
    "  texture (null without --texture) and effects (an array, those of designs last) as they were written, "
    "capped (sentences "
    "about\n"
    "  what is felt softer than asked for, so as to be stable),\n"
    "  peak_memory_bytes. It goes to standard output, all messages to standard error.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 a replay was interrupted.";

constexpr const char* kCsgSummary =
    "Look into a CSG solid from OpenSCAD: its tree and normal forms, which points it holds, a mesh of it";

constexpr const char* kFormHelp =
    "Which form to bring the solid to: the tree as it is in the file, the normal form (a union of products) "
    "or "
    "the sub-normal form (what is subtracted is always a primitive) (default tree)";

constexpr const char* kCsgExamples =
    "Examples:\n"
    "  openscad -o cup.csg cup.scad                makes the file from a model\n"
    "  icome csg cup.csg                           what is in it, how large it is\n"
    "  icome csg cup.csg --form normal --json      the size of its normal form, for a script\n"
    "  icome csg cup.csg --inside points.csv > inside.csv\n"
    "  icome csg cup.csg --mesh cup.stl --cell 0.2\n"
    "\n"
    "Read are cube, sphere, cylinder and polyhedron under multmatrix, color, group, union, intersection,\n"
    "difference and render. What has no exact form (hull, minkowski, extrusions, text, import and so on) is\n"
    "refused by name, line and column. Spheres and cylinders are truly round, but with $fn from 3 to 16 "
    "they\n"
    "are the faceted solids that OpenSCAD makes. Lengths are mm in the file.\n"
    "\n"
    "--inside reads a CSV file with the header x,y,z and coordinates in metres. The answer goes to standard\n"
    "output instead of the report: a CSV with the header inside and 1 or 0 for every point; with --json it "
    "is\n"
    "the field inside of the report, an array.\n"
    "\n"
    "--mesh writes a watertight mesh with sharp edges. STL has no unit; the numbers are mm, as in "
    "OpenSCAD's\n"
    "own files. Parts thinner than a cell may be lost. The report says how many triangles there are and how\n"
    "far they are off the surface at most.\n"
    "\n"
    "JSON: nodes, primitives and depth of the tree in the file (operations and primitives; nodes on the\n"
    "  longest way down), form, form_nodes, pruned (nodes that the form would have more if the bounding "
    "boxes\n"
    "  did not show that they contribute nothing), bounds {min, max} in metres (null for an empty solid),\n"
    "  products (operands of the normal form's union, null for other forms), file, read_seconds, "
    "form_seconds,\n"
    "  notes (what was left out or put right), with --mesh also mesh {file, triangles, cell, error} (m), "
    "with\n"
    "  --inside also inside. It goes to standard output, all messages to standard error.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 it was interrupted.";

constexpr const char* kDesignFileHelp =
    "A design: VRML 2.0 (.wrl, .wrz), glTF (.glb, .gltf), OBJ, PLY, STL, OFF, OpenSCAD's .csg (from glTF on "
    "also packed as .xz), a drawing (.svg) or ICOME's own .icome; or the link of a design on a server";

constexpr const char* kDesignOutHelp =
    "The file to write; its ending says the format: VRML 2.0 (.wrl), glTF (.glb, .gltf), OBJ, PLY, STL, "
    "OFF, of a drawing .svg, or ICOME's own .icome";

constexpr const char* kForceHelp =
    "Write OUT even where a damaged design, or one that another program has changed meanwhile, is lost by "
    "that";

constexpr const char* kInfoSummary =
    "Look into a design: its objects and what they share, materials, size, and what could not be read";

constexpr const char* kInfoExamples =
    "Examples:\n"
    "  icome info table.wrl                        a table, the tree of objects, and warnings\n"
    "  icome info part.stl --unit mm               the same; the file's numbers are millimetres\n"
    "  icome info table.wrl --json | jq .bounds    for a script\n"
    "\n"
    "Lengths are metres in the world's frame. A clone is an object whose shape another object has already:\n"
    "change one, and all change. Exact shapes (primitives, CSG solids, Loop and implicit surfaces) count as\n"
    "the triangles that other programs are shown of them in VRML and glTF files: a few thousand each.\n"
    "\n"
    "JSON: objects, clones, triangles (of all objects; a clone's count again), materials, textures, bounds\n"
    "  {min, max} in metres (null where there is nothing; planes, which have no end, do not count), "
    "warnings\n"
    "  (sentences: what was skipped or put right, with file and line), file, format, shapes (how many of\n"
    "  each kind), scenes, lights, viewpoints, inert (scripts and the like, kept but not run), depth "
    "(objects\n"
    "  on the longest way down), motions {count, objects: [{object (its name), keys (key frames), seconds "
    "(until\n"
    "  it is over or begins anew), loops}]}, bytes (of memory, for shapes and pictures), read_seconds.\n"
    "\n"
    "Exit code: 0 done, 1 it could not be read, 2 wrong usage, 130 it was interrupted.";

constexpr const char* kConvertSummary =
    "Write a design in another format, and tell what that format cannot hold";

constexpr const char* kConvertExamples =
    "Examples:\n"
    "  icome convert table.wrl table.glb           hierarchy, clones, materials and exact shapes are kept\n"
    "  icome convert scan.ply.xz scan.obj\n"
    "  icome convert part.stl part.ply --unit mm   from millimetres: what is written is always in metres\n"
    "  icome convert cup.csg cup.off               a solid as triangles\n"
    "\n"
    "y is up, as in VRML and glTF: .csg and .stl files, which have z up, are turned, and .stl is turned "
    "back. The new file takes its\n"
    "place when it is complete; until then, and when something goes wrong, what was there stays. IN and OUT\n"
    "may be the same file.\n"
    "\n"
    "JSON: in, out, objects, triangles (as icome info counts them), bytes (of the file), warnings (what was\n"
    "  skipped in reading and lost in writing).\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 it was interrupted.";

constexpr const char* kEditInHelp =
    "The design to begin with: new for an empty one, or a file (see icome info --help for its types)";

constexpr const char* kEditSummary =
    "Change a design by a script: each line is an operation with its parameters";

constexpr const char* kEditExamples =
    "Examples:\n"
    "  icome edit new --apply table.jsonl --out table.wrl\n"
    "  icome edit table.wrl --apply longer-legs.jsonl --out table.wrl --json\n"
    "  icome edit lamp.recording.icome --replay lamp.recording --out lamp.icome\n"
    "  icome edit 'icome://...' --apply longer-legs.jsonl\n"
    "                                              a design on a server, while others work on it\n"
    "  icome edit 'icome://...' --watch --json     what people do to it, a line each, until Ctrl-C\n"
    "  icome edit --help-ops                       all operations with their parameters\n"
    "  icome edit --help-ops extrude               one of them\n"
    "\n"
    "table.jsonl may be:\n"
    "  {\"op\": \"create\", \"shape\": \"box\", \"size\": [0.8, 0.03, 0.5], \"at\": [0, 0.7, 0], \"name\": "
    "\"top\"}\n"
    "  {\"op\": \"create\", \"shape\": \"cylinder\", \"radius\": 0.02, \"height\": 0.7, \"name\": \"leg\"}\n"
    "  {\"op\": \"clone\", \"object\": \"leg\", \"name\": \"leg 2\"}\n"
    "\n"
    "Operations are what the window's tools are, by the same names. Lengths are metres, y is up. Objects "
    "are\n"
    "named by name; where several have it, by a path such as table/leg, or by # and their number. Empty "
    "lines\n"
    "and lines that begin with # are skipped. undo and redo are operations, too.\n"
    "\n"
    "--unit is that of IN's numbers; what is written is always in metres.\n"
    "\n"
    "A line that is wrong ends the run with its number, and nothing is written. OUT takes its place when it "
    "is\n"
    "complete; it may be the same file as IN.\n"
    "\n"
    "JSON: in, out (null when nothing was written), operations (how many were done), errors (a list of "
    "{line,\n"
    "  op, message}), objects, triangles (as icome info counts them), bytes (of the file), warnings (what "
    "was\n"
    "  skipped in reading and lost in writing), notes (what operations came to: {line, op, text}), seconds\n"
    "  (for the operations). With --help-ops: operations, a list of {name, title, group, summary,\n"
    "  parameters}.\n"
    "\n"
    "A design on a server (its link as IN, without --out) is changed where it is, line by line, each an "
    "action of its\n"
    "own; lines that are wrong or refused are told, and the others done. It ends when all is durable.\n"
    "{\"op\": \"select\", \"object\": \"leg\"} asks for an object for oneself, \"deselect\" gives it back. "
    "\"take-away\" takes it from another (role own). "
    "JSON of such a run:\n"
    "applied, refused (a list of {line, why}), sequence (of the design's last edit by it), and unknown where "
    "the server\n"
    "was gone before it said what became of so many. ICOME_TOKEN in the environment may hold the link's "
    "secret.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 it was interrupted.";

constexpr const char* kShotSummary = "Draw a design into a picture, without a window";

constexpr const char* kShotExamples =
    "Examples:\n"
    "  icome shot house.wrl house.png              from the design's first viewpoint, or three-quarter view\n"
    "  icome shot house.wrl top.png --view top --size 3000x2000\n"
    "  icome shot house.wrl door.png --view \"Front door\"\n"
    "  icome shot part.stl part.png --unit mm --background white\n"
    "  icome shot part.ply cut-out.png --background none --json\n"
    "  icome shot mill.wrl turned.png --time 1.5   as its motions have it 1.5 s after they began\n"
    "\n"
    "Directions (front, back, left, right, top, bottom, iso) show all of the design as large as it can be.\n"
    "front looks along -z, top straight down; y is up unless the format or --up says z. The lights are the\n"
    "design's own, with a weak one at the eye; a design without any is lit as in a studio. Exact shapes are\n"
    "drawn as fine triangles. No display, no window and no graphics card is needed.\n"
    "\n"
    "JSON: file, width, height, view, time (with --time), objects and triangles (of all that is drawn, "
    "clones counted each),\n"
    "  read_seconds, draw_seconds (making triangles, drawing, writing), seconds (both), warnings "
    "(sentences:\n"
    "  what is not shown; icome info tells what could not be read). It goes to standard output, all "
    "messages\n"
    "  to standard error.\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 it was interrupted.";

constexpr const char* kTechniquesSummary =
    "Rank ways of selecting (virtual hand, ray, spotlight and others) by simulated people";

constexpr const char* kTechniquesExamples =
    "Examples:\n"
    "  icome techniques                            a ranking\n"
    "  icome techniques --picture techniques.png   and a page that shows all of it\n"
    "  icome techniques --users 100 --seed 7 --json > techniques.json\n"
    "  icome techniques --menus --picture menus.png  lists, pies and daisies, clicked and pushed\n"
    "\n"
    "Simulated people select one ball after the other on a ring before them, as in ISO 9241-411, with "
    "targets\n"
    "of three sizes at three distances among none, few and many other balls. The techniques are the real\n"
    "ones: virtual hand, Go-Go, ray pointer, spotlight, world in miniature and look-at get hands and head\n"
    "step by step as from trackers. The people are not: they move by minimum jerk, with noise that grows "
    "with\n"
    "speed, with tremor, a time to react and corrections, and their numbers are partly from the literature\n"
    "and partly chosen; --json lists each with its source. The result ranks techniques under these\n"
    "assumptions. It is no study of people.\n"
    "\n"
    "Throughput is that of ISO 9241-411: log2(Ae / We + 1) over the movement time, for each person and\n"
    "condition, with We = 4.133 deviations of the endpoints along the way. What an arm cannot reach counts\n"
    "nothing in the score. The same options give the same result, to the last digit.\n"
    "\n"
    "JSON: assumptions {notice, users, trials_per_condition, seed, sizes_m, distances_m,\n"
    "  distractors_per_target, person [{name, value, unit, source}], left_out, room_m (what the miniature\n"
    "  shows)}, techniques, the highest score first:\n"
    "  [{name, movement_time_s and movement_time_sd_s, error_rate (a share), throughput_bits_per_s (mean of\n"
    "  the conditions within reach), score_bits_per_s (mean of all), conditions_reached, regression {a_s,\n"
    "  b_s_per_bit, r_squared} of times on indices of difficulty, conditions [{size_m, distance_m,\n"
    "  distractors_per_target, distractors (all in the scene), id_bits, reachable, movement_time_s,\n"
    "  movement_time_sd_s, error_rate, movements (with corrections), effective_width_m,\n"
    "  throughput_bits_per_s}]}]. Figures of what is out of reach are null.\n"
    "\n"
    "With --menus the same people choose from lists, pies and daisies of 5, 12 and 40 items, by click and\n"
    "by push, without feel, with wells and with recesses, which they feel through the servo. JSON then:\n"
    "assumptions {notice, users, trials_per_condition, seed, person, left_out}, conditions [{menu, items,\n"
    "  choose, feel, time_s, time_sd_s, error_rate, movements, way_m}].\n"
    "\n"
    "Exit code: 0 done, 1 something could not be done, 2 wrong usage, 130 it was interrupted.";

}  // namespace icome::apps
