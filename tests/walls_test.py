"""Who may see whom: every #include and every linked library follows the arrows of ARCHITECTURE.md."""
import pathlib
import re
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parent.parent

# A room's folder, and the rooms that it stands on; what those stand on it may see, too.
STANDS_ON = {
    "renderengine/numerics": [],
    "renderengine/io": ["numerics"],
    "renderengine/digest": ["numerics"],
    "renderengine/film": ["io", "digest"],
    "renderengine/denoise": ["film"],
    "renderengine/scene": ["film"],
    "renderengine/vulkan": ["io"],
    "renderengine/kernels": ["numerics"],
    "renderengine/gpu": ["scene", "vulkan", "kernels"],
    "renderengine/techniques": ["gpu", "film"],
    "renderengine/blocks": ["scene", "film"],
    "proto": ["scene", "digest"],
    "proto/wire": ["proto", "techniques"],
    "terminal": ["film"],
    "farm/jobs": ["wire", "blocks"],
    "farm/nodes": ["jobs"],
    "client/study": ["jobs", "terminal"],
    "client/view": ["terminal"],
    "client": ["nodes", "terminal", "study", "view", "denoise"],
    "server/relay": ["nodes"],
    "server": ["relay", "terminal"],
}
# Whose a public header of the library is; those that are not named are everyone's.
PUBLIC = {
    "io/": ["io"], "sha256.h": ["digest"], "scene.h": ["scene"], "import_options.h": ["scene"], "events.h": ["film"], "film.h": ["film"], "exposure.h": ["film"],
    "film_layout.h": ["film"], "error_estimate.h": ["film"], "error_classes.h": ["film"],
    "flip.h": ["film"], "pictures.h": ["film"], "denoise.h": ["denoise"],
    "devices.h": ["vulkan"], "renderer.h": ["scene", "film"], "block_worker.h": ["scene", "film"],
    "engine.h": ["techniques"], "light_paths.h": ["techniques"], "scene_effects.h": ["techniques"],
}
FOLDER = {folder.rsplit("/")[-1]: folder for folder in STANDS_ON}
TARGETS = {f"antipode_{room}": room for room in FOLDER} | {"renderengine": "techniques", "antipode_net": "wire",
                                                           "antipode_schema": "proto"}
SUFFIXES = {".h", ".cpp", ".in"}


def reach(room):
    """The room itself and all that it may see."""
    return {room}.union(*(reach(below) for below in STANDS_ON[FOLDER[room]]))


def room_of(path):
    """Of a file or header by its path from the root, the room; nothing where it is in none."""
    while path:
        path = path.rpartition("/")[0]
        if path in STANDS_ON:
            return path.rsplit("/")[-1]
    return None


def owners(header):
    """The rooms that one must be able to see to include this; nothing where it is no header of the project."""
    if header.startswith("renderengine/"):
        name = header.removeprefix("renderengine/")
        return next((rooms for prefix, rooms in PUBLIC.items() if name.startswith(prefix)), [])
    room = room_of(header) or room_of("renderengine/" + header)
    return [room] if room else []


def is_private(header):
    """Whether it is a header of a room of the library and not among its public ones."""
    if (ROOT / "renderengine/include" / header).is_file() or header == "renderengine/version.h":
        return False
    return header.startswith("renderengine/") or room_of("renderengine/" + header) is not None


def faults(root):
    """One sentence for each include or link against the arrows."""
    found = []
    for folder in STANDS_ON:
        for path in sorted((root / folder).rglob("*")):
            name = path.relative_to(root).as_posix()
            room = room_of(name)
            if FOLDER.get(room) != folder or not path.is_file():
                continue
            if path.suffix in SUFFIXES:
                for header in re.findall(r'^\s*#include ["<]([^">]+)[">]', path.read_text(), re.MULTILINE):
                    if not folder.startswith(("renderengine/", "proto")) and is_private(header):
                        found.append(f"{name} includes {header}, which is private to the library")
                        continue
                    found += [f"{name} includes {header}, but {room} may not see {other}"
                              for other in owners(header) if other not in reach(room)]
            if path.name == "CMakeLists.txt":
                calls = re.findall(r"target_link_libraries\((\w+)([^)]*)\)", path.read_text())
                for target, libraries in calls:
                    found += [f"{name}: {target} links {library}, but {TARGETS[target]} may not see {TARGETS[library]}"
                              for library in libraries.split()
                              if target in TARGETS and library in TARGETS
                              and TARGETS[library] not in reach(TARGETS[target])]
    return found


class Walls(unittest.TestCase):
    def test_hold(self):
        self.assertEqual(faults(ROOT), [])

    def test_every_room_has_sources(self):
        for folder in STANDS_ON:
            self.assertTrue(any(SUFFIXES & {f.suffix} for f in (ROOT / folder).rglob("*.*")), folder)

    def test_no_public_header_shows_what_is_behind_it(self):
        for header in (ROOT / "renderengine/include").rglob("*.h"):
            for other in re.findall(r'#include ["<]([^">]+)[">]', header.read_text()):
                self.assertTrue(other.startswith("renderengine/") or "/" not in other and not other.endswith(".h"),
                                f"{header.name} includes {other}")

    def check(self, name, content, *words):
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place) / name
            path.parent.mkdir(parents=True)
            path.write_text(content)
            found = faults(pathlib.Path(place))
            self.assertEqual(len(found), 1 if words else 0, found)
            for word in words:
                self.assertIn(word, found[0])

    def test_find_an_include_against_the_arrows(self):
        self.check("renderengine/film/a.cpp", '#include "scene/affine.h"\n', "film/a.cpp", "scene/affine.h")
        self.check("renderengine/gpu/a.h", '#include "renderengine/engine.h"\n', "may not see techniques")
        self.check("farm/jobs/a.cpp", '#include "farm/nodes/farm.h"\n', "jobs may not see nodes")
        self.check("terminal/a.cpp", '#include "farm/jobs/merge.h"\n', "terminal may not see jobs")
        self.check("renderengine/scene/a.cpp", '#include "renderengine/film.h"\n#include "scene/affine.h"\n')

    def test_find_an_include_of_what_is_private_to_the_library(self):
        self.check("client/a.cpp", '#include "scene/lamp_units.h"\n', "scene/lamp_units.h, which is private")
        self.check("server/a.cpp", '#include "renderengine/scene/lamp_units.h"\n', "which is private")
        self.check("client/a.cpp", '#include "renderengine/scene.h"\n#include "renderengine/version.h"\n'
                                   '#include "renderengine/io/text.h"\n#include "proto/scene_loader.h"\n')
        self.check("proto/a.cpp", '#include "scene/scene_fields.h"\n')

    def test_find_a_library_linked_against_the_arrows(self):
        self.check("renderengine/scene/CMakeLists.txt",
                   "target_link_libraries(antipode_scene\n  PUBLIC antipode_film PRIVATE antipode_gpu)",
                   "antipode_scene links antipode_gpu")


if __name__ == "__main__":
    unittest.main()
