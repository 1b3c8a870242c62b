#!/usr/bin/env python3
"""A binding that is made of spherecloud.json alone, with ctypes: does the library answer to it?

    bind_from_json.py SPHERECLOUD_JSON LIBRARY CONVENTIONS_CSV
"""
import csv
import ctypes
import json
import platform
import re
import sys
import unittest

BASE = {"void": None, "char": ctypes.c_char, "float": ctypes.c_float, "double": ctypes.c_double, "size_t": ctypes.c_size_t,
        **{f"{u}int{bits}_t": getattr(ctypes, f"c_{u}int{bits}") for u in ("", "u") for bits in (8, 16, 32, 64)}}
MACHINES = {"x86_64": "x86_64-linux-gnu", "aarch64": "aarch64-linux-gnu", "riscv64": "riscv64-linux-gnu", "i686": "i686-linux-gnu",
            "armv7l": "armv7-linux-gnueabihf"}


class Binding:
    def __init__(self, told, library):
        self.told, self.types = told, dict(BASE)
        for name, base in told["types"].items():
            self.types[name] = BASE[base]
        for callback in told["callbacks"]:
            self.types[callback["name"]] = ctypes.c_void_p
        for struct in told["structs"]:
            fields = [(f["name"], self.type_of(f["type"])) for f in struct["fields"]]
            self.types[struct["name"]] = type(struct["name"], (ctypes.Structure,), {"_fields_": fields})
        self.functions = {f["name"]: self.bind(f, library) for f in told["functions"]}
        self.constants = {v["name"]: v["value"] for e in told["enums"] for v in e["values"]}

    def type_of(self, spelling):
        array = re.fullmatch(r"(.*?)\[(\d+)\]", spelling)
        if array:
            return self.type_of(array.group(1)) * int(array.group(2))
        if spelling in ("const char *", "char *"):
            return ctypes.c_char_p
        if "*" in spelling:
            return ctypes.c_void_p
        return self.types[spelling.replace("const ", "").strip()]

    def bind(self, told, library):
        function = getattr(library, told["name"])
        function.restype = self.type_of(told["returns"])
        function.argtypes = [self.type_of(re.sub(r"\[\d*\]", "*", p["type"])) for p in told["parameters"]]
        return function


