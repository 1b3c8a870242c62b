"""Changes of spherecloud.h that somebody might make, for the tests of what compares interfaces."""
import pathlib
import re
import sys

SDK = pathlib.Path(__file__).resolve().parent.parent.parent / "sdk"
sys.path.insert(0, str(SDK.parent / "toolchains"))


def grown(text, struct, field):
    """One field more at the end of a struct."""
    return re.sub(r"\n\} %s;" % struct, f"\n  {field};\n}} {struct};", text)


def replaced(before, after):
    return lambda text: text.replace(before, after, 1)


def declared(more):
    """More declarations behind all others."""
    return lambda text: text.replace("\n#ifdef __cplusplus\n}", f"\n{more}\n\n#ifdef __cplusplus\n}}", 1)


def grown_and_changed(text):
    return grown(text, "sphc_localizer_result", "uint64_t added").replace("double confidence;", "int64_t confidence;", 1)


# What a program of the header before would not survive.
BREAKS = {
    "a field in the middle": replaced("  uint64_t seed;", "  uint64_t inserted;\n  uint64_t seed;"),
    "a field is gone": replaced("  uint64_t seed;", ""),
    "a field of another type": replaced("double confidence;", "int64_t confidence;"),
    "an atom that grew": lambda text: grown(text, "sphc_rigid", "double scale"),
    "a reserved field that is gone": replaced("  uint32_t reserved;\n  sphc_clock_fn clock;", "  sphc_clock_fn clock;"),
    "more in the place of a reserved field": replaced("  uint32_t reserved;\n  sphc_clock_fn clock;",
                                                      "  uint64_t wide;\n  sphc_clock_fn clock;"),
    "a struct that grew and changed": grown_and_changed,
    "a function is gone": replaced("SPHC_API void sphc_localizer_reset(sphc_localizer *localizer);", ""),
    "a parameter of another type": replaced("uint32_t point_index, double direction[3]);",
                                            "uint64_t point_index, double direction[3]);"),
    "a parameter more": replaced("SPHC_API uint32_t sphc_abi(void);", "SPHC_API uint32_t sphc_abi(uint32_t wanted);"),
    "a result of another type": replaced("SPHC_API uint32_t sphc_abi(void);", "SPHC_API double sphc_abi(void);"),
    "a callback of another type": replaced("const char *text, size_t length);", "const char *text, uint16_t length);"),
}
ADDITIONS = {
    "a config that grew": lambda text: grown(text, "sphc_localizer_config", "uint64_t added"),
    "a result that grew": lambda text: grown(text, "sphc_localizer_result", "double added[4]"),
    "an element that grew": lambda text: grown(text, "sphc_localizer_observation", "uint32_t added"),
    "a field in the place of a reserved one": replaced("  uint32_t reserved;\n  sphc_clock_fn clock;",
                                                       "  sphc_localizer_mode wanted;\n  sphc_clock_fn clock;"),
    "a function more": declared("SPHC_API sphc_status sphc_localizer_added(sphc_localizer *localizer);"),
    "a struct and a function more": declared("typedef struct sphc_added {\n  uint32_t struct_size, a;\n} sphc_added;\n"
                                             "SPHC_API void sphc_get_added(sphc_added *added);"),
}


def headers_with(folder, change=None):
    """Today's spherecloud.h, with a change where one is given, as folder/spherecloud/spherecloud.h."""
    text = (SDK / "include" / "spherecloud" / "spherecloud.h").read_text(encoding="utf-8")
    now = change(text) if change else text
    if change and now == text:
        raise ValueError("the change finds nothing to change")
    headers = pathlib.Path(folder) / "spherecloud"
    headers.mkdir(parents=True)
    (headers / "spherecloud.h").write_text(now, encoding="utf-8")
    return headers
