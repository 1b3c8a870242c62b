"""Writes the parts of bindings/csharp that follow from the C interface, and the .meta files that Unity wants.

    csharp.py [--check]
"""
import hashlib
import re
import textwrap

import interface

PACKAGE = "bindings/csharp"
TOLD = interface.read()
STRUCTS = {s.name: s for s in TOLD.structs}

# Structs that programs see.  Others keep the names of C, inside the binding.
VALUES = {  # come out of the library
    "sphc_map_info": "MapInfo", "sphc_depth_bias": "DepthBias", "sphc_keypoint": "Keypoint",
    "sphc_localizer_result": "LocalizerResult", "sphc_localizer_prediction": "LocalizerPrediction",
    "sphc_localizer_observation": "LocalizerObservation", "sphc_localizer_hypothesis": "LocalizerHypothesis",
    "sphc_localizer_parameter_range": "LocalizerParameterRange", "sphc_rig": "Rig"}
INPUTS = {  # go into it, and begin as the library says
    "sphc_aligner_config": "AlignerConfig", "sphc_localizer_config": "LocalizerConfig",
    "sphc_localizer_camera": "LocalizerCamera", "sphc_localizer_prior": "LocalizerPrior",
    "sphc_localizer_view": "LocalizerView", "sphc_localizer_depth_camera": "LocalizerDepthCamera",
    "sphc_localizer_depth_view": "LocalizerDepthView", "sphc_localizer_frame": "LocalizerFrame"}
BY_HAND = {"sphc_rigid": "Rigid", "sphc_camera": "CameraIntrinsics"}
PUBLIC = {**VALUES, **BY_HAND}
ENUMS = {
    "SPHC_": "Status", "SPHC_FORMAT_": "PixelFormat", "SPHC_CAMERA_": "CameraModel", "SPHC_BAND_": "Band",
    "SPHC_CONVENTION_": "Convention", "SPHC_ALIGNED_": "AlignedPixel", "SPHC_LOG_": "LogLevel",
    "SPHC_MODE_": "LocalizerMode", "SPHC_STATE_": "LocalizerState", "SPHC_PRIOR_": "PriorParts",
    "SPHC_OUTCOME_": "LocalizerOutcome", "SPHC_FAULT_": "Faults", "SPHC_CUT_": "Cuts", "SPHC_HINT_": "Hints",
    "SPHC_EVENT_": "PoseEvents", "SPHC_PARAMETER_": "LocalizerParameter", "SPHC_OBSERVATION_": "ObservationFlags"}
ENUM_OF_TYPE = {e.type: ENUMS[e.prefix] for e in TOLD.enums if e.type != "uint32_t"}
BITS = {("sphc_localizer_prior", "flags"): "PriorParts", ("sphc_localizer_observation", "flags"): "ObservationFlags",
        ("sphc_localizer_result", "faults"): "Faults", ("sphc_localizer_result", "cuts"): "Cuts",
        ("sphc_localizer_result", "hints"): "Hints", ("sphc_localizer_result", "events"): "PoseEvents"}
ARRAYS = {("double", 3): "Vector3d", ("double", 36): "PoseCovariance"}
BASES = {"void": "void", "char": "byte", "float": "float", "double": "double", "size_t": "UIntPtr", "uint8_t": "byte",
         "uint16_t": "ushort", "uint32_t": "uint", "int32_t": "int", "uint64_t": "ulong", "int64_t": "long"}
WORDS = {  # where C needs none
    "SPHC_CAMERA_": "How a camera maps bearings to pixels; the parameters follow each other as listed.",
    "SPHC_LOG_": "How much a line of the log matters.",
    "SPHC_OUTCOME_": "Whether a frame brought a pose, or why it did not.",
    "sphc_map_info": "What a map says of itself.",
    "sphc_aligner_config": "What an Aligner is made with; it begins with the library's defaults.",
    "sphc_localizer_config": "What a Localizer is made with; it begins with the library's defaults.",
    "sphc_localizer_prior": "What is known of a pose before its frame is looked at.",
    "sphc_localizer_observation": "What became of one keypoint of the last processed frame; for overlays and diagnosis.",
    "sphc_localizer_result": "What a frame brought.",
    "map_id": "The map, by the number that the program gave it.",
    "outcome": "Whether there is a pose, or why there is none.",
    "mode": "Whether frames belong together.",
    "rig": "The colour and the depth camera.",
    "flags": "What became of it.",
    "state": "How far the last pose is to be trusted.",
    "slope": "Change of the offset with z - MidM.",
    "camera_from_map": "Where the map is, seen from the camera: the pose.",
    "depth_offset_sigma_m": "1 sigma of what is unknown of the offset before the first frame; 0: nothing is learnt.",
    "depth_slope_sigma": "1 sigma of what is unknown of the slope before the first frame.",
    "camera": "What it is like.",
    "depth_time_ns": "Mid-exposure of the depth image.",
    "format_version": "Of its file.",
    "file_bytes": "Size of its file.",
    "mid_m": "The depth about which the slope turns.",
    "offset_m": "What is added to a depth at MidM.",
    "noise_scale": "How many times the config's noise the sensor's is.",
    "initial": "What it is where it was not set.",
    "lowest": "May be set to no less.",
    "highest": "May be set to no more.",
    "color_from_depth": "Where the depth camera is, seen from the colour camera.",
    "depth_unit_m": "Metres for each unit of the depth image."}
