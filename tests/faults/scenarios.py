"""The commands that write, and one that does not, on inputs as small as they can be."""
import dataclasses
import os
import pathlib
import shutil
import subprocess
import typing

KEY = pathlib.Path(__file__).resolve().parent.parent / "pipeline" / "test_key.txt"
FEW_POINTS = ["--max-keypoints", 150]


@dataclasses.dataclass
class Scenario:
    name: str
    arguments: list
    prepare: typing.Callable = lambda folder: None  # makes the files that were there before
    secret: str = ""
    is_recording: bool = False  # or a key or a calibration: never replaced, nor what a killed command left of one
    keeps_cut: bool = False  # what was recorded stays as NAME.part
    by_chains: bool = False  # of allocations, which are too many, the first of each chain of callers fails


class Scenarios:
    NAMES = ["version", "build", "build first", "build model", "map", "map refine", "localize", "convert", "convert folder", "convert 7scenes",
             "convert raw", "record", "record guide", "guide", "doctor", "calibration", "inspect", "advise", "audit", "live", "simulate", "key", "key encryption", "sign", "encrypt", "decrypt"]
    QUICK = ["build model", "convert", "calibration"]

    def __init__(self, tool, folder):
        self.tool, self.inputs = tool, folder / "inputs"
        self.inputs.mkdir()
        self.walk = self.inputs / "walk.mcap"
        self.run("simulate", "--out", self.walk, "--frames", 4, "--rate", 6.25)
        self.key = self.inputs / "key.txt"
        shutil.copy(KEY, self.key)
        self.key.chmod(0o600)
        self.secret = self.key.read_text().strip().lower()

    def run(self, *arguments):
        command = [str(part) for part in (self.tool, *arguments)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL, env=dict(os.environ, PATH="/nonexistent"))

    def frames(self, last):
        return ["--recording", self.walk, "--last", last, *FEW_POINTS]

    def build(self, folder, last, *more):
        self.run("build", *self.frames(last), "--map", folder / "room.sphc", "--key", self.key, *more)

    def model(self, last):
        path = self.inputs / ("room%d.model" % last)
        if not path.exists():
            self.build(self.fresh("model%d" % last), last, "--save-model", path)
        return path

    def released(self):
        folder = self.inputs / "released"
        if not folder.exists():
            self.build(self.fresh("released"), 3)
        return folder

    def fresh(self, name):
        folder = self.inputs / name
        folder.mkdir()
        return folder

    def make(self, name):
        scenario = getattr(self, "make_" + name.replace(" ", "_"))()
        return dataclasses.replace(scenario, name=name)

    def make_version(self):
        return Scenario("", ["--version"])

    def make_build(self):  # an update of a place
        arguments = ["build", *self.frames(3), "--map", "room.sphc", "--save-model", "room.model"]
        return Scenario("", arguments, lambda folder: self.build(folder, 1, "--save-model", folder / "room.model"), self.secret)

    def make_build_first(self):
        return Scenario("", ["build", *self.frames(1), "--map", "room.sphc", "--key", self.key], secret=self.secret)

    def make_build_model(self):
        before, after = self.model(1), self.model(3)

        def prepare(folder):
            self.run("build", "--model", before, "--map", folder / "room.sphc", "--key", self.key)
        return Scenario("", ["build", "--model", after, "--map", "room.sphc"], prepare, self.secret)

    def make_map(self, *more):
        outputs = ["--model", "room.model", "--trajectory", "walk.tum", *more]

        def prepare(folder):
            self.run("map", *self.frames(2), *[folder / part if "." in part else part for part in outputs[:4]])  # no calibration is replaced
        return Scenario("", ["map", *self.frames(3), *outputs, "--threads", 1], prepare, by_chains=True)

    def make_map_refine(self):
        # A calibration is never replaced either.
        return dataclasses.replace(self.make_map("--refine-calibration", "refined.json"), is_recording=True)

    def make_localize(self):
        outputs = ["--trajectory", "walk.tum", "--frames-json", "frames.jsonl", "--report", "report"]
        room = self.released() / "room.sphc"
        source = ["--recording", self.walk, "--map", room, "--owner-note", "%s.owner.json" % room]

        def prepare(folder):
            self.run("localize", *source, "--last", 1, *[folder / part if part[0] != "-" else part for part in outputs])
        return Scenario("", ["localize", *source, "--last", 3, *outputs], prepare, by_chains=True)

    def make_convert(self):
        return Scenario("", ["convert", self.walk, "out.mcap"], is_recording=True)

    def make_convert_folder(self):
        return Scenario("", ["convert", self.walk, "out"], is_recording=True, by_chains=True)

    def make_convert_7scenes(self):
        return Scenario("", ["convert", self.walk, "out", "--to", "7scenes"], is_recording=True, by_chains=True)

    def make_convert_raw(self):
        return Scenario("", ["convert", self.walk, "out.raw"], is_recording=True)

    def make_record(self):
        return Scenario("", ["record", "--device", "replay:%s" % self.walk, "--out", "out.mcap"], is_recording=True, keeps_cut=True)

    def make_record_guide(self):
        return Scenario("", ["record", "--device", "replay:%s" % self.walk, "--out", "out.mcap", "--guide"], is_recording=True, keeps_cut=True)

    def make_guide(self):
        return Scenario("", ["guide", "--recording", self.walk, "--json"])

    def make_doctor(self):
        return Scenario("", ["doctor", "--device", "replay:%s" % self.walk, "--frames", 4])

    def make_calibration(self):
        ours = self.inputs / "rig.json"
        if not ours.exists():
            self.run("convert", self.walk, self.inputs / "rig")
            shutil.copy(self.inputs / "rig" / "calibration.json", ours)

        def prepare(folder):
            self.run("calibration", ours, "--out", folder / "rig.yaml", "--to", "opencv", "--depth-unit", 0.002)
        return Scenario("", ["calibration", ours, "--out", "rig.yaml", "--to", "opencv", "--force"], prepare)

    def make_inspect(self):
        def prepare(folder):
            (folder / "sky.png").write_bytes(b"")
        return Scenario("", ["inspect", self.released() / "room.sphc", "--picture", "sky.png"], prepare, by_chains=True)

    def make_advise(self):
        return Scenario("", ["advise", "--recording", self.walk, "--last", 3, "--folds", 2, "--picture", "sky.png"], by_chains=True)

    def make_audit(self):
        ledger, room = self.released() / "spherecloud.ledger", self.released() / "room.sphc"
        arguments = ["audit", room, "--truth", ledger, "--only", "file", "--report", "report", "--figures", "figures.csv"]
        others = ["file.cues_sigma", "density", "real_or_fake", "inversion", "triangulation", "intersection.gain"]
        allowed = [part for name in others for part in ("--allow-unmeasured", name)]
        return Scenario("", [*arguments, *allowed], secret=self.secret)

    def make_live(self):
        return Scenario("", ["live", "--device", "replay:%s" % self.walk, "--map", self.released() / "room.sphc", "--every", "--json"])

    def make_key(self):  # a key that is there is never replaced
        return Scenario("", ["key", "--out", "maps.key"], is_recording=True)

    def make_key_encryption(self):
        return Scenario("", ["key", "--for", "encryption", "--out", "rooms.key"], is_recording=True)

    def key_for(self, use):
        path = self.inputs / ("%s.key" % use)
        if not path.exists():
            self.run("key", "--for", use, "--out", path)
        return path

    def secret_of(self, key):
        return key.read_text().split()[-1]

    def make_sign(self):
        room, key = self.released() / "room.sphc", self.key_for("signatures")

        def prepare(folder):
            self.run("sign", room, "--key", key, "--release", 1, "--out", folder / "room.sig")
        return Scenario("", ["sign", room, "--key", key, "--release", 2, "--out", "room.sig"], prepare, self.secret_of(key))

    def make_encrypt(self):
        room, key = self.released() / "room.sphc", self.key_for("encryption")

        def prepare(folder):
            self.run("encrypt", room, "--key", key, "--out", folder / "room.enc")
        return Scenario("", ["encrypt", room, "--key", key, "--out", "room.enc"], prepare, self.secret_of(key))

    def make_decrypt(self):
        room, key, encrypted = self.released() / "room.sphc", self.key_for("encryption"), self.inputs / "room.enc"
        if not encrypted.exists():
            self.run("encrypt", room, "--key", key, "--out", encrypted)
        return Scenario("", ["decrypt", encrypted, "--key", key, "--out", "room.again"], lambda folder: None, self.secret_of(key), is_recording=True)

    def make_simulate(self):
        return Scenario("", ["simulate", "--out", "walk", "--frames", 1, "--threads", 1], is_recording=True, by_chains=True)
