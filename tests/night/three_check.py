# Serves docs/recipes/three as documented, opens it in headless Chromium, and compares its
# vertices with queries.
#
# usage: three_check.py FOLDER IMAGE.png PELAGIC RECIPE NODE_MODULES
import array
import http.server
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

from compare_with_query import compare

folder, image, pelagic, recipe, node_modules = sys.argv[1:]
record = json.loads((Path(folder) / "sea.json").read_text())
N, length = record["sea"]["resolution"], record["sea"]["patch_size_m"]
received = {}
is_over = threading.Event()


class Page(http.server.SimpleHTTPRequestHandler):
    def do_POST(self):
        received[self.path[1:]] = self.rfile.read(int(self.headers["Content-Length"]))
        self.send_response(204)
        self.end_headers()
        if self.path in ("/done", "/failed"):
            is_over.set()

    def log_message(self, *_):
        pass


with tempfile.TemporaryDirectory() as site:
    for file in Path(recipe).iterdir():
        shutil.copy(file, site)
    shutil.copy(Path(__file__).parent / "three_check.html", site)
    os.symlink(Path(folder).resolve(), Path(site) / "waves")
    os.symlink(Path(node_modules).resolve(), Path(site) / "node_modules")
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), lambda *a: Page(*a, directory=site))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    # Software GL, and no sandbox, because root cannot use it.
    browser = subprocess.Popen(["chromium", "--headless=new", "--no-sandbox", "--use-angle=swiftshader",
                                "--enable-unsafe-swiftshader", "--user-data-dir=" + site + "/profile",
                                f"http://127.0.0.1:{server.server_port}/three_check.html"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    is_over.wait(300)
    browser.terminate()
    browser.wait()

assert "done" in received, received.get("failed", b"the page sent nothing in five minutes").decode()
Path(image).write_bytes(received["image"])
for number in range(len(record["frames"])):
    floats = array.array("f", received[f"places_{number}"])
    places = [tuple(floats[4 * k:4 * k + 3]) for k in range((N + 1) ** 2)]
    compare(pelagic, folder, number, places)

    # The decoded normals differ from those of a query by up to half a byte. Compared with the
    # heights of the neighbours they show an exchanged or mirrored axis, the likely error here.
    gradients = array.array("f", received[f"gradients_{number}"])
    wrong = 0
    for j in range(1, N):
        for i in range(1, N):
            at = j * (N + 1) + i
            left, right, up, down = places[at - 1], places[at + 1], places[at - N - 1], places[at + N + 1]
            a, b = [r - l for l, r in zip(left, right)], [d - u for u, d in zip(up, down)]
            normal = [b[1] * a[2] - b[2] * a[1], b[2] * a[0] - b[0] * a[2], b[0] * a[1] - b[1] * a[0]]
            size = sum(n * n for n in normal) ** 0.5
            jacobian = normal[1] / (2 * length / N) ** 2
            said = gradients[4 * at:4 * at + 4]
            # A byte has a step of 2/255, so its value is within 1/255. The y of a unit vector
            # follows from the other components.
            off = max(abs(normal[0] / size - said[0]), abs(normal[2] / size - said[2]),
                      abs(max(-1, min(1, jacobian)) - said[3]))
            wrong += off > 1 / 255 + 1e-4
    print(f"frame {number}: {wrong} normals or Jacobians off by more than half a byte")
    assert wrong == 0