class FromJson(unittest.TestCase):
    def setUp(self):
        with open(ARGUMENTS[0], encoding="utf-8") as stream:
            self.told = json.load(stream)
        self.binding = Binding(self.told, ctypes.CDLL(ARGUMENTS[1]))

    def call(self, name, *arguments):
        return self.binding.functions[name](*arguments)

    def made(self, name):
        return self.binding.types[name]()

    def test_layouts_are_those_of_this_machine(self):
        machine = MACHINES[platform.machine()]
        for struct in self.told["structs"]:
            bound, layout = self.binding.types[struct["name"]], struct["layouts"][machine]
            self.assertEqual(ctypes.sizeof(bound), layout["bytes"], struct["name"])
            self.assertEqual(ctypes.alignment(bound), layout["alignment"], struct["name"])
            for name, offset in layout["offsets"].items():
                self.assertEqual(getattr(bound, name).offset, offset, f"{struct['name']}.{name}")

    def test_the_library_answers(self):
        self.assertEqual(self.call("sphc_version_string").decode(), self.told["version"])
        self.assertEqual(self.call("sphc_abi"), self.told["abi"])
        config = self.made("sphc_localizer_config")
        self.assertEqual(self.call("sphc_localizer_config_init", ctypes.byref(config), ctypes.sizeof(config)), 0)
        self.assertEqual(config.struct_size, ctypes.sizeof(config))
        self.assertEqual(config.rig.color_from_depth.q_wxyz[0], 1)
        for camera in (config.rig.color_camera, config.rig.depth_camera):
            camera.model, camera.width, camera.height, camera.param_count = self.binding.constants["SPHC_CAMERA_PINHOLE"], 640, 480, 4
            camera.params[:4] = 500, 500, 320, 240
        need, message = self.made("sphc_memory"), self.made("sphc_message")
        self.assertEqual(self.call("sphc_localizer_memory", ctypes.byref(config), ctypes.byref(need), ctypes.byref(message)), 0)
        self.assertGreater(need.scratch_bytes, 640 * 480)
        config.max_maps = 0
        refused = self.call("sphc_localizer_memory", ctypes.byref(config), ctypes.byref(need), ctypes.byref(message))
        self.assertEqual(refused, self.binding.constants["SPHC_E_ARGUMENT"])
        self.assertIn("max_maps", message.text.decode())

    def test_constants_have_the_names_that_the_library_gives(self):
        named = {f["parameters"][0]["type"]: f["name"] for f in self.told["functions"] if f["name"].endswith("_name")}
        for enum in self.told["enums"]:
            for value in enum["values"] if enum["type"] in named and enum["type"] != "uint32_t" else ():
                self.assertEqual(self.call(named[enum["type"]], value["value"]).decode(), value["name"])

    def assert_numbers(self, found, wanted):
        self.assertEqual(len(found), len(wanted))
        self.assertLess(max(abs(f - w) for f, w in zip(found, wanted)), 1e-12, f"{list(found)} is not {wanted}")

    def test_poses_of_other_systems(self):
        with open(ARGUMENTS[2], encoding="utf-8", newline="") as stream:
            vectors = list(csv.DictReader(stream))
        self.assertGreater(len(vectors), 60)
        for vector in vectors:
            with self.subTest(scene=vector["scene"], convention=vector["convention"]):
                self.compare_poses(vector)

    def compare_poses(self, vector):
        def numbers(name):
            return [float(value) for key, value in vector.items() if key.startswith(name + "_") and value]

        def rigid(name):
            values = numbers(name) or [1] + [0] * 6
            made = self.made("sphc_rigid")
            made.q_wxyz[:], made.t_m[:] = values[:4], values[4:]
            return made

        def call(name, *arguments):
            message = self.made("sphc_message")
            done = self.call("sphc_convention_" + name, self.binding.constants["SPHC_CONVENTION_" + vector["convention"]],
                             *arguments, ctypes.byref(message))
            self.assertEqual(done, 0, message.text.decode())

        world, camera, found = rigid("world_from_map"), rigid("camera_from_map"), self.made("sphc_rigid")
        told = ctypes.byref(world) if numbers("world_from_map") else None
        pose = (ctypes.c_double * 7)()
        if numbers("up_map"):
            call("make_world", (ctypes.c_double * 3)(*numbers("up_map")), ctypes.byref(found))
            self.assert_numbers([*found.q_wxyz, *found.t_m], numbers("world_from_map"))
        call("write_camera", told, ctypes.byref(camera), pose)
        self.assert_numbers(pose, numbers("camera_pose"))
        call("read_camera", told, (ctypes.c_double * 7)(*numbers("camera_pose")), ctypes.byref(found))
        self.assert_numbers([*found.q_wxyz, *found.t_m], numbers("camera_from_map"))
        call("write_map", ctypes.byref(world), pose)
        self.assert_numbers(pose, numbers("map_pose"))
        call("read_map", (ctypes.c_double * 7)(*numbers("map_pose")), ctypes.byref(found))
        self.assert_numbers([*found.q_wxyz, *found.t_m], numbers("world_from_map") or [1] + [0] * 6)

    def test_everything_is_said(self):
        for function in self.told["functions"]:
            self.assertIn(function["threads"], ("pure", "shared", "exclusive"), function["name"])
        for struct in self.told["structs"]:
            self.assertEqual(len(struct["layouts"]), 5)
        self.assertEqual({"sphc_map", "sphc_aligner", "sphc_features", "sphc_localizer", "sphc_pairer", "sphc_clock_mapper"},
                         set(self.told["opaque"]))


if __name__ == "__main__":
    ARGUMENTS = sys.argv[1:4]
    unittest.main(argv=sys.argv[:1])
