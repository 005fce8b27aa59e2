# The shader of Godot 4, translated to GLSL ES 3.0, which also converts no integers: its functions and the built-in
# variables that it uses compile. https://docs.godotengine.org/en/4.1/tutorials/shaders/shader_reference/spatial_shader.html
# usage: shader_test.py SHADER
import re
import subprocess
import sys
import tempfile
from pathlib import Path

text = Path(sys.argv[1]).read_text()
assert re.search(r"^shader_type spatial;$", text, re.M)
HINTS = {"filter_linear_mipmap", "filter_linear_mipmap_anisotropic", "repeat_enable", "source_color"}
BUILT_IN = {"vert": "vec3 VERTEX, NORMAL;", "frag": "vec3 NORMAL, ALBEDO; uniform vec3 VIEW; float ROUGHNESS, SPECULAR; uniform mat4 VIEW_MATRIX, INV_VIEW_MATRIX;"}


def uniform(match):
    hints = {hint.strip() for hint in (match["hints"] or "").split(",") if hint.strip()}
    assert hints <= HINTS, hints - HINTS
    return f"uniform {match['declared']};"


for stage, function, other, direction in (("vert", "vertex", "fragment", "out"), ("frag", "fragment", "vertex", "in")):
    body = re.sub(r"^shader_type \w+;\n", "", text, flags=re.M)
    body = re.sub(r"^uniform (?P<declared>\w+ \w+)\s*(?::(?P<hints>[^=;]*))?(?:=[^;]*)?;", uniform, body, flags=re.M)
    body = re.sub(r"^varying ", f"{direction} ", body, flags=re.M)
    body, removed = re.subn(rf"^void {other}\(\) \{{\n.*?^\}}\n", "", body, flags=re.M | re.S)
    assert removed == 1 and re.search(rf"^void {function}\(\)", body, re.M)
    head = "#version 300 es\nprecision highp float; precision highp int; precision highp sampler2DArray;\n"
    end = f"void main() {{ {function}(); " + ("gl_Position = vec4(VERTEX + NORMAL, 1.0); }" if stage == "vert" else "colour = vec4(ALBEDO + NORMAL, ROUGHNESS + SPECULAR); }")
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, f"sea.{stage}")
        file.write_text(head + BUILT_IN[stage] + ("out vec4 colour;" if stage == "frag" else "") + "\n" + body + end + "\n")
        run = subprocess.run(["glslangValidator", str(file)], capture_output=True, text=True)
        assert run.returncode == 0, run.stdout
