# Runs a script in Godot, and groups the lines that begin with SAYS by their second word.
import os
import subprocess
from pathlib import Path

# Errors that Debian's build prints for any project, in a new home directory and for its locale.
KNOWN_ERRORS = ("ERROR: make_dir_recursive: Method failed.", "ERROR: get_language_code: Invalid locale",
                "ERROR: set_locale: Unsupported locale")


def run(command, home, environment, timeout_s):
    done = subprocess.run(command, timeout=timeout_s, capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          env={**os.environ, "HOME": str(home), "XDG_DATA_HOME": str(home), "XDG_CONFIG_HOME": str(home),
                               "XDG_CACHE_HOME": str(home), **environment})
    lines = (done.stdout + done.stderr).splitlines()
    text = "\n".join(lines)
    assert done.returncode == 0, f"{command}: {done.returncode}\n{text}"
    errors = [line for line in lines if ("ERROR" in line or "WARNING" in line) and not line.startswith(KNOWN_ERRORS)]
    assert not errors, "\n".join(errors[:5])
    says = {"lines": lines}
    for line in lines:
        if line.startswith("SAYS "):
            _, kind, *rest = line.split(" ", 2)
            says.setdefault(kind, []).append(rest[0] if rest else "")
    return says


def run_headless(project, script, home, environment, fps=None):
    fixed = ["--fixed-fps", str(fps)] if fps else []  # frames advance the engine's clock by 1 / fps
    return run(["godot3-server", "--path", str(project), *fixed, "-s", str(script)], home, environment, 280)


def run_drawing(project, script, home, environment, fps=None):
    """Runs a script in a window of 64 x 36. Scripts that save images render to viewports of their
    own."""
    fixed = ["--fixed-fps", str(fps)] if fps else []
    return run(["xvfb-run", "-a", "-s", "-screen 0 1280x800x24", "godot3", "--path", str(project), "--audio-driver", "Dummy",
                "--resolution", "64x36", *fixed, "-s", str(script)], home, environment, 560)


def single(says, kind):
    [words] = says[kind]
    return words