SKIPPED_CONSTANTS = ("VERSION", "ABI", "BYTES")  # of which the binding, or nobody, has a use
KEYWORDS = {"event": "@event", "params": "@params"}
FIELDS = {f.name for s in TOLD.structs for f in s.fields if "_" in f.name}


# ---- names and comments

def pascal(name):
    name = re.sub(r"_(m|rad)_s$", r"_\1_per_s", name)
    return "".join(part[:1].upper() + part[1:].lower() for part in name.split("_"))


def enum_value(prefix, name):
    return pascal(name[len(prefix):].removeprefix("E_") if prefix == "SPHC_" else name[len(prefix):])


NAMES = {name: f"{ENUMS[e.prefix]}.{enum_value(e.prefix, name)}" for e in TOLD.enums for name, _, _ in e.values}
NAMES.update({e.prefix: ENUMS[e.prefix] for e in TOLD.enums if e.prefix != "SPHC_"})
NAMES.update({**PUBLIC, **INPUTS, **ENUM_OF_TYPE, "sphc_localizer_result_confidence": "LocalizerResult.ConfidenceWithin"})
BARE = {name[len(e.prefix):]: enum_value(e.prefix, name) for e in TOLD.enums if e.prefix != "SPHC_" for name, _, _ in e.values}


def in_csharp(text):
    """A comment of the C header with the names that C# has."""
    def function(match):
        name = match.group(0)
        if name in NAMES:
            return NAMES[name]
        owner, _, rest = name.removeprefix("sphc_").partition("_")
        return f"{owner.capitalize()}.{pascal(rest)}" if owner in ("map", "aligner", "localizer", "features") and rest else name

    text = re.sub(r"sphc_\w+", function, text)
    text = re.sub(r"SPHC_\w+", lambda m: NAMES.get(m.group(0), "Limits." + pascal(m.group(0)[5:])), text)
    text = re.sub(r"\b(result|frame|config|rig|Rig|prior)\.([a-z]\w*)", lambda m: f"{m.group(1)}.{pascal(m.group(2))}", text)
    text = re.sub(r"(?<![\w.])[a-z]+(_[a-z0-9]+)+\b", lambda m: pascal(m.group(0)) if m.group(0) in FIELDS else m.group(0), text)
    return re.sub(r"(?<![\w.])[A-Z_]{2,}\b", lambda m: BARE.get(m.group(0), m.group(0)), text)


def doc(text, indent="  ", translated=in_csharp):
    """A <summary> of any length; nothing where there is no comment."""
    if not text:
        return ""
    text = translated(" ".join(text.split())).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    first = text if text.startswith("fx ") else text[:1].upper() + text[1:]
    text = first + ("" if text.endswith((".", "]")) else ".")
    start = f"{indent}/// "
    lines = textwrap.wrap(f"<summary>{text}</summary>", 117 - len(indent), initial_indent=start, subsequent_indent=start)
    return "\n".join(lines) + "\n"


def doc_of(field):
    return doc(field.comment or WORDS[field.name])


# ---- types

def pointed(base):
    return BASES.get(base) or PUBLIC.get(base) or ENUM_OF_TYPE.get(base) or base


def field_type(struct, field):
    key, told = (struct.name, field.name), field.type
    if told.base in TOLD.callbacks:
        return "IntPtr"
    if (told.base, told.length) in ARRAYS:
        return ARRAYS[told.base, told.length]
    return BITS.get(key) or pointed(told.base) + "*" * told.pointers


def parameter_type(told):
    return "IntPtr" if told.base in TOLD.callbacks else pointed(told.base) + "*" * (told.pointers or bool(told.length))


def hidden(field):
    return field.name == "struct_size" or field.name.startswith("reserved")


def raw_field(struct, field, name, access="internal"):
    kind = field_type(struct, field)
    if field.type.length and (field.type.base, field.type.length) not in ARRAYS:
        return f"internal fixed {kind} {KEYWORDS.get(field.name, field.name)}[{field.type.length}];"
    return f"{access} {kind} {name};"


