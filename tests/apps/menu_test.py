"""icome menu: where the items of a haptic element lie, what a tip path chooses, and how it feels; judged by geometry
written here."""
import json
import math
import pathlib
import unittest

from icome_program import ProgramTest, run

MENUS = pathlib.Path(__file__).resolve().parents[2] / "data" / "menus"
TURNED = """
title = "Colours"
centre = [0.05, 0.1, -0.2]
turn_deg = %s
[[item]]
name = "Red"
[[item]]
name = "Green"
enabled = false
[[item]]
name = "Blue"
[[item]]
name = "More"
[[item.item]]
name = "Pink"
"""


def plus(a, b, times=1.0):
    return [p + times * q for p, q in zip(a, b)]


def path_of(points, button=None, hertz=1000, speed=0.1):
    """Straight ways between points at a speed (m/s); `button` holds the numbers of the ways on which it is down."""
    rows = ["t,x,y,z,b" if button is not None else "t,x,y,z"]
    tick = 0
    for number, (a, b) in enumerate(zip(points, points[1:])):
        steps = max(1, int(math.dist(a, b) / speed * hertz))
        for i in range(steps):
            place = [p + (q - p) * (i + 1) / steps for p, q in zip(a, b)]
            row = [tick / hertz, *place] + ([int(number in button)] if button is not None else [])
            rows.append(",".join(repr(x) for x in row))
            tick += 1
    return "\n".join(rows) + "\n"


