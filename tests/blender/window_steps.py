"""Steps of window_test.py. Each waits for a condition, so a slow machine only takes longer."""
import os
import sys
import time
import traceback
from pathlib import Path

import bpy

from pelagic_ocean import panel

folder = Path(sys.argv[-1])
patience_s = 240
bpy.context.preferences.view.show_splash = False
drawn = set()


def watched(section):
    as_written = section.draw

    def draw(self, context):  # Blender 3.4 crashes if it has defaults
        as_written(self, context)
        drawn.add(section.__name__)

    return draw


panel.unregister()
for each in panel.classes:
    each.draw = watched(each)
    each.bl_options = set()  # open, so that each is drawn
panel.register()


def window():
    return bpy.context.window_manager.windows[0]


def view():
    (area,) = [area for area in window().screen.areas if area.type == "VIEW_3D"]
    return area


def region(kind):
    return next(region for region in view().regions if region.type == kind)


def inside():
    return bpy.context.temp_override(window=window(), area=view(), region=region("WINDOW"))


def click(x, y):
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window().event_simulate(type=kind, value=value, x=x, y=y)


def press(key):
    window().event_simulate(type="MOUSEMOVE", value="NOTHING", x=view().x + 300, y=view().y + 300)
    window().event_simulate(type=key, value="PRESS")
    window().event_simulate(type=key, value="RELEASE")


def steps():
    """Yields the condition before each next step."""
    yield lambda: region("WINDOW").height > 400
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    with inside():
        bpy.ops.pelagic.add_ocean(preset="storm")
        view().spaces[0].show_region_ui = True
    sea = bpy.context.view_layer.objects.active.pelagic
    yield lambda: region("UI").width > 100
    # The tab is the last one on the sidebar's edge. Its position depends on the theme, so positions
    # are tried from above.
    sidebar = region("UI")
    for y in range(sidebar.y + sidebar.height - 100, sidebar.y + 300, -12):
        if "PELAGIC_PT_ocean" in drawn:
            break
        click(sidebar.x + sidebar.width - 8, y)
        until = time.monotonic() + 0.5
        yield lambda: time.monotonic() > until
    assert "PELAGIC_PT_ocean" in drawn, "the tab Pelagic is missing"
    yield lambda: {each.__name__ for each in panel.classes if "_PT_" in each.__name__} <= drawn
    with inside():
        bpy.ops.screen.screenshot(filepath=str(folder / "panel.png"))
    for preset in ("pond", "analytic-calm", "moderate"):
        drawn.clear()
        with inside():
            bpy.ops.pelagic.preset(preset=preset)
        view().tag_redraw()
        yield lambda: "PELAGIC_PT_waves" in drawn
    sea.cascade_side, sea.cascades = 100, 2
    drawn.clear()
    view().tag_redraw()
    assert sea.error
    yield lambda: "PELAGIC_PT_ocean" in drawn
    sea.cascade_side = sea.cascades = 0

    # Escape stops a bake, and the next bake continues to the end.
    sea.resolution, sea.bake_folder, sea.bake_start, sea.bake_end = 64, str(folder / "bake"), 1, 120
    into = folder / "bake" / "Ocean"
    journal, whole = into / "bake.journal", into / "sea.json"
    with inside():
        assert bpy.ops.pelagic.bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield lambda: (into / "foam_0003.png").exists()
    press("ESC")
    lines = [-1]

    def stands_still():
        """Returns whether the journal has as many lines as a second ago."""
        if time.monotonic() < stands_still.next:
            return False
        stands_still.next = time.monotonic() + 1
        lines.append(len(journal.read_text().splitlines()))
        return lines[-1] == lines[-2]

    stands_still.next = 0
    yield stands_still
    assert not sea.is_baked and not whole.exists() and 3 < lines[-1] < 121, lines
    with inside():
        bpy.ops.pelagic.bake("INVOKE_DEFAULT")
    yield lambda: sea.is_baked and whole.exists()
    print(f"stopped after {lines[-1] - 1} frames, and continued to the end")


def run():
    try:
        walk = steps()
        condition, since = next(walk), time.monotonic()

        def step():
            nonlocal condition, since
            try:
                if condition():
                    condition, since = next(walk), time.monotonic()
                assert time.monotonic() - since < patience_s, "a condition did not become true"
                return 0.05
            except StopIteration:
                print("window_steps passed", flush=True)
            except BaseException:
                traceback.print_exc()
            sys.stdout.flush()
            os._exit(0)

        bpy.app.timers.register(step, first_interval=0.5)
    except BaseException:
        traceback.print_exc()
        os._exit(1)


run()