# ---- what is written

HEAD = """// Generated by bindings/generate/csharp.py from spherecloud.json; do not edit.
using System;
using System.Runtime.InteropServices;

#pragma warning disable 0649, 0169  // what the library fills, the compiler does not see being set

namespace SphereCloud {
"""


def write(name, body):
    interface.write(f"{PACKAGE}/Runtime/Generated/{name}.cs", HEAD + body.rstrip("\n") + "\n}\n")


def enums():
    text = ""
    for e in TOLD.enums:
        bits = e.type == "uint32_t"
        text += doc(e.comment or WORDS[e.prefix], "")
        text += ("[Flags]\n" if bits else "") + f"public enum {ENUMS[e.prefix]} : {'uint' if bits else 'int'} {{\n"
        if bits:
            text += "  /// <summary>None of them.</summary>\n  None = 0,\n"
        for name, value, comment in e.values:
            text += doc(comment) or f"  /// <summary>{name} of C.</summary>\n"
            text += f"  {enum_value(e.prefix, name)} = {value},\n"
        text += "}\n\n"
    return text


def limits():
    text = "/// <summary>The limits of the C interface: the constants SPHC_.</summary>\npublic static class Limits {\n"
    for name, value in TOLD.constants.items():
        if not any(part in name for part in SKIPPED_CONSTANTS):
            kind = "double" if isinstance(value, float) else "uint" if value > 2**31 else "int"
            text += f"  /// <summary>{name} of the C interface.</summary>\n  public const {kind} {pascal(name[5:])} = {value!r};\n"
    return text + "}\n"


def value_struct(struct):
    text = doc(struct.comment or WORDS[struct.name], "")
    text += f"[StructLayout(LayoutKind.Sequential)]\npublic unsafe partial struct {VALUES[struct.name]} {{\n"
    for field in struct.fields:
        public = pascal(field.name)
        if hidden(field):
            text += f"  internal uint {field.name};\n"
        elif field.boolean:
            text += f"  internal uint {field.name};\n" + doc_of(field).replace("1: ", "True: ")
            text += f"  public bool {public} => {field.name} != 0;\n"
        else:
            text += doc_of(field)
            text += f"  {raw_field(struct, field, public, 'public')}\n"
    return text + "}\n\n"


def by_hand(field):
    """Borrowed memory and calls back: a person writes what a program sees of them."""
    return (hidden(field) or field.type.pointers or field.type.base in (*TOLD.callbacks, "sphc_image")
            or field.name in ("camera_count", "view_count", "depth_camera_count", "depth_view_count", "parallel_tasks"))


def input_class(struct):
    name = INPUTS[struct.name]
    text = doc(struct.comment or WORDS[struct.name], "")
    text += f"""public sealed unsafe partial class {name} {{
  internal Native.{struct.name} raw;

  /// <summary>Has the library's defaults.</summary>
  public {name}() {{
    Library.Require();
    fixed (Native.{struct.name}* p = &raw)
      SpherecloudException.Check(Native.{struct.name}_init(p, Size.Of(sizeof(Native.{struct.name}))));
  }}
"""
    for field in struct.fields:
        if not by_hand(field):
            kind = field_type(struct, field)
            text += "\n" + doc_of(field)
            text += f"  public {kind} {pascal(field.name)} {{ get {{ return raw.{field.name}; }} set {{ raw.{field.name} = value; }} }}\n"
    return text + "}\n\n"


def native():
    text = f"""/// <summary>The C interface as it is.</summary>
internal static unsafe class Native {{
#if (UNITY_IOS || UNITY_TVOS || UNITY_VISIONOS || UNITY_WEBGL) && !UNITY_EDITOR
  internal const string File = "__Internal";  // linked into the program
#else
  internal const string File = "spherecloud";
#endif
  internal const uint Abi = {TOLD.abi};
  internal const string Version = "{TOLD.version}";
  internal const int DescriptorBytes = {TOLD.constants['SPHC_DESCRIPTOR_BYTES']};
  internal const int StrideMaxBytes = {TOLD.constants['SPHC_STRIDE_MAX_BYTES']};

"""
    text += "".join(f"  internal struct {name} {{}}\n" for name in TOLD.opaque) + "\n"
    for struct in TOLD.structs:
        if struct.name not in PUBLIC:
            text += doc(struct.comment, translated=str) + f"  [StructLayout(LayoutKind.Sequential)]\n  internal struct {struct.name} {{\n"
            text += "".join(f"    {raw_field(struct, f, f.name)}\n" for f in struct.fields) + "  }\n\n"
    for function in TOLD.functions:
        words = ", ".join(f"{parameter_type(p.type)} {KEYWORDS.get(p.name, p.name)}" for p in function.parameters)
        text += doc(f"[{function.threads}] {function.comment or ''}".strip(), translated=str)
        text += "  [DllImport(File, CallingConvention = CallingConvention.Cdecl, ExactSpelling = true)]\n"
        text += f"  internal static extern {parameter_type(function.returns)} {function.name}({words});\n\n"
    return text.rstrip() + "\n}\n"