class MenuTest(ProgramTest):
    def layout(self, toml):
        return json.loads(self.succeeds("menu", self.write("menu.toml", toml), "--json").stdout)

    def tried(self, toml, path, *options):
        return json.loads(self.succeeds("menu", self.write("menu.toml", toml), "--path", self.write("p.csv", path),
                                        "--json", *options).stdout)

    def test_items_lie_in_the_plane_below_each_other(self):
        for turn in (0, 90, -90, 35.5, -120):
            items = self.layout(TURNED % turn)["items"]
            self.assertEqual([it["name"] for it in items], ["Red", "Green", "Blue", "More"])
            alpha = math.radians(turn)
            for item in items:
                self.assertAlmostEqual(math.dist(item["normal"], [-math.sin(alpha), 0, math.cos(alpha)]), 0, places=12)
                away = sum(n * d for n, d in zip(item["normal"], plus(item["centre"], [0.05, 0.1, -0.2], -1)))
                self.assertAlmostEqual(away, 0, places=12)
            for above, below in zip(items, items[1:]):
                self.assertAlmostEqual(above["centre"][1] - below["centre"][1],
                                       (above["height"] + below["height"]) / 2, places=12)
            self.assertEqual([it["enabled"] for it in items], [True, False, True, True])
            self.assertIsNone(items[0]["submenu"])
            self.assertEqual([it["name"] for it in items[3]["submenu"]], ["Pink"])

    def test_push_and_click_choose_what_the_tip_is_at(self):
        for turn in (0, 60):
            items = {it["name"]: it for it in self.layout(TURNED % turn)["items"]}
            for name, chosen in (("Red", ["Red"]), ("Blue", ["Blue"]), ("Green", [])):
                at, normal = items[name]["centre"], items[name]["normal"]
                way = [plus(at, normal, 0.05), plus(at, normal, -0.006), plus(at, normal, 0.03)]
                pushed = self.tried(TURNED % turn, path_of(way), "--choose", "push")
                self.assertEqual(pushed["chosen"], chosen)
                self.assertEqual(pushed["pushes"], 1)
                # 600 N/m against 6 mm, softer by its recess and the click.
                self.assertGreater(pushed["max_force_n"], 1.5)
                self.assertLess(pushed["max_force_n"], 3.3)
                self.assertLess(pushed["max_force_step_n"], 0.5)
                near = [plus(at, normal, 0.05), plus(at, normal, 0.01), plus(at, normal, 0.0101)]
                clicked = self.tried(TURNED % turn, path_of(near), "--choose", "click")
                self.assertEqual(clicked["chosen"], chosen)
                self.assertEqual(clicked["pushes"], 0)

    def test_coarse_paths_are_felt_as_fine_ones(self):
        item = self.layout(TURNED % 0)["items"][0]
        at, normal = item["centre"], item["normal"]
        way = [plus(at, normal, 0.05), plus(at, normal, -0.006), plus(at, normal, 0.03)]
        fine = self.tried(TURNED % 0, path_of(way), "--choose", "push")
        coarse = self.tried(TURNED % 0, path_of(way, hertz=50), "--choose", "push")
        self.assertEqual(coarse["chosen"], ["Red"])
        self.assertLess(coarse["max_force_step_n"], 0.5)
        self.assertAlmostEqual(coarse["max_force_n"], fine["max_force_n"], delta=0.1)

    def test_near_time_is_that_of_the_path(self):
        item = self.layout(TURNED % 0)["items"][0]
        at, normal = item["centre"], item["normal"]
        path = path_of([plus(at, normal, 0.06), plus(at, normal, 0.001), plus(at, normal, 0.06)], speed=0.05)
        self.assertAlmostEqual(self.tried(TURNED % 0, path)["near_s"], 2 * 0.019 / 0.05, delta=0.005)

    def test_from_behind_nothing_is_felt_or_pushed(self):
        menu = TURNED % 0
        item = self.layout(menu)["items"][0]
        at, normal = item["centre"], item["normal"]
        way = [plus([at[0] + 0.3, at[1], at[2]], normal, -0.03), plus(at, normal, -0.03), plus(at, normal, 0.0005)]
        plain = menu.replace("[[item]]", "[feel]\nwell_n = 0\nrecess_m = 0\n[[item]]", 1)
        tried = self.tried(plain, path_of(way), "--choose", "push")
        self.assertEqual(tried["chosen"], [])
        self.assertEqual(tried["max_force_n"], 0)

    def test_a_button_of_the_path_clicks_and_opens_menus(self):
        menu = TURNED % 0
        items = self.layout(menu)["items"]
        more, pink = items[3], items[3]["submenu"][0]
        way = [plus(more["centre"], more["normal"], 0.04), plus(more["centre"], more["normal"], 0.01),
               plus(more["centre"], more["normal"], 0.009), plus(pink["centre"], pink["normal"], 0.01),
               plus(pink["centre"], pink["normal"], 0.009)]
        tried = self.tried(menu, path_of(way, button={1, 3}))
        self.assertEqual(tried["chosen"][0], "More")
        tried = self.tried(menu, path_of([*way, way[-1]], button={1, 4}))
        self.assertEqual(tried["chosen"], ["More", "Pink"])
        self.assertEqual([it["opens"] for it in tried["choices"]], ["menu", None])

    def test_a_menu_that_closes_under_a_push_does_not_jump(self):
        for turn in (0, 35):
            menu = TURNED % turn
            more = self.layout(menu)["items"][3]
            pink = more["submenu"][0]
            way = []
            for item in (more, pink):
                way += [plus(item["centre"], item["normal"], f) for f in (0.01, -0.006, 0.01)]
            for device in ("touch", "omega.x"):
                tried = self.tried(menu, path_of(way, speed=0.05), "--choose", "push", "--device", device)
                self.assertEqual(tried["chosen"], ["More", "Pink"])
                self.assertLess(tried["max_force_step_n"], 0.5)

    def test_menus_beside_each_other_change_forces_as_one(self):
        deep = ('title = "T"\ncentre = [0, 0, 0]\n[[item]]\nname = "A"\n[[item.item]]\nname = "A1"\n'
                '[[item.item.item]]\nname = "A1a"\n[[item.item.item]]\nname = "A1b"\n[[item.item]]\nname = "A2"\n'
                '[[item]]\nname = "B"\n[[item.item]]\nname = "B1"\n[[item.item]]\nname = "B2"\n'
                '[[item]]\nname = "C"\nenabled = false\n[[item]]\nname = "D"\n')
        corners = ((0, 0, 0, 0.03), (0.1, 0, 0, -0.006), (0.2, 0, 0, 0.01), (0.264, 0.01, -0.011, -0.002),
                   (0.294, 0.027, 0.006, 0.01))
        rows = ["t,x,y,z"]
        for a, b in zip(corners, corners[1:]):
            ticks = round((b[0] - a[0]) * 1000)
            rows += [",".join(repr(p + (q - p) * i / ticks) for p, q in zip(a, b)) for i in range(ticks)]
        tried = self.tried(deep, "\n".join(rows) + "\n", "--choose", "push")
        self.assertEqual(tried["chosen"][:1], ["B"])
        self.assertLess(tried["max_force_step_n"], 0.45)

    def test_a_list_is_printed_as_it_shows(self):
        rows = '[[item]]\nname = "Rows"\nkind = "list"\nrows = 3\nvalue = "r4"\n' + "".join(
            f'[[item.item]]\nname = "r{i}"\n' for i in range(1, 6))
        (laid,) = self.layout(rows)["items"]
        self.assertEqual([it["name"] for it in laid["items"]], ["r2", "r3", "r4"])
        self.assertEqual(laid["scroll"]["first"], 1)
        for row in laid["items"]:
            at = row["centre"]
            self.assertEqual(self.tried(rows, path_of([plus(at, (0, 0, 0.02)), plus(at, (0, 0, 0.004))]))["chosen"],
                             [row["name"]])
        shown = json.loads(self.succeeds("menu", self.write("menu.toml", rows), "--show", "r5", "--json").stdout)
        self.assertEqual([it["name"] for it in shown["items"][0]["items"]], ["r3", "r4", "r5"])

    def test_a_path_of_one_row_clicks_there(self):
        item = self.layout(TURNED % 0)["items"][0]
        self.assertEqual(self.tried(TURNED % 0, path_of([plus(item["centre"], item["normal"], 0.005)] * 2))["chosen"],
                         ["Red"])

    def test_what_no_device_renders_is_told(self):
        steep = (TURNED % 0).replace("[[item]]", "[ground]\nborder_m = 0.005\n[[item]]", 1)
        path = path_of([(0, 0, 1), (0, 0, 0.99)])
        told = self.succeeds("menu", self.write("menu.toml", steep), "--path", self.write("p.csv", path)).stderr
        self.assertIn("ridges and recesses are felt at", told)

    def test_languages_change_words_and_not_names(self):
        colours = MENUS / "colours.toml"
        dutch = json.loads(self.succeeds("menu", colours, "--language", "nl", "--json").stdout)
        self.assertEqual([it["text"] for it in dutch["items"]],
                         ["Rood", "Groen", "Blauw", "Geel", "Paars", "Wit", "Zwart"])
        self.assertEqual(dutch["items"][0]["name"], "Red")
        self.fails("menu", colours, "--language", "fr", code=1, saying="it has en, nl")

    def test_arabic_lies_the_other_way_round_and_boxes_are_told(self):
        toml = ('languages = ["en", "ar"]\ncolumns = 2\nkind = "toolbar"\n' + "".join(
            f'[[item]]\nname = "{name}"\ntext = {{ en = "{name}", ar = "{text}" }}\n'
            for name, text in (("Red", "أحمر"), ("Blue", "أزرق"))))
        file = self.write("menu.toml", toml)
        x = {language: [it["centre"][0] for it in
                        json.loads(self.succeeds("menu", file, "--language", language, "--json").stdout)["items"]]
             for language in ("en", "ar")}
        self.assertLess(x["en"][0], x["en"][1])
        self.assertGreater(x["ar"][0], x["ar"][1])
        done = run("menu", self.write("boxes.toml", '[[item]]\nname = "A\U0010fffdB"\n'), "--json")
        self.assertEqual(done.returncode, 0)
        self.assertIn("boxes stand for \U0010fffd: no font here", done.stderr)

    def test_lists_scroll_and_their_rows_are_chosen(self):
        menu = ('[[item]]\nname = "L"\nkind = "list"\nrows = 5\noperation = "create"\nvalue_as = "name"\n'
                + "".join('[[item.item]]\nname = "r%d"\n' % i for i in range(500)))
        listed = self.layout(menu)["items"][0]
        self.assertEqual([it["name"] for it in listed["items"]], ["r%d" % i for i in range(5)])
        self.assertEqual({key: listed["scroll"][key] for key in ("first", "seen", "count")},
                         {"first": 0, "seen": 5, "count": 500})
        top, bottom = listed["scroll"]["less"][1], listed["scroll"]["more"][1]
        for item in listed["items"]:
            self.assertLess(item["centre"][1], top + 1e-9)
            self.assertGreater(item["centre"][1], bottom - 1e-9)
        more, second = listed["scroll"]["more"], listed["items"][1]["centre"]
        way = []
        for place in (more, more, more, second):
            way += [plus(place, [0, 0, 1], f) for f in (0.01, -0.006, 0.01)]
        tried = self.tried(menu, path_of(way), "--choose", "push")
        self.assertEqual(tried["chosen"], ["r4"])
        self.assertEqual(tried["choices"][0]["value"], "r4")
        self.assertEqual(tried["pushes"], 4)
        self.assertLess(tried["max_force_step_n"], 0.5)
        shown = self.tried(menu, path_of([(0, 0, 1), *way[-3:]]), "--choose", "push", "--show", "r499")
        self.assertEqual(shown["chosen"], ["r496"])
        self.fails("menu", self.write("menu.toml", menu), "--show", "r500", code=1, saying="r500")

    def test_numbers_are_pushed_to_more_and_less(self):
        menu = '[[item]]\nname = "N"\nkind = "number"\nleast = 1\nmost = 9\nvalue = 5\nunit = "mm"\n'
        item = self.layout(menu)["items"][0]
        self.assertEqual((item["kind"], item["value"]), ("number", 5))
        way = []
        for place in (item["more"], item["less"], item["less"]):
            way += [plus(place, [0, 0, 1], f) for f in (0.01, -0.006, 0.01)]
        tried = self.tried(menu, path_of(way), "--choose", "push")
        self.assertEqual([it["value"] for it in tried["choices"]], [6, 5, 4])
        held = self.tried(menu, path_of([plus(item["more"], [0, 0, 1], f) for f in (0.05, 0.01, 0.0099)],
                                        button={1}))
        self.assertEqual(held["chosen"], ["N"])

    def test_colours_are_taken_from_ring_and_triangle(self):
        menu = '[[item]]\nname = "C"\nkind = "colour"\nvalue = "#ff0000"\n'
        wheel = self.layout(menu)["items"][0]["wheel"]
        centre = wheel["centre"]
        r = (wheel["inner"] + wheel["outer"]) / 2
        turned = math.radians(120)  # clockwise from the top: green
        ring = plus(centre, [math.sin(turned), math.cos(turned), 0], r)
        full, white, black = wheel["corners"]
        middle = [0.25 * f + 0.75 * w for f, w in zip(full, white)]  # a quarter as saturated, full value
        way = []
        for place in (ring, middle):
            way += [plus(place, [0, 0, 1], f) for f in (0.01, -0.006, 0.01)]
        tried = self.tried(menu, path_of(way), "--choose", "push")
        self.assertEqual([it["value"] for it in tried["choices"]], ["#00ff00", "#bfffbf"])
        # Dragged from the top of the ring a quarter round: one choice where it is let go.
        quarter = [plus(centre, [math.sin(math.radians(a)), math.cos(math.radians(a)), 0], r) for a in range(0, 61, 5)]
        drag = [plus(place, [0, 0, 1], 0.005) for place in (quarter[0], *quarter)]
        dragged = self.tried(menu, path_of([plus(quarter[0], [0, 0, 1], 0.05), *drag],
                                           button=set(range(1, len(drag)))))
        self.assertEqual([it["value"] for it in dragged["choices"]], ["#ffff00"])

    def test_pages_show_one_at_a_time(self):
        path = MENUS / "properties.toml"
        tabs = json.loads(self.succeeds("menu", path, "--json").stdout)["items"][0]
        self.assertEqual([it["name"] for it in tabs["items"]], ["Colour", "Size", "Shapes"])
        self.assertEqual([it["name"] for it in tabs["items"][1]["items"]], ["Times", "Radius", "Height", "Stiffness"])
        shapes = tabs["items"][2]["items"][0]
        self.assertEqual(shapes["items"][0]["name"], "box")
        header, row = tabs["items"][2]["centre"], shapes["items"][2]["centre"]
        toml = path.read_text().replace('at = "pointer"\n', "")
        way = []
        for place in (row, header, row):
            way += [plus(place, [0, 0, 1], f) for f in (0.01, -0.006, 0.01)]
        tried = self.tried(toml, path_of(way), "--choose", "push")
        self.assertEqual(tried["chosen"][-2:], ["Shapes", "sphere"])
        self.assertNotIn("sphere", tried["chosen"][:-1])

    def test_bad_files_are_told_by_line(self):
        done = self.fails("menu", self.write("menu.toml", "[[item]]\nname = 3\n"), "--json", code=1,
                          saying="menu.toml:2:8:")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.fails("menu", self.write("menu.toml", 'languages = []\n[[item]]\nname = "A"\ndefault = true\n'), code=1,
                   saying="menu.toml:1:13: the element: languages is empty")
        self.fails("menu", self.write("menu.toml", '[[item]]\nname = "A"\ndefault = true\n'), code=1,
                   saying="menu.toml:1:1: item 'A': only an item of a dialog")
        self.fails("menu", self.write("menu.toml", '[[item]]\nname = "L"\nkind = "list"\nrows = 4\n'), code=1,
                   saying="menu.toml:1:1: item 'L': it has no rows")
        self.fails("menu", self.folder / "none.toml", code=1, saying="none.toml")
        path = self.write("p.csv", "t,x,y,z,b\n0,0,0,0,2\n")
        self.fails("menu", MENUS / "clear.toml", "--path", path, code=1,
                   saying="p.csv:2: b, the button, is 0 (up) or 1 (down)")
        self.fails("menu", MENUS / "clear.toml", "--picture", self.folder / "menu.jpg", code=1, saying=".png")

    def test_a_daisy_lies_on_a_sphere_and_turns_with_the_hand(self):
        daisy = 'kind = "daisy"\ncentre = [0.1, 0.2, 0.3]\n' + "".join(f'[[item]]\nname = "N{i}"\n' for i in range(20))
        layout = self.layout(daisy)
        self.assertEqual(layout["kind"], "daisy")
        items = layout["items"]
        # All normals lead from one point, the middle of the sphere, which lies behind the element's place.
        front = items[0]
        self.assertAlmostEqual(math.dist(front["centre"], [0.1, 0.2, 0.3]), 0, places=9)
        side = next(it for it in items if it["normal"][2] < 0.9)
        radius = (front["centre"][2] - side["centre"][2]) / (1 - side["normal"][2])
        for item in items:
            self.assertAlmostEqual(math.dist(plus(item["centre"], item["normal"], -radius), [0.1, 0.2, 0.3 - radius]),
                                   0, places=9)
        # A hand goes as far in the plane as the item is away along the sphere.
        for item in (front, side, items[-1]):
            angle = math.acos(max(-1.0, min(1.0, item["normal"][2])))
            sine = math.hypot(*item["normal"][:2])
            aside = [radius * angle * n / sine if sine > 1e-9 else 0.0 for n in item["normal"][:2]]
            at = [0.1 + aside[0], 0.2 + aside[1], 0.3]
            way = [plus(at, (0, 0, 1), 0.05), plus(at, (0, 0, 1), -0.006), plus(at, (0, 0, 1), 0.03)]
            self.assertEqual(self.tried(daisy, path_of(way), "--choose", "push")["chosen"], [item["name"]])

    def test_what_a_head_looks_at_is_chosen(self):
        menu = TURNED % 30
        items = self.layout(menu)["items"]
        for item, chosen in ((items[0], ["Red"]), (items[1], []), (items[2], ["Blue"])):
            eye = plus(plus(item["centre"], item["normal"], 0.4), (0.1, 0.05, 0))
            way = plus(item["centre"], eye, -1)
            length = math.hypot(*way)
            # The shortest turn from -z to the way looked.
            x, y, z = (w / length for w in way)
            turn = [y, -x, 0.0, 1.0 - z]
            rows = ["t x y z qx qy qz qw"] + [" ".join(map(repr, [0.02 * i, *eye, *turn])) for i in range(30)]
            motion = self.write("head.txt", "\n".join(rows).replace("t x y z qx qy qz qw\n", "") + "\n")
            looked = json.loads(self.succeeds("menu", self.write("menu.toml", menu), "--path", motion, "--choose", "look",
                                              "--json").stdout)
            self.assertEqual(looked["chosen"], chosen)
            self.assertIsNone(looked["tick_us"])
            self.assertAlmostEqual(looked["near_s"], 0.58, places=6)
            self.assertEqual([it["by"] for it in looked["choices"]], ["look"] * len(chosen))
        self.fails("menu", MENUS / "clear.toml", "--path", self.write("head.txt", "0 0 0 0 0 0 0\n"), "--choose", "look",
                   code=1, saying="head.txt:1")

    def test_pictures_show_it_faded_and_opaque(self):
        out = self.folder / "menu.png"
        self.succeeds("menu", MENUS / "colours.toml", "--picture", out)
        self.assertEqual(out.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")
        pictures = set()
        for page in ("Any colour", "Radius", "polygon"):
            self.succeeds("menu", MENUS / "properties.toml", "--show", page, "--picture", out)
            pictures.add(out.read_bytes())
        self.assertEqual(len(pictures), 3)


if __name__ == "__main__":
    unittest.main()
