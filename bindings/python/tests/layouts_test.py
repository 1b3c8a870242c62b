"""Structs lie in memory as the interface says, and enums have its names."""
import ctypes
import json
import pathlib
import platform
import unittest

import spherecloud as sphc
from spherecloud import _answers, _interface, _library

JSON = pathlib.Path(__file__).parents[3] / "sdk" / "include" / "spherecloud" / "spherecloud.json"
MACHINES = {"x86_64": "x86_64-linux-gnu", "aarch64": "aarch64-linux-gnu", "riscv64": "riscv64-linux-gnu",
            "i686": "i686-linux-gnu", "armv7l": "armv7-linux-gnueabihf"}
NAMED = {sphc.Status: "status", sphc.Format: "format", sphc.CameraModel: "camera_model", sphc.Band: "band",
         sphc.Convention: "convention", sphc.AlignedPixel: "aligned_pixel", sphc.LogLevel: "log_level",
         sphc.Mode: "localizer_mode", sphc.State: "localizer_state", sphc.Outcome: "localizer_outcome",
         sphc.Parameter: "localizer_parameter", sphc.Fault: "localizer_fault", sphc.Cut: "localizer_cut",
         sphc.Hint: "localizer_hint", sphc.Event: "localizer_event"}


class Layouts(unittest.TestCase):
    def setUp(self):
        told = json.loads(JSON.read_text(encoding="utf-8"))
        self.structs = [s for s in told["structs"] if s["header"] == "spherecloud.h"]
        self.machine = MACHINES[platform.machine()]

    def test_structs(self):
        self.assertEqual(len(self.structs), 25)
        self.assertEqual(set(MACHINES.values()), set(self.structs[0]["layouts"]), "each machine of the interface is known here")
        for struct in self.structs:
            bound, layout = getattr(_interface, struct["name"]), struct["layouts"][self.machine]
            self.assertEqual(ctypes.sizeof(bound), layout["bytes"], struct["name"])
            self.assertEqual(ctypes.alignment(bound), layout["alignment"], struct["name"])
            for name, offset in layout["offsets"].items():
                self.assertEqual(getattr(bound, name).offset, offset, f"{struct['name']}.{name}")

    def test_structured_arrays(self):
        for made, name in ((_answers.OBSERVATION, "sphc_localizer_observation"), (_answers.KEYPOINT, "sphc_keypoint")):
            bound = getattr(_interface, name)
            self.assertEqual(made.itemsize, ctypes.sizeof(bound))
            for field in made.names:
                self.assertEqual(made.fields[field][1], getattr(bound, field).offset)

    def test_the_library_names_the_values_so(self):
        for made, name in NAMED.items():
            call = getattr(_library.interface(), f"sphc_{name}_name")
            for value in made:
                self.assertRegex(call(value).decode(), rf"^SPHC_(\w+_)?{value.name}$")

    def test_versions(self):
        self.assertEqual(sphc.version(), sphc.__version__)
        project = (pathlib.Path(__file__).parents[1] / "pyproject.toml").read_text(encoding="utf-8")
        self.assertIn(f'version = "{sphc.__version__.replace("-rc", "rc")}"', project)  # as PyPI writes it


if __name__ == "__main__":
    unittest.main()