def layouts():
    """What the tests compare: sizes and offsets, on each machine of spherecloud.json."""
    machines = list(TOLD.structs[0].layouts)
    text = "/// <summary>Sizes and offsets of C, by machine, beside those that the compiler chose.</summary>\n"
    text += "internal static unsafe class GeneratedLayouts {\n  internal static readonly string[] Machines = {"
    text += ", ".join(f'"{m}"' for m in machines) + "};\n\n  internal static void Compare(LayoutTest test) {\n"
    for struct in TOLD.structs:
        kind = PUBLIC.get(struct.name) or f"Native.{struct.name}"
        told = ", ".join(str(struct.layouts[m]["bytes"]) for m in machines)
        offsets = "".join(offset_line(struct, f, machines) for f in struct.fields)
        text += f'    {{\n      var s = new {kind}();\n      byte* at = (byte*)&s;\n'
        text += f'      test.Same("{struct.name}", sizeof({kind}), {told});\n{offsets}    }}\n'
    return text + "  }\n}\n"


def offset_line(struct, field, machines):
    name = field.name
    if struct.name in VALUES and not hidden(field) and not field.boolean:
        name = name if "fixed" in raw_field(struct, field, name) else pascal(name)
    if struct.name == "sphc_rigid":
        name = {"q_wxyz": "Rotation", "t_m": "TranslationM"}[name]
    elif struct.name == "sphc_camera":
        name = KEYWORDS.get(name) or pascal(name)
    told = ", ".join(str(struct.layouts[m]["offsets"][field.name]) for m in machines)
    fixed = field.type.length and (field.type.base, field.type.length) not in ARRAYS and struct.name != "sphc_rigid"
    where = f"(byte*)s.{name}" if fixed else f"(byte*)&s.{name}"
    return f'      test.Same("{struct.name}.{field.name}", {where} - at, {told});\n'


# ---- what Unity wants beside each file

IMPORTERS = {".cs": "MonoImporter", ".asmdef": "AssemblyDefinitionImporter", ".md": "TextScriptImporter"}


def meta(path):
    guid = hashlib.md5(f"SphereCloud SDK: {path}".encode()).hexdigest()
    kind = IMPORTERS.get(path.suffix, "DefaultImporter") if path.name != "package.json" else "PackageManifestImporter"
    folder = "folderAsset: yes\n" if (interface.ROOT / PACKAGE / path).is_dir() else ""
    return (f"fileFormatVersion: 2\nguid: {guid}\n{folder}{kind}:\n  externalObjects: {{}}\n  userData: \n"
            "  assetBundleName: \n  assetBundleVariant: \n")


def is_of_package(path):
    """Not what compilers leave there, and no native library, which place_library.py puts there with its settings."""
    if path.parts[:2] == ("Runtime", "Plugins") and path.parts[2:] not in ((), ("README.md",)):
        return False
    return path.suffix != ".meta" and not any(part.endswith("~") or part[0] == "." or part in ("bin", "obj")
                                              for part in path.parts)


def metas():
    """Unity's settings for each file of the package and each folder."""
    root = interface.ROOT / PACKAGE
    files = {path.relative_to(root) for path in root.rglob("*") if path.is_file()}
    for path in sorted(files.union(*(file.parents[:-1] for file in files))):
        if is_of_package(path):
            interface.write(f"{PACKAGE}/{path}.meta", meta(path))


def versions():
    """The packages' version is the library's."""
    for name, pattern in ("package.json", r'("version": ")[^"]*'), ("SphereCloud.csproj", "(<Version>)[^<]*"):
        text = (interface.ROOT / PACKAGE / name).read_text(encoding="utf-8")
        interface.write(f"{PACKAGE}/{name}", re.sub(pattern, rf"\g<1>{TOLD.version}", text, count=1))


def main():
    write("Enums", enums() + limits())
    write("Values", "".join(value_struct(STRUCTS[name]) for name in VALUES))
    write("Inputs", "".join(input_class(STRUCTS[name]) for name in INPUTS))
    write("Native", native())
    interface.write("tests/bindings/csharp/GeneratedLayouts.cs", HEAD + layouts() + "}\n")
    versions()
    metas()


if __name__ == "__main__":
    main()
